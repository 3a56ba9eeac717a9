"""What each command finds, as the program reports it: data first, figures on top of it."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from . import _native
from ._entry import FloatArray
from ._methods import know_bands
from ._report_types import (
    Branch,
    CampbellReport,
    Instability,
    Mode,
)
from ._result import Result
from ._table import frame, read
from .checks import CheckResults
from .designs import FitResults, PlaceResults, TradeoffResults
from .errors import InputError
from .motions import CutResults, DeflectResults, RunUpResults, WashboardResults
from .studies import StudyResults

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
        return self._described("campbell")

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
