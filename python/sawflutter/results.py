"""Results of the command analyze, and reading of reports of every kind."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from . import _native
from ._entry import FloatArray, array
from ._extras import entries, extra, read
from ._methods import know_bands
from ._report_types import Branch, CampbellReport, Instability, Mode
from ._result import Result
from .designs import TradeoffResults
from .errors import InputError

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from .plot.chart import Chart

Table: TypeAlias = Literal["branches", "modes_at_rest", "critical_speeds", "bands"]


class CampbellResults(Result, CampbellReport):
    """Campbell diagram, critical speeds and bands of instability of a saw."""

    command = "analyze"

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
        return array([critical.rpm for critical in self.critical_speeds])

    @property
    def flutter_rpm(self) -> float | None:
        """Onset of the first flutter band whose peak growth reaches the threshold; None if the
        sweep has none.

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
            If the speed is outside of the sweep.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.modes(1800)[0].direction
        'reflected'
        """
        return self.saw.modes(rpm)

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes ``campbell.csv`` with the same bytes as the program: one row for each branch and
        speed.

        Parameters
        ----------
        path : str or path
            The file.

        Raises
        ------
        OSError
            If the file cannot be written.

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

    def save_vtk(self, folder: str | os.PathLike[str]) -> None:
        """Writes the shapes for ParaView, as the program does: ``modes.pvd``, which lists a grid
        for each phase of a period.

        Parameters
        ----------
        folder : str or path
            An existing folder.

        Raises
        ------
        ValueError
            If the chart was computed without shapes.
        OSError
            If the file cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft", shapes=True)
        >>> r.shapes[0].occasion, r.shapes[0].name
        ('critical_speed', '2 diameters')
        >>> folder = pathlib.Path(tempfile.mkdtemp())
        >>> r.save_vtk(folder)
        >>> (folder / "modes.pvd").exists()
        True
        """
        files = _native.vtk_files(self._text)
        if not files:
            raise ValueError("the chart has no shapes; run_campbell(shapes=True) computes them")
        for name, text in files:
            (Path(folder) / name).write_text(text, encoding="utf-8", newline="\n")

    def to_xarray(self) -> xr.Dataset:
        """Branches over the speed as labelled arrays; needs xarray.

        Returns
        -------
        xarray.Dataset
            ``frequency_hz``, ``body_frequency_hz``, ``growth_per_s`` and ``krein_sign`` over
            ``branch`` and ``rpm``; NaN where a branch has no point at a speed.

        Raises
        ------
        ImportError
            If xarray is missing; the message says how to install it.

        Examples
        --------
        >>> import sawflutter as sf
        >>> chart = sf.Scene.paper().run_campbell(accuracy="draft").to_xarray()
        >>> chart.frequency_hz.dims
        ('branch', 'rpm')
        """
        with extra("xarray"):
            import xarray as xr

        branches = self.branches
        rpm = np.unique(np.concatenate([branch.rpm for branch in branches] or [np.empty(0)]))
        units = {"frequency_hz": "Hz", "body_frequency_hz": "Hz", "growth_per_s": "1/s", "krein_sign": ""}
        variables = {}
        for name, unit in units.items():
            table = np.full((len(branches), len(rpm)), np.nan)
            for row, branch in zip(table, branches):
                row[np.searchsorted(rpm, branch.rpm)] = getattr(branch, name)
            variables[name] = (("branch", "rpm"), table, {"units": unit})
        coordinates = {
            "branch": [branch.branch for branch in branches],
            "rpm": ("rpm", rpm, {"units": "rpm"}),
            "name": ("branch", [branch.name for branch in branches]),
        }
        return xr.Dataset(variables, coordinates, {"scene": self.scene["name"]})

    def to_dataframe(self, of: Table = "branches") -> pd.DataFrame:
        """Part of the results as a table; needs pandas.

        Parameters
        ----------
        of : {"branches", "modes_at_rest", "critical_speeds", "bands"}
            Rows of the table: branches at their speeds, with the columns of ``campbell.csv``;
            modes at rest; critical speeds; or bands of instability with their waves, the
            directions of these (``directions``) and their nodal diameters.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ValueError
            If no table has this name.
        ImportError
            If pandas is missing; the message says how to install it.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.to_dataframe("bands").loc[0, ["kind", "nodal_diameters"]].tolist()
        ['divergence', '2']
        """
        if of not in get_args(Table):
            raise ValueError(f"there is no table of {of!r}, but {', '.join(get_args(Table))}")
        if of == "branches":
            return read(_native.campbell_csv(self._text))
        table = entries(getattr(self, of))
        if of == "bands":
            waves = [[mode.partition(", ") for mode in band.modes] for band in self.bands]
            table["modes"] = [" + ".join(band.modes) for band in self.bands]
            table["directions"] = [" + ".join(way or "standing" for *_, way in of) for of in waves]
            table["nodal_diameters"] = [
                " + ".join(name.partition(" diameter")[0] for name, *_ in of) for of in waves
            ]
        return table

    def root_loci_chart(self) -> Chart:
        """Root loci of the two modes that coalesce at the flutter speed, in the complex plane and
        over speed.

        Returns
        -------
        sawflutter.plot.Chart
            A chart without panels if no two modes coalesce.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> r.root_loci_chart().panels[0].x_name
        'Re λ, positive for growth [1/s]'
        """
        return self._described("root-loci", "no two modes meet within the sweep")

    def sensitivity_chart(self) -> Chart:
        """Effects of the numbers of the scene on the first critical speed and the flutter speed.

        Returns
        -------
        sawflutter.plot.Chart
            A chart without panels unless :meth:`Scene.run_campbell` was asked for ``sensitivity``.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft", sensitivity=True)
        >>> r.sensitivity_chart().panels[0].x_name
        'change of the speed [%]'
        """
        return self._described("sensitivity", "the sensitivities were not asked for")

    def _read(self) -> None:
        know_bands(self.branches, self.bands)

    def _facts(self) -> str:
        critical = "no critical speed"
        flutter = f"no flutter above {self.flutter_threshold_per_s:g} 1/s"
        if self.critical_speeds:
            critical = f"first critical speed {self.critical_rpm[0]:.0f} rpm"
        if self.flutter_rpm is not None:
            flutter = f"flutter from {self.flutter_rpm:.0f} rpm"
        first, last = self.campbell.from_rpm, self.campbell.to_rpm
        bands = f"{len(self.bands)} bands of instability from {first:.0f} to {last:.0f} rpm"
        return f"{critical}, {flutter}, {bands}"


def load(path: str | os.PathLike[str]) -> Result | TradeoffResults:
    """Reads a report that the program or :meth:`Result.save` has written.

    Parameters
    ----------
    path : str or path
        The file.

    Returns
    -------
    Result or TradeoffResults
        A result of the kind in the file.

    Raises
    ------
    InputError
        If the file is not a report.
    OSError
        If the file cannot be read.

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
    kinds = [kind for kind in Result.__subclasses__() if kind.required_keys() <= data.keys()]
    if not kinds:
        raise InputError(f"{path} is no report of sawflutter; a scene is read by Scene.load")
    return max(kinds, key=lambda kind: len(kind.required_keys())).load(path)
