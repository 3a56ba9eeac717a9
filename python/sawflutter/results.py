"""What each command finds, as the program reports it: data first, figures on top of it."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

import numpy as np

from . import _native
from ._entry import Entry, FloatArray
from ._report_types import (
    Branch,
    CampbellReport,
    CheckReport,
    Criterion,
    CutReport,
    FitReport,
    Instability,
    Mode,
    PlaceReport,
    RunUpReport,
    Setting,
    StudyReport,
    WashboardReport,
)
from ._table import frame, read
from ._view import html

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from plotly.graph_objects import Figure

    from .plot.chart import Chart
    from .scene import Scene

R = TypeVar("R", bound="Result")


class Result:
    """Base of all results. A result is made of the JSON that the program writes and keeps it word
    for word: :meth:`save` writes the same bytes as the program does.
    """

    figure_names: ClassVar[tuple[str, ...]] = ()
    """Names of the program's own figures of this result, see :meth:`figure`."""

    _text: str

    @classmethod
    def from_json(cls: type[R], text: str) -> R:
        """The result of a JSON text."""
        assert issubclass(cls, Entry)
        result = cls.from_dict(json.loads(text))
        object.__setattr__(result, "_text", text)
        return result

    def to_json(self) -> str:
        """The report as the program writes it."""
        return self._text

    @property
    def raw(self) -> dict[str, Any]:
        """The report as a dict, with every key that it has."""
        data: dict[str, Any] = json.loads(self._text)
        return data

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the report, the same bytes as the program; :func:`sawflutter.load` reads it."""
        Path(path).write_bytes(self._text.encode())

    @property
    def saw(self) -> Scene:
        """The scene that was looked at; of a fit or a placement, the one that was found."""
        from .scene import Scene

        return Scene.from_json(json.dumps(self.raw["scene"]))

    def figure(self, name: str) -> bytes | None:
        """A figure of the program, the same bytes as it writes; None where the saw has none.

        Parameters
        ----------
        name : str
            One of :attr:`figure_names`, PNG or SVG.
        """
        return _native.picture(name, self._text)

    def chart(self) -> Chart:
        """What :meth:`plot` and :meth:`plot_matplotlib` draw: lines, points and bands as numbers."""
        raise NotImplementedError

    def plot(self) -> Figure:
        """A plotly figure."""
        from .plot.with_plotly import draw

        return draw(self.chart())

    def plot_matplotlib(self, ax: Axes | None = None) -> Axes:
        """A matplotlib figure; its upper or only axes.

        Parameters
        ----------
        ax : Axes, optional
            Axes to draw the upper panel into; without them, a figure with all panels is begun.
        """
        from .plot.with_matplotlib import draw

        return draw(self.chart(), ax)

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return self._text == other._text

    def __hash__(self) -> int:
        return hash(self._text)

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        return type(self).from_json, (self._text,)

    def __repr__(self) -> str:
        unusual = self.raw.get("unusual_numbers")
        warned = f"unusual numbers: {'; '.join(unusual)}; " if unusual else ""
        return f"<{type(self).__name__} {self.raw['scene']['name']!r}: {warned}{self._facts()}>"

    def _facts(self) -> str:
        """The answer in a line."""
        return ""

    def _repr_html_(self) -> str:
        """What a notebook shows: the answer, and the program's figure."""
        name = next((name for name in self.figure_names if name.endswith(".svg")), None)
        picture = self.figure(name) if name is not None else None
        return html(repr(self), None if picture is None else picture.decode())


class CampbellResults(Result, CampbellReport):
    """Campbell diagram, critical speeds and bands of instability of a saw."""

    figure_names = (
        "campbell.svg",
        "campbell.png",
        "root-loci.svg",
        "root-loci.png",
        "membrane.svg",
        "membrane.png",
        "in-cut.svg",
        "in-cut.png",
    )

    @property
    def critical_rpm(self) -> FloatArray:
        """Critical speeds up to the end of the sweep, ascending."""
        return np.array([critical.rpm for critical in self.critical_speeds])

    @property
    def flutter_rpm(self) -> float | None:
        """Onset of the first flutter band whose peak growth reaches the threshold; None where there
        is none within the sweep."""
        return self.flutter_speed_rpm

    @property
    def bands(self) -> tuple[Instability, ...]:
        """Bands of instability within the sweep, ascending."""
        return self.instabilities

    @property
    def branches(self) -> tuple[Branch, ...]:
        """Modes followed over speed, by frequency at their lowest speed."""
        return self.campbell.branches

    def modes(self, rpm: float) -> tuple[Mode, ...]:
        """Modes at a speed of the sweep, with their shapes; see :meth:`sawflutter.Scene.modes`."""
        return self.saw.modes(rpm)

    def summary(self) -> str:
        """What the program prints."""
        return _native.summary(self._text)

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes ``campbell.csv``, the same bytes as the program: one row a branch and speed."""
        Path(path).write_bytes(_native.campbell_csv(self._text).encode())

    def to_dataframe(self) -> pd.DataFrame:
        """One row a branch and speed, the columns of ``campbell.csv``; needs pandas."""
        return read(_native.campbell_csv(self._text))

    def chart(self) -> Chart:
        """Frequencies over speed, growth rates below."""
        from .plot.campbell import campbell

        return campbell(self, self._facts())

    def root_loci_chart(self) -> Chart:
        """The two modes that meet at the flutter speed, in the complex plane."""
        from .plot.campbell import root_loci

        return root_loci(self)

    def plot_root_loci(self) -> Figure:
        """The two modes that meet at the flutter speed, in the complex plane: a plotly figure."""
        from .plot.with_plotly import draw

        return draw(self.root_loci_chart())

    def _facts(self) -> str:
        first, last = self.campbell.from_rpm, self.campbell.to_rpm
        lowest = self.critical_rpm[:1]
        critical = (
            f"lowest critical speed {lowest[0]:.0f} rpm" if len(lowest) else "no critical speed"
        )
        flutter = (
            "no flutter" if self.flutter_rpm is None else f"flutter from {self.flutter_rpm:.0f} rpm"
        )
        return (
            f"{critical}, {flutter}, {len(self.bands)} bands of instability "
            f"from {first:.0f} to {last:.0f} rpm"
        )

    def _repr_html_(self) -> str:
        picture = self.figure("campbell.svg")
        return html(self.summary(), None if picture is None else picture.decode())


class CheckResults(Result, CheckReport):
    """A saw held against limits. Its truth is :attr:`passed`, so that ``assert saw.check(...)`` fails
    where a limit is not kept, and pytest shows which.
    """

    figure_names = ("check.svg", "check.png")

    def __bool__(self) -> bool:
        return self.passed

    @property
    def failures(self) -> tuple[str, ...]:
        """Numbers that no saw has, unless they were accepted, and names of the limits that are not
        kept."""
        unusual = () if self.accept_unusual else self.unusual_numbers
        return unusual + tuple(c.name for c in self.criteria if not c.passed)

    def to_dataframe(self) -> pd.DataFrame:
        """One row a limit; needs pandas."""
        return frame(self.criteria)

    def chart(self) -> Chart:
        """Speeds that were asked for and found."""
        from .plot.design import check

        return check(self, self._facts())

    def _facts(self) -> str:
        broken = (_missed(criterion) for criterion in self.criteria if not criterion.passed)
        found = "passed" if self.passed else f"failed: {'; '.join(broken)}"
        return f"{found}, at {self.operating_rpm:.0f} rpm"


def _missed(criterion: Criterion) -> str:
    """A limit that is not kept, in the words of the program."""
    return f"{criterion.name}: {criterion.finding}"


class CutResults(Result, CutReport):
    """A saw in the wood, at one or several speeds."""

    figure_names = (
        "cut.svg",
        "cut.png",
        "cut-map.svg",
        "cut-map.png",
        "spline-orbit.svg",
        "spline-orbit.png",
    )

    def to_dataframe(self) -> pd.DataFrame:
        """One row a speed, without the histories and maps; needs pandas."""
        return frame(self.runs)

    def chart(self) -> Chart:
        """Deflection at the probe over time, one panel a speed."""
        from .plot.histories import cut

        return cut(self, self._facts())

    def map_chart(self, run: int = 0) -> Chart:
        """Growth over guide angle and load, of one of the runs."""
        from .plot.histories import cut_map

        return cut_map(self, run)

    def plot_map(self, run: int = 0) -> Figure:
        """Growth over guide angle and load: a plotly figure."""
        from .plot.with_plotly import draw

        return draw(self.map_chart(run))

    def _facts(self) -> str:
        return ", ".join(f"{run.verdict.replace('_', ' ')} at {run.rpm:.0f} rpm" for run in self.runs)


class RunUpResults(Result, RunUpReport):
    """A run-up under a lateral force."""

    figure_names = ("runup.svg", "runup.png", "response-map.svg", "response-map.png")

    def to_dataframe(self) -> pd.DataFrame:
        """Speed and deflection, one row a sample; needs pandas."""
        import pandas as pd

        return pd.DataFrame({"rpm": self.rpm, "deflection_m": self.deflection_m})

    def chart(self) -> Chart:
        """Deflection at the probe over speed."""
        from .plot.histories import run_up

        return run_up(self, self._facts())

    def response_chart(self) -> Chart:
        """Deflection per newton over speed and frequency, with the branches on top."""
        from .plot.histories import response

        return response(self)

    def plot_response(self) -> Figure:
        """Deflection per newton over speed and frequency: a plotly figure."""
        from .plot.with_plotly import draw

        return draw(self.response_chart())

    def _facts(self) -> str:
        doubling = self.first_doubling_rpm
        at = "none" if doubling is None else f"the first at {doubling:.0f} rpm"
        crossed = f"{self.rpm[0]:.0f} to {self.rpm[-1]:.0f} rpm, {len(self.bands)} bands crossed"
        return f"{crossed}; that more than double a motion: {at}"


class WashboardResults(Result, WashboardReport):
    """Whether the teeth set the blade swinging, each on the surface left by the one before."""

    figure_names = ("washboard.svg", "washboard.png")

    def to_dataframe(self) -> pd.DataFrame:
        """One row a mode; needs pandas."""
        return frame(self.modes)

    def chart(self) -> Chart:
        """Least cutting stiffness at which a motion grows, and its frequency, over the speed."""
        from .plot.washboard import lobes

        return lobes(self, self._facts())

    def _facts(self) -> str:
        least = self.critical_stiffness_n_per_m
        beyond = f"none up to {self.ceiling_n_per_m:.3g}" if least is None else f"{least:.4g}"
        return f"{self.verdict} at {self.rpm:.0f} rpm, critical cutting stiffness {beyond} N/m"


class FitResults(Result, FitReport):
    """A saw fitted to measured frequencies: :attr:`saw` is the calibrated one."""

    figure_names = ("fit.svg", "fit.png")

    def to_dataframe(self) -> pd.DataFrame:
        """One row a fitted number; needs pandas."""
        return frame(self.parameters)

    def chart(self) -> Chart:
        """Measured and computed frequencies over speed."""
        from .plot.design import fit

        return fit(self, self._facts())

    def _facts(self) -> str:
        found = ", ".join(f"{found.path} = {found.value:.4g}" for found in self.parameters)
        return f"{found}; {self.rms_hz:.3f} Hz rms, before {self.rms_before_hz:.3f} Hz"


class PlaceResults(Result, PlaceReport):
    """The best place found for the guides: :attr:`saw` is that saw."""

    figure_names = ("place.svg", "place.png")

    def to_dataframe(self) -> pd.DataFrame:
        """One row a number that was moved; needs pandas."""
        return frame(self.parameters)

    def chart(self) -> Chart:
        """The goal over one or two numbers."""
        from .plot.design import place

        return place(self, self._facts())

    def _facts(self) -> str:
        found = ", ".join(f"{found.path} = {found.value:.4g}" for found in self.parameters)
        robust = "fragile" if self.fragile else "robust"
        worst = 1e2 * self.worst_neighbour_share
        return (
            f"{found}; {self.best.goal_rpm:.0f} rpm, before {self.before.goal_rpm:.0f}, "
            f"{robust}: {worst:.0f} % at the worst of its tolerances"
        )


class StudyResults(Result, StudyReport):
    """Many saws, summed up; :meth:`sawflutter.Study.run` makes it."""

    figure_names = ("study.svg", "study.png")

    _folder: Path | None = None

    def to_dataframe(self) -> pd.DataFrame:
        """One row a saw, from ``study.csv`` beside the report; needs pandas."""
        if self._folder is None:
            raise FileNotFoundError(
                "the table of the saws is study.csv beside the report: load it there"
            )
        return read((self._folder / "study.csv").read_text(encoding="utf-8"))

    def sensitivity(self, *, confidence: float = 0.95, seed: int = 0) -> pd.DataFrame:
        """Sobol' indices of the first order: the share of the variance of a speed that a number
        causes by itself, whatever the others are. What is missing to 1 in their sum is due to
        several together. Needs SALib, which estimates them by RBD-FAST from the saws that there
        are (Tarantola, Gatelli and Mara, Reliability Engineering and System Safety 91 (2006), 717).

        Parameters
        ----------
        confidence : float
            Of the half-width beside each index, from resampled saws.
        seed : int
            Of this resampling.

        Returns
        -------
        pandas.DataFrame
            One row a number; columns ``lowest_critical``, ``flutter``, and the half-widths
            ``lowest_critical_confidence``, ``flutter_confidence``. A column is NaN where the speed
            is the same in all saws. A saw without a speed counts with the last speed looked at, and
            one that was not analysed does not count.
        """
        import numpy as np
        import pandas as pd
        from SALib.analyze import rbd_fast

        table = self.to_dataframe()
        table = table[table["status"] == "analysed"]
        names = [parameter["path"] for parameter in self.study["parameters"]]
        numbers = table[names].to_numpy(dtype=float)
        # Ranks: an index depends on the order of the saws by each number, not on its distribution.
        bounds = [[low, high] for low, high in zip(numbers.min(axis=0), numbers.max(axis=0))]
        problem = {"num_vars": len(names), "names": names, "bounds": bounds}
        columns: dict[str, Any] = {}
        for key, column in (("lowest_critical", "lowest_critical_rpm"), ("flutter", "flutter_rpm")):
            speeds = table[column].astype(float).fillna(self.swept_to_rpm).to_numpy()
            columns[key] = columns[f"{key}_confidence"] = np.full(len(names), np.nan)
            if len(speeds) > 1 and np.ptp(speeds) > 0.0:
                found = rbd_fast.analyze(problem, numbers, speeds, conf_level=confidence, seed=seed)
                columns[key] = np.array(found["S1"])
                columns[f"{key}_confidence"] = np.array(found["S1_conf"])
        return pd.DataFrame(columns, index=pd.Index(names, name="number"))

    def chart(self) -> Chart:
        """Shares of the saws below a speed, and those that can be run at one."""
        from .plot.design import study

        return study(self, self._facts())

    def _facts(self) -> str:
        passing = self.all.passing
        kept = "" if passing is None else f", {1e2 * passing.probability:.2f} % keep the limits"
        return f"{self.all.saws} saws{kept}"


class TradeoffResults:
    """Computing time against true error, for bases of several sizes."""

    def __init__(self, settings: Iterable[Setting], text: str, name: str) -> None:
        self.settings: tuple[Setting, ...] = tuple(settings)
        self.name = name
        self._text = text

    @classmethod
    def from_json(cls, text: str, name: str = "") -> TradeoffResults:
        """The result of a JSON text."""
        return cls((Setting.from_dict(setting) for setting in json.loads(text)), text, name)

    def recommended(self, error: float) -> Setting | None:
        """The fastest chart within a relative error."""
        charts = [s for s in self.settings if s.speeds > 0 and s.error <= error]
        return min(charts, key=lambda setting: setting.seconds, default=None)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes ``tradeoff.json``."""
        Path(path).write_bytes(self._text.encode())

    def to_dataframe(self) -> pd.DataFrame:
        """One row a setting; needs pandas."""
        return frame(self.settings)

    def chart(self) -> Chart:
        """Error over time."""
        from .plot.design import tradeoff

        return tradeoff(self.settings, self.name)

    def plot(self) -> Figure:
        """A plotly figure."""
        from .plot.with_plotly import draw

        return draw(self.chart())

    def plot_matplotlib(self, ax: Axes | None = None) -> Axes:
        """A matplotlib figure; its axes."""
        from .plot.with_matplotlib import draw

        return draw(self.chart(), ax)

    def __eq__(self, other: object) -> bool:
        return self._text == other._text if isinstance(other, TradeoffResults) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._text)

    def __reduce__(self) -> tuple[Any, tuple[str, str]]:
        return TradeoffResults.from_json, (self._text, self.name)

    def __repr__(self) -> str:
        return f"<TradeoffResults {self.name!r}: {len(self.settings)} settings>"


# Which report has which key that no other has.
_KINDS: tuple[tuple[str, type[Result]], ...] = (
    ("modes_at_rest", CampbellResults),
    ("criteria", CheckResults),
    ("tooth_angles_deg", CutResults),
    ("rate_rpm_per_s", RunUpResults),
    ("lobes", WashboardResults),
    ("without_effect", FitResults),
    ("swept_to_rpm", StudyResults),
)


def load(path: str | os.PathLike[str]) -> Result | TradeoffResults:
    """Reads a report that the program or :meth:`Result.save` has written.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> import sawflutter as sf
    >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "report.json"
    >>> r.save(path)
    >>> sf.load(path) == r
    True
    """
    text = Path(path).read_text(encoding="utf-8")
    data = json.loads(text)
    if isinstance(data, list):
        return TradeoffResults.from_json(text)
    if "kept" in data:
        return PlaceResults.from_json(text)
    for key, kind in _KINDS:
        if key in data:
            result = kind.from_json(text)
            if isinstance(result, StudyResults):
                object.__setattr__(result, "_folder", Path(path).parent)
            return result
    raise ValueError(f"{path} is no report of sawflutter; a scene is read by Scene.load")


__all__ = [
    "CampbellResults",
    "CheckResults",
    "CutResults",
    "FitResults",
    "PlaceResults",
    "Result",
    "RunUpResults",
    "StudyResults",
    "TradeoffResults",
    "WashboardResults",
    "load",
]
