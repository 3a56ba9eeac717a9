"""Records of a saw by a displacement probe or a microphone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ._drawn import Drawn
from ._entry import Entry, FloatArray, IntArray, array
from ._trend import is_steady, trend
from ._values import Number, number, optional
from .errors import ArgumentError, refused
from .motions import RunUpResults
from .plot.chart import Chart, Line, Panel, colours
from .spectra import Spectrum, after_tap
from .waterfalls import Waterfall, sliding_spectra

# Largest speed, as in scenes.
_MOST_RPM = 1e6
# Share of the largest speed by which the noise of a measured one may be below zero.
_NOISE = 0.02
# Parts of a record of which a figure shows the extremes.
_PARTS = 2000


@dataclass(frozen=True, eq=False, repr=False, init=False)
class Record(Drawn, Entry):
    """Samples of a probe or a microphone. The parameters are attributes, too: ``samples`` of the shape
    (samples), and ``rpm`` of the same shape, the rotation speed at each sample. :func:`read_record` reads a record from a file.

    Parameters
    ----------
    samples : array_like
        Samples at even time steps.
    rate_hz : float
        Sample rate.
    rpm : float, (float, float) or array_like
        Constant speed; first and last speed of a run-up at a constant rate; pairs (time in s,
        speed), between which the speed is interpolated; or the speed at each sample. A measured
        speed may have noise: whether it rises, falls or is constant is judged by its means over
        twentieths of the record. By default the saw is at rest.
    unit, name : str
        Unit of the samples and name of the record.
    """

    samples: FloatArray
    rate_hz: float
    rpm: FloatArray
    unit: str
    name: str

    def __init__(
        self,
        samples: npt.ArrayLike,
        rate_hz: Number,
        rpm: npt.ArrayLike = 0.0,
        *,
        unit: str = "",
        name: str = "record",
    ) -> None:
        found, rate = np.asarray(samples, float), number("rate_hz", rate_hz)
        if found.ndim != 1 or len(found) < 2 or not np.isfinite(found).all():
            remedy = "give the samples of one channel, without gaps"
            raise refused("samples", f"of shape {found.shape}", "at least 2 finite numbers in a row", remedy)
        if not (np.isfinite(rate) and rate > 0.0):
            raise refused("rate_hz", rate, "above 0", "give the number of samples per second")
        speeds = array(_speeds(rpm, len(found), rate))
        vars(self).update(samples=array(found), rate_hz=rate, rpm=speeds, unit=unit, name=name)

    @classmethod
    def of_run_up(cls, up: RunUpResults) -> Record:
        """The computed record of a run-up, the deflection at the probe in m, to compare it with a
        measured one."""
        # The last step of a run-up may be shorter than the others.
        rpm, samples = up.rpm[:-1], up.deflection_m[:-1]
        rate = up.rate_rpm_per_s * (len(rpm) - 1) / (rpm[-1] - rpm[0])
        name = f"run-up of {up._scene['name']}"
        return cls(samples, rate, rpm, unit="m", name=name)

    @property
    def time_s(self) -> FloatArray:
        """Time of each sample from the begin of the record."""
        return array(np.arange(len(self.samples)) / self.rate_hz)

    def chart(self) -> Chart:
        """Samples and speed over time, to look at. Of a long record the lines have the smallest and the
        largest sample of each of two thousand parts."""
        places = _extremes(self.samples)
        time_s = self.time_s[places]
        unit = f" [{self.unit}]" if self.unit else ""
        curves = ((f"signal{unit}", self.samples, "forward"), ("rotation speed [rpm]", self.rpm, "quiet"))
        panels = tuple(
            Panel("time [s]", name, [Line(time_s, of[places], colours()[colour])], x_range=(0.0, float(self.time_s[-1])))
            for name, of, colour in curves
        )
        return Chart(self.name, f"{len(self.samples)} samples at {self.rate_hz:g} Hz", panels)

    def between(self, from_s: Number, to_s: Number) -> Record:
        """Part of the record from ``from_s`` to ``to_s``, such as its run-up, or the time after one of
        several taps."""
        begin, end = number("from_s", from_s), number("to_s", to_s)
        within = np.flatnonzero((self.time_s >= begin) & (self.time_s <= end))
        if len(within) < 2:
            allowed = f"times from 0 to {self.time_s[-1]:g} s, the second one later"
            raise refused("from_s, to_s", (begin, end), allowed, "give a part of the record")
        part = slice(within[0], within[-1] + 1)
        return Record(
            self.samples[part], self.rate_hz, self.rpm[part], unit=self.unit, name=self.name
        )

    def waterfall(
        self, *, resolution_hz: Number | None = None, to_hz: Number | None = None
    ) -> Waterfall:
        """Spectra of the record over the rotation speed, by a short-time Fourier transform with a
        Gaussian window. The speed of a spectrum is the mean over its window.

        Parameters
        ----------
        resolution_hz : float, optional
            Width of the peak of a steady sine at half its amplitude; the standard deviation of the
            window is 0.375 s divided by it. By default the window for which a wave of two nodal
            diameters, whose frequency changes with the speed, gives the narrowest peak.
        to_hz : float, optional
            Highest frequency; by default 500 Hz, or 40 % of the sample rate if that is less.

        Examples
        --------
        >>> import numpy as np
        >>> import sawflutter as sf
        >>> tone = np.sin(2 * np.pi * 40 * np.arange(0, 30, 1e-3))
        >>> w = sf.Record(tone, 1000, rpm=(0, 1500), unit="mm").waterfall(to_hz=100)
        >>> w.frequency_hz[w.amplitude[0].argmax()].round(), w.amplitude.max().round(3)
        (np.float64(40.0), np.float64(1.0))
        """
        resolution = optional("resolution_hz", resolution_hz)
        return sliding_spectra(self, resolution, self._highest(to_hz))

    def spectrum(self, *, to_hz: Number | None = None) -> Spectrum:
        """Spectrum of a free decay at a constant speed, such as that of a tap test at rest: of the
        record from its largest deflection on, with an exponential window that ends at 1 %. The
        window widens each peak to 2.5 Hz divided by the remaining duration in seconds.

        Parameters
        ----------
        to_hz : float, optional
            As in :meth:`waterfall`.
        """
        if not is_steady(self.rpm):
            message = f"rpm must be constant, but that of {self.name} goes {self._course()}; use waterfall(), or a part by between()"
            raise ArgumentError(message, "rpm", self._course(), "constant", "use waterfall()")
        return after_tap(self, self._highest(to_hz))

    def _course(self) -> str:
        """First and last speed, without the noise of a measured one."""
        _, course = trend(self.rpm)
        return f"from {course[0]:.0f} to {course[-1]:.0f} rpm"

    def _highest(self, to_hz: Number | None) -> float:
        highest = 0.4 * self.rate_hz
        if to_hz is None:
            return min(500.0, highest)
        asked = number("to_hz", to_hz)
        if not 0.0 < asked <= 0.5 * self.rate_hz:
            allowed = f"above 0 and at most {0.5 * self.rate_hz:g}, half of the sample rate"
            raise refused("to_hz", asked, allowed, "give a frequency that the record contains")
        return asked

    def __repr__(self) -> str:
        speeds = f"{self.rpm.mean():.0f} rpm" if is_steady(self.rpm) else self._course()
        return f"<Record {self.name!r}: {self.time_s[-1]:.1f} s at {self.rate_hz:.0f} Hz, {speeds}>"


def _extremes(samples: FloatArray) -> IntArray:
    """Places of the smallest and the largest sample of each part of a record, or of all of a short one."""
    if len(samples) <= 2 * _PARTS:
        return np.arange(len(samples))
    parts = np.array_split(np.arange(len(samples)), _PARTS)
    found = [part[[samples[part].argmin(), samples[part].argmax()]] for part in parts]
    return np.unique([0, *np.concatenate(found), len(samples) - 1])


def _speeds(rpm: npt.ArrayLike, size: int, rate_hz: float) -> FloatArray:
    """The speed at each sample."""
    try:
        numbers = np.asarray(rpm, float)
    except (TypeError, ValueError):
        remedy = "a channel is named by speed or tacho"
        raise refused("rpm", rpm, "a number, or numbers", remedy) from None
    if numbers.shape == (size,) and 0.0 > numbers.min() >= -_NOISE * numbers.max():
        numbers = np.maximum(numbers, 0.0)
    speeds = numbers[..., 1:] if numbers.ndim == 2 else numbers
    if not (np.isfinite(numbers).all() and ((speeds >= 0.0) & (speeds <= _MOST_RPM)).all()):
        remedy = "give speeds in rpm without a sign, and pulses of a tachometer as tacho"
        raise refused("rpm", f"from {speeds.min():g} to {speeds.max():g}", f"from 0 to {_MOST_RPM:g}", remedy)
    if numbers.ndim == 0:
        return np.full(size, float(numbers))
    if numbers.shape == (size,):
        return numbers
    if numbers.shape == (2,):
        return np.linspace(numbers[0], numbers[1], size)
    if numbers.ndim == 2 and numbers.shape[1] == 2 and (np.diff(numbers[:, 0]) > 0.0).all():
        return np.asarray(np.interp(np.arange(size) / rate_hz, numbers[:, 0], numbers[:, 1]))
    allowed = f"one speed, the first and the last one, pairs (time in s, speed) by time, or {size} speeds"
    raise refused("rpm", f"of shape {numbers.shape}", allowed, "give one of these")
