"""Every example of the library's docstrings runs as it stands."""

import doctest
import importlib
import inspect
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


@pytest.mark.parametrize("name", occsim.__all__)
def test_every_public_name_has_an_example(name):
    value = inspect.unwrap(getattr(occsim, name))
    text = inspect.getdoc(value)
    if not (inspect.isclass(value) or inspect.isfunction(value)):
        # The text of a constant stands below it, in the module that defines it.
        home = inspect.getmodule(type(next(iter(value.values()))))
        text = inspect.getsource(home).partition(f"\n{name}")[2]
    _, _, examples = text.partition("Examples\n--------\n")
    assert ">>> " in examples
