"""Tables of numbers from instruments: columns with names, units, and either decimal mark."""

from __future__ import annotations

import codecs
import os
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ._entry import FloatArray
from .errors import InputError

# Lines from which separator and decimal mark are determined.
_LOOKED_AT = 50
_MARKS = ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16"))
# Units as the end of a name, like deflection_mm.
_ENDINGS = ("rpm", "hz", "khz", "s", "ms", "us", "m", "mm", "um", "µm", "v", "mv", "pa", "n", "g")
_SPEEDS = {"rpm", "speed", "drehzahl", "n", "vitesse", "varvtal"}
_PER_MINUTE = {"rpm", "1/min", "min-1", "min^-1", "min⁻¹", "u/min", "r/min", "rev/min", "tr/min"}


@dataclass(frozen=True)
class Channel:
    """Samples with a name and a unit, which may be blank."""

    name: str
    unit: str
    samples: FloatArray

    def is_speed(self) -> bool:
        """Whether it is a rotation speed in rpm, by its unit, or without one by its name."""
        return self.unit.lower() in _PER_MINUTE or (not self.unit and self.name.lower() in _SPEEDS)


def read(path: str | os.PathLike[str]) -> list[Channel]:
    """The columns of a table. Lines that begin with # and blank lines are ignored; names, and units
    below them, are optional."""
    lines = [
        (number, line)
        for number, line in enumerate(_text(path).splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    mark, comma = _written([line for _, line in lines[:_LOOKED_AT]])
    if mark and all(line.rstrip().endswith(mark) for _, line in lines):
        # Some instruments end each line with a separator.
        lines = [(number, line.rstrip()[:-1]) for number, line in lines]
    names = list[str]()
    while lines and len(names) < 2 and not any(map(_is_number, _cells(lines[0][1], mark, comma))):
        names.append(lines.pop(0)[1])
    if not lines:
        raise InputError(f"{path} has no line of numbers; give a table with one row for each sample")
    try:
        table = np.loadtxt(
            [line.replace(",", ".") if comma else line for _, line in lines],
            delimiter=mark,
            ndmin=2,
        )
    except ValueError:
        raise _fault(path, lines, mark, comma) from None
    if not np.isfinite(table).all():
        raise _fault(path, lines, mark, comma)
    titles = [_cells(line, mark, False) for line in names]
    return [_column(number, titles, column) for number, column in enumerate(table.T, start=1)]


def _text(path: str | os.PathLike[str]) -> str:
    content = Path(path).read_bytes()
    for mark, encoding in _MARKS:
        if content.startswith(mark):
            return content.decode(encoding)
    try:
        return content.decode()
    except UnicodeDecodeError:
        return content.decode("latin-1")


def _written(lines: list[str]) -> tuple[str | None, bool]:
    """The separator, None for blanks, and whether decimals begin with a comma."""
    text = "\n".join(lines)
    mark = next((mark for mark in ";\t," if mark in text), None)
    numbers = [cell for line in lines for cell in line.split(mark) if re.search(r"\d,\d", cell)]
    return mark, mark != "," and bool(numbers)


def _cells(line: str, mark: str | None, comma: bool) -> list[str]:
    cells = [cell.strip().strip('"') for cell in line.split(mark)]
    return [cell.replace(",", ".") for cell in cells] if comma else cells


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _fault(
    path: str | os.PathLike[str], lines: list[tuple[int, str]], mark: str | None, comma: bool
) -> InputError:
    """The first line that is not a row of as many numbers as the line before it."""
    width = len(_cells(lines[0][1], mark, comma))
    for number, line in lines:
        cells = _cells(line, mark, comma)
        if len(cells) != width:
            return InputError(
                f"line {number} of {path} has {len(cells)} columns, the first one {width}; give "
                "every line the same columns"
            )
        for place, cell in enumerate(cells, start=1):
            if not (_is_number(cell) and np.isfinite(float(cell))):
                return InputError(
                    f"line {number} of {path}: column {place} must be a finite number "
                    f"(you gave {cell!r}); remove the line, or fill the gap"
                )
    return InputError(f"{path} is no table of numbers; separate its columns by commas or tabs")


def _column(number: int, titles: list[list[str]], numbers: FloatArray) -> Channel:
    texts = [title[number - 1] if number <= len(title) else "" for title in titles]
    name, unit = split_unit(texts[0]) if texts else ("", "")
    below = texts[1].strip("[]() ") if len(texts) > 1 else ""
    return Channel(name or f"column {number}", below or unit, np.ascontiguousarray(numbers))


def split_unit(text: str) -> tuple[str, str]:
    """A name without its unit, and the unit.

    >>> split_unit("probe [mm]"), split_unit("deflection_m"), split_unit("rpm"), split_unit("f")
    (('probe', 'mm'), ('deflection', 'm'), ('rpm', 'rpm'), ('f', ''))
    """
    bracketed = re.fullmatch(r"(.*?)\s*[\[(]([^\])]*)[\])]\s*", text)
    if bracketed:
        return bracketed[1] or bracketed[2], bracketed[2].strip()
    name, _, ending = text.rpartition("_")
    if name and ending.lower() in _ENDINGS:
        return name, ending
    return text, "rpm" if text.lower() == "rpm" else ""
