"""Print the times of the library's costly calls: ``python -m tests.benchmarks
[TOPIC]``.

A topic is a module of this folder that has a function ``rows``.
"""

import importlib
import pkgutil
import sys

import tests.benchmarks
from tests.benchmarks.table import print_table


def topics() -> dict:
    """Return the functions that give rows, by the name of their module."""
    names = [module.name for module in pkgutil.iter_modules(tests.benchmarks.__path__)]
    modules = {
        name: importlib.import_module(f"tests.benchmarks.{name}")
        for name in sorted(names)
        if name != "__main__"
    }
    return {name: m.rows for name, m in modules.items() if hasattr(m, "rows")}


def main(chosen: list[str]) -> None:
    found = topics()
    unknown = set(chosen) - set(found)
    if unknown:
        sys.exit(f"topics are {', '.join(found)}; got {', '.join(sorted(unknown))}")
    print_table([row for name in chosen or found for row in found[name]()])


if __name__ == "__main__":
    main(sys.argv[1:])
