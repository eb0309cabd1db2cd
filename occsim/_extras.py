"""Packages that only some of the library needs, and that may not be installed."""

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def needs_extra(extra: str, what: str) -> Iterator[None]:
    """Explain how to install a package whose import inside the block fails.

    Parameters
    ----------
    extra : str
        Extra of `occsim` that brings the package.
    what : str
        What the package is needed for.

    Raises
    ------
    ImportError
        Where the import fails, in one sentence.

    Examples
    --------
    >>> with needs_extra("study", "a figure"):
    ...     import no_such_package
    Traceback (most recent call last):
    ImportError: a figure needs no_such_package: pip install 'occsim[study]'
    """
    try:
        yield
    except ModuleNotFoundError as error:
        missing = (error.name or "a package").partition(".")[0]
        raise ImportError(
            f"{what} needs {missing}: pip install 'occsim[{extra}]'", name=missing
        ) from None
