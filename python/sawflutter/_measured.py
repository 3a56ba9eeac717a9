"""Measured frequencies as the library reads them, whatever a notebook has them in."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _native

if TYPE_CHECKING:
    import pandas as pd

Row: TypeAlias = "tuple[float, Sequence[float]] | Sequence[float] | npt.NDArray[Any]"
Measured: TypeAlias = "str | os.PathLike[str] | npt.NDArray[Any] | pd.DataFrame | Iterable[Row] | Iterable[float] | None"


def table(measured: Measured) -> tuple[str, str] | None:
    """Name and text of a table of frequencies."""
    if measured is None:
        return None
    if isinstance(measured, (str, os.PathLike)):
        return Path(measured).name, _native.read_text(measured, True)
    rows = _rows(measured)
    width = max((len(row) for row in rows), default=1)
    header = ["rpm", *(f"mode {place} [Hz]" for place in range(1, width))]
    cells = [["" if np.isnan(cell) else repr(float(cell)) for cell in row] for row in rows]
    padded = [row + [""] * (width - len(row)) for row in cells]
    return "measured", "".join(f"{','.join(row)}\n" for row in [header, *padded])


def _rows(measured: Any) -> list[list[float]]:
    """Rows of a speed and frequencies; NaN is a blank."""
    if hasattr(measured, "columns"):
        measured = _columns(measured)
    try:
        entries = list(measured)
        if not any(isinstance(entry, Sequence) or np.ndim(entry) for entry in entries):
            # Frequencies alone are those at rest.
            entries = [[0.0, *entries]] if entries else []
        return [[float(row[0]), *_numbers(row[1:])] for row in entries]
    except (TypeError, ValueError, IndexError):
        raise TypeError(
            "measured must be a file, a DataFrame with a column rpm, rows of a speed in rpm and "
            "frequencies in Hz, or the frequencies at rest alone"
        ) from None


def _numbers(cells: Any) -> list[float]:
    """Frequencies, given one by one or as a list in themselves."""
    if len(cells) == 1 and np.ndim(cells[0]) == 1:
        cells = cells[0]
    return [np.nan if cell is None else float(cell) for cell in cells]


def _columns(frame: Any) -> Any:
    """Rows of a data frame: the speeds are its column or its index "rpm"."""
    names = [str(name) for name in frame.columns]
    if "rpm" not in names:
        if frame.index.name != "rpm":
            raise TypeError(f"no column of the data frame is 'rpm', but {', '.join(names)}")
        frame, names = frame.reset_index(), ["rpm", *names]
    speeds = names.index("rpm")
    order = [speeds, *(place for place in range(len(names)) if place != speeds)]
    return frame.to_numpy(dtype=float)[:, order]
