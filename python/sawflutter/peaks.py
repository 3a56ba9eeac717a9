"""Frequencies that were picked from spectra, as data for a fit."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ._entry import Entry, FloatArray, IntArray, array
from ._extras import extra, frame
from ._measured import titled
from ._picking import peak_rows
from ._values import Number, number
from .errors import ArgumentError, refused

if TYPE_CHECKING:
    import pandas as pd

    from .scene import Scene
    from .spectra import Spectrum
    from .waterfalls import Waterfall

# The windows of rows for a fit do not overlap within so many standard deviations of each other's
# middle, so that their errors are independent.
_APART = 4.0
# Largest number of frequencies in a row of a fit.
_MOST_FREQUENCIES = 24


@dataclass(frozen=True, eq=False, repr=False)
class Peaks(Entry):
    """Peaks of spectra, by ascending speed and frequency. :meth:`Waterfall.peaks` and
    :meth:`Spectrum.peaks` pick them.

    Attributes
    ----------
    rpm : speed of each peak; the arrays have the shape (peaks).
    frequency_hz : frequency in space.
    amplitude : amplitude.
    order : multiple of the rotation speed at which the peak is; NaN at none.
    spectrum : number of the spectrum of each peak, from 0.
    resolution_hz : width of the peak of a steady sine.
    hop : distance of neighbouring spectra, in standard deviations of a window.
    unit : unit of the amplitudes.
    name : name of the record.
    """

    rpm: FloatArray
    frequency_hz: FloatArray
    amplitude: FloatArray
    order: FloatArray
    spectrum: IntArray
    resolution_hz: float
    hop: float
    unit: str
    name: str

    @classmethod
    def _picked(
        cls,
        of: Spectrum | Waterfall,
        hop: float,
        spectra: Iterable[tuple[float, FloatArray]],
        orders: Iterable[Number],
        above_db: Number,
    ) -> Peaks:
        """Peaks of spectra, each a speed and amplitudes."""
        found = peak_rows(of.frequency_hz, spectra, of.resolution_hz, orders, above_db)
        numbers = np.array(found, float).reshape(-1, 5)
        rpm, frequency_hz, amplitude, order = map(array, numbers[:, :4].T)
        spectrum = array(numbers[:, 4], np.int64)
        return cls(rpm, frequency_hz, amplitude, order, spectrum, of.resolution_hz, hop, of.unit, of.name)

    def rows(
        self,
        saw: Scene,
        *,
        lowest: int = 6,
        within_hz: Number = 5.0,
        speeds: int = 20,
    ) -> list[tuple[float, list[float]]]:
        """The peaks as rows for :meth:`sawflutter.Scene.fit`: a speed and the lowest frequencies in
        ascending order, NaN if no peak was found. A spectrum does not show which modes the probe
        does not see, so that a saw near the measured one is needed: its computed frequencies are
        assigned to the peaks with the smallest sum of differences. Peaks of an order are left out.

        Parameters
        ----------
        saw : Scene
            The saw before the fit, or a fitted one for a second assignment.
        lowest : int
            Number of lowest computed frequencies, at most 24.
        within_hz : float
            Largest difference between a peak and its computed frequency.
        speeds : int
            Largest number of rows, spread evenly. Their windows do not overlap by much.
        """
        limit = number("within_hz", within_hz)
        if not 1 <= lowest <= _MOST_FREQUENCIES:
            raise refused("lowest", lowest, f"from 1 to {_MOST_FREQUENCIES}", "6 is usual")
        if not limit > 0.0:
            raise refused("within_hz", limit, "above 0", "give a few Hz")
        if speeds < 1:
            raise refused("speeds", speeds, "at least 1", "20 is usual")
        spectra, rpm = self._chosen(speeds)
        modes = saw.modes(rpm.tolist()).frequency_hz[:, :lowest] if len(rpm) else np.empty((0, lowest))
        free = np.isnan(self.order)
        found = list[tuple[float, list[float]]]()
        for spectrum, speed, computed in zip(spectra, rpm, modes):
            seen = self.frequency_hz[free & (self.spectrum == spectrum)]
            row = _assigned(seen, computed[~np.isnan(computed)], limit)
            if not all(np.isnan(row)):
                found.append((float(speed), row))
        if not found:
            message = (
                f"none of {int(free.sum())} peaks of {self.name} is within {limit:g} Hz of the {lowest} lowest "
                f"computed frequencies; change the scene towards the measured saw, or raise within_hz"
            )
            raise ArgumentError(message, "within_hz", f"{limit:g}", "more", "raise within_hz")
        return found

    def to_csv(
        self, path: str | os.PathLike[str], rows: Sequence[tuple[float, Sequence[float]]] | None = None
    ) -> None:
        """Writes ``rows``, the result of :meth:`rows` or several such lists in one, as a table for
        ``sawflutter fit`` to a path, with blanks for NaN; without them all peaks, as a table for
        ``sawflutter margin``."""
        text = listed([(self.name, self)]) if rows is None else titled(rows)
        Path(path).write_text(text, encoding="utf-8", newline="\n")

    def to_dataframe(self) -> pd.DataFrame:
        """The peaks as a table; needs pandas."""
        names = ("rpm", "frequency_hz", "amplitude", "order")
        return frame({name: getattr(self, name) for name in names})

    def _chosen(self, speeds: int) -> tuple[IntArray, FloatArray]:
        """Numbers and speeds of spectra with peaks of no order, so far apart that their windows do
        not overlap by much."""
        numbers, first = np.unique(self.spectrum[np.isnan(self.order)], return_index=True)
        rpm = self.rpm[np.isnan(self.order)][first]
        least = max(1, int(np.ceil(_APART / self.hop)))
        last = int(numbers[-1] - numbers[0]) if len(numbers) else 0
        count = min(speeds, 1 + last // least)
        wanted = np.linspace(numbers[0], numbers[-1], count) if len(numbers) else np.empty(0)
        chosen = sorted({int(np.abs(numbers - number).argmin()) for number in wanted})
        return numbers[chosen], rpm[chosen]

    def __repr__(self) -> str:
        of_order = int((~np.isnan(self.order)).sum())
        counts = f"{len(self.rpm)} at {len(np.unique(self.spectrum))} speeds, {of_order} of them of an order"
        return f"<Peaks {self.name!r}: {counts}>"


def listed(found: Iterable[tuple[str, Peaks]]) -> str:
    """The table of peaks of files by their names, which ``sawflutter margin`` reads."""
    lines = ["file,rpm,frequency_hz,amplitude,order"]
    for name, of in found:
        each = zip(of.rpm, of.frequency_hz, of.amplitude, of.order)
        quoted = '"' + name.replace('"', '""') + '"'
        lines += [f"{quoted},{n:.6g},{hz:.6f},{size:.6g},{'' if np.isnan(k) else f'{k:g}'}" for n, hz, size, k in each]
    return "\n".join([*lines, ""])


def _assigned(seen: FloatArray, computed: FloatArray, within_hz: float) -> list[float]:
    """The peak of each computed frequency, or NaN: as many as possible within the distance, with the
    smallest sum of differences."""
    with extra("records"):
        from scipy.optimize import linear_sum_assignment

    differences = np.abs(computed[:, None] - seen[None, :])
    # A pair beyond the distance costs more than all others together.
    beyond = within_hz * (1.0 + min(differences.shape, default=0))
    costs = np.where(differences <= within_hz, differences, beyond)
    places, peaks = linear_sum_assignment(costs)
    row = np.full(len(computed), np.nan)
    near = differences[places, peaks] <= within_hz
    row[places[near]] = seen[peaks[near]]
    # Equal sums permit crossed pairs, but frequencies of a row ascend.
    found = ~np.isnan(row)
    row[found] = np.sort(row[found])
    return [float(hz) for hz in row]
