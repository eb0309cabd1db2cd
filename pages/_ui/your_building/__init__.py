"""The page "Your building": one module for each of its sections."""
