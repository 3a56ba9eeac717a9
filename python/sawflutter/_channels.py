"""Channels that were recorded together, and frequency responses, with their units."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from math import pi

import numpy as np

from ._entry import ComplexArray, FloatArray
from ._extras import extra
from .errors import ArgumentError, InputError, refused

# Largest deviation of a value from even ones, as a share of a step: values of few digits deviate by
# less, and a missing sample by at least half a step.
_UNEVEN = 0.3
# A step of uneven times that is longer than the median one by this factor is a gap, and a shorter one than its inverse a mistake.
_GAP = 1.5
# Fewer samples than these rise evenly by chance.
_FEWEST = 8


def _units(*factors: tuple[float, str]) -> dict[str, float]:
    return {unit: factor for factor, units in factors for unit in units.split()}


SECONDS = _units(
    (1.0, "s sec sek second seconds sekunde sekunden seconde secondes"),
    (1e-3, "ms msec millisecond milliseconds millisekunden"),
    (1e-6, "us µs μs microseconds"),
    (60.0, "min minutes minuten"),
)
HERTZ = _units((1.0, "Hz hertz"), (1e3, "kHz"), (0.5 / pi, "rad/s"), (1.0 / 60.0, "rpm cpm 1/min min-1"))
RADIANS = _units((1.0, "rad radian radians"), (pi / 180.0, "deg degree degrees ° grad"))
_RPM = _units((1.0, "rpm 1/min min-1 min^-1 min⁻¹ u/min r/min rev/min tr/min"))
# Units that others than speeds have as well.
_OF_SPEED = _units((1e3, "krpm"), (60.0, "hz rps rev/s u/s"), (30.0 / pi, "rad/s"), (1.0 / 6.0, "deg/s °/s"))
_SPEEDS = ("rpm", "speed", "drehzahl", "vitesse", "varvtal")


def factor(units: dict[str, float], unit: str) -> float | None:
    """The factor from a unit to that of the library; None for an unknown one."""
    small = unit.lower().rstrip(".")
    return next((of for name, of in units.items() if name.lower() == small), None)


def known_factor(units: dict[str, float], unit: str, what: str) -> float:
    """The factor from a unit, which is refused if it is unknown."""
    found = factor(units, unit)
    if found is None:
        first = dict.fromkeys(units.values())
        allowed = ", ".join(next(name for name in units if units[name] == of) for of in first)
        remedy = "convert them, or correct the unit"
        raise InputError(f"the {what} are in {unit!r}, but must be in one of {allowed}; {remedy}")
    return found


def even_step(values: FloatArray) -> float | None:
    """The step of values that rise evenly; None for others."""
    step = float(values[-1] - values[0]) / max(len(values) - 1, 1)
    deviation = np.abs(values - values[0] - step * np.arange(len(values))).max()
    return step if step > 0.0 and deviation <= _UNEVEN * step else None


def _bare(title: str) -> str:
    """A name and a unit without the marks between them."""
    return " ".join(re.split(r"[\s_/,()\[\]]+", title.lower())).strip()


def has_no_gap(values: FloatArray) -> bool:
    """Whether the steps of values are of one size, but not equal, as those of a sensor of a phone."""
    steps = np.diff(values)
    middle = float(np.median(steps)) if len(steps) >= _FEWEST else 0.0
    return middle > 0.0 and bool((steps <= _GAP * middle).all() and (steps >= middle / _GAP).all())


@dataclass(frozen=True)
class Channel:
    """Samples with a name and a unit, which may be blank."""

    name: str
    unit: str
    samples: FloatArray

    @property
    def title(self) -> str:
        """Name and unit."""
        return f"{self.name} ({self.unit})" if self.unit not in ("", self.name) else self.name

    def is_speed(self) -> bool:
        """Whether it is a speed, by its unit or by its name."""
        name = self.name.lower()
        # A column named n may also have the numbers of the samples.
        is_n = name == "n" and not (np.diff(self.samples) == 1.0).all()
        is_named = any(word.endswith(_SPEEDS) for word in name.replace("_", " ").split())
        return factor(_RPM, self.unit) is not None or is_n or is_named

    def to_rpm(self) -> float | None:
        """The factor of a speed to rpm; None for an unknown unit."""
        return factor(_RPM | _OF_SPEED, self.unit or "rpm")

    def rises_evenly(self) -> bool:
        """Whether it is a time, or a number of the sample, and no signal."""
        return len(self.samples) >= _FEWEST and even_step(self.samples) is not None


@dataclass(frozen=True)
class Channels:
    """Channels that were sampled together."""

    file: str
    rate_hz: float | None
    channels: tuple[Channel, ...]
    uneven_s: FloatArray | None = None
    """Times that are not evenly spaced, but without a gap."""

    def evenly(self, rate_hz: float | None) -> Channels:
        """Channels of even times: those of uneven ones are interpolated by a cubic spline at a given rate."""
        if self.uneven_s is None:
            return self
        steps, mean_hz = np.diff(self.uneven_s), (len(self.uneven_s) - 1) / float(np.ptp(self.uneven_s))
        if rate_hz is None or not 0.0 < rate_hz <= mean_hz * (1.0 + _UNEVEN):
            given = f"steps from {steps.min():g} to {steps.max():g} s, {mean_hz:.4g} samples per second"
            remedy = f"give rate_hz={mean_hz:.3g}, at which its channels are interpolated, or write more digits of the time"
            message = f"the times of {self.file} are not evenly spaced ({given}); {remedy}"
            raise ArgumentError(message, "rate_hz", None if rate_hz is None else f"{rate_hz:g}", f"at most {mean_hz:g}", remedy)
        with extra("records"):
            from scipy.interpolate import CubicSpline
        at = np.arange(self.uneven_s[0], self.uneven_s[-1], 1.0 / rate_hz)
        channels = (replace(of, samples=np.asarray(CubicSpline(self.uneven_s, of.samples)(at))) for of in self.channels)
        return Channels(self.file, rate_hz, tuple(channels))

    def named(self, argument: str, key: str | int) -> Channel:
        """A channel by its name, with or without its unit, or by its number from 0."""
        names = [channel.title for channel in self.channels]
        if isinstance(key, str):
            for same in (str, _bare):
                found = [of for of in self.channels if same(key) in (same(of.name), same(of.title))]
                if len(found) == 1:
                    return found[0]
            # Options of the command line are texts.
            key = int(key) if key.isdecimal() and key not in names else key
        if not isinstance(key, (str, bool)) and 0 <= key < len(names):
            return self.channels[key]
        allowed = ", ".join(f"{number} ({name})" for number, name in enumerate(names))
        raise refused(argument, key, f"a channel of {self.file}", f"it has {allowed}")

    def rate(self, given: float | None) -> float:
        """The sample rate of the file, or the given one, which must agree with it."""
        if given is None and self.rate_hz is None:
            remedy = (
                f"{self.file} has no column of time: give the samples per second, or name this column "
                "time_s in the line above the numbers"
            )
            raise refused("rate_hz", None, "above 0", remedy)
        if given is None or self.rate_hz is None:
            return float(given or self.rate_hz or 0.0)
        # Times of few digits give a rate that is less exact than the given one.
        samples = max((len(channel.samples) for channel in self.channels), default=0)
        if not given > 0.0 or abs(self.rate_hz / given - 1.0) * samples > _UNEVEN:
            remedy = f"leave it out, because {self.file} has a rate of {self.rate_hz:g} Hz"
            raise refused("rate_hz", given, "left out", remedy)
        return given


@dataclass(frozen=True)
class ResponseFunction:
    """A frequency response with its unit; the speed is None if the file does not give one."""

    name: str
    unit: str
    frequency_hz: FloatArray
    response: ComplexArray
    rpm: float | None
