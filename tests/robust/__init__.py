"""What no input and no speed of clicking may do."""
