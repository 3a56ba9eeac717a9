"""Tables of pandas."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ._extras import extra

if TYPE_CHECKING:
    import pandas as pd


def frame(columns: Any) -> pd.DataFrame:
    """A table of columns or rows."""
    with extra("pandas"):
        import pandas as pd

    return pd.DataFrame(columns)


def entries(of: Iterable[Any]) -> pd.DataFrame:
    """The plain numbers and words of entries of a report, one row each."""
    plain = (str, bool, int, float, type(None))
    return frame([{k: v for k, v in vars(entry).items() if isinstance(v, plain)} for entry in of])


def read(text: str) -> pd.DataFrame:
    """A table that the library has written: every number to the last bit, which the reader of
    pandas promises in some of its versions with an argument that others refuse."""
    names, *rows = csv.reader(io.StringIO(text))
    columns = zip(*rows) if rows else ([] for _ in names)
    return frame({name: _column(list(cells)) for name, cells in zip(names, columns)})


def _column(cells: list[str]) -> list[Any]:
    """Cells that all are numbers or truths, written as JSON has them, with None for blanks; or words."""
    try:
        values: list[Any] = json.loads(f"[{','.join(cell or 'null' for cell in cells)}]")
    except ValueError:
        return cells
    return values
