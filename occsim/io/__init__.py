"""Adapters between the library and outside formats, one module each."""
