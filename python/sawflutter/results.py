"""Results of the command analyze, and reading of reports of every kind."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from . import _native
from ._entry import FloatArray, array
from ._extras import csv_frame, entries, extra
from ._methods import know_bands
from ._report_types import Branch, CampbellReport
from ._result import Result
from ._saving import Contents
from .designs import TradeoffResults
from .errors import InputError
from .studies import StudyResults

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

Table: TypeAlias = Literal["branches", "modes_at_rest", "critical_speeds", "bands"]


class CampbellResults(Result, CampbellReport):
    """Campbell diagram, critical speeds and bands of instability of a saw."""

    _command = "analyze"

    @property
    def critical_rpm(self) -> FloatArray:
        """Critical speeds up to the end of the sweep, ascending."""
        return array([critical.rpm for critical in self.critical_speeds])

    @property
    def branches(self) -> tuple[Branch, ...]:
        """Modes followed over speed, by frequency at their lowest speed."""
        return self.campbell.branches

    def _contents(self, name: str) -> Contents:
        # The text of the library, because pandas would be needed for its copy.
        table = {".csv": lambda: _native.campbell_csv(self._text).encode()}
        return {**super()._contents(name), **table, ".pvd": lambda: self._grids()[1].encode()}

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file as :meth:`Result.save` does; one that ends in .pvd lists the grids for ParaView
        that are written beside it, one for each phase of a period of every shape.

        Raises
        ------
        ArgumentError
            As in :meth:`Result.save`.
        ValueError
            The chart has no shapes for ParaView.
        """
        super().save(path)
        if Path(path).suffix.lower() == ".pvd":
            for name, text in self._grids()[0]:
                Path(path).with_name(name).write_text(text, encoding="utf-8", newline="\n")

    def _grids(self) -> tuple[list[tuple[str, str]], str]:
        """Names and texts of the grids for ParaView, and their list."""
        files = _native.vtk_files(self._text)
        if not files:
            raise ValueError("the chart has no shapes; run_campbell(shapes=True) computes them")
        grids = [(name, text) for name, text in files if not name.endswith(".pvd")]
        return grids, next(text for name, text in files if name.endswith(".pvd"))

    def to_xarray(self) -> xr.Dataset:
        """``frequency_hz``, ``body_frequency_hz``, ``growth_per_s`` and ``krein_sign`` as labelled
        arrays over ``branch`` and ``rpm``, NaN where a branch has no point at a speed; needs xarray."""
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
        return xr.Dataset(variables, coordinates, {"scene": self._scene["name"]})

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
            There is no such table.
        """
        if of not in get_args(Table):
            raise ValueError(f"there is no table of {of!r}, but {', '.join(get_args(Table))}")
        if of == "branches":
            return csv_frame(_native.campbell_csv(self._text))
        table = entries(getattr(self, of))
        if of == "bands":
            waves = [[mode.partition(", ") for mode in band.modes] for band in self.bands]
            table["modes"] = [" + ".join(band.modes) for band in self.bands]
            table["directions"] = [" + ".join(way or "standing" for *_, way in of) for of in waves]
            table["nodal_diameters"] = [
                " + ".join(name.partition(" diameter")[0] for name, *_ in of) for of in waves
            ]
        return table

    def _read(self) -> None:
        know_bands(self.branches, self.bands)


def load(path: str | os.PathLike[str]) -> Result | TradeoffResults:
    """Reads a report that the program or :meth:`Result.save` has written, of any kind; for a study
    also the table of its saws in the same folder.

    Returns
    -------
    Result
        Of the kind of the report, such as :class:`CampbellResults`; a tradeoff is a
        :class:`TradeoffResults`.

    Raises
    ------
    InputError
        The file is no report that this version reads.
    """
    text = Path(path).read_text(encoding="utf-8")
    try:
        data = json.loads(text)
    except json.JSONDecodeError as error:
        raise InputError(f"{path} is no report of sawflutter: it is no JSON ({error})") from None
    if isinstance(data, list):
        return TradeoffResults(text)
    # Of the kinds whose keys are all there, the one with the most: some have the keys of others.
    kinds = [kind for kind in Result.__subclasses__() if kind._required_keys() <= data.keys()]
    if not kinds:
        written = data.get("sawflutter") if isinstance(data, dict) else None
        by = f" that this version reads, but one of {written}" if written else ""
        raise InputError(f"{path} is no report of sawflutter{by}; a scene is read by Scene.load")
    result = max(kinds, key=lambda kind: len(kind._required_keys()))._from_json(text)
    if isinstance(result, StudyResults):
        object.__setattr__(result, "_table", Path(path).with_suffix(".csv").absolute())
    return result
