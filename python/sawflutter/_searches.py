"""Searches over many saws: fits, places and maps, and matrices for custom searches."""

from __future__ import annotations

import json
import os
import tempfile
import warnings
from collections.abc import Iterable, Mapping
from concurrent.futures import Executor
from typing import TYPE_CHECKING, Any, Literal, SupportsFloat, SupportsIndex, TypeAlias, cast

import numpy as np
import numpy.typing as npt

from . import _native
from ._entry import array
from ._measured import Measured, table
from ._progress import Progress, reporting
from ._result import R
from ._scene_data import Number, SceneData
from ._scene_types import Accuracy
from ._values import whole
from .designs import FitResults, PlaceResults, StiffnessMap, TradeoffResults
from .errors import ModelWarning
from .matrices import Matrices
from .results import CampbellResults

if TYPE_CHECKING:
    from distributed import Client
    from typing_extensions import Self

    from .maps import Along, MapResults
    from .scene import Scene

# Paths of the scene and their bounds, or paths with the default bounds.
Free: TypeAlias = "Mapping[str, tuple[SupportsFloat, SupportsFloat] | None] | Iterable[str] | None"


class Searches(SceneData):
    """Methods of a scene that compute many saws, or that return matrices."""

    __slots__ = ()

    def _with(self, numbers: dict[str, Number]) -> Self:
        """The scene with those numbers that are not None, each by its path."""
        given = {path: number for path, number in numbers.items() if number is not None}
        return self.replace(given) if given else self

    def _asked(
        self,
        kind: type[R],
        accuracy: Accuracy | None,
        tolerance: Number,
        progress: Progress,
        **options: Any,
    ) -> R:
        """The library's report of this scene at another accuracy, with its warnings."""
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, kind._steps) as told:
            result = kind.from_json(_native.run(kind.command, scene._text, options, told))
        return _warned(result, 4)

    def fit(
        self,
        measured: Measured = None,
        *,
        free: Free = None,
        to_rpm: Number = None,
        confidence: SupportsFloat = 0.95,
        starts: SupportsIndex = 12,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> FitResults:
        """Fits guides, density or other numbers of the scene to measured frequencies.

        Parameters
        ----------
        measured : path, DataFrame, array_like or rows, optional
            A file with a table of speeds in rpm and frequencies in Hz, ascending, blank if a mode
            was not measured; or the same table as rows ``(rpm, hz, hz, ...)`` or ``(rpm, [hz, hz,
            ...])``, as an array, or as a data frame with a column or an index ``rpm``, with NaN
            for a blank. A list of frequencies alone is measured at rest. By default the measured
            frequencies of the scene.
        free : dict or list of str, optional
            Paths of the numbers to fit, with their bounds ``(from, to)`` or None for the default
            bounds. By default radius and stiffness of every guide, and the angles between several
            guides.
        to_rpm : float, optional
            Leaves out measurements above this speed.
        confidence : float
            Confidence level of the intervals.
        starts : int
            Number of starting points: the numbers of the scene, and others between the bounds.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        FitResults

        Raises
        ------
        ArgumentError
            If the table cannot be read, or if neither the scene nor the call gives one.
        SceneError
            If a number of ``free`` is not in the scene, or its bounds are invalid.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> taps = [7.9, 13.2, 25.9]
        >>> found = saw.fit(taps, free=["guides[0].stiffness_n_per_m"], starts=1)
        >>> found.parameters[0].path
        'guides[0].stiffness_n_per_m'
        """
        return self._asked(
            FitResults,
            accuracy,
            tolerance,
            progress,
            measured=table(measured),
            free=_bounds(free),
            to_rpm=to_rpm,
            confidence=confidence,
            starts=whole("starts", starts),
        )

    def place(
        self,
        *,
        free: Free = None,
        goal: Literal["flutter", "window"] = "flutter",
        min_critical_rpm: Number = None,
        amplitude_mm: Number = None,
        max_deviation_mm: Number = None,
        force_n: Number = None,
        samples: SupportsIndex = 64,
        refine: SupportsIndex = 60,
        map: SupportsIndex = 17,
        radius_tolerance_m: SupportsFloat = 0.002,
        angle_tolerance_deg: SupportsFloat = 1.0,
        guide_tolerance_share: SupportsFloat = 0.1,
        other_tolerance_share: SupportsFloat = 0.01,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> PlaceResults:
        """Finds the place of the guides with the highest flutter speed. This takes minutes.

        Parameters
        ----------
        free : dict or list of str, optional
            Paths of the numbers to vary, with their bounds ``(from, to)`` or None for the default
            bounds. By default radius, angle and stiffness of the first guide.
        goal : {"flutter", "window"}
            Quantity to maximize: the flutter speed, or the stable window around the operating
            speed.
        min_critical_rpm : float, optional
            Lowest allowed first critical speed.
        amplitude_mm : float, optional
            Amplitude at guides with a gap, with whose mean stiffness bands and critical speeds are
            computed; by default guides have their full stiffness.
        max_deviation_mm : float, optional
            Largest allowed deflection at the cut at the operating speed, with guides with a gap.
        force_n : float, optional
            Constant side force for this limit, in place of the scene's ``side_force.force_n``;
            1 N in a scene without one.
        samples, refine, map : int
            Number of saws in the first sampling of the bounds, of saws in each refinement, and of
            points of the map along each axis (0 for no map).
        radius_tolerance_m, angle_tolerance_deg : float
            Manufacturing tolerance of radii and angles. A saw is rated by the worst of its
            neighbours within the tolerances.
        guide_tolerance_share, other_tolerance_share : float
            Tolerance of the stiffness, damping or gap of a guide, and of other numbers, as a share of
            the value.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        PlaceResults

        Raises
        ------
        SceneError
            If the scene has no guide, or no number at a path.
        ArgumentError
            If another argument is out of range.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> free = {"guides[0].radius_m": (0.20, 0.28)}
        >>> found = saw.place(free=free, samples=2, refine=1, map=0)
        >>> [parameter.path for parameter in found.parameters]
        ['guides[0].radius_m']
        """
        return self._with({"side_force.force_n": force_n})._asked(
            PlaceResults,
            accuracy,
            tolerance,
            progress,
            free=_bounds(free),
            goal=goal,
            min_critical_rpm=min_critical_rpm,
            amplitude_mm=amplitude_mm,
            max_deviation_mm=max_deviation_mm,
            samples=whole("samples", samples),
            refine=whole("refine", refine),
            map=whole("map", map),
            radius_tolerance_m=radius_tolerance_m,
            angle_tolerance_deg=angle_tolerance_deg,
            guide_tolerance_share=guide_tolerance_share,
            other_tolerance_share=other_tolerance_share,
        )

    def run_map(
        self,
        x: Along,
        y: Along | None = None,
        *,
        points: SupportsIndex | None = None,
        rpm: Number = None,
        to_rpm: Number = None,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        folder: str | os.PathLike[str] | None = None,
        executor: Executor | Client | None = None,
        progress: Progress = None,
    ) -> MapResults:
        """Maps stability over one number of the scene and the speed, or over two numbers.

        Parameters
        ----------
        x : (str, float, float)
            Path of the number along the horizontal axis, and the ends of its axis in the unit of
            the path, or as texts with a unit: ``("blade.thickness_m", "2.4 mm", "3.2 mm")``.
        y : (str, float, float), optional
            The number along the vertical axis; by default that is the speed.
        points : int, optional
            Points along the axis of a number; by default 41, or 17 along each of two.
        rpm : float, optional
            Speed at which the saws are judged; by default the operating speed.
        to_rpm : float, optional
            Last speed; by default the end of the scene's sweep.
        folder : path, optional
            Folder for the log of the saws and for ``map.json``: a map that was stopped continues
            when computed again with the same folder. By default nothing is kept.
        executor
            As in :meth:`sawflutter.Study.run`.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        MapResults

        Raises
        ------
        SceneError
            If the scene has no such number, or refuses the ends of an axis.
        StudyError
            If another argument is out of range.

        Examples
        --------
        >>> import sawflutter as sf
        >>> free = sf.Scene.paper().replace({"accuracy": "draft", "guides": []})
        >>> found = free.run_map(("blade.thickness_m", "2.5 mm", "3 mm"), points=3)
        >>> [round(1e3 * value, 3) for value in found.x.values.tolist()]
        [2.5, 2.75, 3.0]
        """
        from .maps import MapResults, axis
        from .study import Study

        scene = self.with_accuracy(accuracy, tolerance)
        native = _native.Map(
            scene._text,
            axis(x),
            None if y is None else axis(y),
            points=None if points is None else whole("points", points),
            rpm=rpm,
            to_rpm=to_rpm,
        )
        study = Study(cast("Scene", scene), json.loads(native.study))
        with tempfile.TemporaryDirectory() as temporary:
            place = temporary if folder is None else os.fspath(folder)
            study._compute(place, executor, progress)
            result = MapResults.from_json(native.report(place))
        if folder is not None:
            result.save(os.path.join(place, "map.json"))
        return _warned(result)

    def tradeoff(self, *, progress: Progress = None) -> TradeoffResults:
        """Measures computing time against true error, for bases of several sizes.

        Parameters
        ----------
        progress
            As in :meth:`run_campbell`.

        Returns
        -------
        TradeoffResults

        Raises
        ------
        AnalysisError
            If the program cannot analyse the saw.

        Examples
        --------
        >>> import sawflutter as sf
        >>> free = sf.Scene.paper().replace({"guides": [], "sweep.to_rpm": 500})
        >>> found = free.tradeoff()
        >>> found.recommended(1e-2) is not None
        True
        """
        with reporting(progress, "settings") as told:
            text = _native.run("tradeoff", self._text, {}, told)
        return TradeoffResults.from_json(text, self.name)

    def matrices(
        self,
        basis: tuple[SupportsIndex, SupportsIndex] | None = None,
        *,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
    ) -> Matrices:
        """Matrices of the equation of motion, for custom eigenvalue and response computations.

        Parameters
        ----------
        basis : (int, int), optional
            Largest number of nodal diameters, and number of radial functions for each; by default
            as the accuracy requires.
        accuracy, tolerance
            As in :meth:`run_campbell`.

        Returns
        -------
        Matrices

        Raises
        ------
        ArgumentError
            If the basis is out of range.

        Examples
        --------
        >>> import sawflutter as sf
        >>> sf.Scene.paper().matrices(basis=(6, 4)).stiffness.shape
        (52, 52)
        """
        if basis is not None:
            diameters, functions = basis
            basis = (whole("basis", diameters), whole("basis", functions))
        return Matrices.of(self.with_accuracy(accuracy, tolerance)._text, basis)

    def run_stiffness_map(
        self,
        stiffness_n_per_m: npt.ArrayLike,
        *,
        guide: SupportsIndex | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> StiffnessMap:
        """Critical speeds and flutter speed as functions of the stiffness of the guides.

        Parameters
        ----------
        stiffness_n_per_m : array_like
            Stiffness values of the guide, or of every guide.
        guide : int, optional
            Index of the guide, counted from 0; by default all guides.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        StiffnessMap

        Raises
        ------
        PathError
            If no guide has this index.

        Examples
        --------
        >>> import sawflutter as sf
        >>> found = sf.Scene.paper().run_stiffness_map([1e4, 1e8], accuracy="draft")
        >>> found.critical_rpm[:, 0].round().tolist()
        [1477.0, 1563.0]
        """
        chosen = range(len(self.guides)) if guide is None else [whole("guide", guide)]
        stiffness = array(np.ravel(stiffness_n_per_m).tolist())
        saw = self.with_accuracy(accuracy, tolerance)
        plain = {"sensitivity": False, "amplitude": False, "shapes_at_rpm": None}
        reports = []
        with reporting(progress, "saws") as told:
            for done, value in enumerate(stiffness.tolist(), start=1):
                saw = saw.replace({f"guides[{at}].stiffness_n_per_m": value for at in chosen})
                reports.append(CampbellResults.from_json(_native.run("analyze", saw._text, plain)))
                if told is not None:
                    told(done, len(stiffness), "")
        critical = array([report.critical_rpm.tolist() for report in reports])
        return StiffnessMap(self.name, stiffness, critical, array([r.flutter_rpm for r in reports]))


def _warned(result: R, stacklevel: int = 3) -> R:
    """A result, after its warnings, which name the line that calls the method of the scene."""
    for warning in result._warnings():
        warnings.warn(warning, ModelWarning, stacklevel=stacklevel)
    return result


def _bounds(free: Free) -> list[tuple[str, tuple[float, float] | None]]:
    if isinstance(free, str):
        free = [free]
    if not isinstance(free, Mapping):
        return [(path, None) for path in free or ()]
    return [(path, b if b is None else (float(b[0]), float(b[1]))) for path, b in free.items()]
