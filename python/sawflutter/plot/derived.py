"""Charts of what the package derives from results: a speed over a grid of saws, and speeds over the
stiffness of guides."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .. import _native
from .._entry import FloatArray
from .._report_types import StudyReport
from .chart import STRONG_CURVE, Chart, Heat, Item, Line, Panel, colours

if TYPE_CHECKING:
    from ..designs import StiffnessMap


def grid(r: StudyReport, rows: FloatArray, names: tuple[str, str], speed: str) -> Chart:
    """A speed over the two numbers of a grid; rows of both and of the speed."""
    x, y = np.unique(rows[:, 0]), np.unique(rows[:, 1])
    z = np.full((len(y), len(x)), np.nan)
    for row, column in ((row, column) for row in range(len(y)) for column in range(len(x))):
        of = rows[(rows[:, 0] == x[column]) & (rows[:, 1] == y[row]), 2]
        # The median represents several random saws of one point of the grid.
        z[row, column] = np.median(of) if len(of) else np.nan
    label = speed.removesuffix("_rpm").replace("_", " ") + " speed [rpm]"
    panel = Panel(_native.axis_name(names[0]), _native.axis_name(names[1]), [Heat(x, y, z, label)])
    return Chart(r.study["name"], label, (panel,))


def stiffness(of: StiffnessMap) -> Chart:
    """Critical speeds and flutter speed over the stiffness of the guides."""
    x = of.stiffness_n_per_m
    items: list[Item] = [
        Line(x, column, colours()["forward"], f"critical speed {place}")
        for place, column in enumerate(of.critical_rpm.T, start=1)
    ]
    items.append(Line(x, of.flutter_rpm, colours()["flutter"], "flutter speed", STRONG_CURVE))
    panel = Panel("stiffness of each guide [N/m]", "rotation speed [rpm]", items, x_log=True)
    return Chart(of.name, "critical speeds (thin) and flutter speed (thick)", (panel,))
