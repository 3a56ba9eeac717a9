"""The process that ``sawflutter margin`` starts: how fast a measured saw may turn.

    python -m sawflutter._margin_command

reads the arguments as JSON from its input, writes the files and prints the text. What has gone wrong
is printed instead, with exit code 1 and without any file.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

from . import _native
from ._command import answered, in_options, png, wrapped
from ._progress import Callback
from .errors import ArgumentError, InputError
from .margins import MeasuredMargin
from .scene import Scene

# Seconds between two lines of progress.
_APART = 10.0


def run(given: dict[str, Any]) -> str:
    """Samples the saws of the arguments, writes the files, and returns the text."""
    saw = Scene.from_json(json.dumps(given["scene"]))
    rpm, hz = np.array(_native.peaks(given["peaks"])).reshape(-1, 2).T
    free = {path: (low, high) for path, low, high in given["free"]}
    options = {name: given[name] for name in ("orders", "margin", "steps")}
    try:
        found = saw.measured_margin(rpm, hz, free, progress=_lines(), **options)
    except ArgumentError as error:
        message = in_options(error, ("orders", "margin", "steps", "free"))
        raise InputError(message.replace("peak_hz must be", f"the peaks of {given['peaks']} must be")) from None
    out = Path(given["out"])
    files = {
        "margin.csv": _saws(found).encode(), "peak-modes.csv": _modes(found).encode(), "margin.png": png(found.chart()),
    }  # fmt: skip
    out.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        (out / name).write_bytes(content)
    lines = [of for line in str(found).split("\n") for of in (wrapped(line, "    ") or [""])]
    # The margins of the lines are lost where they are wrapped.
    return "\n".join([*lines, "", f"Written to {out}: {', '.join(files)}", ""])


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


def _lines() -> Callback:
    """Prints lines of progress at intervals."""
    last = [time.monotonic()]

    def told(done: int, of: int, what: str) -> None:
        if time.monotonic() - last[0] > _APART:
            last[0] = time.monotonic()
            print(f"{done} of {of} {what}", file=sys.stderr, flush=True)

    return told


if __name__ == "__main__":
    sys.exit(answered(run))
