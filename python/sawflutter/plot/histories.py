"""Deflections at the probe in the cut and in a run-up."""

from __future__ import annotations

import numpy as np

from .._report_types import CutReport, RunUpReport
from .chart import Chart, Heat, Item, Line, Panel, Points, Shade, colours


def cut(r: CutReport, facts: str) -> Chart:
    """Deflection at the probe over time, one panel for each speed."""
    panels = []
    for run in r.runs:
        colour = colours()["forward" if run.verdict == "stable" else "flutter"]
        frequency = "" if run.frequency_hz is None else f" at {run.frequency_hz:.2f} Hz"
        hover = [f"{t:.3f} s<br>{1e3 * w:.4g} mm" for t, w in zip(run.time_s, run.deflection_m)]
        items: list[Item] = [
            Shade(run.forces_from_s, run.forces_to_s, colours()["grid"], "forces act"),
            Line(run.time_s, 1e3 * run.deflection_m, colour, f"{run.rpm:.0f} rpm", hover=hover),
        ]
        title = f"{run.rpm:.0f} rpm: {run.verdict.replace('_', ' ')}, {run.growth_per_s:.3g} 1/s{frequency}"
        panels.append(Panel("time [s]", "deflection [mm]", items, title=title))
    return Chart(r.scene["name"], facts, tuple(panels))


def cut_map(r: CutReport, run: int) -> Chart:
    """Growth over guide angle and load."""
    of = r.runs[run]
    growth = np.maximum(of.map.growth_per_s, 0.0)
    heat = Heat(of.map.guide_angle_deg, of.map.load_level, growth, "growth [1/s]")
    name = "angle of the first guide, all guides moving with it [°]"
    panel = Panel(name, "multiple of the forces", [heat])
    return Chart(r.scene["name"], f"growth at {of.rpm:.0f} rpm", (panel,))


def response(r: RunUpReport) -> Chart:
    """Deflection per newton over speed and frequency, with the branches on top."""
    of = r.response
    micrometres = 1e6 * of.receptance_m_per_n.T
    decades = np.log10(np.maximum(micrometres, 1e-12))
    top = float(np.max(decades))
    heat = Heat(of.rpm, of.frequency_hz, decades, "log₁₀ of µm/N", range=(top - 4.0, top))
    items: list[Item] = [heat]
    limit = float(of.frequency_hz[-1])
    for branch in r.campbell.branches:
        shown = np.where(branch.frequency_hz <= limit, branch.frequency_hz, np.nan)
        items.append(
            Line(branch.rpm, shown, colours()[branch.direction[-1]], branch.name, width=1.0)
        )
    measured = r.scene.get("measured")
    for row in measured["rows"] if measured else []:
        below = np.array([hz for hz in row["frequencies_hz"] if hz is not None and hz <= limit])
        speed = np.full(len(below), row["rpm"])
        items.append(Points(speed, below, colours()["ink"], hollow=True))
    speeds = (float(of.rpm[0]), float(of.rpm[-1]))
    y_name, limits = "frequency of the force [Hz]", (0.0, limit)
    panel = Panel("rotation speed Ω [rpm]", y_name, items, speeds, limits, harmonics=True)
    return Chart(r.scene["name"], "deflection at the probe per newton", (panel,))
