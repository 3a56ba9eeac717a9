"""Maps: stability over one number of a saw and the speed, or over two numbers."""

from __future__ import annotations

import os
import tempfile
import warnings
from concurrent.futures import Executor
from typing import TYPE_CHECKING, SupportsFloat, SupportsIndex, TypeAlias

import numpy as np

from . import _native
from ._entry import FloatArray, array
from ._grids import of_map
from ._progress import Progress
from ._report_types import MapReport
from ._result import Result, pictures
from ._scene_data import Number
from ._values import plain, whole
from .errors import ModelWarning
from .study import Study

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

    from .scene import Scene

Along: TypeAlias = "tuple[str, SupportsFloat | str, SupportsFloat | str]"
"""Path of a number in the scene, and the ends of its axis."""


class MapResults(Result, MapReport):
    """Stability over one number of a saw and the speed, or over two numbers."""

    command, table = "map", "saws"
    figure_names = pictures("map")

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
        """Lowest critical speeds in the shape of the map; NaN where a saw has none.

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
        return of_map(self)

    def _speeds(self, speeds: list[float | None]) -> FloatArray:
        return np.reshape(array(speeds), self.shape)

    def _facts(self) -> str:
        over = self.x.path if self.y is None else f"{self.x.path} and {self.y.path}"
        states = [saw.state for saw in self.saws if saw.state is not None]
        stable = sum(state == "stable" for state in states)
        judged = "" if self.rpm is None else f", {stable} of {len(states)} stable at {self.rpm:g} rpm"
        return f"{len(self.saws)} saws over {over}{judged}"


def run_map(
    scene: Scene,
    x: Along,
    y: Along | None,
    *,
    points: SupportsIndex | None,
    rpm: Number,
    to_rpm: Number,
    folder: str | os.PathLike[str] | None,
    executor: Executor | Client | None,
    progress: Progress,
) -> MapResults:
    """A map of a scene: a study of a grid, and its report."""
    native = _native.Map(
        scene.to_json(),
        _range(x),
        y if y is None else _range(y),
        points=points if points is None else whole("points", points),
        rpm=rpm,
        to_rpm=to_rpm,
    )
    study = Study._of(scene, native.study)
    with tempfile.TemporaryDirectory() as temporary:
        place = temporary if folder is None else os.fspath(folder)
        study._compute(place, executor, progress)
        result = MapResults.from_json(native.report(place))
    if folder is not None:
        result.save(os.path.join(place, "map.json"))
    for warning in result._warnings():
        # At the line that has called the method of the scene.
        warnings.warn(warning, ModelWarning, stacklevel=3)
    return result


def _range(along: Along) -> tuple[str, float, float]:
    path, *ends = along

    def number(end: SupportsFloat | str) -> float:
        if isinstance(end, str):
            found = _native.number(path, end)
            return float(end) if found is None else found
        return float(plain(end, path))

    first, last = ends
    return path, number(first), number(last)
