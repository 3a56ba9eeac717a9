"""Packages that only some methods need."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def extra(name: str) -> Iterator[None]:
    """Imports in its block say how a missing package is installed.

    >>> with extra("plot"):
    ...     import no_such_package
    Traceback (most recent call last):
    ImportError: this needs no_such_package: pip install "sawflutter[plot]"
    """
    try:
        yield
    except ModuleNotFoundError as error:
        needed = (error.name or "").partition(".")[0]
        raise ImportError(
            f'this needs {needed}: pip install "sawflutter[{name}]"', name=error.name
        ) from None
