"""Results of searches over many saws: fits, places, computing time against accuracy, and critical
speeds over the stiffness of the guides."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from . import _native
from ._drawn import Drawn
from ._entry import Entry, FloatArray
from ._report_types import DesignReport, FitReport, Instability, PlaceReport, Setting
from ._result import Report, Result
from ._values import Number, number


class FitResults(Result, FitReport):
    """A saw fitted to measured frequencies; :attr:`saw` is the calibrated scene."""

    _command, _rows_of, _steps = "fit", "parameters", "starts"

    def _answer(self) -> str:
        found = ", ".join(f"{found.path} = {found.value:.4g}" for found in self.parameters)
        return f"{super()._answer()}: {found}; {self.rms_hz:.3f} Hz rms, before {self.rms_before_hz:.3f} Hz"


class PlaceResults(Result, PlaceReport):
    """The best place found for the guides; :attr:`saw` is the scene with it. Its chart has no
    panel without a map."""

    _command, _rows_of, _steps = "place", "parameters", "saws"


class DesignResults(Result, DesignReport):
    """Report of a saw for a decision: its analyses idling and in the cut, its steady response, margins
    and the changes that help most. ``save`` writes the page to print to a name that ends in ``.html``."""

    _command, _rows_of = "report", "speeds"


class TradeoffResults(Report):
    """Computing time against true error, for bases of several sizes."""

    _rows_of = "settings"

    def __init__(self, text: str, name: str = "") -> None:
        self.settings: tuple[Setting, ...] = tuple(map(Setting._from_dict, json.loads(text)))
        self.name, self._text = name, text

    def recommended(self, error: Number) -> Setting | None:
        """The fastest chart whose true relative error is at most ``error``; None if no chart reaches
        this accuracy."""
        error = number("error", error)
        charts = [s for s in self.settings if s.speeds > 0 and s.error <= error]
        return min(charts, key=lambda setting: setting.seconds, default=None)

    def _drawing(self) -> str:
        return _native.tradeoff_chart(self.name, self._text)

    def __reduce__(self) -> tuple[Any, tuple[str, str]]:
        return TradeoffResults, (self._text, self.name)

    def __repr__(self) -> str:
        return f"<TradeoffResults {self.name!r}: {len(self.settings)} settings>"


@dataclass(frozen=True, eq=False, repr=False)
class StiffnessMap(Drawn, Entry):
    """Critical speeds of a saw over the stiffness of its guides, like the critical speed map of
    rotor dynamics over bearing stiffness. :meth:`sawflutter.Scene.run_stiffness_map` returns
    it.

    Attributes
    ----------
    name : title of the scene.
    stiffness_n_per_m : stiffness of each guide that is varied.
    critical_rpm : critical speeds within the sweep, ascending, a row each; NaN where there are fewer.
    flutter_rpm : flutter speed of each; NaN where there is none within the sweep.
    """

    name: str
    stiffness_n_per_m: FloatArray
    critical_rpm: FloatArray
    flutter_rpm: FloatArray

    def _drawing(self) -> str:
        return _native.stiffness_chart(self)


@dataclass(frozen=True, eq=False, repr=False)
class Speeds(Entry):
    """Speeds of a saw, of :meth:`sawflutter.Scene.speeds`.

    Attributes
    ----------
    name : title of the scene.
    to_rpm : last speed; the first one is 0.
    critical_rpm : critical speeds up to the last speed, ascending.
    lowest_critical_rpm : first critical speed, also above the last speed; None if there is none.
    flutter_rpm : flutter speed; None if there is none up to the last speed.
    bands : bands of instability up to the last speed, ascending.
    estimated_relative_error : estimated relative error of the critical speeds.
    """

    name: str
    to_rpm: float
    critical_rpm: FloatArray
    lowest_critical_rpm: float | None
    flutter_rpm: float | None
    bands: tuple[Instability, ...]
    estimated_relative_error: float

    def __repr__(self) -> str:
        critical, flutter = (
            "none" if rpm is None else f"{rpm:.0f} rpm" for rpm in (self.lowest_critical_rpm, self.flutter_rpm)
        )
        counted = f"{len(self.bands)} bands up to {self.to_rpm:.0f} rpm"
        return f"<Speeds {self.name!r}: first critical speed {critical}, flutter from {flutter}, {counted}>"
