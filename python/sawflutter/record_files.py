"""Records of a saw from files."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import numpy.typing as npt

from . import _channels
from ._channels import Channel, Channels
from ._entry import FloatArray
from ._values import Number, number
from .errors import ArgumentError, InputError, refused
from .records import Record

# A pulse begins above the upper share of the range of the signal, after it was below the lower one.
_LOWER, _MIDDLE, _UPPER = 0.4, 0.5, 0.6


def read_record(
    path: str | os.PathLike[str],
    *,
    signal: str | int | None = None,
    rpm: npt.ArrayLike | None = None,
    speed: str | int | None = None,
    tacho: str | int | None = None,
    pulses_per_turn: int = 1,
    rate_hz: Number | None = None,
    unit: str | None = None,
    scale: Number = 1.0,
) -> Record:
    """Reads a record of a saw from a WAV file, a table (CSV), or a universal file with data sets 58.

    A table has one row for each sample, and names of its columns with units, such as ``time_s``,
    ``probe [mm]``, ``rpm``. Separators and decimal mark are determined from it. Universal files are
    read by pyuff, WAV files by SciPy.

    Parameters
    ----------
    path : str or path
        The file: .wav, .csv (.txt, .tsv, .dat), .uff (.unv, .uf).
    signal : str or int, optional
        Name or number, from 0, of the channel of the probe or microphone; columns of time are not
        counted. By default the first channel that is neither the speed nor the tachometer.
    rpm : float, (float, float) or array_like, optional
        The speed, as in :class:`Record`.
    speed : str or int, optional
        Channel of the speed in rpm; by default the one with this unit, or named rpm or speed.
    tacho : str or int, optional
        Channel of the pulses of a tachometer.
    pulses_per_turn : int
        Number of its pulses in one rotation.
    rate_hz : float, optional
        Sample rate of a table without a column of time.
    unit : str, optional
        Unit of the signal; by default that of the file.
    scale : float
        Factor from the numbers of the file to the unit, such as that of the probe. The numbers of a
        WAV file of integers are shares of full scale.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import sawflutter as sf
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "probe.csv"
    >>> _ = path.write_text("time_s;probe_mm;rpm\\n0,0;0,1;0\\n0,5;0,2;10\\n1,0;0,1;20\\n")
    >>> record = sf.read_record(path)
    >>> record.unit, record.rate_hz, record.rpm.tolist()
    ('mm', 2.0, [0.0, 10.0, 20.0])
    """
    found = _channels.read(path)
    given = [name for name, of in (("rpm", rpm), ("speed", speed), ("tacho", tacho)) if of is not None]
    if len(given) > 1:
        raise ArgumentError(f"{' and '.join(given)} are given, but the speed has one source; keep one")
    turning = _turning(found, given, speed, tacho)
    chosen = _signal(found, signal, turning)
    rate = _rate(found, rate_hz)
    if rpm is not None:
        speeds: npt.ArrayLike = rpm
    elif turning is None:
        remedy = (
            "give rpm=0 for a tap test, rpm=(from, to) for a run-up at a constant rate, or a channel as speed or tacho"
        )
        raise refused("rpm", None, f"given, because {found.file} has no channel of a speed", remedy)
    elif tacho is None:
        speeds = turning.samples
    else:
        speeds = _speed_of_pulses(turning.samples, rate, pulses_per_turn)
    samples = number("scale", scale) * chosen.samples
    return Record(
        samples, rate, speeds, unit=chosen.unit if unit is None else unit, name=Path(path).name
    )


def _turning(
    found: Channels, given: list[str], speed: str | int | None, tacho: str | int | None
) -> Channel | None:
    """The channel of the speed or the tachometer; None if the speed is given, or missing."""
    if tacho is not None:
        return found.named("tacho", tacho)
    if speed is not None:
        channel = found.named("speed", speed)
        if channel.unit and not channel.is_speed():
            remedy = "convert it, and give it as rpm, one value for each sample"
            raise refused("speed", f"{channel.name} [{channel.unit}]", "in rpm", remedy)
        return channel
    speeds = [channel for channel in found.channels if channel.is_speed()]
    if not given and len(speeds) > 1:
        names = ", ".join(channel.name for channel in speeds)
        raise ArgumentError(f"speed is missing, but {found.file} has several speeds ({names}); choose one")
    return speeds[0] if speeds and not given else None


def _signal(found: Channels, signal: str | int | None, turning: Channel | None) -> Channel:
    if signal is not None:
        return found.named("signal", signal)
    others = (of for of in found.channels if of is not turning and not of.is_speed())
    first = next(others, None)
    if first is None:
        raise InputError(f"{found.file} has no channel beside time and speed; export the probe as well")
    return first


def _rate(found: Channels, rate_hz: Number | None) -> float:
    if found.rate_hz is None and rate_hz is None:
        remedy = f"give the samples per second, because {found.file} has no column of time"
        raise refused("rate_hz", None, "above 0", remedy)
    if found.rate_hz is not None and rate_hz is not None:
        remedy = f"leave it out, because {found.file} has a rate of {found.rate_hz:g} Hz"
        raise refused("rate_hz", number("rate_hz", rate_hz), "left out", remedy)
    return number("rate_hz", rate_hz) if rate_hz is not None else float(found.rate_hz or 0.0)


def _speed_of_pulses(samples: FloatArray, rate_hz: float, pulses_per_turn: int) -> FloatArray:
    """The speed in rpm at each sample. Each turn gives its mean speed, at its middle; between these
    the speed is interpolated, and before the first and after the last one it is constant."""
    if pulses_per_turn < 1:
        remedy = "give the number of marks or slots of the tachometer"
        raise refused("pulses_per_turn", pulses_per_turn, "at least 1", remedy)
    low, high = float(samples.min()), float(samples.max())
    lower, middle, upper = (low + share * (high - low) for share in (_LOWER, _MIDDLE, _UPPER))
    # Levels that are neither high nor low keep the last state.
    state = np.where(samples >= upper, 1, np.where(samples <= lower, 0, -1))
    known = np.maximum.accumulate(np.where(state >= 0, np.arange(len(state)), 0))
    is_high = state[known] == 1
    begun = np.flatnonzero(is_high[1:] & ~is_high[:-1]) + 1
    if len(begun) <= pulses_per_turn:
        allowed = f"a channel with more pulses than those of one turn, {pulses_per_turn}"
        remedy = "give the channel of the pulses, or the speed as rpm"
        raise refused("tacho", f"{len(begun)} pulses", allowed, remedy)
    before, after = samples[begun - 1], samples[begun]
    share = np.clip((middle - before) / np.where(after > before, after - before, 1.0), 0.0, 1.0)
    times = (begun - 1 + share) / rate_hz
    turns = times[pulses_per_turn:] - times[:-pulses_per_turn]
    middles = 0.5 * (times[pulses_per_turn:] + times[:-pulses_per_turn])
    return np.asarray(np.interp(np.arange(len(samples)) / rate_hz, middles, 60.0 / turns))
