"""What can be asked of a saw that takes many of them: fits, places, maps, and matrices for one's
own searches."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Literal, SupportsFloat, SupportsIndex, TypeAlias

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
from .designs import FitResults, PlaceResults, TradeoffResults
from .errors import ModelWarning
from .matrices import Matrices
from .results import CampbellResults
from .stiffness import StiffnessMap

# Paths of the scene and their bounds, or paths with the usual bounds.
Free: TypeAlias = "Mapping[str, tuple[SupportsFloat, SupportsFloat] | None] | Iterable[str] | None"


class Searches(SceneData):
    """The methods of a scene that compute many saws, or leave the computing to the user."""

    __slots__ = ()

    def _asked(
        self,
        kind: type[R],
        ask: Callable[..., str],
        what: str,
        accuracy: Accuracy | None,
        tolerance: Number,
        progress: Progress,
    ) -> R:
        """What the library reports of this scene in another accuracy, with its warnings."""
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, what) as told:
            result = kind.from_json(ask(scene._text, progress=told))
        for warning in result._warnings():
            # At the line that has called the method.
            warnings.warn(warning, ModelWarning, stacklevel=3)
        return result

    def fit(
        self,
        measured: Measured = None,
        *,
        free: Free = None,
        to_rpm: Number = None,
        confidence: SupportsFloat = 0.95,
        starts: SupportsIndex = 12,
        seed: SupportsIndex = 0,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> FitResults:
        """Fits guides, density or other numbers of the scene to measured frequencies.

        Parameters
        ----------
        measured : path, DataFrame, array_like or rows, optional
            A file with a table of speeds in rpm and frequencies in Hz, ascending, blank where a mode
            was not seen; or the same as rows ``(rpm, hz, hz, ...)`` or ``(rpm, [hz, hz, ...])``, as an
            array or as a data frame with a column or an index ``rpm``, with NaN for a blank.
            Frequencies alone are those at rest. The scene's own without it.
        free : dict or list of str, optional
            Paths of the numbers to fit, with their bounds ``(from, to)`` or None for the usual
            ones. By default radius and stiffness of every guide, and angles between several.
        to_rpm : float, optional
            Leaves out measurements above this speed.
        confidence : float
            Probability with which the intervals cover the truth.
        starts, seed : int
            Number of starts, and which ones.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        FitResults

        Raises
        ------
        ArgumentError
            Where the table cannot be read, or the scene has none and none is given.
        SceneError
            Where a number of ``free`` is not in the scene, or its bounds are none.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> taps = [7.9, 13.2, 25.9]
        >>> found = saw.fit(taps, free=["guides[0].stiffness_n_per_m"], starts=1)
        >>> found.parameters[0].path
        'guides[0].stiffness_n_per_m'
        """
        ask = partial(
            _native.fit,
            measured=table(measured),
            free=_bounds(free),
            to_rpm=to_rpm,
            confidence=confidence,
            starts=whole("starts", starts),
            seed=whole("seed", seed),
        )
        return self._asked(FitResults, ask, "starts", accuracy, tolerance, progress)

    def place(
        self,
        *,
        free: Free = None,
        goal: Literal["flutter", "window"] = "flutter",
        min_critical_rpm: Number = None,
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
        """Looks for the place of the guides where flutter comes latest. This takes minutes.

        Parameters
        ----------
        free : dict or list of str, optional
            Paths of the numbers that may move, with their bounds ``(from, to)`` or None for the
            usual ones. By default radius, angle and stiffness of the first guide.
        goal : {"flutter", "window"}
            The flutter speed, or the stable window around the operating speed.
        min_critical_rpm : float, optional
            Least lowest critical speed.
        samples, refine, map : int
            Saws spread over the bounds at first, saws that each refinement may take, and points of
            the map along each axis, 0 for none.
        radius_tolerance_m, angle_tolerance_deg : float
            How far production may be off a radius and an angle: every saw counts as the worst of
            those around it.
        guide_tolerance_share, other_tolerance_share : float
            The same of a guide's stiffness or damping, and of other numbers, as a share of each.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        PlaceResults

        Raises
        ------
        SceneError
            Where the scene has no guide, or no number of a path.
        ArgumentError
            Where another argument is out of range.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> free = {"guides[0].radius_m": (0.20, 0.28)}
        >>> found = saw.place(free=free, samples=2, refine=1, map=0)
        >>> [parameter.path for parameter in found.parameters]
        ['guides[0].radius_m']
        """
        ask = partial(
            _native.place,
            free=_bounds(free),
            goal=goal,
            min_critical_rpm=min_critical_rpm,
            samples=whole("samples", samples),
            refine=whole("refine", refine),
            map=whole("map", map),
            radius_tolerance_m=radius_tolerance_m,
            angle_tolerance_deg=angle_tolerance_deg,
            guide_tolerance_share=guide_tolerance_share,
            other_tolerance_share=other_tolerance_share,
        )
        return self._asked(PlaceResults, ask, "saws", accuracy, tolerance, progress)

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
            Where the saw cannot be analysed so far.

        Examples
        --------
        >>> import sawflutter as sf
        >>> free = sf.Scene.paper().replace({"guides": [], "sweep.to_rpm": 500})
        >>> found = free.tradeoff()
        >>> found.recommended(1e-2) is not None
        True
        """
        with reporting(progress, "settings") as told:
            text = _native.tradeoff(self._text, progress=told)
        return TradeoffResults.from_json(text, self.name)

    def matrices(
        self,
        basis: tuple[SupportsIndex, SupportsIndex] | None = None,
        *,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
    ) -> Matrices:
        """Matrices of the equation of motion, for eigenvalues and responses of one's own.

        Parameters
        ----------
        basis : (int, int), optional
            Largest number of nodal diameters, and radial functions of each; by default what the
            accuracy takes.
        accuracy, tolerance
            As in :meth:`run_campbell`.

        Returns
        -------
        Matrices

        Raises
        ------
        ArgumentError
            Where the basis is out of range.

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
        """Critical speeds and flutter speed over the stiffness of the guides, all else being equal.

        Parameters
        ----------
        stiffness_n_per_m : array_like
            Stiffness of the guide, or of each of them.
        guide : int, optional
            Which guide, counted from 0; all of them by default.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        StiffnessMap

        Raises
        ------
        PathError
            Where the saw has no such guide.

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
        reports = []
        with reporting(progress, "saws") as told:
            for done, value in enumerate(stiffness.tolist(), start=1):
                saw = saw.replace({f"guides[{at}].stiffness_n_per_m": value for at in chosen})
                reports.append(CampbellResults.from_json(_native.analyze(saw._text)))
                if told is not None:
                    told(done, len(stiffness), "")
        critical = array([report.critical_rpm.tolist() for report in reports])
        return StiffnessMap(self.name, stiffness, critical, array([r.flutter_rpm for r in reports]))


def _bounds(free: Free) -> list[tuple[str, tuple[float, float] | None]]:
    if isinstance(free, str):
        free = [free]
    if not isinstance(free, Mapping):
        return [(path, None) for path in free or ()]
    return [(path, b if b is None else (float(b[0]), float(b[1]))) for path, b in free.items()]
