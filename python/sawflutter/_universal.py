"""Channels and frequency responses from data sets 58 of universal files, in text or binary."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ._channels import HERTZ, Channel, Channels, ResponseFunction, known_factor
from ._entry import ComplexArray, FloatArray
from ._tables import magnitude, of_times
from .errors import InputError

_TIME_RESPONSE, _RESPONSE_FUNCTION, _GENERAL = 1, 4, 0
# Types of abscissas; 0 and 1 are unknown and general.
_TIME, _FREQUENCY, _OF_RPM = 17, 18, 19
_IEEE = 2
# Types of ordinates: real and complex, in single and double precision.
_SINGLE, _COMPLEX, _TYPES = (2, 5), (5, 6), (2, 4, 5, 6)
_BEGIN = re.compile(rb"^ *-1[ \r]*\n *58(?:[bB](?P<binary>[^\n]*)|[ \r][^\n]*)?\n", re.MULTILINE)
_END = re.compile(rb"^ *-1[ \r]*$", re.MULTILINE)
_LINES_OF_HEADER, _LONGEST_HEADER = 11, 4096
# Line with the type of the ordinates, the number of samples, and the abscissas.
_OF_ABSCISSA = 6
# A number in text; Fortran writes exponents with D, and those of three digits without a letter.
_NUMBER = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+))(?:[EeDd]?([-+]\d+)|[EeDd](\d+))?")
# Most numbers of a line of text, which fillers complete.
_MOST_IN_LINE = 6


@dataclass(frozen=True)
class _Set:
    """A data set 58."""

    kind: int
    title: str
    unit: str
    kind_of_abscissa: int
    unit_of_abscissa: str
    abscissa: FloatArray
    ordinate: FloatArray | ComplexArray
    rpm: float | None


def read(path: str | os.PathLike[str]) -> Channels:
    """The time histories of a file."""
    found = _sets(path, (_TIME_RESPONSE, _GENERAL), _TIME, "time history")
    rates = [(of_times(path, of.abscissa, of.unit_of_abscissa or "s"), len(of.ordinate)) for of in found]
    if any(abs(rate / rates[0][0] - 1.0) > 1e-6 or size != rates[0][1] for rate, size in rates):
        each = ", ".join(f"{size} samples at {rate:g} Hz" for rate, size in rates)
        raise InputError(f"the channels of {path} differ ({each}); export them with one rate and length")
    names = [of.title or f"data set {number}" for number, of in enumerate(found)]
    if len(set(names)) < len(names):
        names = [f"{name} ({number})" for number, name in enumerate(names)]
    channels = (Channel(name, of.unit, np.asarray(of.ordinate, float)) for name, of in zip(names, found))
    return Channels(str(path), rates[0][0], tuple(channels))


def read_responses(path: str | os.PathLike[str]) -> list[ResponseFunction]:
    """The frequency responses of a file."""
    responses = list[ResponseFunction]()
    for number, of in enumerate(_sets(path, (_RESPONSE_FUNCTION,), _FREQUENCY, "frequency response")):
        name = of.title or f"data set {number}"
        values, unit = of.ordinate, of.unit
        if not np.iscomplexobj(values):
            values, unit = magnitude(path, Channel(name, unit, np.asarray(values, float)))
        factor = known_factor(HERTZ, of.unit_of_abscissa or "Hz", f"frequencies of {path}")
        responses.append(
            ResponseFunction(name, unit, factor * of.abscissa, np.asarray(values, complex), of.rpm)
        )
    return responses


def holds_response(path: str | os.PathLike[str]) -> bool:
    """Whether a file has a frequency response."""
    return any(of.kind == _RESPONSE_FUNCTION for of in _all_sets(path))


def _sets(
    path: str | os.PathLike[str], kinds: tuple[int, ...], abscissa: int, wanted: str
) -> list[_Set]:
    """The data sets 58 of some types of function."""
    sets = _all_sets(path)
    found = [of for of in sets if of.kind in kinds and of.kind_of_abscissa in (0, 1, abscissa)]
    if not found:
        others = ", ".join(sorted({f"{of.kind} over {of.kind_of_abscissa}" for of in sets})) or "no data set 58"
        raise InputError(
            f"{path} has no {wanted} (data set 58 with the type of function {' or '.join(map(str, kinds))} "
            f"over abscissas of the type {abscissa}), but {others}; export it with one"
        )
    return found


def _all_sets(path: str | os.PathLike[str]) -> list[_Set]:
    """The data sets 58 of a file."""
    sets = list[_Set]()
    try:
        for header, body, binary in _blocks(Path(path).read_bytes().removeprefix(b"\xef\xbb\xbf")):
            sets.append(_set(header, body, binary))
    except ValueError as error:
        raise InputError(f"data set 58 number {len(sets) + 1} of {path} cannot be read: {error}") from None
    return sets


def _blocks(content: bytes) -> Iterator[tuple[list[str], bytes, list[int]]]:
    """Lines of the header, body, and fields of the first line if the body is binary, of each data set."""
    at = 0
    while begin := _BEGIN.search(content, at):
        near = content[begin.end() : begin.end() + _LONGEST_HEADER]
        *lines, rest = near.split(b"\n", _LINES_OF_HEADER)
        at = begin.end() + len(near) - len(rest)
        fields = (begin["binary"] or b"").split()
        binary = [int(field) for field in fields if field.isdigit()]
        if fields and (len(binary) < len(fields) or len(fields) < 4):
            raise ValueError("its first line has not the fields of a binary data set; export it as text")
        end = _END.search(content, at)
        size = binary[3] if binary else (end.start() if end else len(content)) - at
        try:
            header = [line.decode().rstrip() for line in lines]
        except UnicodeDecodeError:
            header = [line.decode("latin-1").rstrip() for line in lines]
        yield header, content[at : at + size], binary
        at += size


def _set(header: list[str], body: bytes, binary: list[int]) -> _Set:
    if len(header) < _LINES_OF_HEADER:
        raise ValueError("its header is not complete; export it again")
    kind_of_ordinate, count, even = (_whole(header, _OF_ABSCISSA, begin, begin + 10) for begin in (0, 10, 20))
    if kind_of_ordinate not in _TYPES:
        raise ValueError(f"its type of ordinate is {kind_of_ordinate}, but must be one of {_TYPES}; export it again")
    first, step, z = (_real(header, begin) for begin in (30, 43, 56))
    parts = 2 if kind_of_ordinate in _COMPLEX else 1
    columns = parts if even else 1 + parts
    if binary:
        precision = 4 if kind_of_ordinate in _SINGLE else 8
        rows = _of_binary(body, binary, count, precision, parts, bool(even))
    else:
        numbers = _of_text(body.decode("latin-1"))
        rows = numbers[: len(numbers) // columns * columns].reshape(-1, columns)
    if not 0 < count <= len(rows):
        raise ValueError(
            f"{len(rows)} of {count} samples are there; export it again, or state the number that is there in "
            "columns 11 to 20 of line 7 below the 58"
        )
    if rows[count:].size >= _MOST_IN_LINE and rows[count:].any():
        raise ValueError(
            f"it states {count} samples, but has {len(rows)}; export it again, or state their number in columns "
            "11 to 20 of line 7 below the 58"
        )
    values = rows[:count]
    above, below = (_label(line[46:]) for line in (header[8], header[9]))
    return _Set(
        _whole(header, 5, 0, 5),
        next(filter(None, map(_label, (header[0], header[1], header[3], header[4]))), ""),
        f"{above}/{below}" if above and below else above,
        _whole(header, 7, 0, 10),
        _label(header[7][46:]),
        np.asarray(first + step * np.arange(count) if even else values[:, 0]),
        values[:, -2] + 1j * values[:, -1] if parts == 2 else values[:, -1],
        z if _whole(header, 10, 0, 10) == _OF_RPM else None,
    )


def _of_text(text: str) -> FloatArray:
    if foreign := _NUMBER.sub(" ", text).split():
        raise ValueError(f"it has {foreign[0]!r} instead of a number; export it again")
    return np.array([float(f"{of[1]}E{of[2] or of[3] or 0}") for of in _NUMBER.finditer(text)])


def _of_binary(body: bytes, fields: list[int], count: int, precision: int, parts: int, even: bool) -> FloatArray:
    order, floats = fields[:2]
    if floats != _IEEE:
        raise ValueError(f"its format of numbers is {floats}, but must be {_IEEE}, IEEE 754; export it with this one")
    # Abscissas are in single precision, but some programs write them as ordinates.
    wide = precision == 8 and len(body) >= count * 8 * (parts + 1)
    sizes = ([] if even else [8 if wide else 4]) + [precision] * parts
    row = np.dtype([(str(place), f"{'<' if order == 1 else '>'}f{size}") for place, size in enumerate(sizes)])
    rows = np.frombuffer(body, row, len(body) // row.itemsize)
    return np.column_stack([rows[name].astype(float) for name in row.names or ()])


def _whole(header: list[str], line: int, begin: int, end: int) -> int:
    """A whole number of the header, which is 0 if it is blank."""
    text = header[line][begin:end].strip()
    if not re.fullmatch(r"[-+]?\d*", text):
        raise ValueError(
            f"line {line + 1} below the 58 must have a whole number in the columns {begin + 1} to {end} (you gave "
            f"{text!r}); export it again"
        )
    return int(text or 0)


def _real(header: list[str], begin: int) -> float:
    """A number of the line with the abscissas, which is 0 if it is blank."""
    text = header[_OF_ABSCISSA][begin : begin + 13]
    return float(_of_text(text)[0]) if text.strip() else 0.0


def _label(text: str) -> str:
    """A text of the header; NONE is blank."""
    return "" if text.strip().upper() == "NONE" else text.strip()
