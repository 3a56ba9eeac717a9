"""What each command finds, as the program reports it: data first, figures on top of it."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from . import _native
from ._entry import FloatArray
from ._extras import extra
from ._methods import know_bands
from ._report_types import (
    Branch,
    CampbellReport,
    CheckReport,
    Criterion,
    CutReport,
    DeflectReport,
    Instability,
    Mode,
    RunUpReport,
    WashboardReport,
)
from ._result import Result
from ._table import frame, read
from .designs import FitResults, PlaceResults, StudyResults, TradeoffResults
from .errors import InputError

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure
    from typing_extensions import Unpack

    from ._drawn import Look
    from .plot.chart import Chart

Table: TypeAlias = Literal["branches", "modes_at_rest", "critical_speeds", "bands"]


class CampbellResults(Result, CampbellReport):
    """Campbell diagram, critical speeds and bands of instability of a saw."""

    command = "analyze"
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
        """Critical speeds up to the end of the sweep, ascending.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.critical_rpm[:2].round(-1).tolist()
        [1530.0, 1550.0]
        """
        speeds = np.array([critical.rpm for critical in self.critical_speeds])
        speeds.setflags(write=False)
        return speeds

    @property
    def flutter_rpm(self) -> float | None:
        """Onset of the first flutter band whose peak growth reaches the threshold; None where there
        is none within the sweep.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> 2250 < r.flutter_rpm < 2260
        True
        """
        return self.flutter_speed_rpm

    @property
    def bands(self) -> tuple[Instability, ...]:
        """Bands of instability within the sweep, ascending.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> [band.kind for band in r.bands[:2]]
        ['divergence', 'flutter']
        """
        return self.instabilities

    @property
    def branches(self) -> tuple[Branch, ...]:
        """Modes followed over speed, by frequency at their lowest speed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.branches[0].branch
        1
        """
        return self.campbell.branches

    def modes(self, rpm: float) -> tuple[Mode, ...]:
        """Modes at a speed of the sweep, with their shapes; see :meth:`sawflutter.Scene.modes`.

        Parameters
        ----------
        rpm : float
            A speed of the sweep.

        Returns
        -------
        tuple of Mode
            Ascending by frequency.

        Raises
        ------
        ArgumentError
            Where the speed is outside of the sweep.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.modes(1800)[0].direction
        'reflected'
        """
        return self.saw.modes(rpm)

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes ``campbell.csv``, the same bytes as the program: one row a branch and speed.

        Parameters
        ----------
        path : str or path
            The file.

        Raises
        ------
        OSError
            Where it cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "campbell.csv"
        >>> r.to_csv(path)
        >>> path.read_text().startswith("branch,")
        True
        """
        Path(path).write_bytes(_native.campbell_csv(self._text).encode())

    def to_dataframe(self, of: Table = "branches") -> pd.DataFrame:
        """A table, a row each; needs pandas.

        Parameters
        ----------
        of : {"branches", "modes_at_rest", "critical_speeds", "bands"}
            Branches and speeds, with the columns of ``campbell.csv``; or modes at rest, critical
            speeds, or bands of instability, with the waves that make them, how those run
            (``directions``), and their nodal diameters.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ValueError
            Where there is no such table.
        ImportError
            Where pandas is missing: it says how it is installed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.to_dataframe("bands").loc[0, ["kind", "nodal_diameters"]].tolist()
        ['divergence', '2']
        """
        if of == "branches":
            return read(_native.campbell_csv(self._text))
        if of == "bands":
            table = frame(self.bands)
            for name, column in self._of_bands().items():
                table[name] = column
            return table
        if of not in ("modes_at_rest", "critical_speeds"):
            raise ValueError(f"there is no table of {of!r}, but {', '.join(get_args(Table))}")
        return frame(getattr(self, of))

    def _of_bands(self) -> dict[str, list[str]]:
        """The waves of each band, how they run, and their nodal diameters."""
        columns: dict[str, list[str]] = {"modes": [], "directions": [], "nodal_diameters": []}
        for band in self.bands:
            waves = [mode.partition(", ") for mode in band.modes]
            diameters = (name.partition(" diameter")[0] for name, _, _ in waves)
            columns["modes"].append(" + ".join(band.modes))
            columns["directions"].append(" + ".join(way or "standing" for _, _, way in waves))
            columns["nodal_diameters"].append(" + ".join(diameters))
        return columns

    def chart(self) -> Chart:
        """Frequencies over speed, growth rates below.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> [panel.y_name for panel in r.chart().panels]
        ['Im λ / 2π [Hz]', 'Re λ [1/s], square root scale']
        """
        from .plot.campbell import campbell

        return campbell(self, self._facts())

    def root_loci_chart(self) -> Chart:
        """The two modes that meet at the flutter speed, in the complex plane.

        Returns
        -------
        sawflutter.plot.Chart
            Without a panel where no two modes meet.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.root_loci_chart().panels[0].x_name
        'Re λ [1/s]'
        """
        from .plot.campbell import root_loci

        return root_loci(self)

    def plot_root_loci(
        self, fig: Figure | None = None, **look: Unpack[Look]
    ) -> Figure:
        """Draws :meth:`root_loci_chart` with plotly.

        Parameters
        ----------
        fig : plotly.graph_objects.Figure, optional
            A figure to draw into; by default a new one.
        **look
            Units and harmonics, as in :meth:`plot`.

        Returns
        -------
        plotly.graph_objects.Figure

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.plot_root_loci(frequency_units="rad/s").layout.yaxis.title.text
        'Im λ [rad/s]'
        """
        return self.root_loci_chart().plot(fig, **look)

    def _read(self) -> None:
        know_bands(self.branches, self.bands)

    def _facts(self) -> str:
        first, last = self.campbell.from_rpm, self.campbell.to_rpm
        lowest = self.critical_rpm[:1]
        critical = (
            f"lowest critical speed {lowest[0]:.0f} rpm" if len(lowest) else "no critical speed"
        )
        flutter = (
            f"no flutter above {self.flutter_threshold_per_s:g} 1/s"
            if self.flutter_rpm is None
            else f"flutter from {self.flutter_rpm:.0f} rpm"
        )
        return (
            f"{critical}, {flutter}, {len(self.bands)} bands of instability "
            f"from {first:.0f} to {last:.0f} rpm"
        )


class CheckResults(Result, CheckReport):
    """A saw held against limits. Its truth is :attr:`passed`, so that ``assert saw.check(...)`` fails
    where a limit is not kept, and pytest shows which.
    """

    command = "check"
    figure_names = ("check.svg", "check.png")

    def __bool__(self) -> bool:
        return self.passed

    @property
    def failures(self) -> tuple[str, ...]:
        """Numbers that no saw has, unless they were accepted, and names of the limits that are not
        kept.

        Examples
        --------
        >>> import sawflutter as sf
        >>> check = sf.Scene.paper().check(operating_rpm=1400, accuracy="draft")
        >>> check.failures
        ('85 % rule',)
        """
        unusual = () if self.accept_unusual else self.unusual_numbers
        return unusual + tuple(c.name for c in self.criteria if not c.passed)

    def to_dataframe(self) -> pd.DataFrame:
        """One row a limit; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            Where pandas is missing: it says how it is installed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> check = sf.Scene.paper().check(operating_rpm=1400, accuracy="draft")
        >>> bool(check.to_dataframe()["passed"].all())
        False
        """
        return frame(self.criteria)

    def chart(self) -> Chart:
        """Speeds that were asked for and found.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> check = sf.Scene.paper().check(operating_rpm=1400, accuracy="draft")
        >>> check.chart().panels[0].y_names[-1]
        '85 % rule'
        """
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

    command = "cut"
    figure_names = (
        "cut.svg",
        "cut.png",
        "cut-map.svg",
        "cut-map.png",
        "spline-orbit.svg",
        "spline-orbit.png",
    )

    def to_dataframe(self) -> pd.DataFrame:
        """One row a speed, without the histories and maps; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            Where pandas is missing: it says how it is installed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> cut = sf.Scene.paper().run_cut(1800, accuracy="draft")
        >>> cut.to_dataframe()["rpm"].tolist()
        [1800.0]
        """
        return frame(self.runs)

    def chart(self) -> Chart:
        """Deflection at the probe over time, one panel a speed.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> cut = sf.Scene.paper().run_cut(1800, accuracy="draft")
        >>> len(cut.chart().panels) == len(cut.runs)
        True
        """
        from .plot.histories import cut

        return cut(self, self._facts())

    def map_chart(self, run: int = 0) -> Chart:
        """Growth over guide angle and load, of one of the runs.

        Parameters
        ----------
        run : int
            Which of :attr:`runs`, counted from 0.

        Returns
        -------
        sawflutter.plot.Chart

        Raises
        ------
        IndexError
            Where there is no such run.

        Examples
        --------
        >>> import sawflutter as sf
        >>> cut = sf.Scene.paper().run_cut(1800, accuracy="draft")
        >>> cut.map_chart().panels[0].y_name
        'multiple of the forces'
        """
        from .plot.histories import cut_map

        return cut_map(self, run)

    def plot_map(
        self, run: int = 0, fig: Figure | None = None, **look: Unpack[Look]
    ) -> Figure:
        """Draws :meth:`map_chart` with plotly.

        Parameters
        ----------
        run : int
            Which of :attr:`runs`, counted from 0.
        fig : plotly.graph_objects.Figure, optional
            A figure to draw into; by default a new one.
        **look
            Units and harmonics, as in :meth:`plot`.

        Returns
        -------
        plotly.graph_objects.Figure

        Examples
        --------
        >>> import sawflutter as sf
        >>> cut = sf.Scene.paper().run_cut(1800, accuracy="draft")
        >>> cut.plot_map().layout.yaxis.title.text
        'multiple of the forces'
        """
        return self.map_chart(run).plot(fig, **look)

    def _facts(self) -> str:
        verdicts = ", ".join(
            f"{run.verdict.replace('_', ' ')} at {run.rpm:.0f} rpm" for run in self.runs
        )
        stretched = any(run.stretching is not None for run in self.runs)
        return f"{verdicts}, with stretching" if stretched else verdicts


class RunUpResults(Result, RunUpReport):
    """A run-up under a lateral force."""

    command = "runup"
    figure_names = (
        "runup.svg",
        "runup.png",
        "response-map.svg",
        "response-map.png",
        "runup-map.svg",
        "runup-map.png",
    )

    def to_dataframe(self) -> pd.DataFrame:
        """Speed and deflection, one row a sample; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            Where pandas is missing: it says how it is installed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> up = sf.Scene.paper().run_up(accuracy="draft")
        >>> list(up.to_dataframe())
        ['rpm', 'deflection_m']
        """
        with extra("pandas"):
            import pandas as pd

        return pd.DataFrame({"rpm": self.rpm, "deflection_m": self.deflection_m})

    def chart(self) -> Chart:
        """Deflection at the probe over speed.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> up = sf.Scene.paper().run_up(accuracy="draft")
        >>> up.chart().panels[0].y_name
        'deflection [mm], square root scale'
        """
        from .plot.histories import run_up

        return run_up(self, self._facts())

    def response_chart(self) -> Chart:
        """Deflection per newton over speed and frequency, with the branches on top.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> up = sf.Scene.paper().run_up(accuracy="draft")
        >>> up.response_chart().panels[0].y_name
        'frequency of the force [Hz]'
        """
        from .plot.histories import response

        return response(self)

    def plot_response(
        self, fig: Figure | None = None, **look: Unpack[Look]
    ) -> Figure:
        """Draws :meth:`response_chart` with plotly.

        Parameters
        ----------
        fig : plotly.graph_objects.Figure, optional
            A figure to draw into; by default a new one.
        **look
            Units and harmonics, as in :meth:`plot`.

        Returns
        -------
        plotly.graph_objects.Figure

        Examples
        --------
        >>> import sawflutter as sf
        >>> up = sf.Scene.paper().run_up(accuracy="draft")
        >>> up.plot_response(harmonics=[1]).layout.xaxis.title.text
        'rotation speed Ω [rpm]'
        """
        return self.response_chart().plot(fig, **look)

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
    """Where the blade stands while its speed slowly rises and falls."""

    command = "deflect"
    figure_names = ("deflect.svg", "deflect.png")

    def to_dataframe(self) -> pd.DataFrame:
        """Stable equilibria, one row each, without the frequencies; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            Where pandas is missing: it says how it is installed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> found = sf.Scene.paper().run_deflect(to_rpm=1000, accuracy="draft")
        >>> sorted(set(found.to_dataframe()["direction"]))
        ['down', 'up']
        """
        with extra("pandas"):
            import pandas as pd

        rows = []
        for direction, sweep in {"up": self.up, "down": self.down}.items():
            for number, arc in enumerate(sweep.arcs):
                table = {
                    "direction": direction,
                    "arc": number,
                    "rpm": arc.rpm,
                    "deflection_m": arc.deflection_m,
                    "largest_deflection_m": arc.largest_deflection_m,
                    "largest_slope": arc.largest_slope,
                }
                rows.append(pd.DataFrame(table))
        return pd.concat(rows, ignore_index=True)

    def chart(self) -> Chart:
        """Deflection at the probe over speed.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> found = sf.Scene.paper().run_deflect(to_rpm=1000, accuracy="draft")
        >>> found.chart().panels[0].y_name
        'deflection [mm]'
        """
        from .plot.histories import deflection

        return deflection(self, self._facts())

    def _facts(self) -> str:
        jumps = f"{len(self.up.jumps)} ends of stable stretches while the speed rises"
        return f"{self.force_n:g} N across the rim, {jumps}, {len(self.down.jumps)} while it falls"


class WashboardResults(Result, WashboardReport):
    """Whether the teeth set the blade swinging, each on the surface left by the one before."""

    command = "washboard"
    figure_names = ("washboard.svg", "washboard.png")

    def to_dataframe(self) -> pd.DataFrame:
        """One row a mode; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            Where pandas is missing: it says how it is installed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> spring = {"stiffness_n_per_m": 1e5, "overlap": 1.0}
        >>> changes = {"cut.washboarding": spring, "damping.air_n_s_per_m3": 50.0}
        >>> saw = sf.Scene.paper().replace(changes)
        >>> found = saw.run_washboard(1000, accuracy="draft")  # doctest: +SKIP
        >>> len(found.to_dataframe()) == len(found.modes)  # doctest: +SKIP
        True
        """
        return frame(self.modes)

    def chart(self) -> Chart:
        """Least cutting stiffness at which a motion grows, and its frequency, over the speed.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> spring = {"stiffness_n_per_m": 1e5, "overlap": 1.0}
        >>> changes = {"cut.washboarding": spring, "damping.air_n_s_per_m3": 50.0}
        >>> saw = sf.Scene.paper().replace(changes)
        >>> found = saw.run_washboard(1000, accuracy="draft")  # doctest: +SKIP
        >>> found.chart().panels[0].y_name  # doctest: +SKIP
        'cutting stiffness [N/m]'
        """
        from .plot.washboard import lobes

        return lobes(self, self._facts())

    def _facts(self) -> str:
        least = self.critical_stiffness_n_per_m
        beyond = f"none up to {self.ceiling_n_per_m:.3g}" if least is None else f"{least:.4g}"
        return f"{self.verdict} at {self.rpm:.0f} rpm, critical cutting stiffness {beyond} N/m"


_KINDS: tuple[type[Result], ...] = (
    CampbellResults,
    CheckResults,
    CutResults,
    DeflectResults,
    FitResults,
    PlaceResults,
    RunUpResults,
    StudyResults,
    WashboardResults,
)


def load(path: str | os.PathLike[str]) -> Result | TradeoffResults:
    """Reads a report that the program or :meth:`Result.save` has written.

    Parameters
    ----------
    path : str or path
        The file.

    Returns
    -------
    Result or TradeoffResults
        Of the kind that the file has.

    Raises
    ------
    InputError
        Where the file is no report.
    OSError
        Where it cannot be read.

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
    try:
        data = json.loads(text)
    except json.JSONDecodeError as error:
        raise InputError(f"{path} is no report of sawflutter: it is no JSON ({error})") from None
    if isinstance(data, list):
        return TradeoffResults.from_json(text)
    # Of the kinds whose keys are all there, the one with the most: some have the keys of others.
    kinds = [kind for kind in _KINDS if kind.required_keys() <= data.keys()]
    if not kinds:
        raise InputError(f"{path} is no report of sawflutter; a scene is read by Scene.load")
    return max(kinds, key=lambda kind: len(kind.required_keys())).load(path)


__all__ = [
    "CampbellResults",
    "CheckResults",
    "CutResults",
    "DeflectResults",
    "FitResults",
    "PlaceResults",
    "Result",
    "RunUpResults",
    "StudyResults",
    "TradeoffResults",
    "WashboardResults",
    "load",
]
