"""Records of a saw from files."""

from __future__ import annotations

import os
from pathlib import Path

import numpy.typing as npt

from . import _files
from ._channels import Channel, Channels
from ._pulses import jumps, speed_of
from ._values import Number, number
from .errors import ArgumentError, InputError, refused
from .records import Record


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
    r"""Reads a record of a saw from a WAV file, a table (CSV, LabVIEW, a spreadsheet), a universal file
    with data sets 58, or a file of LabVIEW (TDMS) or MATLAB.

    A table has one row for each sample, and names of its columns with units, such as ``time_s``,
    ``probe [mm]``, ``rpm``. Separators and decimal mark are determined from it. Comments begin with #, % or
    \*. SciPy reads WAV files and those of MATLAB up to version 7, npTDMS those of LabVIEW, and pandas
    spreadsheets.

    Parameters
    ----------
    path : str or path
        The file: .wav, .csv (.txt, .tsv, .dat, .lvm), .xlsx, .uff (.unv, .uf), .tdms, .mat.
    signal : str or int, optional
        Name, with or without unit, or number, from 0, of the channel of the probe or microphone;
        columns of time are not counted. By default the first channel that is neither a speed nor pulses of a tachometer nor
        a number of the sample.
    rpm : float, (float, float) or array_like, optional
        The speed, as in :class:`Record`.
    speed : str or int, optional
        Channel of the speed; by default the one in rpm, or named rpm or speed.
    tacho : str or int, optional
        Channel of the pulses of a tachometer.
    pulses_per_turn : int
        Number of its pulses in one rotation; of a wheel with missing teeth, that of its pulses or of
        its teeth with the missing ones. Each turn gives one speed.
    rate_hz : float, optional
        Sample rate of a table without a column of time, or a more exact one than that of rounded
        times. Uneven times without gaps, such as those of a phone, are interpolated at it.
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
    >>> _ = path.write_text("time_s;probe_mm;rpm\n0,0;0,1;0\n0,5;0,2;10\n1,0;0,1;20\n")
    >>> record = sf.read_record(path)
    >>> record.unit, record.rate_hz, record.rpm.tolist()
    ('mm', 2.0, [0.0, 10.0, 20.0])
    """
    if not isinstance(path, (str, os.PathLike)):
        remedy = 'make a record of numbers: sf.Record(table["probe"], rate_hz, rpm=table["rpm"])'
        raise refused("path", type(path).__name__, "the path of a file", remedy)
    return read_signal(
        path, signal=signal, rpm=rpm, speed=speed, tacho=tacho, pulses_per_turn=pulses_per_turn,
        rate_hz=rate_hz, unit=unit, scale=scale,
    )[0]  # fmt: skip


def read_signal(
    path: str | os.PathLike[str],
    *,
    signal: str | int | None,
    rpm: npt.ArrayLike | None,
    speed: str | int | None,
    tacho: str | int | None,
    pulses_per_turn: int,
    rate_hz: Number | None,
    unit: str | None = None,
    scale: Number = 1.0,
) -> tuple[Record, str, list[str]]:
    """The record of :func:`read_record`, the name of its channel, and those of others that may be meant."""
    found = _files.read(path)
    given = [name for name, of in (("rpm", rpm), ("speed", speed), ("tacho", tacho)) if of is not None]
    if len(given) > 1:
        raise ArgumentError(f"{' and '.join(given)} are given, but the speed has one source; keep one")
    rate_given = None if rate_hz is None else number("rate_hz", rate_hz)
    found = found.evenly(rate_given)
    turning = _turning(found, given, speed, tacho)
    chosen, *others = _signals(found, signal, turning)
    rate = found.rate(rate_given)
    if rpm is not None:
        speeds: npt.ArrayLike = rpm
    elif turning is None:
        pulses = [f"tacho={of.name!r}" for of in found.channels if jumps(of.samples)]
        titles = ", ".join(of.title for of in found.channels)
        such = f", such as {' or '.join(pulses)}" if pulses else f" (it has {titles})"
        remedy = (
            "give rpm=0 for a tap test, rpm=(from, to) for a run-up at a constant rate, or a channel as "
            f"speed or tacho{such}"
        )
        unknown = "".join(f" in rpm ({of.name} is in {of.unit!r})" for of in found.channels if of.is_speed())
        raise refused("rpm", None, f"given, because {found.file} has no channel of a speed{unknown}", remedy)
    elif tacho is None:
        speeds = (turning.to_rpm() or 1.0) * turning.samples
    else:
        speeds = speed_of(turning.samples, rate, pulses_per_turn)
    samples = number("scale", scale) * chosen.samples
    unit = chosen.unit if unit is None else unit
    return Record(samples, rate, speeds, unit=unit, name=Path(path).name), chosen.name, [of.title for of in others]


def _turning(
    found: Channels, given: list[str], speed: str | int | None, tacho: str | int | None
) -> Channel | None:
    """The channel of the speed or the tachometer; None if the speed is given, or missing."""
    if tacho is not None:
        return found.named("tacho", tacho)
    speeds = [of for of in found.channels if of.is_speed() and of.to_rpm() is not None]
    if speed is not None:
        speeds = [found.named("speed", speed)]
    elif given or not speeds:
        return None
    elif len(speeds) > 1:
        names = ", ".join(channel.title for channel in speeds)
        raise ArgumentError(f"speed is missing, but {found.file} has several speeds ({names}); choose one")
    of = speeds[0]
    if of.to_rpm() is None:
        remedy = "convert it, and give it as rpm, one value for each sample"
        raise refused("speed", f"{of.name} [{of.unit}]", "in rpm", remedy)
    if jumps(of.samples):
        shown = f"{of.name}, which jumps between {of.samples.min() + 0.0:g} and {of.samples.max() + 0.0:g}"
        remedy = f"if these are pulses of a tachometer, give tacho={of.name!r}, otherwise the speed as rpm"
        raise refused("speed", shown, "a rotation speed", remedy)
    return of


def _signals(found: Channels, signal: str | int | None, turning: Channel | None) -> list[Channel]:
    """The channel of the probe, and others that may be meant if none is named."""
    if signal is not None:
        of = found.named("signal", signal)
        if of.rises_evenly():
            remedy = "if it is the time, name it time_s in the line above the numbers"
            raise refused("signal", of.name, "a probe, but this channel rises evenly", remedy)
        return [of]
    signals = [
        of for of in found.channels
        if not (of is turning or of.is_speed() or of.rises_evenly() or jumps(of.samples))
    ]  # fmt: skip
    if signals:
        return signals
    titles = ", ".join(of.title for of in found.channels)
    raise InputError(
        f"{found.file} has no channel beside time, speed and pulses ({titles}); export the probe as well, or name it "
        "as signal"
    )
