"""Measured frequencies in the format of the library, from any type that a notebook uses."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _native
from .errors import InputError, refused

if TYPE_CHECKING:
    import pandas as pd

Row: TypeAlias = "tuple[float, Sequence[float] | npt.NDArray[Any]] | Sequence[float] | npt.NDArray[Any]"
Measured: TypeAlias = "str | os.PathLike[str] | npt.NDArray[Any] | pd.DataFrame | Iterable[Row] | Iterable[float] | None"

# Words in the name of a column that has no frequencies.
_NO_FREQUENCIES = ("amplitude", "order", "growth", "krein", "damping", "time", "direction")


def table(measured: Measured) -> tuple[str, str] | None:
    """Name and text of a table of frequencies: lines of a speed and frequencies, which may be blank."""
    if measured is None:
        return None
    if hasattr(measured, "resolution_hz"):
        remedy = "assign its peaks to modes first: peaks.rows(saw)"
        raise refused("measured", type(measured).__name__, "a table of speeds and frequencies", remedy)
    if isinstance(measured, (str, os.PathLike)):
        return Path(measured).name, _native.read_text(measured, True)
    try:
        return "measured", lines(measured)
    except InputError:
        raise
    except (TypeError, ValueError, IndexError):
        raise TypeError(
            "measured must be a file, a DataFrame with a column or an index rpm, rows of a speed in "
            "rpm and frequencies in Hz, or the frequencies at rest alone"
        ) from None


def lines(measured: Any) -> str:
    """Lines of a table of frequencies, with blanks for NaN."""
    cells = [["" if np.isnan(hz) else repr(hz) for hz in row] for row in _rows(measured)]
    return "".join(f"{','.join(row)}\n" for row in _names(measured) + cells)


def titled(rows: Sequence[tuple[float, Sequence[float]]]) -> str:
    """The table of rows with its titles."""
    most = max((len(hz) for _, hz in rows), default=0)
    return f"{','.join(['rpm', *(f'f{place}' for place in range(1, most + 1))])}\n{lines(rows)}"


def _names(measured: Any) -> list[list[str]]:
    """The line of names of a data frame whose columns are named by nodal diameters; the others have ascending frequencies."""
    names = [str(name) for name in getattr(measured, "columns", []) if name != "rpm"]
    return [["rpm", *names]] if any(re.fullmatch(r"n ?=? ?\d+", name) for name in names) else []


def _rows(measured: Any) -> list[list[float]]:
    """Rows of a speed and frequencies; NaN is a blank."""
    if hasattr(measured, "columns"):
        frame = measured.set_index("rpm") if "rpm" in measured.columns else measured
        if frame.index.name != "rpm":
            raise TypeError("the data frame has no speeds")
        for name in frame.columns:
            if any(word in str(name).lower() for word in _NO_FREQUENCIES):
                remedy = "take the columns of frequencies alone, or rows(saw) of peaks"
                raise refused("measured", f"a column {name!r}", "speeds and frequencies", remedy)
        measured = frame.reset_index().to_numpy(dtype=float)
    rows = list(measured)
    if rows and not any(isinstance(row, Iterable) for row in rows):
        # Frequencies without a speed are those at rest.
        rows = [[0.0, *rows]]
    # A row has its frequencies one by one, or as a list.
    found = [[float(row[0]), *np.array(row[1:], float).ravel().tolist()] for row in rows]
    for row in found:
        if 0.0 < row[0] < min((hz for hz in row[1:] if hz > 0.0), default=0.0):
            said = "a speed in rpm and then frequencies in Hz in each row"
            raise refused("measured", row[0], said, "put the speeds before the frequencies: zip(rpm, hz)")
    return found
