"""Channels of the binary files of LabVIEW and MATLAB."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

import numpy as np

from . import _native
from ._channels import Channel, Channels
from ._extras import extra
from ._tables import of_columns
from .errors import InputError

# Names of the numbers of a file of MATLAB that are the sample rate, or the time from one sample to the next.
_RATES = {"fs", "samplerate", "samplingrate", "samplefrequency", "samplingfrequency", "abtastrate", "ratehz", "rate", "fshz"}
_STEPS = {"dt", "ts", "dts", "timestep", "deltat"}


def read_tdms(path: str | os.PathLike[str]) -> Channels:
    """The channels of a file of LabVIEW."""
    with extra("instruments"):
        from nptdms import TdmsFile
    try:
        groups = TdmsFile.read(path).groups()
        found = [(group.name, of, of[:]) for group in groups for of in group.channels() if len(of)]
    except (ValueError, KeyError, EOFError) as error:
        raise InputError(f"{path} is no TDMS file that can be read ({error}); export it again, or as CSV") from None
    if not found:
        raise InputError(f"{path} has no channels of LabVIEW; export it again as TDMS, or as CSV")
    several = len({group for group, _, _ in found}) > 1
    channels, steps = list[Channel](), set[float]()
    for group, of, numbers in found:
        if numbers.dtype.kind == "M":
            numbers = (numbers - numbers[0]) / np.timedelta64(1, "s")
            channels.append(Channel("time", "s", np.asarray(numbers, float)))
        elif numbers.dtype.kind in "iuf":
            name, unit = _titled(f"{group} {of.name}" if several else of.name)
            channels.append(Channel(name, of.properties.get("unit_string") or unit, np.asarray(numbers, float)))
            steps.add(float(of.properties.get("wf_increment", 0.0)))
    return of_columns(path, _of_one_length(path, channels), _one_rate(path, steps - {0.0}))


def read_mat(path: str | os.PathLike[str]) -> Channels:
    """The arrays of a file of MATLAB, also those in structures; the columns of a matrix are channels."""
    with extra("records"):
        from scipy.io import loadmat
        from scipy.io.matlab import MatReadError
    try:
        content = loadmat(path, simplify_cells=True)
    except NotImplementedError:
        raise InputError(f"{path} has the format 7.3 of MATLAB; save it by save('record.mat', ..., '-v7')") from None
    except (ValueError, TypeError, IndexError, MatReadError) as error:
        raise InputError(f"{path} is no MAT file that can be read ({error}); save it again, or as CSV") from None
    channels, steps = list[Channel](), set[float]()
    for path_in, numbers in _arrays("", {name: of for name, of in content.items() if not name.startswith("__")}):
        plain = path_in.rpartition(".")[2].lower().replace("_", "").replace(" ", "")
        if numbers.size == 1 and plain in _RATES | _STEPS and float(numbers.flat[0]) > 0.0:
            one = float(numbers.flat[0])
            steps.add(1.0 / one if plain in _RATES else one)
        elif numbers.size > 1 and numbers.ndim <= 2:
            columns = np.atleast_2d(numbers)
            columns = columns if columns.shape[0] < columns.shape[1] else columns.T
            name, unit = _titled(path_in)
            names = [name] if len(columns) == 1 else [f"{name} {place}" for place in range(1, len(columns) + 1)]
            channels += [Channel(of, unit, np.array(column, float)) for of, column in zip(names, columns)]
    if not channels:
        raise InputError(f"{path} has no arrays of numbers; a timetable must be saved as arrays: t = seconds(T.Time)")
    return of_columns(path, _of_one_length(path, channels), _one_rate(path, steps))


def _arrays(path: str, found: Any) -> Iterator[tuple[str, np.ndarray[Any, Any]]]:
    """Arrays of numbers with their names, those of structures joined by points."""
    if isinstance(found, dict):
        for name, of in found.items():
            yield from _arrays(f"{path}.{name}" if path else name, of)
    else:
        numbers = np.asarray(found)
        if numbers.dtype.kind in "iuf" and numbers.size:
            yield path, numbers


def _titled(title: str) -> tuple[str, str]:
    """Name and unit of a title, as those of a table."""
    cell = title.replace('"', "'")
    ((name, unit, _),) = _native.columns("title", f'"{cell}"\t\n0\t\n')
    return name, unit


def _of_one_length(path: str | os.PathLike[str], channels: list[Channel]) -> list[Channel]:
    if len({len(of.samples) for of in channels}) > 1:
        each = ", ".join(f"{of.title}: {len(of.samples)}" for of in channels)
        raise InputError(f"the channels of {path} differ in length ({each}); keep those of one rate and length")
    if any(not np.isfinite(of.samples).all() for of in channels):
        bad = next(of for of in channels if not np.isfinite(of.samples).all())
        raise InputError(f"{bad.title} of {path} has numbers that are not finite; remove it, or fill the gaps")
    return channels


def _one_rate(path: str | os.PathLike[str], steps: set[float]) -> float | None:
    """The sample rate, if the file states one."""
    if not steps:
        return None
    first = min(steps)
    if any(abs(step / first - 1.0) > 1e-6 for step in steps):
        rates = ", ".join(f"{1.0 / step:g} Hz" for step in sorted(steps))
        raise InputError(f"the channels of {path} have different rates ({rates}); keep those of one rate")
    return 1.0 / first
