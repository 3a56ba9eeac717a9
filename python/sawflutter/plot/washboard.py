"""The lobe diagram of washboarding."""

from __future__ import annotations

import numpy as np

from .._report_types import WashboardReport
from .chart import Chart, Item, Line, Panel, Points, colours


def lobes(r: WashboardReport, facts: str) -> Chart:
    """Least cutting stiffness at which a motion grows, and its frequency, over the speed."""
    of = r.lobes
    # Zero has no logarithm: there a motion grows without the delayed force.
    positive = np.where(of.critical_stiffness_n_per_m > 0.0, of.critical_stiffness_n_per_m, np.nan)
    rows = zip(of.rpm, positive, of.frequency_hz)
    hover = [f"{rpm:.0f} rpm<br>{k:.3g} N/m<br>{hz:.1f} Hz" for rpm, k, hz in rows]
    own = np.array([r.rpm]), np.array([r.stiffness_n_per_m])
    colour = colours()["alarm" if r.verdict == "unstable" else "ink"]
    boundary: list[Item] = [
        Line(of.rpm, positive, colours()["flutter"], "a motion grows above", hover=hover),
        Points(*own, colour, "this cut", hollow=True),
    ]
    per_rpm = r.tooth_passing_hz / r.rpm
    teeth: list[Item] = [
        Line(of.rpm, share * per_rpm * of.rpm, colours()["quiet"], name, dashed=True)
        for share, name in ((1.0, "tooth passing"), (0.5, "half of it"))
    ]
    onset = Points(of.rpm, of.frequency_hz, colours()["flutter"], "frequency there", hover=hover)
    speeds = (float(of.rpm[0]), float(of.rpm[-1]))
    speed = "rotation speed Ω [rpm]"
    panels = (
        Panel(speed, "cutting stiffness [N/m]", boundary, speeds, y_log=True),
        Panel(speed, "frequency [Hz]", [*teeth, onset], speeds, harmonics=True),
    )
    return Chart(r.scene["name"], facts, panels)
