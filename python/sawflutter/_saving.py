"""Files by the endings of their names, and numbers as tables."""

from __future__ import annotations

import dataclasses
import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from .errors import refused

if TYPE_CHECKING:
    import pandas as pd

Contents: TypeAlias = "Mapping[str, Callable[[], bytes]]"
"""Endings of names, and functions that make the content of such a file."""


def write(path: str | os.PathLike[str], contents: Contents) -> None:
    """Writes a file by the ending of its name; a content that cannot be made leaves no file."""
    place = Path(path)
    make = contents.get(place.suffix.lower())
    if make is None:
        allowed = f"a name that ends in one of {', '.join(contents)}"
        raise refused("path", place.name, allowed, "to_dataframe() gives a table, which pandas writes in other formats")
    place.write_bytes(make())


def csv(table: pd.DataFrame) -> bytes:
    """A table of pandas as CSV, whose numbers are exact to the last bit."""
    text: str = table.to_csv(index=False, lineterminator="\n")
    return text.encode()


class Tabled:
    """Base of dataclasses that are no report of the program and have a table."""

    __slots__ = ()

    def to_dataframe(self) -> pd.DataFrame:
        """The numbers as a table; needs pandas."""
        raise NotImplementedError

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the numbers to a path, by the ending of its name: .json by their names, or .csv the
        table, which needs pandas.

        Raises
        ------
        ArgumentError
            The name has another ending.
        """
        write(path, {".json": lambda: _json(self), ".csv": lambda: csv(self.to_dataframe())})


def _json(of: Any) -> bytes:
    return (json.dumps(_plain(of), indent=2, ensure_ascii=False) + "\n").encode()


def _plain(value: Any) -> Any:
    """A value as JSON has it, with null for NaN."""
    if dataclasses.is_dataclass(value):
        return {field.name: _plain(getattr(value, field.name)) for field in dataclasses.fields(value)}
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    return None if isinstance(value, float) and np.isnan(value) else value
