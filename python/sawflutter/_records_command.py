"""The process that ``sawflutter records`` starts: it reads records and frequency responses.

    python -m sawflutter._records_command

reads the arguments as JSON from its input, writes the files and prints the text. What has gone wrong
is printed instead, with exit code 1 and without any file.
"""

from __future__ import annotations

import json
import shlex
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from . import _files
from ._command import answered, in_options, png, wrapped
from ._measured import titled
from ._trend import is_steady
from .errors import ArgumentError, InputError
from .peaks import Peaks, listed
from .plot.chart import Chart
from .record_files import read_signal
from .records import Record
from .results import CampbellResults
from .scene import Scene
from .spectra import Spectrum, read_frf
from .waterfalls import WIDTH

Row = tuple[float, list[float]]
# Arguments that are options of the command line, too.
_OPTIONS = ("rpm", "speed", "tacho", "pulses_per_turn", "signal", "rate_hz", "to_hz")
# Largest number of frequencies of a tap in a row of a fit.
_MOST_FREQUENCIES = 24
# Width of a Gaussian window at half its height, in standard deviations.
_HALF_WIDTH = 2.355
# Largest number of peaks that the text lists.
_LISTED = 12


@dataclass
class _Read:
    """Peaks and rows of a file."""

    name: str
    words: str
    """Kind, size and speed of the file."""
    peaks: Peaks | None
    chart: Chart | None
    rows: list[Row]
    remark: str
    """Why there are no peaks, or no rows."""


def run(given: dict[str, Any]) -> str:
    """Reads the files of the arguments, writes what they give, and returns the text."""
    saw = None if given["saw"] is None else Scene.from_json(json.dumps(given["saw"]))
    campbell: list[CampbellResults] = []

    def computed() -> CampbellResults | None:
        """The chart of the saw, which records of a run-up alone need."""
        if saw is not None and not campbell:
            campbell.append(saw.run_campbell())
        return campbell[0] if campbell else None

    found = [_read(path, given, saw, computed) for path in given["files"]]
    rows = [row for of in found for row in of.rows]
    if all(of.peaks is None for of in found):
        raise InputError("; ".join(f"{of.name}: {of.remark}" for of in found))
    out = Path(given["out"])
    names = _written(out, found, rows)
    return _text(found, rows, names, out, given["saw_file"])


def _read(
    path: str, given: dict[str, Any], saw: Scene | None, computed: Callable[[], CampbellResults | None]
) -> _Read:
    """Reads a file; errors name the options."""
    try:
        if _files.holds_response(path):
            return _of_spectrum(_response(path, given["rpm"]), "frequency response", saw)
        options = {name: given[name] for name in _OPTIONS if name != "to_hz"}
        record, signal, others = read_signal(path, **options)
        if given.get("between"):
            record = record.between(*given["between"])
    except ArgumentError as error:
        message = in_options(error, _OPTIONS)
        raise InputError(message if path in message else f"{path} was refused: {message}") from None
    words = _words(record, signal)
    if others:
        words += f"; --signal can also be {', '.join(others)}"
    if np.ptp(record.samples) == 0.0:
        other = f": {' or '.join(others)}" if others else ", or give another file"
        return _Read(record.name, words, None, None, [], f"no spectrum: {signal} does not change; name another --signal{other}")
    try:
        if is_steady(record.rpm):
            return _of_spectrum(record.spectrum(to_hz=given["to_hz"]), words, saw)
        waterfall = record.waterfall(to_hz=given["to_hz"])
    except ArgumentError as error:
        # The record is read, but it is too short, or its speed rises and falls.
        return _Read(record.name, words, None, None, [], f"no spectrum: {in_options(error, _OPTIONS)}")
    peaks = waterfall.peaks()
    rows, remark = _rows(peaks, saw, None)
    mean_s = _HALF_WIDTH * WIDTH / waterfall.resolution_hz
    words += f"; {len(waterfall.rpm)} spectra, {waterfall.resolution_hz:.2g} Hz wide, each at the mean speed of {mean_s:.2g} s"
    return _Read(record.name, words, peaks, waterfall.chart(computed(), peaks), rows, remark)


def _response(path: str, rpm: float | list[float] | None) -> Spectrum:
    if isinstance(rpm, list):
        raise InputError(f"{path} is a frequency response, at one speed; give --rpm one number")
    return read_frf(path, rpm=rpm)


def _of_spectrum(spectrum: Spectrum, words: str, saw: Scene | None) -> _Read:
    peaks = spectrum.peaks()
    rows, remark = _rows(peaks, saw, spectrum.rpm)
    if words == "frequency response":
        unit = f" ({spectrum.unit})" if spectrum.unit else ""
        lines = f"{len(spectrum.frequency_hz)} lines up to {spectrum.frequency_hz[-1]:g} Hz"
        words += f"{unit}, {lines}, {spectrum.rpm:g} rpm"
    return _Read(spectrum.name, words, peaks, spectrum.chart(saw, peaks), rows, remark)


def _words(record: Record, signal: str) -> str:
    speeds = f"{record.rpm.mean():.0f} rpm" if is_steady(record.rpm) else record._course().removeprefix("from ")
    unit = f" ({record.unit})" if record.unit else ""
    size = f"{len(record.samples)} samples at {record.rate_hz:g} Hz, {record.time_s[-1]:.4g} s"
    return f"record of {signal}{unit}, {size}, {speeds}"


def _rows(peaks: Peaks, saw: Scene | None, rpm: float | None) -> tuple[list[Row], str]:
    """Rows for a fit, or why there are none. A tap at rest shows each pair of modes once, which a fit
    knows; otherwise peaks need the computed frequencies of a saw."""
    free = peaks.frequency_hz[np.isnan(peaks.order)]
    if not len(free):
        return [], "no row for fit: no peak is that of a mode"
    if saw is not None:
        try:
            return peaks.rows(saw), ""
        except ArgumentError as error:
            return [], f"no row for fit: {error}"
    if rpm == 0.0:
        return [(0.0, [float(hz) for hz in np.sort(free)[:_MOST_FREQUENCIES]])], ""
    return [], "no row for fit: give the saw by --saw, whose frequencies are assigned to the peaks"


def _written(out: Path, found: Sequence[_Read], rows: Sequence[Row]) -> list[str]:
    """Writes the files when all of them are complete, and gives their names."""
    peaks = [(of.name, of.peaks) for of in found if of.peaks is not None]
    files: dict[str, bytes] = {"peaks.csv": listed(peaks).encode()}
    if rows:
        files["measured.csv"] = titled(rows).encode()
    for of in found:
        if of.chart is not None:
            stem = name = Path(of.name).stem
            number = 2
            while f"{name}.png" in files:
                name, number = f"{stem}-{number}", number + 1
            files[f"{name}.png"] = png(of.chart)
    out.mkdir(parents=True, exist_ok=True)
    # Rows of an earlier run would be taken for those of these files.
    (out / "measured.csv").unlink(missing_ok=True)
    for name, content in files.items():
        (out / name).write_bytes(content)
    return list(files)


def _text(
    found: Sequence[_Read], rows: Sequence[Row], names: Sequence[str], out: Path, saw_file: str | None
) -> str:
    peaks = [of.peaks for of in found if of.peaks is not None]
    free = sum(int(np.isnan(of.order).sum()) for of in peaks)
    frequencies = sum(int((~np.isnan(hz)).sum()) for _, hz in rows)
    modes = f"{_count(frequencies, 'frequency', 'frequencies')} in {_count(len(rows), 'row')} for a fit"
    answer = f"{_count(free, 'peak')} in {_count(len(found), 'file')}; {modes if rows else 'none in a row for a fit'}"
    lines = [*wrapped(answer, ""), ""]
    for of in found:
        lines += wrapped(f"{of.name}: {of.words}", "    ")
        if of.peaks is not None:
            lines += wrapped(_listed(of.peaks), "    ", "  ")
        if of.remark:
            lines += wrapped(of.remark, "    ", "  ")
    lines += ["", f"Written to {out}: {', '.join(names)}"]
    if rows:
        words = ["sawflutter", "fit", saw_file or "my-saw.json", str(out / "measured.csv")]
        lines.append(f"Next: {shlex.join(words)}")
    return "\n".join(lines) + "\n"


def _count(number: int, one: str, several: str = "") -> str:
    return f"{number} {one if number == 1 else several or one + 's'}"


def _listed(peaks: Peaks) -> str:
    free = np.isnan(peaks.order)
    of_order = f", {int((~free).sum())} near multiples of the speed" if not free.all() else ""
    if len(np.unique(peaks.spectrum)) > 1 or free.sum() > _LISTED:
        return f"{int(free.sum())} peaks at {len(np.unique(peaks.spectrum))} speeds{of_order}"
    hz = " ".join(f"{hz:.2f}" for hz in peaks.frequency_hz[free])
    return f"peaks at {hz} Hz{of_order}" if hz else f"no peaks{of_order}"


if __name__ == "__main__":
    sys.exit(answered(run))
