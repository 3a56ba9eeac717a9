"""Tables of spreadsheets, as text for the reader of tables."""

from __future__ import annotations

import csv
import io
import os
import zipfile
from numbers import Real
from typing import Any

from ._extras import extra
from .errors import InputError

ENDINGS = (".xlsx", ".xlsm")


def text(path: str | os.PathLike[str]) -> str:
    """The sheet with numbers, its cells separated by tabs."""
    with extra("instruments"):
        import openpyxl  # noqa: F401
        import pandas as pd
    try:
        sheets = pd.read_excel(path, sheet_name=None, header=None, dtype=object)
    except (ValueError, KeyError, zipfile.BadZipFile) as error:
        raise InputError(f"{path} is no spreadsheet that can be read ({error}); save it as .xlsx, or as CSV") from None
    rows = {name: [_cells(row) for row in sheet.to_numpy()] for name, sheet in sheets.items()}
    numeric = [name for name, of in rows.items() if sum(any(isinstance(cell, float) for cell in row) for row in of) > 1]
    if len(numeric) > 1:
        raise InputError(f"{path} has {len(numeric)} sheets with numbers ({', '.join(numeric)}); keep one in the file")
    content = io.StringIO()
    writer = csv.writer(content, delimiter="\t", quoting=csv.QUOTE_NONNUMERIC, lineterminator="\n")
    writer.writerows(rows[numeric[0]] if numeric else [])
    return content.getvalue()


def _cells(row: Any) -> list[float | str]:
    """Numbers, and texts in one line; blank cells are empty."""
    return [
        float(cell) if isinstance(cell, Real) and cell == cell else "" if cell != cell or cell is None else " ".join(str(cell).split())
        for cell in row
    ]
