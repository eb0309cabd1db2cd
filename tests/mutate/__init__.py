"""Kept mutations: small faults that the tests must notice."""
