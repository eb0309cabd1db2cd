"""Decoders of images and PDFs, run in a process of their own.

Nothing here imports the rest of `occsim`, whose imports take longer than most drawings:
see ``__main__``.
"""
