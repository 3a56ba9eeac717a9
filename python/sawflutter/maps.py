"""Maps: stability over one number of a saw and the speed, or over two numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from ._entry import FloatArray, array
from ._extras import entries, extra
from ._report_types import MapReport
from ._result import Result
from ._values import Number, number
from .errors import refused

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

Along: TypeAlias = "tuple[str, Number, Number] | Mapping[str, tuple[Number, Number]]"
"""Path of a number in the scene, and the ends of its axis."""


class MapResults(Result, MapReport):
    """Stability over one number of a saw and the speed, or over two numbers."""

    _command = "map"

    def to_dataframe(self) -> pd.DataFrame:
        """A row for each saw, with the values of the numbers by their paths, first critical speed, flutter
        speed, verdict (yes, at_risk, no; blank for a saw that is not analysed) and its cause; needs pandas."""
        paths = {"x": self.x.path} if self.y is None else {"x": self.x.path, "y": self.y.path}
        table = entries(self.saws).drop(columns={"y"} - set(paths)).rename(columns=paths)
        verdicts = [saw.verdict for saw in self.saws]
        table["verdict"] = [None if verdict is None else verdict.answer for verdict in verdicts]
        table["cause"] = [None if verdict is None else verdict.cause for verdict in verdicts]
        return table

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of saws along the axes: ``(y, x)``, or ``(x,)`` for a map over the speed."""
        x = (len(self.x.values),)
        return x if self.y is None else (len(self.y.values), *x)

    @property
    def first_critical_rpm(self) -> FloatArray:
        """First critical speeds in the shape of the map; NaN where a saw has none."""
        return self._speeds([saw.first_critical_rpm for saw in self.saws])

    @property
    def flutter_rpm(self) -> FloatArray:
        """Flutter speeds in the shape of the map; NaN where no flutter counts within the sweep."""
        return self._speeds([saw.flutter_rpm for saw in self.saws])

    def to_xarray(self) -> xr.Dataset:
        """The map as labelled arrays, ``first_critical_rpm``, ``flutter_rpm``, ``answer`` and ``cause``, over the
        paths of the axes; needs xarray."""
        with extra("xarray"):
            import xarray as xr

        axes = [self.x] if self.y is None else [self.y, self.x]
        names = [axis.path for axis in axes]
        verdicts = [saw.verdict for saw in self.saws]
        answers = [(v.answer if v else None) or "" for v in verdicts]
        causes = [(v.cause if v else None) or "" for v in verdicts]
        variables = {
            "first_critical_rpm": (names, self.first_critical_rpm, {"units": "rpm"}),
            "flutter_rpm": (names, self.flutter_rpm, {"units": "rpm"}),
            "answer": (names, np.reshape(np.array(answers), self.shape)),
            "cause": (names, np.reshape(np.array(causes), self.shape)),
        }
        coordinates = {
            axis.path: (axis.path, axis.values, {"units": axis.unit, "long_name": axis.name})
            for axis in axes
        }
        attributes = {"scene": self._scene["name"], "to_rpm": self.to_rpm}
        if self.rpm is not None:
            attributes["rpm"] = self.rpm
        return xr.Dataset(variables, coordinates, attributes)

    def _speeds(self, speeds: list[float | None]) -> FloatArray:
        return np.reshape(array(speeds), self.shape)


def axis(name: str, along: Along) -> tuple[str, float, float]:
    """The path of a number, and the ends of its axis in the unit of the path."""
    if isinstance(along, Mapping) and len(along) == 1:
        (along,) = ((path, *ends) for path, ends in along.items())
    if isinstance(along, str) or not isinstance(along, (tuple, list)) or len(along) != 3:
        said = "a path and the two ends of its axis"
        raise refused(name, along, said, 'write it like ("blade.thickness_m", "2.4 mm", "3.2 mm")')
    path, first, last = along
    return path, number(path, first), number(path, last)
