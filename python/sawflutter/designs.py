"""Results of searches over many saws: fits, places, computing time against accuracy, and critical
speeds over the stiffness of the guides."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _native
from ._drawn import Drawn
from ._entry import Entry, FloatArray
from ._report_types import FitReport, PlaceReport, Setting
from ._result import Report, Result

if TYPE_CHECKING:
    from .plot.chart import Chart


class FitResults(Result, FitReport):
    """A saw fitted to measured frequencies; :attr:`saw` is the calibrated scene."""

    command, table, _steps = "fit", "parameters", "starts"

    def _facts(self) -> str:
        found = ", ".join(f"{found.path} = {found.value:.4g}" for found in self.parameters)
        return f"{found}; {self.rms_hz:.3f} Hz rms, before {self.rms_before_hz:.3f} Hz"


class PlaceResults(Result, PlaceReport):
    """The best place found for the guides; :attr:`saw` is the scene with it. Its chart has no
    panel without a map."""

    command, table, _steps = "place", "parameters", "saws"

    def _facts(self) -> str:
        found = ", ".join(f"{found.path} = {found.value:.4g}" for found in self.parameters)
        robust = "fragile" if self.fragile else "robust"
        kept = "" if self.kept else ", but the lower limit of the first critical speed is NOT kept"
        goal = f"{self.best.goal_rpm:.0f} rpm, before {self.before.goal_rpm:.0f}"
        worst = f"{1e2 * self.worst_neighbour_share:.0f} % in the worst case of its tolerances"
        return f"{found}; {goal}, {robust}: {worst}{kept}"


class TradeoffResults(Report):
    """Computing time against true error, for bases of several sizes."""

    table = "settings"

    def __init__(self, settings: Iterable[Setting], text: str, name: str) -> None:
        self.settings: tuple[Setting, ...] = tuple(settings)
        self.name = name
        self._text = text

    @classmethod
    def from_json(cls, text: str, name: str = "") -> TradeoffResults:
        """Reads a result from JSON.

        Parameters
        ----------
        text : str
            JSON as written by :meth:`save`.
        name : str
            Title of the scene.

        Returns
        -------
        TradeoffResults

        Raises
        ------
        json.JSONDecodeError
            If the text is not JSON.

        Examples
        --------
        >>> import sawflutter as sf
        >>> sf.TradeoffResults.from_json("[]", "none")
        <TradeoffResults 'none': 0 settings>
        """
        return cls((Setting.from_dict(setting) for setting in json.loads(text)), text, name)

    def recommended(self, error: float) -> Setting | None:
        """The fastest chart within a relative error.

        Parameters
        ----------
        error : float
            Largest true relative error.

        Returns
        -------
        Setting or None
            None if no chart reaches this accuracy.

        Examples
        --------
        >>> import sawflutter as sf
        >>> sf.TradeoffResults.from_json("[]").recommended(1e-3) is None
        True
        """
        charts = [s for s in self.settings if s.speeds > 0 and s.error <= error]
        return min(charts, key=lambda setting: setting.seconds, default=None)

    def _chart(self) -> Chart:
        from .plot.described import read

        return read(_native.tradeoff_chart(self.name, self._text))

    def __reduce__(self) -> tuple[Any, tuple[str, str]]:
        return TradeoffResults.from_json, (self._text, self.name)

    def __repr__(self) -> str:
        return f"<TradeoffResults {self.name!r}: {len(self.settings)} settings>"


@dataclass(frozen=True, eq=False, repr=False)
class StiffnessMap(Drawn, Entry):
    """Critical speeds of a saw over the stiffness of its guides, like the critical speed map of
    rotor dynamics over bearing stiffness. :meth:`sawflutter.Scene.run_stiffness_map` returns
    it."""

    name: str
    """Title of the scene."""

    stiffness_n_per_m: FloatArray
    """Stiffness of each guide that is varied."""

    critical_rpm: FloatArray
    """Critical speeds within the sweep, ascending, a row each; NaN where there are fewer."""

    flutter_rpm: FloatArray
    """Flutter speed of each; NaN where there is none within the sweep."""

    def _chart(self) -> Chart:
        from .plot.derived import stiffness

        return stiffness(self)
