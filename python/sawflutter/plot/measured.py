"""Charts of records: spectra over speed beside computed branches, and spectra at one speed."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from .._entry import FloatArray
from .._picking import lowest_hz
from .chart import CURVE, Chart, Heat, Item, Line, Panel, Points, Upright, colours
from .look import with_harmonics

if TYPE_CHECKING:
    from .._report_types import Mode
    from ..peaks import Peaks
    from ..results import CampbellResults
    from ..scene import Scene
    from ..spectra import Spectrum
    from ..waterfalls import Waterfall

# Pale greens, over which the colours of branches and the rings of peaks are seen.
_GREENS = ("#ffffff", "#e2f2e6", "#b5ddc0", "#7fc297", "#4aa372")
# Speeds with rings; more would hide the branches.
_MOST_SPEEDS = 40
# Rows of the picture; more are not seen, and the largest of several is kept.
_MOST_ROWS = 600


def waterfall(
    w: Waterfall,
    computed: CampbellResults | None,
    peaks: Peaks | None,
    orders: list[float],
    range_db: float,
) -> Chart:
    """Levels over speed and frequency, with branches, orders and peaks."""
    step = -(-len(w.frequency_hz) // _MOST_ROWS)
    blocks = np.arange(0, len(w.frequency_hz), step)
    largest = np.maximum.reduceat(w.amplitude, blocks, axis=1)
    ends = np.append(blocks[1:], len(w.frequency_hz)) - 1
    rows = 0.5 * (w.frequency_hz[blocks] + w.frequency_hz[ends])
    above = w.frequency_hz >= lowest_hz(w.resolution_hz)
    top = float(w.amplitude[:, above].max(initial=0.0))
    levels = 20.0 * np.log10(np.maximum(largest.T / (top or 1.0), 1e-15))
    items: list[Item] = [Heat(w.rpm, rows, levels, "level [dB]", _GREENS, (-range_db, 0.0))]
    limit = float(w.frequency_hz[-1])
    first, last = float(w.rpm[0]), float(w.rpm[-1])
    items += _branches(computed)
    items += _rings(peaks)
    facts = f"{w.name}: 0 dB is {top:.3g} {w.unit}".rstrip() + f"; peaks {w.resolution_hz:.2g} Hz wide"
    if peaks is not None:
        of_order = int((~np.isnan(peaks.order)).sum())
        facts += f"; {len(peaks.rpm) - of_order} peaks picked, {of_order} at multiples of the speed left out"
    panel = Panel(
        "rotation speed Ω [rpm]",
        "frequency in space [Hz]",
        items,
        (first, last),
        (0.0, limit),
        harmonics=True,
        share=2.0,
    )
    title = computed.scene["name"] if computed else w.name
    return Chart(title, facts, tuple(with_harmonics((panel,), orders)))


def _branches(computed: CampbellResults | None) -> list[Item]:
    """The branches of the chart, without the labels at their ends, which may be beyond the record."""
    if computed is None:
        return []
    names = {branch.name for branch in computed.branches}
    lines = (item for item in computed.chart().panels[0].items if isinstance(item, Line))
    return [replace(line, end="", width=min(line.width, CURVE)) for line in lines if line.name in names]


def _rings(peaks: Peaks | None) -> list[Item]:
    """Picked peaks of some speeds; those at a multiple of the speed are small and grey."""
    if peaks is None:
        return []
    every = 1 + int(peaks.spectrum.max(initial=0)) // _MOST_SPEEDS
    shown = peaks.spectrum % every == 0
    groups = (
        (np.isnan(peaks.order), colours()["ink"], "picked peaks", 4.5),
        (~np.isnan(peaks.order), colours()["quiet"], "peaks at a multiple of the speed", 2.5),
    )
    return [
        Points(
            peaks.rpm[chosen],
            peaks.frequency_hz[chosen],
            colour,
            name,
            "ring",
            size,
            [f"{rpm:.0f} rpm<br>{hz:.2f} Hz measured" for rpm, hz in zip(peaks.rpm[chosen], peaks.frequency_hz[chosen])],
        )
        for chosen, colour, name, size in ((shown & of, *look) for of, *look in groups)
        if chosen.any()
    ]


def spectrum(s: Spectrum, saw: Scene | None, peaks: Peaks | None) -> Chart:
    """Level over frequency, with computed frequencies and peaks."""
    size = np.abs(s.response)
    top = float(size.max()) or 1.0

    def level(amplitude: FloatArray) -> FloatArray:
        return np.asarray(20.0 * np.log10(np.maximum(amplitude / top, 1e-15)))

    limit = float(s.frequency_hz[-1])
    hover = [f"{hz:.2f} Hz<br>{of:.3g} {s.unit}".rstrip() for hz, of in zip(s.frequency_hz, size)]
    line = Line(s.frequency_hz, level(size), colours()["ink"], s.name, 1.0, hover=hover)
    modes: tuple[Mode, ...] = () if saw is None else saw.modes(s.rpm).modes
    items: list[Item] = [
        Upright(mode.frequency_hz, colours()["forward"], name=f"computed: {mode.frequency_hz:.2f} Hz")
        for mode in modes
        if mode.frequency_hz <= limit
    ]
    items.append(line)
    if peaks is not None:
        said = [f"{hz:.2f} Hz measured" for hz in peaks.frequency_hz]
        rings = Points(
            peaks.frequency_hz, level(peaks.amplitude), colours()["alarm"], "picked peaks", "ring", hover=said
        )
        items.append(rings)
    facts = f"{s.name} at {s.rpm:.0f} rpm: 0 dB is {top:.3g} {s.unit}".rstrip()
    if saw is not None:
        facts += "; vertical lines are computed frequencies"
    panel = Panel(
        "frequency in space [Hz]", "level [dB]", items, (0.0, limit), (max(-100.0, float(level(size).min())), 5.0)
    )
    return Chart(s.name if saw is None else str(saw["name"]), facts, (panel,))
