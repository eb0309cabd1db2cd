"""Tests with damaged input and fast clicking."""
