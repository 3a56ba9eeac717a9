"""Spectra of a record over the rotation speed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import pi, sqrt
from typing import TYPE_CHECKING

import numpy as np

from . import _native
from ._drawn import Drawn
from ._entry import Entry, FloatArray, array
from ._extras import extra
from ._trend import longest_part, trend
from ._values import Number, number
from ._picking import lowest_hz
from .errors import ArgumentError, refused
from .peaks import Peaks
from .plot.chart import Chart
from .plot.described import read
from .plot.look import with_harmonics

if TYPE_CHECKING:
    from .records import Record
    from .results import CampbellResults

# Standard deviations in a window: at its ends a Gaussian is 0.03 % of its middle.
_DEVIATIONS = 8
# Width of the spectrum of a Gaussian window at half its height, times the standard deviation.
WIDTH = sqrt(2.0 * np.log(2.0)) / pi
# Nodal diameters of the wave for which the window is chosen.
_WAVES = 2
# The window takes at most this share of the record.
_LONGEST = 0.5


@dataclass(frozen=True, eq=False, repr=False)
class Waterfall(Drawn, Entry):
    """Spectra of a record over the rotation speed, ascending: each is that of a window, at the
    mean speed of the window. :meth:`Record.waterfall` makes one.

    Attributes
    ----------
    rpm : speed of each spectrum, ascending, of the shape (speeds).
    frequency_hz : frequencies in space, as the probe sees them, of the shape (frequencies).
    amplitude : amplitudes, of the shape (speeds, frequencies). A steady sine has its own
        amplitude.
    resolution_hz : width of the peak of a steady sine at half its amplitude.
    hop : distance of the windows, in standard deviations of one.
    unit : unit of the amplitudes.
    name : name of the record.
    """

    rpm: FloatArray
    frequency_hz: FloatArray
    amplitude: FloatArray
    resolution_hz: float
    hop: float
    unit: str
    name: str

    def peaks(
        self, *, orders: Iterable[Number] = (1, 2, 3, 4), above_db: Number = 20.0
    ) -> Peaks:
        """Peaks of each spectrum. A peak within twice the resolution of a multiple of the rotation
        speed is marked as one of its order, and is not used for a fit.

        Parameters
        ----------
        orders : iterable of float
            Multiples of the rotation speed; the number of teeth is one.
        above_db : float
            Height above the median level around the peak. Peaks below a thousandth of the largest
            amplitude at their speed, or below twice the resolution, are left out.
        """
        return Peaks._picked(self, self.hop, zip(self.rpm, self.amplitude), orders, above_db)

    def chart(
        self,
        computed: CampbellResults | None = None,
        peaks: Peaks | None = None,
        *,
        orders: Iterable[Number] = (1, 2),
        range_db: Number = 60.0,
    ) -> Chart:
        """Amplitudes over speed and frequency, under the computed branches and the picked peaks.

        Parameters
        ----------
        computed : CampbellResults, optional
            The chart whose branches are drawn.
        peaks : Peaks, optional
            Picked peaks, as rings at no more than 40 speeds; those of an order are smaller and
            grey.
        orders : iterable of float
            Multiples of the rotation speed that are drawn as lines.
        range_db : float
            Range of the colours, below the largest amplitude.
        """
        if not (span := number("range_db", range_db)) > 0.0:
            raise refused("range_db", range_db, "above 0", "60 is usual")
        report = None if computed is None else computed.to_json()
        chart = read(_native.waterfall_chart(self, lowest_hz(self.resolution_hz), span, report, peaks))
        multiples = [number("orders", order) for order in orders]
        return replace(chart, panels=tuple(with_harmonics(chart.panels, multiples)))

    def __repr__(self) -> str:
        speeds = f"{len(self.rpm)} spectra from {self.rpm[0]:.0f} to {self.rpm[-1]:.0f} rpm"
        return f"<Waterfall {self.name!r}: {speeds}, up to {self.frequency_hz[-1]:.0f} Hz, {self.resolution_hz:.2g} Hz wide>"


def sliding_spectra(record: Record, resolution_hz: float | None, to_hz: float) -> Waterfall:
    """Spectra of a Gaussian window that moves by one standard deviation. They are computed one by
    one, because only the frequencies up to a limit are kept."""
    with extra("records"):
        from scipy.fft import next_fast_len, rfft
        from scipy.signal import detrend

    samples, rate_hz, rpm = record.samples, record.rate_hz, record.rpm
    deviation_s = _deviation_s(record, resolution_hz)
    half = round(0.5 * _DEVIATIONS * deviation_s * rate_hz)
    places = np.arange(-half, half + 1)
    if len(places) < 8:
        remedy = "give a smaller number, or a record with a higher sample rate"
        raise refused("resolution_hz", f"{WIDTH / deviation_s:g}", f"below {rate_hz:g}", remedy)
    window = np.exp(-0.5 * (places / (deviation_s * rate_hz)) ** 2)
    hop = max(1, round(deviation_s * rate_hz))
    middles = np.arange(half, len(samples) - half, hop)
    size = next_fast_len(2 * len(window), real=True)
    frequency_hz = np.fft.rfftfreq(size, 1.0 / rate_hz)
    kept = int(np.searchsorted(frequency_hz, to_hz, side="right"))
    factor = 2.0 / window.sum()
    spectra = [
        factor * np.abs(rfft(window * detrend(samples[at - half : at + half + 1]), size)[:kept])
        for at in middles
    ]
    weights = window / window.sum()
    speeds = np.array([weights @ rpm[at - half : at + half + 1] for at in middles])
    ascending = np.argsort(speeds, kind="stable")
    return Waterfall(
        array(speeds[ascending]),
        array(frequency_hz[:kept]),
        array(np.array(spectra)[ascending]),
        WIDTH / deviation_s,
        hop / (deviation_s * rate_hz),
        record.unit,
        record.name,
    )


def _deviation_s(record: Record, resolution_hz: float | None) -> float:
    """Standard deviation of the window."""
    rpm = record.rpm
    duration_s = len(rpm) / record.rate_hz
    _, course = trend(rpm)
    rises, total = float(course[-1] - course[0]), float(np.abs(np.diff(course)).sum())
    if np.ptp(course) < 1.0:
        message = f"rpm must be rising or falling throughout, but that of {record.name} is constant; use spectrum()"
        raise ArgumentError(message, "rpm", f"{course[0]:.0f} rpm", "rising or falling throughout", "use spectrum()")
    if abs(rises) < 0.5 * total:
        begin, end = longest_part(rpm, duration_s)
        given = f"from {course[0]:.0f} to {course[-1]:.0f} rpm, between {rpm.min():.0f} and {rpm.max():.0f} rpm"
        remedy = f"take a part by between({begin:.3g}, {end:.3g})"
        message = f"rpm must be rising or falling throughout, but that of {record.name} goes {given}; {remedy}"
        raise ArgumentError(message, "rpm", given, "rising or falling throughout", remedy)
    longest_s = _LONGEST * duration_s / _DEVIATIONS
    if resolution_hz is None:
        # A wave of n diameters that rotates with the blade changes by n/60 Hz for each rpm. Its peak
        # has the standard deviation (1/(2πσ))² + (aσ)², with the rate a of its frequency.
        rate = _WAVES / 60.0 * abs(rises) / duration_s
        return min(sqrt(1.0 / (2.0 * pi * rate)), longest_s)
    if not (np.isfinite(resolution_hz) and resolution_hz > 0.0 and WIDTH / resolution_hz <= longest_s):
        allowed = f"at least {WIDTH / longest_s:.3g}, for which the window takes half of the record"
        raise refused("resolution_hz", resolution_hz, allowed, "give a larger number")
    return WIDTH / resolution_hz
