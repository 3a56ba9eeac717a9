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

    def _facts(self) -> str:
        verdicts = ", ".join(
            f"{run.verdict.replace('_', ' ')} at {run.rpm:.0f} rpm" for run in self.runs
        )
        stretched = any(run.stretching is not None for run in self.runs)
        return f"{verdicts}, with stretching" if stretched else verdicts


class RunUpResults(Result, RunUpReport):
    """A run-up under a lateral force."""

    _command, _steps = "runup", "steps"

    def _rows(self) -> pd.DataFrame:
        return frame({"rpm": self.rpm, "deflection_m": self.deflection_m})

    def _facts(self) -> str:
        last = self.rpm[-1]
        crossed = sum(entry.band.from_rpm < last for entry in self.bands)
        doubling = self.first_doubling_rpm
        at = "none" if doubling is None else f"the first at {doubling:.0f} rpm"
        facts = f"{self.rpm[0]:.0f} to {last:.0f} rpm, {crossed} bands crossed"
        if self.linear_until_rpm is not None:
            facts += f", where the linear model ends; asked up to {self.to_rpm:.0f} rpm"
        if self.stretching is not None:
            facts += ", with stretching"
        return f"{facts}; bands that more than double a motion: {at}"


class DeflectResults(Result, DeflectReport):
    """Equilibrium deflection of the blade while its speed slowly rises and falls."""

    _command, _steps = "deflect", "equilibria"

    def _rows(self) -> pd.DataFrame:
        names = ("rpm", "deflection_m", "largest_deflection_m", "largest_slope")
        rows = [
            {"direction": direction, "arc": number, **dict(zip(names, point))}
            for direction, sweep in (("up", self.up), ("down", self.down))
            for number, arc in enumerate(sweep.arcs)
            for point in zip(*(getattr(arc, name) for name in names))
        ]
        return frame(rows)

    def _facts(self) -> str:
        jumps = f"{len(self.up.jumps)} jumps while the speed rises"
        return f"{self.force_n:g} N across the rim, {jumps}, {len(self.down.jumps)} while it falls"


class ResponseResults(Result, ResponseReport):
    """Steady-state amplitude and phase over the speed, and over the frequency at one speed."""

    _command = "response"

    def _rows(self) -> pd.DataFrame:
        columns = {line.name: line.amplitude_m for line in self.lines}
        table = {"rpm": self.rpm, **columns, "board_deviation_m": self.board_deviation_m}
        return frame([dict(zip(table, row)) for row in zip(*table.values())])

    def _facts(self) -> str:
        causes = ", ".join(line.name for line in self.lines)
        if self.operating is None or self.operating.board_deviation_m is None:
            return causes
        deviation = 1e3 * self.operating.board_deviation_m
        return f"{causes}; board within {deviation:.3g} mm at {self.operating.rpm:.0f} rpm"


class GapResults(Result, GapReport):
    """Guides with a gap: the chart over the amplitude, and the deflection at the cut."""

    _command, _steps = "gap", "amplitudes"

    def _rows(self) -> pd.DataFrame:
        found = self.deviation
        rows = [
            {"gap_factor": factor, "force_n": force, "deflection_m": at, "largest_deflection_m": most}
            for factor, deflections, largest in zip(
                found.gap_factors, found.deflection_m, found.largest_deflection_m
            )
            for force, at, most in zip(found.forces_n, deflections, largest)
        ]
        return frame(rows)

    def _facts(self) -> str:
        half = self.half_way_amplitude_m
        at = "half way at no amplitude" if half is None else f"half way at {1e3 * half:.4g} mm"
        return f"smallest gap {1e3 * self.smallest_gap_m:g} mm, first critical speed: {at}"


class WashboardResults(Result, WashboardReport):
    """Washboarding: whether the cutting force on the surface left by the previous tooth makes a
    motion grow."""

    _command, _rows_of = "washboard", "modes"

    def _facts(self) -> str:
        least = self.critical_stiffness_n_per_m
        beyond = f"none up to {self.ceiling_n_per_m:.3g}" if least is None else f"{least:.4g}"
        return f"{self.verdict} at {self.rpm:.0f} rpm, critical cutting stiffness {beyond} N/m"
