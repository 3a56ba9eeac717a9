"""Channels and frequency responses from tables, by the names and units of their columns."""

from __future__ import annotations

import os
import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from . import _native, _spreadsheets as spreadsheets
from ._channels import (
    HERTZ,
    RADIANS,
    SECONDS,
    Channel,
    Channels,
    ResponseFunction,
    even_step,
    factor,
    has_no_gap,
    known_factor,
)
from ._entry import FloatArray
from .errors import InputError

_TIMES = {
    "t", "time", "zeit", "temps", "tiempo", "tid", "tijd", "timestamp", "zeitstempel", "messzeit", "laufzeit",
    "elapsed",
}  # fmt: skip
# Words that the name of a time may have as well.
_BESIDE = {"stamp", "relative", "absolute", "date", "écoulé", "default", "sample", "rate", "axis"}
# Lowest sample rate of times without a unit: a lower one is rather of milliseconds, or of numbers of
# samples.
_LOWEST_RATE_HZ = 20.0
# Words for the columns of a frequency response; the first kind with a word in the name is taken.
_KINDS = {
    "coherence": {"coherence", "kohärenz", "cohérence", "coh"},
    "phase": {"phase", "phi", "φ", "arg", "angle", "winkel", "phasenwinkel", "deg", "rad"},
    "imaginary": {"im", "imag", "imaginary", "imaginärteil", "imaginaire"},
    "real": {"re", "real", "realteil", "réelle"},
    "magnitude": {"mag", "magnitude", "amplitude", "abs", "betrag", "module", "modulus", "gain", "level", "pegel", "db"},
    "frequency": {"f", "freq", "frequency", "frequenz", "fréquence", "frecuencia", "frekvens", "omega", "ω", "hz"},
}  # fmt: skip
_PARTS, _POLAR = {"frequency", "real", "imaginary"}, {"frequency", "magnitude", "phase"}


def read(path: str | os.PathLike[str]) -> Channels:
    """The channels of a table."""
    return of_columns(path, _columns(path))


def of_columns(path: str | os.PathLike[str], columns: list[Channel], rate_hz: float | None = None) -> Channels:
    """The channels of columns, one of which may be the time, or of a rate that the file gives."""
    times = [column for column in columns if _is_time(column)]
    others = tuple(column for column in columns if not _is_time(column))
    if any(of.unit != times[0].unit or (of.samples != times[0].samples).any() for of in times):
        names = ", ".join(column.title for column in times)
        raise InputError(f"{path} has {len(times)} columns of time ({names}); keep one")
    if not times:
        return Channels(str(path), rate_hz, others)
    time = times[0]
    seconds = known_factor(SECONDS, time.unit or "s", f"times of {path}") * time.samples
    if even_step(seconds) is None and has_no_gap(seconds):
        return Channels(str(path), None, others, seconds)
    rate = of_times(path, time.samples, time.unit or "s")
    if not time.unit and rate < _LOWEST_RATE_HZ and time.rises_evenly():
        raise InputError(
            f"the times of {path} rise by {1.0 / rate:g}, and the column {time.name} has no unit; name "
            "it with one: time_s, time_ms"
        )
    return Channels(str(path), rate, others)


def holds_response(path: str | os.PathLike[str]) -> bool:
    """Whether a table has frequencies and no times."""
    columns = _columns(path)
    if any(_is_time(column) and factor(HERTZ, column.unit) is None for column in columns):
        return False
    kinds = [kind for kind, column in map(_of_response, columns) if not column.unit or factor(HERTZ, column.unit)]
    return "frequency" in kinds


def of_times(path: str | os.PathLike[str], times: FloatArray, unit: str) -> float:
    """The sample rate of evenly spaced times."""
    seconds = known_factor(SECONDS, unit, f"times of {path}") * times
    step = even_step(seconds)
    if step is None:
        if len(seconds) < 2:
            raise InputError(f"{path} has fewer than two times; record more samples")
        steps = np.diff(times)
        raise InputError(
            f"the times of {path} are not evenly spaced (steps from {steps.min():g} to {steps.max():g} {unit}); "
            "resample it, or write more digits of the time"
        )
    return 1.0 / step


def read_response(path: str | os.PathLike[str]) -> list[ResponseFunction]:
    """The frequency response of a table."""
    found, others = dict[str, Channel](), list[Channel]()
    for kind, column in map(_of_response, _columns(path)):
        if kind in found:
            raise InputError(
                f"{path} has two columns of one kind, {kind} ({found[kind].name}, {column.name}); keep one "
                "frequency response"
            )
        if kind:
            found[kind] = column
        else:
            others.append(column)
    if len(others) == 1 and not {"real", "imaginary", "magnitude"} & set(found):
        found["magnitude"] = others.pop()
    kinds = set(found) - {"coherence"}
    is_polar = {"frequency", "magnitude"} <= kinds <= _POLAR
    if others or not (is_polar or _PARTS <= kinds <= _PARTS | _POLAR):
        names = ", ".join([f"{of.name} ({kind})" for kind, of in found.items()] + [of.name for of in others])
        raise InputError(
            f"{path} has the columns {names}, but a frequency response has frequency_hz, real, imaginary, or "
            "frequency_hz, magnitude, phase_deg; name them so in a line above the numbers, and remove others"
        )
    axis = found["frequency"]
    if not axis.unit and not {"omega", "ω", "khz", "rpm", "rad"}.isdisjoint(_words(axis.name)):
        raise InputError(f"the column {axis.name} of {path} has no unit; name it with one: f_hz, omega [rad/s]")
    frequency_hz = axis.samples * known_factor(HERTZ, axis.unit or "Hz", f"frequencies of {path}")
    if is_polar:
        size, unit = magnitude(path, found["magnitude"])
        response = size * np.exp(1j * _phase(path, found.get("phase")))
    else:
        real, imaginary = found["real"], found["imaginary"]
        if real.unit != imaginary.unit:
            raise InputError(
                f"real and imaginary part in {path} have the units {real.unit!r} and {imaginary.unit!r}; "
                "give them one unit"
            )
        response, unit = real.samples + 1j * imaginary.samples, real.unit
    return [ResponseFunction(Path(path).name, unit, frequency_hz, np.asarray(response, np.complex128), None)]


def magnitude(path: str | os.PathLike[str], column: Channel) -> tuple[FloatArray, str]:
    """Magnitudes, also from levels in dB, and their unit."""
    if not column.unit.lower().startswith("db"):
        if column.samples.min() < 0.0:
            raise InputError(
                f"the magnitudes {column.name} of {path} must be 0 or more (you gave {column.samples.min():g}); "
                "give them the unit dB if they are levels, and a real part its imaginary part"
            )
        return column.samples, column.unit
    reference = column.unit[2:].strip(" ()")
    level = re.fullmatch(r"(?:re[fl]?\b[.:]?\s*)?(\d+(?:\.\d*)?(?:e[-+]?\d+)?)?\s*(\S*)", reference, re.IGNORECASE)
    if level is None or column.unit[2:3] not in ("", " ", "(") or reference in ("A", "B", "C"):
        raise InputError(
            f"the magnitudes {column.name} of {path} are in {column.unit!r}, which has no known reference; "
            "write dB, or dB re 1 mm/N"
        )
    return float(level[1] or 1.0) * 10.0 ** (column.samples / 20.0), level[2]


def _phase(path: str | os.PathLike[str], column: Channel | None) -> FloatArray | float:
    if column is None:
        return 0.0
    if not column.unit:
        raise InputError(
            f"the phases {column.name} of {path} have no unit; name the column phase_deg or phase_rad"
        )
    return column.samples * known_factor(RADIANS, column.unit, f"phases {column.name} of {path}")


def _columns(path: str | os.PathLike[str]) -> list[Channel]:
    """The columns of a table, which may be that of a spreadsheet."""
    text = spreadsheets.text(path) if Path(path).suffix.lower() in spreadsheets.ENDINGS else None
    return [Channel(name, unit, np.frombuffer(of, "<f8")) for name, unit, of in _native.columns(path, text)]


def _words(text: str) -> set[str]:
    return set(re.findall(r"[^\W\d_]+", text.lower()))


def _is_time(column: Channel) -> bool:
    # LabVIEW names a time "Time - " and its channel.
    words = _words(column.name.split(" - ")[0])
    if column.name == column.unit:
        return factor(SECONDS, column.unit) is not None
    return words == {"x", "value"} or (bool(words & _TIMES) and words <= _TIMES | _BESIDE)


def _of_response(column: Channel) -> tuple[str, Channel]:
    """The kind of a column of a frequency response, which may be blank, and the column."""
    words = _words(re.sub(r"\((?:f|j?ω)\)", "", column.name))
    if words == {"x", "value"}:
        return "frequency", column
    in_brackets = column.unit.lower()
    if any(in_brackets in names for names in _KINDS.values()) and not (
        in_brackets == "db" or factor(HERTZ | RADIANS, in_brackets)
    ):
        # The kind is in the brackets of the unit: "FRF (imag)".
        words, column = words | {in_brackets}, replace(column, unit="")
    return next((kind for kind, names in _KINDS.items() if names & words), ""), column
