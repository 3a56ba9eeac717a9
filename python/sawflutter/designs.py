"""Results of searches over many saws: fits, places, computing time against accuracy, and critical
speeds over the stiffness of the guides."""

from __future__ import annotations

import json
from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING, Any

from . import _native
from ._drawn import Drawn
from ._entry import Entry, FloatArray
from ._extras import extra, frame, plain
from ._report_types import DesignReport, FitReport, Instability, PlaceReport, Setting, SizeReport
from ._result import Report, Result
from ._saving import Tabled
from ._values import Number, number
from .errors import refused

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


class FitResults(Result, FitReport):
    """A saw fitted to measured frequencies; :attr:`saw` is the calibrated scene."""

    _command, _rows_of, _steps = "fit", "parameters", "starts"

    def _answer(self) -> str:
        found = ", ".join(f"{found.path} = {found.value:.4g}" for found in self.parameters)
        return f"{super()._answer()}: {found}; {self.rms_hz:.3f} Hz rms, before {self.rms_before_hz:.3f} Hz"


    def differs_from(self, other: FitResults, path: str) -> FittedDifference:
        """Whether a number differs between two saws, such as the tension of two blades, by their intervals.

        The interval of the difference is that of two independent estimates: each end has the root of the
        sum of the squares of the two half widths towards each other (G. Y. Zou and A. Donner, *Statistics
        in Medicine* 27, 1693, 2008). Intervals of single numbers may overlap where the difference has one
        without zero.

        Parameters
        ----------
        other : FitResults
            The fit of the other saw, with the same confidence.
        path : str
            Path of a number that both fits have determined.

        Examples
        --------
        >>> import sawflutter as sf
        >>> band = {"radius_m": 0.22, "width_m": 0.02, "eigenstrain": 2e-4}
        >>> blade = sf.Scene.paper().replace({"accuracy": "draft", "membrane": {"roll_tension": [band]}})
        >>> strain = "membrane.roll_tension[0].eigenstrain"
        >>> taps = [blade.replace({strain: value}).modes(0).frequency_hz[:6].round(1) for value in (2e-4, 3e-4)]
        >>> first, second = (blade.fit(hz, free={strain: (0, 6e-4)}, starts=1) for hz in taps)
        >>> first.differs_from(second, strain).differs, first.differs_from(first, strain).differs
        (True, False)
        """
        if self.confidence != other.confidence:
            remedy = "fit both with the same confidence"
            raise refused("other", other.confidence, f"a fit with the confidence {self.confidence:g}", remedy)
        (value, below, above), (of_other, below_other, above_other) = (
            _interval(of, path) for of in (self, other)
        )
        difference = value - of_other
        from_, to = difference - hypot(below, above_other), difference + hypot(above, below_other)
        is_one_of_several = bool(self.other_minima or other.other_minima)
        return FittedDifference(path, difference, from_, to, self.confidence, is_one_of_several)


def _interval(of: FitResults, path: str) -> tuple[float, float, float]:
    """Value of a fitted number, and the widths of its interval below and above it."""
    found = next((number for number in of.parameters if number.path == path), None)
    if found is None:
        named = ", ".join(number.path for number in of.parameters)
        raise refused("path", path, f"a number of both fits ({named})", "free it in both")
    if found.interval_from is None or found.interval_to is None:
        why = "at its bound" if found.at_bound else "not determined"
        remedy = "give it wider bounds, or measure more frequencies"
        raise refused("path", path, f"a number with an interval, but it is {why} in a fit", remedy)
    return found.value, found.value - found.interval_from, found.interval_to - found.value


@dataclass(frozen=True)
class FittedDifference:
    """Difference of a number of two fitted saws, of :meth:`FitResults.differs_from`.

    Attributes
    ----------
    path : path of the number.
    difference : value of the first saw minus that of the other one.
    interval_from, interval_to : interval of the difference.
    confidence : probability that the interval contains the true difference.
    is_one_of_several : whether another saw fits one of the measurements about as well; the interval
        then holds for the best ones.
    """

    path: str
    difference: float
    interval_from: float
    interval_to: float
    confidence: float
    is_one_of_several: bool

    @property
    def differs(self) -> bool:
        """Whether zero is outside of the interval."""
        return not self.interval_from <= 0.0 <= self.interval_to

    def __str__(self) -> str:
        answer = "differs" if self.differs else "is not shown to differ"
        condition = ", if these are the saws" if self.is_one_of_several else ""
        return (
            f"{self.path} {answer}: {self.difference:+.4g} ({100 * self.confidence:g} % interval "
            f"{self.interval_from:.4g} … {self.interval_to:.4g}{condition})"
        )


class PlaceResults(Result, PlaceReport):
    """The best place found for the guides; :attr:`saw` is the scene with it. Its chart has no
    panel without a map."""

    _command, _rows_of, _steps = "place", "parameters", "saws"


class SizeResults(Result, SizeReport):
    """The ranges of a number in which the saw keeps its limits (:attr:`windows`), and a checked value in the
    nearest one (:attr:`answer`, None if there is none)."""

    _command, _rows_of, _steps = "size", "windows", "saws"


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
class StiffnessMap(Tabled, Drawn, Entry):
    """Critical speeds of a saw over the stiffness of its guides, like the critical speed map of
    rotor dynamics over bearing stiffness. :meth:`sawflutter.Scene.run_stiffness_map` returns
    it.

    Attributes
    ----------
    name : title of the scene.
    stiffness_n_per_m : stiffness of each guide that is varied, of the shape (values).
    critical_rpm : critical speeds within the sweep, ascending, of the shape (values, critical speeds); NaN
        where there are fewer.
    flutter_rpm : flutter speed of each, of the shape (values); NaN where there is none within the sweep.
    """

    name: str
    stiffness_n_per_m: FloatArray
    critical_rpm: FloatArray
    flutter_rpm: FloatArray

    def to_dataframe(self) -> pd.DataFrame:
        """A row for each stiffness with the critical speeds ``critical_1_rpm`` and so on, ascending, NaN where
        there are fewer, and the flutter speed; needs pandas."""
        critical = {f"critical_{number}_rpm": of for number, of in enumerate(self.critical_rpm.T, 1)}
        return frame({"stiffness_n_per_m": self.stiffness_n_per_m, **critical, "flutter_rpm": self.flutter_rpm})

    def to_xarray(self) -> xr.Dataset:
        """``critical_rpm`` over stiffness and number, ``flutter_rpm`` over stiffness, as labelled arrays; needs
        xarray."""
        with extra("xarray"):
            import xarray as xr

        units, along = {"units": "rpm"}, "stiffness_n_per_m"
        variables = {
            "critical_rpm": ((along, "number"), self.critical_rpm, units),
            "flutter_rpm": (along, self.flutter_rpm, units),
        }
        coordinates = {
            along: (along, self.stiffness_n_per_m, {"units": "N/m"}),
            "number": range(1, 1 + self.critical_rpm.shape[1]),
        }
        return xr.Dataset(variables, coordinates, {"scene": self.name})

    def _drawing(self) -> str:
        return _native.stiffness_chart(self)


@dataclass(frozen=True, eq=False, repr=False)
class Speeds(Tabled, Entry):
    """Speeds of a saw, of :meth:`sawflutter.Scene.speeds`.

    Attributes
    ----------
    name : title of the scene.
    to_rpm : last speed; the first one is 0.
    critical_rpm : critical speeds up to the last speed, ascending, of the shape (critical speeds).
    first_critical_rpm : first critical speed, also above the last speed; None if there is none.
    flutter_rpm : flutter speed; None if there is none up to the last speed.
    bands : bands of instability up to the last speed, ascending.
    estimated_relative_error : estimated relative error of the critical speeds.
    """

    name: str
    to_rpm: float
    critical_rpm: FloatArray
    first_critical_rpm: float | None
    flutter_rpm: float | None
    bands: tuple[Instability, ...]
    estimated_relative_error: float

    def to_dataframe(self) -> pd.DataFrame:
        """A row for each critical speed and each band of instability, by ascending speed, with the columns
        ``event`` (critical speed, divergence, flutter), ``from_rpm``, ``to_rpm``, and those of a band; needs
        pandas."""
        at = [{"event": "critical speed", "from_rpm": rpm, "to_rpm": rpm} for rpm in self.critical_rpm.tolist()]
        bands = [{"event": band["kind"], **band} for band in plain(self.bands)]
        table = frame(sorted([*at, *bands], key=lambda row: row["from_rpm"]))
        return table.drop(columns="kind", errors="ignore")

    def __repr__(self) -> str:
        critical, flutter = (
            "none" if rpm is None else f"{rpm:.0f} rpm" for rpm in (self.first_critical_rpm, self.flutter_rpm)
        )
        counted = f"{len(self.bands)} bands up to {self.to_rpm:.0f} rpm"
        return f"<Speeds {self.name!r}: first critical speed {critical}, flutter from {flutter}, {counted}>"
