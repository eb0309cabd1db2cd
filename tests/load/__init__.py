"""A class of students on one server: ``python -m tests.load --clients 30``."""
