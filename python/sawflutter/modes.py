"""Modes at one or several speeds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar, overload

import numpy as np

from ._entry import Entry, FloatArray, IntArray, array
from ._extras import entries
from ._report_types import Mode

if TYPE_CHECKING:
    import pandas as pd

T = TypeVar("T")


@dataclass(frozen=True, eq=False, repr=False)
class Modes(Entry, Generic[T]):
    """Modes ascending by frequency, of :meth:`Scene.modes`: a sequence of :class:`Mode` at one
    speed, or of a tuple of them for each of several speeds. Rows of fewer modes are filled with
    NaN, and with 0 for Krein signs.

    Attributes
    ----------
    rpm : speed, or speeds.
    frequency_hz : frequencies in space, of the shape (modes), or (speeds, modes).
    growth_per_s : growth rates, of the same shape.
    krein_sign : Krein signs, of the same shape; 0 where a mode has none.
    modes : the modes themselves, with their shapes, or those of each speed.
    complete_to_hz : frequency up to which no mode is missing.
    """

    rpm: FloatArray
    frequency_hz: FloatArray
    growth_per_s: FloatArray
    krein_sign: IntArray
    modes: tuple[T, ...]
    complete_to_hz: float

    @classmethod
    def _of(cls, rpm: FloatArray, found: dict[str, Any]) -> Modes[Any]:
        """The table of the library's report of each speed."""
        rows = tuple(tuple(map(Mode._from_dict, at)) for at in found["modes"])
        size = max(map(len, rows), default=0)

        def table(of: str) -> FloatArray:
            values = np.full((len(rows), size), np.nan)
            for row, modes in zip(values, rows):
                row[: len(modes)] = [getattr(mode, of) for mode in modes]
            return array(values if rpm.ndim else values[0])

        signs = array(np.nan_to_num(table("krein_sign")), np.int64)
        modes: tuple[Any, ...] = rows if rpm.ndim else rows[0]
        hz, growth = table("frequency_hz"), table("growth_per_s")
        return Modes(array(rpm), hz, growth, signs, modes, found["complete_to_hz"])

    @overload
    def __getitem__(self, place: int) -> T: ...
    @overload
    def __getitem__(self, place: slice) -> tuple[T, ...]: ...
    def __getitem__(self, place: int | slice) -> T | tuple[T, ...]:
        return self.modes[place]

    def __iter__(self) -> Iterator[T]:
        return iter(self.modes)

    def __len__(self) -> int:
        return len(self.modes)

    def to_dataframe(self) -> pd.DataFrame:
        """One row for each speed and mode with speed, frequency, growth rate, Krein sign,
        direction and the dominant number of nodal diameters; needs pandas."""
        modes = self._all()
        table = entries(modes)
        table["nodal_diameters"] = [mode.harmonics[0].nodal_diameters for mode in modes]
        return table

    def _all(self) -> list[Mode]:
        rows: Any = self.modes
        return [mode for at in rows for mode in at] if self.rpm.ndim else list(rows)

    def __repr__(self) -> str:
        hz = self.frequency_hz
        speeds = np.ravel(self.rpm)
        ends = f"{speeds.min():g} to {speeds.max():g}" if speeds.size else "no"
        at = f"{len(speeds)} speeds, {ends}" if self.rpm.ndim else f"{self.rpm:g}"
        span = "none" if not hz.size else f"{np.nanmin(hz):.4g} to {np.nanmax(hz):.4g} Hz"
        return f"<Modes at {at} rpm: {len(self._all())}, {span}, complete to {self.complete_to_hz:.4g} Hz>"

    def _repr_html_(self) -> str:
        """The lowest modes as a table, for a notebook."""
        rows = self._all()
        head = "".join(f"<th>{name}</th>" for name in ("rpm", "frequency", "growth", "mode", "direction"))
        body = "".join(
            f"<tr><td>{m.rpm:.0f}</td><td>{m.frequency_hz:.2f} Hz</td><td>{m.growth_per_s:.3g} 1/s</td>"
            f"<td>{m.name}</td><td>{m.direction}</td></tr>"
            for m in rows[:_SHOWN]
        )
        return f"<table><tr>{head}</tr>{body}</table><p>{len(rows)} modes, complete to {self.complete_to_hz:.4g} Hz</p>"


# Rows of the table in a notebook.
_SHOWN = 20
