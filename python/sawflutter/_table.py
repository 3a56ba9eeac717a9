"""Tables of pandas."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from ._extras import extra

if TYPE_CHECKING:
    import pandas as pd

# What the cells of a column may be, from the narrowest kind on.
_TRUTHS = {"true": True, "false": False}
_KINDS: tuple[Callable[[str], Any], ...] = (int, float, lambda cell: _TRUTHS[cell])


def frame(entries: Iterable[Any]) -> pd.DataFrame:
    """The plain numbers and words of entries of a report, one row each."""
    with extra("pandas"):
        import pandas as pd

    def plain(value: Any) -> bool:
        return value is None or isinstance(value, (str, bool, int, float))

    rows = [{key: value for key, value in vars(entry).items() if plain(value)} for entry in entries]
    return pd.DataFrame(rows)


def read(text: str) -> pd.DataFrame:
    """A table that the library has written: every number to the last bit, which the reader of
    pandas promises in some of its versions with an argument that others refuse."""
    with extra("pandas"):
        import pandas as pd

    names, *rows = csv.reader(io.StringIO(text))
    columns = zip(*rows) if rows else ([] for _ in names)
    return pd.DataFrame({name: _column(list(cells)) for name, cells in zip(names, columns)})


def _column(cells: list[str]) -> list[Any]:
    """Cells of one kind; blanks are None."""
    for kind in _KINDS:
        try:
            return [None if cell == "" else kind(cell) for cell in cells]
        except (ValueError, KeyError):
            continue
    return list(cells)
