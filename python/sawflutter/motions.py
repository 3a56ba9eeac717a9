"""Motions of the blade: in a cut, in a run-up, under a force, and in washboarding."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._extras import frame
from ._report_types import CutReport, DeflectReport, GapReport, ResponseReport, RunUpReport, WashboardReport
from ._result import Result

if TYPE_CHECKING:
    import pandas as pd


class CutResults(Result, CutReport):
    """A saw in a cut, at one or several speeds."""

    _command, _rows_of, _steps = "cut", "runs", "points of the map"


class RunUpResults(Result, RunUpReport):
    """A run-up under a lateral force."""

    _command, _steps = "runup", "steps"

    def to_dataframe(self) -> pd.DataFrame:
        return frame({"rpm": self.rpm, "deflection_m": self.deflection_m})


class DeflectResults(Result, DeflectReport):
    """Equilibrium deflection of the blade while its speed slowly rises and falls."""

    _command, _steps = "deflect", "equilibria"

    def to_dataframe(self) -> pd.DataFrame:
        names = ("rpm", "deflection_m", "largest_deflection_m", "largest_slope")
        rows = [
            {"direction": direction, "arc": number, **dict(zip(names, point))}
            for direction, sweep in (("up", self.up), ("down", self.down))
            for number, arc in enumerate(sweep.arcs)
            for point in zip(*(getattr(arc, name) for name in names))
        ]
        return frame(rows)


class ResponseResults(Result, ResponseReport):
    """Steady-state amplitude and phase over the speed, and over the frequency at one speed."""

    _command = "response"

    def to_dataframe(self) -> pd.DataFrame:
        columns = {line.name: line.amplitude_m for line in self.lines}
        table = {"rpm": self.rpm, **columns, "board_deviation_m": self.board_deviation_m}
        return frame([dict(zip(table, row)) for row in zip(*table.values())])


class GapResults(Result, GapReport):
    """Guides with a gap: the chart over the amplitude, and the deflection at the cut."""

    _command, _steps = "gap", "amplitudes"

    def to_dataframe(self) -> pd.DataFrame:
        found = self.deviation
        rows = [
            {"gap_factor": factor, "force_n": force, "deflection_m": at, "largest_deflection_m": most}
            for factor, deflections, largest in zip(
                found.gap_factors, found.deflection_m, found.largest_deflection_m
            )
            for force, at, most in zip(found.forces_n, deflections, largest)
        ]
        return frame(rows)


class WashboardResults(Result, WashboardReport):
    """Washboarding: whether the cutting force on the surface left by the previous tooth makes a
    motion grow."""

    _command, _rows_of = "washboard", "modes"
