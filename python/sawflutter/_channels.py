"""Channels of a record from WAV, CSV and UFF58 files."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from . import _native
from ._entry import ComplexArray, FloatArray
from ._extras import extra
from .errors import InputError, refused

T = TypeVar("T")

# Largest deviation of a time from even ones, as a share of a step: times of few digits deviate by
# less, and a missing sample by at least half a step.
_UNEVEN = 0.3
_TIMES = {"t", "time", "zeit", "temps", "tiempo", "tid"}
_SECONDS = {"": 1.0, "s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6}
_SPEEDS = {"rpm", "speed", "drehzahl", "n", "vitesse", "varvtal"}
_PER_MINUTE = {"rpm", "1/min", "min-1", "min^-1", "min⁻¹", "u/min", "r/min", "rev/min", "tr/min"}
# Numbers of a data set 58 of a universal file.
_TIME_RESPONSE, _RESPONSE_FUNCTION, _GENERAL = 1, 4, 0
_OF_RPM = 19


@dataclass(frozen=True)
class Channel:
    """Samples with a name and a unit, which may be blank."""

    name: str
    unit: str
    samples: FloatArray

    def is_speed(self) -> bool:
        """Whether it is a rotation speed in rpm, by its unit, or without one by its name."""
        return self.unit.lower() in _PER_MINUTE or (not self.unit and self.name.lower() in _SPEEDS)


@dataclass(frozen=True)
class Channels:
    """Channels that were sampled together."""

    file: str
    rate_hz: float | None
    channels: tuple[Channel, ...]

    def named(self, argument: str, key: str | int) -> Channel:
        """A channel by its name, or by its number from 0."""
        names = [channel.name for channel in self.channels]
        if isinstance(key, str) and key in names:
            return self.channels[names.index(key)]
        if not isinstance(key, (str, bool)) and 0 <= key < len(names):
            return self.channels[key]
        allowed = ", ".join(f"{number} ({name})" for number, name in enumerate(names))
        raise refused(argument, key, f"a channel of {self.file}", f"it has {allowed}")


@dataclass(frozen=True)
class ResponseFunction:
    """A frequency response with its unit; the speed is None if the file does not give one."""

    name: str
    unit: str
    frequency_hz: FloatArray
    response: ComplexArray
    rpm: float | None


def read(path: str | os.PathLike[str]) -> Channels:
    """The channels of a file, by the ending of its name."""
    return _by_ending(path, {"wav": _wav, "csv": _table, "uff": _universal})(path)


def read_responses(path: str | os.PathLike[str]) -> list[ResponseFunction]:
    """The frequency responses of a file, by the ending of its name."""
    return _by_ending(path, {"csv": _table_of_response, "uff": _universal_responses})(path)


def _by_ending(
    path: str | os.PathLike[str], readers: dict[str, Callable[[str | os.PathLike[str]], T]]
) -> Callable[[str | os.PathLike[str]], T]:
    ending = Path(path).suffix.lower().lstrip(".")
    same = {"wave": "wav", "txt": "csv", "tsv": "csv", "dat": "csv", "unv": "uff", "uf": "uff"}
    kind = same.get(ending, ending)
    if kind not in readers:
        known = [name for name in [*readers, *same] if same.get(name, name) in readers]
        allowed = ", ".join(f".{name}" for name in known)
        raise InputError(
            f"the name of {path} ends in {Path(path).suffix!r}, but must end in one of {allowed}; "
            "rename the file, or export it in one of these formats"
        )
    return readers[kind]


def _wav(path: str | os.PathLike[str]) -> Channels:
    with extra("records"):
        from scipy.io import wavfile
    try:
        with warnings.catch_warnings():
            # SciPy warns of blocks beside the samples, such as notes of the recorder.
            warnings.simplefilter("ignore", wavfile.WavFileWarning)
            rate, numbers = wavfile.read(path)
    except (ValueError, EOFError) as error:
        raise InputError(f"{path} is no WAV file that can be read ({error}); export PCM or float") from None
    if not len(numbers):
        raise InputError(f"{path} has no samples; record again, or give another file")
    samples = np.asarray(numbers, float).reshape(len(numbers), -1)
    if numbers.dtype.kind in "iu":
        info = np.iinfo(numbers.dtype)
        samples = (samples - (info.max + 1) / 2 * (info.min == 0)) / (0.5 * (float(info.max) - info.min))
    names = ("channel 0",) if samples.shape[1] == 1 else map("channel {}".format, range(samples.shape[1]))
    channels = (Channel(name, "full scale", of) for name, of in zip(names, samples.T.copy()))
    return Channels(str(path), float(rate), tuple(channels))


def _columns(path: str | os.PathLike[str]) -> list[Channel]:
    """The columns of a table."""
    return [Channel(name, unit, np.frombuffer(of, "<f8")) for name, unit, of in _native.columns(path)]


def _table(path: str | os.PathLike[str]) -> Channels:
    columns = _columns(path)
    times = [column for column in columns if column.name.lower() in _TIMES]
    others = tuple(column for column in columns if column.name.lower() not in _TIMES)
    if len(times) > 1:
        names = ", ".join(column.name for column in times)
        raise InputError(f"{path} has {len(times)} columns of time ({names}); keep one")
    rate = None
    for column in times:
        if column.unit.lower() not in _SECONDS:
            raise InputError(f"the times of {path} are in {column.unit!r}; give them in s or ms")
        rate = _rate(path, _SECONDS[column.unit.lower()] * column.samples)
    return Channels(str(path), rate, others)


def _rate(path: str | os.PathLike[str], times: FloatArray) -> float:
    """The sample rate of evenly spaced times."""
    steps = np.diff(times)
    step = (times[-1] - times[0]) / max(len(steps), 1)
    if not step > 0.0 or np.abs(times - times[0] - step * np.arange(len(times))).max() > _UNEVEN * step:
        raise InputError(
            f"the times of {path} are not evenly spaced (steps from {steps.min(initial=0.0):g} to "
            f"{steps.max(initial=0.0):g} s); resample it, or write more digits of the time"
        )
    return float(1.0 / step)


def _table_of_response(path: str | os.PathLike[str]) -> list[ResponseFunction]:
    columns = _columns(path)
    if len(columns) not in (2, 3):
        raise InputError(
            f"{path} has {len(columns)} columns, but a frequency response has 3, frequency in Hz, "
            "real and imaginary part, or 2, frequency and magnitude; remove the others"
        )
    frequency, real = columns[:2]
    imaginary = columns[2].samples if len(columns) == 3 else 0.0
    if frequency.unit.lower() not in ("", "hz"):
        raise InputError(f"the frequencies of {path} are in {frequency.unit!r}; give them in Hz")
    response = np.asarray(real.samples + 1j * imaginary, np.complex128)
    return [ResponseFunction(Path(path).name, real.unit, frequency.samples, response, None)]


def _sets(path: str | os.PathLike[str], kinds: tuple[int, ...], wanted: str) -> Iterator[dict[str, Any]]:
    """The data sets 58 of some types of function."""
    with extra("records"):
        import pyuff
    if not Path(path).exists():
        raise FileNotFoundError(f"there is no file {path}")
    try:
        file = pyuff.UFF(os.fspath(path))
        of_58 = np.flatnonzero(file.get_set_types() == 58)
        sets = [file.read_sets(int(number)) for number in of_58]
    except Exception as error:  # noqa: BLE001 pyuff raises nothing narrower
        raise InputError(f"{path} cannot be read as a universal file ({error}); export data set 58") from None
    found = [data for data in sets if data["func_type"] in kinds]
    if not found:
        others = ", ".join(sorted({str(data["func_type"]) for data in sets})) or "no data set 58"
        raise InputError(
            f"{path} has no {wanted} (type of function {' or '.join(map(str, kinds))} of data set "
            f"58), but {others}; export it with one"
        )
    yield from found


def _universal(path: str | os.PathLike[str]) -> Channels:
    channels, rates = list[Channel](), list[tuple[float, int]]()
    for number, data in enumerate(_sets(path, (_TIME_RESPONSE, _GENERAL), "time history")):
        samples = np.asarray(data["data"], float)
        even = bool(data["abscissa_spacing"]) and data["abscissa_inc"] > 0.0
        rates.append((1.0 / data["abscissa_inc"] if even else _rate(path, data["x"]), len(samples)))
        channels.append(Channel(_title(data, f"data set {number}"), _unit(data), samples))
    if any(abs(rate / rates[0][0] - 1.0) > 1e-6 or size != rates[0][1] for rate, size in rates):
        each = ", ".join(f"{size} samples at {rate:g} Hz" for rate, size in rates)
        raise InputError(f"the channels of {path} differ ({each}); export them with one rate and length")
    names = [channel.name for channel in channels]
    if len(set(names)) < len(names):
        channels = [Channel(f"{of.name} ({k})", of.unit, of.samples) for k, of in enumerate(channels)]
    return Channels(str(path), rates[0][0], tuple(channels))


def _universal_responses(path: str | os.PathLike[str]) -> list[ResponseFunction]:
    return [
        ResponseFunction(
            _title(data, f"data set {number}"),
            _unit(data),
            np.asarray(data["x"], float),
            np.asarray(data["data"], complex),
            float(data["z_axis_value"]) if data.get("z_axis_spec_data_type") == _OF_RPM else None,
        )
        for number, data in enumerate(_sets(path, (_RESPONSE_FUNCTION,), "frequency response"))
    ]


def _title(data: dict[str, Any], otherwise: str) -> str:
    """The first line of text of a data set that is not blank."""
    texts = (str(data.get(key, "")).strip() for key in ("id1", "id2", "id4", "id5"))
    return next((text for text in texts if text.upper() not in ("", "NONE")), otherwise)


def _unit(data: dict[str, Any]) -> str:
    """The unit of the numbers of a data set, over that of its denominator if it has one."""
    above, below = (
        str(data.get(f"{of}_axis_units_lab", "")).strip() for of in ("ordinate", "orddenom")
    )
    above, below = ("" if unit.upper() == "NONE" else unit for unit in (above, below))
    return f"{above}/{below}" if above and below else above
