"""Every example of the library's docstrings runs as it stands."""

import doctest
import importlib
import pkgutil

import pytest

import occsim

MODULES = [
    module.name
    for module in pkgutil.walk_packages(occsim.__path__, "occsim.")
    if not module.name.endswith(("__main__", "elitism"))  # runs; imports pymoo
]


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_of_a_module_run(name):
    assert doctest.testmod(importlib.import_module(name)).failed == 0
