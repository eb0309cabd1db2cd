"""The command line: ``occsim``, or ``python -m occsim``."""

import argparse
import os
import sys
from collections.abc import Sequence

from occsim import __version__
from occsim.cli import claims, exercises, study
from occsim.errors import OccsimError

PROG = "occsim"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : sequence of str, optional
        Those of the process by default.

    Returns
    -------
    int
        Exit status: 0; 1 where an exercise is refused; 2 after a message on bad input,
        or where no drawing gave a result; 128 plus the signal's number for a command
        that was interrupted or whose output pipe was closed.
    """
    options = _parser().parse_args(arguments)
    try:
        return options.run(options) or 0
    except BrokenPipeError:
        # The reader closed the pipe (``| head``): no error. Python flushes its buffer
        # at exit; without a valid file it would print an error.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 128 + 13  # SIGPIPE, which Windows does not define
    except (OccsimError, ImportError) as error:
        return _refuse(str(error))
    except OSError as error:
        return _refuse(f"{error.filename} cannot be used ({error.strerror})")
    except KeyboardInterrupt:
        print("\nStopped; run the same command again to continue.", file=sys.stderr)
        return 130


def _refuse(sentence: str) -> int:
    print(f"{PROG}: {sentence}", file=sys.stderr)
    return 2


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog=PROG,
        description="Occupancy grid mapping with informative priors: which prior is "
        "best, for several drawings and cell sizes.",
    )
    parser.add_argument("--version", action="version", version=f"{PROG} {__version__}")
    commands = parser.add_subparsers(dest="command", required=True)
    study.add_command(commands)
    claims.add_command(commands)
    exercises.add_command(commands)
    return parser
