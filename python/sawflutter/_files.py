"""Channels and frequency responses of files, by the endings of their names."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numpy as np

from . import _instruments, _tables, _universal
from ._channels import Channel, Channels, ResponseFunction
from ._extras import extra
from .errors import InputError

T = TypeVar("T")
_BINARY = {"tdms": _instruments.read_tdms, "mat": _instruments.read_mat}
_TABLES = ("txt", "tsv", "dat", "lvm", "xlsx", "xlsm")


def read(path: str | os.PathLike[str]) -> Channels:
    """The channels of a file."""
    return _by_ending(path, {"wav": _wav, "csv": _tables.read, "uff": _universal.read, **_BINARY})


def read_responses(path: str | os.PathLike[str]) -> list[ResponseFunction]:
    """The frequency responses of a file."""
    return _by_ending(path, {"csv": _tables.read_response, "uff": _universal.read_responses})


def holds_response(path: str | os.PathLike[str]) -> bool:
    """Whether a file has a frequency response instead of channels over time."""
    over_time: dict[str, Callable[[str | os.PathLike[str]], bool]] = dict.fromkeys(["wav", *_BINARY], lambda _: False)
    readers = {**over_time, "csv": _tables.holds_response, "uff": _universal.holds_response}
    return _by_ending(path, readers)


def _by_ending(
    path: str | os.PathLike[str], readers: dict[str, Callable[[str | os.PathLike[str]], T]]
) -> T:
    ending = Path(path).suffix.lower().lstrip(".")
    same = {"wave": "wav", "unv": "uff", "uf": "uff"} | dict.fromkeys(_TABLES, "csv")
    kind = same.get(ending, ending)
    if kind not in readers:
        known = [name for name in [*readers, *same] if same.get(name, name) in readers]
        allowed = ", ".join(f".{name}" for name in known)
        raise InputError(
            f"the name of {path} ends in {Path(path).suffix!r}, but must end in one of {allowed}; "
            "rename the file, or export it in one of these formats"
        )
    # Numbers that are not finite are refused with the record or the frequency response.
    with np.errstate(over="ignore", invalid="ignore"):
        return readers[kind](path)


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
