"""The process that ``sawflutter margin`` starts: how fast a measured saw may turn.

    python -m sawflutter._margin_command

reads the arguments as JSON from its input, writes the files and prints the text. What has gone wrong
is printed instead, with exit code 1 and without any file.
"""

from __future__ import annotations

import csv
import json
import re
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

from . import _native
from ._command import answered, in_options, png, wrapped
from .errors import ArgumentError, InputError
from .margins import MeasuredMargin, measured_margin
from .scene import Scene

# Seconds between two lines of progress.
_APART = 10.0


def run(given: dict[str, Any]) -> str:
    """Samples the saws of the arguments, writes the files, and returns the text."""
    saw = Scene.from_json(json.dumps(given["scene"]))
    rpm, hz = _peaks(given["peaks"])
    free = {path: (low, high) for path, low, high in given["free"]}
    options = {name: given[name] for name in ("orders", "margin", "steps")}
    try:
        found = measured_margin(saw, rpm, hz, free, progress=_lines(), **options)
    except ArgumentError as error:
        message = in_options(error, ("orders", "margin", "steps", "free"))
        raise InputError(message.replace("peak_hz must be", f"the peaks of {given['peaks']} must be")) from None
    out = Path(given["out"])
    files = {
        "margin.csv": _saws(found).encode(), "peak-modes.csv": _modes(found).encode(), "margin.png": png(found.chart()),
    }  # fmt: skip
    for name, content in files.items():
        (out / name).write_bytes(content)
    lines = [of for line in str(found).split("\n") for of in (wrapped(line, "    ") or [""])]
    # The margins of the lines are lost where they are wrapped.
    return "\n".join([*lines, "", f"Written to {out}: {', '.join(files)}", ""])


def _peaks(path: str) -> tuple[list[float], list[float]]:
    """Speed and frequency of each peak of a table: of frequencies one in a line, or several."""
    speeds, found = list[float](), list[float]()
    rows = csv.DictReader(_native.read_text(path, True).splitlines())
    titles = rows.fieldnames or ()
    names = [name for name in titles if re.fullmatch(r"frequency_hz|f\d+", name)]
    if "rpm" not in titles or not names:
        listed = ", ".join(titles) or "no line of titles"
        raise InputError(f"{path} has {listed}, but must have the columns rpm and frequency_hz; name them so")
    for row in rows:
        for name in names:
            if row[name]:
                try:
                    # A line that is too short has no speed.
                    pair = float(row["rpm"] or ""), float(row[name])
                except ValueError:
                    raise InputError(f"line {rows.line_num} of {path} has no number in rpm or {name}; correct it") from None
                speeds.append(pair[0])
                found.append(pair[1])
    return speeds, found


def _saws(found: MeasuredMargin) -> str:
    titles = [*found.paths, "deviation_hz", "critical_rpm", "flutter_rpm"]
    columns = [*found.numbers.T, found.deviation_hz, found.critical_rpm, found.flutter_rpm]
    return _table(titles, columns)


def _modes(found: MeasuredMargin) -> str:
    titles = ["rpm", "frequency_hz", "mode", "probability"]
    return _table(titles, [found.rpm, found.peak_hz, found.mode, found.probability])


def _table(titles: list[str], columns: list[Any]) -> str:
    rows = [",".join("" if np.isnan(one) else f"{one:.8g}" for one in row) for row in zip(*columns)]
    return "\n".join([",".join(titles), *rows, ""])


def _lines() -> Any:
    """Prints lines of progress at intervals."""
    last = [time.monotonic()]

    def told(what: str, done: int, of: int) -> None:
        if time.monotonic() - last[0] > _APART:
            last[0] = time.monotonic()
            print(f"{done} of {of} {what}", file=sys.stderr, flush=True)

    return told


if __name__ == "__main__":
    sys.exit(answered(run))
