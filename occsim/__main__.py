"""Run the command line: ``python -m occsim``."""

from occsim.cli import main

raise SystemExit(main())
