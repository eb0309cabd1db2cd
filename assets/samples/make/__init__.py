"""The script that makes the reference drawings, their ground truths and tours."""
