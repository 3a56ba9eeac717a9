"""Maps: stability over one number of a saw and the speed, or over two numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, SupportsFloat, TypeAlias

import numpy as np

from . import _native
from ._entry import FloatArray, array
from ._extras import extra
from ._report_types import MapReport
from ._result import Result
from ._values import plain

if TYPE_CHECKING:
    import xarray as xr

Along: TypeAlias = "tuple[str, SupportsFloat | str, SupportsFloat | str]"
"""Path of a number in the scene, and the ends of its axis."""


class MapResults(Result, MapReport):
    """Stability over one number of a saw and the speed, or over two numbers."""

    command, table = "map", "saws"

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of saws along the axes: ``(y, x)``, or ``(x,)`` for a map over the speed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> free = sf.Scene.paper().replace({"accuracy": "draft", "guides": []})
        >>> free.run_map(("blade.thickness_m", 0.0025, 0.003), points=3).shape
        (3,)
        """
        x = (len(self.x.values),)
        return x if self.y is None else (len(self.y.values), *x)

    @property
    def lowest_critical_rpm(self) -> FloatArray:
        """First critical speeds in the shape of the map; NaN where a saw has none.

        Examples
        --------
        >>> import sawflutter as sf
        >>> free = sf.Scene.paper().replace({"accuracy": "draft", "guides": []})
        >>> found = free.run_map(("blade.thickness_m", 0.0025, 0.003), points=3)
        >>> bool(found.lowest_critical_rpm[2] > found.lowest_critical_rpm[0])
        True
        """
        return self._speeds([saw.lowest_critical_rpm for saw in self.saws])

    @property
    def flutter_rpm(self) -> FloatArray:
        """Flutter speeds in the shape of the map; NaN where no flutter counts within the sweep.

        Examples
        --------
        >>> import sawflutter as sf
        >>> free = sf.Scene.paper().replace({"accuracy": "draft", "guides": []})
        >>> found = free.run_map(("blade.thickness_m", 0.0025, 0.003), points=3)
        >>> bool(found.flutter_rpm.max() > 0)
        False
        """
        return self._speeds([saw.flutter_speed_rpm for saw in self.saws])

    def to_xarray(self) -> xr.Dataset:
        """The map as labelled arrays over its numbers; needs xarray.

        Returns
        -------
        xarray.Dataset
            ``lowest_critical_rpm``, ``flutter_rpm`` and ``state`` over the paths of the axes.

        Raises
        ------
        ImportError
            If xarray is missing; the message says how to install it.

        Examples
        --------
        >>> import sawflutter as sf
        >>> free = sf.Scene.paper().replace({"accuracy": "draft", "guides": []})
        >>> found = free.run_map(("blade.thickness_m", 0.0025, 0.003), points=3).to_xarray()
        >>> found.lowest_critical_rpm.dims
        ('blade.thickness_m',)
        """
        with extra("xarray"):
            import xarray as xr

        axes = [self.x] if self.y is None else [self.y, self.x]
        names = [axis.path for axis in axes]
        states = [saw.state or "" for saw in self.saws]
        variables = {
            "lowest_critical_rpm": (names, self.lowest_critical_rpm, {"units": "rpm"}),
            "flutter_rpm": (names, self.flutter_rpm, {"units": "rpm"}),
            "state": (names, np.reshape(np.array(states), self.shape)),
        }
        coordinates = {
            axis.path: (axis.path, axis.values, {"units": axis.unit, "long_name": axis.name})
            for axis in axes
        }
        attributes = {"scene": self.scene["name"], "to_rpm": self.to_rpm}
        if self.rpm is not None:
            attributes["rpm"] = self.rpm
        return xr.Dataset(variables, coordinates, attributes)

    def _speeds(self, speeds: list[float | None]) -> FloatArray:
        return np.reshape(array(speeds), self.shape)

    def _facts(self) -> str:
        over = self.x.path if self.y is None else f"{self.x.path} and {self.y.path}"
        states = [saw.state for saw in self.saws if saw.state is not None]
        stable = sum(state == "stable" for state in states)
        judged = "" if self.rpm is None else f", {stable} of {len(states)} stable at {self.rpm:g} rpm"
        return f"{len(self.saws)} saws over {over}{judged}"


def axis(along: Along) -> tuple[str, float, float]:
    """The path of a number, and the ends of its axis in the unit of the path."""
    path, *ends = along

    def number(end: SupportsFloat | str) -> float:
        if isinstance(end, str):
            found = _native.number(path, end)
            return float(end) if found is None else found
        return float(plain(end, path))

    first, last = ends
    return path, number(first), number(last)
