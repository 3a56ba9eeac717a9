"""Packages that only some methods need, and tables of pandas."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd


@contextmanager
def extra(name: str) -> Iterator[None]:
    """Imports in its block say how a missing package is installed."""
    try:
        yield
    except ModuleNotFoundError as error:
        needed = (error.name or "").partition(".")[0]
        raise ImportError(
            f'this needs {needed}: pip install "sawflutter[{name}]"', name=error.name
        ) from None


def frame(columns: Any) -> pd.DataFrame:
    """A table of columns or rows."""
    with extra("pandas"):
        import pandas as pd

    return pd.DataFrame(columns)


def entries(of: Iterable[Any]) -> pd.DataFrame:
    """The plain numbers and texts of entries of a report, one row each."""
    return frame(plain(of))


def plain(of: Iterable[Any]) -> list[dict[str, Any]]:
    """The plain numbers and texts of entries of a report."""
    kinds = (str, bool, int, float, type(None))
    return [{name: value for name, value in vars(entry).items() if isinstance(value, kinds)} for entry in of]


def csv_frame(text: str) -> pd.DataFrame:
    """A table that the library has written, with every number exact to the last bit: some versions
    of pandas need an argument for this that others refuse."""
    names, *rows = csv.reader(io.StringIO(text))
    columns = zip(*rows) if rows else ([] for _ in names)
    return frame({name: _column(list(cells)) for name, cells in zip(names, columns)})


def _column(cells: list[str]) -> list[Any]:
    """Cells that are all numbers or booleans, written as in JSON, with None for blanks; otherwise
    texts."""
    try:
        values: list[Any] = json.loads(f"[{','.join(cell or 'null' for cell in cells)}]")
    except ValueError:
        return cells
    return values
