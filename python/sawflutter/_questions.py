"""What can be asked of a saw."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Literal, SupportsFloat, SupportsIndex, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from . import _native
from ._measured import Measured, table
from ._progress import Progress, reporting
from ._report_types import Mode
from ._scene_types import Accuracy, GuideDict
from .matrices import Matrices
from .modes import Modes
from .results import (
    CampbellResults,
    CheckResults,
    CutResults,
    DeflectResults,
    FitResults,
    PlaceResults,
    RunUpResults,
    TradeoffResults,
    WashboardResults,
)
from .stiffness import StiffnessMap, rows

if TYPE_CHECKING:
    from .scene import Scene

# Paths of the scene and their bounds, or paths with the usual bounds.
Free: TypeAlias = "Mapping[str, tuple[SupportsFloat, SupportsFloat] | None] | Iterable[str] | None"
Number: TypeAlias = "SupportsFloat | None"


class Questions:
    """The methods of a scene that compute."""

    __slots__ = ()

    if TYPE_CHECKING:
        _text: str

        @property
        def name(self) -> str: ...
        @property
        def guides(self) -> tuple[GuideDict, ...]: ...
        def with_accuracy(
            self, accuracy: Accuracy | None = None, tolerance: Number = None
        ) -> Scene: ...

    def run_campbell(
        self,
        *,
        speed_range: npt.ArrayLike | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        sensitivity: bool = False,
        amplitude: bool = False,
        progress: Progress = None,
    ) -> CampbellResults:
        """Charts the saw: modes, critical speeds, bands of instability, certificate.

        Parameters
        ----------
        speed_range : (float, float) or array_like, optional
            First and last speed in rpm, instead of the scene's ``sweep``. Of more speeds the least
            and the largest count: those in between are chosen by what happens there.
        accuracy : {"draft", "design", "reference"}, optional
            Instead of the scene's.
        tolerance : float, optional
            Relative error allowed of critical speeds and onsets, instead of a name.
        sensitivity : bool
            Also how critical speeds and onsets move with the numbers of the scene.
        amplitude : bool
            Also how far the flutter of each band rises: ``saturated_amplitude_m`` of the bands.
        progress : bool or callable, optional
            True shows a bar, a callable is called with what is done and of how many.

        Returns
        -------
        CampbellResults

        Raises
        ------
        SceneError
            Where the range or the accuracy is refused.
        AnalysisError
            Where the saw cannot be analysed so far: the message says what to do.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> [round(float(rpm), -1) for rpm in r.critical_rpm[:2]]
        [1530.0, 1550.0]
        >>> r.bands[0].kind
        'divergence'
        >>> r.branches[0].frequency_hz.shape == r.branches[0].rpm.shape
        True
        """
        scene = self.with_accuracy(accuracy, tolerance)
        if speed_range is not None:
            speeds = np.asarray(speed_range, float)
            ends = {"sweep.from_rpm": speeds.min(), "sweep.to_rpm": speeds.max()}
            scene = scene.replace(ends)
        with reporting(progress, "speeds") as told:
            text = _native.analyze(
                scene._text, sensitivity=sensitivity, amplitude=amplitude, progress=told
            )
        return CampbellResults.computed(text)

    @overload
    def modes(self, rpm: SupportsFloat) -> tuple[Mode, ...]: ...
    @overload
    def modes(self, rpm: Iterable[SupportsFloat]) -> Modes: ...
    def modes(self, rpm: Any) -> tuple[Mode, ...] | Modes:
        """Modes at a speed within the sweep, or at several, ascending by frequency, with their
        shapes.

        Parameters
        ----------
        rpm : float or array_like
            The speed, or several: these are found in one basis.

        Returns
        -------
        tuple of Mode
            At one speed.
        Modes
            At several, with frequencies and growth rates as arrays.

        Raises
        ------
        ArgumentError
            Where a speed is outside of the sweep.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().replace({"accuracy": "draft"})
        >>> f"{saw.modes(rpm=0)[0].frequency_hz:.1f} Hz"
        '7.7 Hz'
        >>> saw.modes([0, 500, 1000]).frequency_hz[:, 0].round(1).tolist()
        [7.7, 5.2, 2.6]
        """
        speeds = np.asarray(rpm, float)
        found = json.loads(_native.modes(self._text, speeds.ravel().tolist()))
        if speeds.ndim == 0:
            return tuple(Mode.from_dict(mode) for mode in found[0])
        return Modes.of(speeds.ravel(), found)

    def check(
        self,
        *,
        operating_rpm: Number = None,
        margin: SupportsFloat = 0.85,
        min_flutter_rpm: Number = None,
        min_critical_rpm: Number = None,
        max_rim_m_per_s: SupportsFloat = 100.0,
        max_amplitude_mm: Number = None,
        accept_unusual: bool = False,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
    ) -> CheckResults:
        """Holds the saw against limits.

        Parameters
        ----------
        operating_rpm : float, optional
            Speed at which it is run; the scene's by default.
        margin : float
            Largest share of the lowest critical speed that it may be.
        min_flutter_rpm, min_critical_rpm : float, optional
            Least flutter speed and least first critical speed.
        max_rim_m_per_s : float
            Largest speed of the rim.
        max_amplitude_mm : float, optional
            Largest deflection in millimetres that flutter may rise to in any band up to the
            operating speed, without damping.
        accept_unusual : bool
            Whether a saw may pass that has numbers no saw has.
        accuracy, tolerance
            As in :meth:`run_campbell`.

        Returns
        -------
        CheckResults
            Its truth is whether every limit is kept: ``assert saw.check(...)``.

        Raises
        ------
        ArgumentError
            Where a limit is none, or the scene has no operating speed and none is given.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> saw.check(operating_rpm=1250, accuracy="draft").passed
        True
        >>> saw.check(operating_rpm=1400, accuracy="draft").failures
        ('85 % rule',)
        """
        scene = self.with_accuracy(accuracy, tolerance)
        text = _native.check(
            scene._text,
            operating_rpm=operating_rpm,
            margin=margin,
            min_flutter_rpm=min_flutter_rpm,
            min_critical_rpm=min_critical_rpm,
            max_rim_m_per_s=max_rim_m_per_s,
            max_amplitude_mm=max_amplitude_mm,
            accept_unusual=accept_unusual,
        )
        return CheckResults.computed(text)

    def run_cut(
        self,
        rpm: npt.ArrayLike = (),
        *,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> CutResults:
        """Cuts wood: eigenvalues and a time history, with the forces of the scene's ``cut``.

        Parameters
        ----------
        rpm : float or array_like, optional
            Speeds to cut at, in place of the scene's.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        CutResults

        Raises
        ------
        ArgumentError
            Where the scene has no ``cut``.

        Examples
        --------
        >>> import sawflutter as sf
        >>> cut = sf.Scene.paper().run_cut([1800, 2800], accuracy="draft")
        >>> cut.runs[1].verdict
        'unstable'
        """
        speeds = np.atleast_1d(np.asarray(rpm, float)).tolist()
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, "points of the map") as told:
            text = _native.cut(scene._text, speeds, progress=told)
        return CutResults.computed(text)

    def run_up(
        self,
        *,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> RunUpResults:
        """Runs the saw up under a lateral force, both the scene's ``runup``.

        Parameters
        ----------
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        RunUpResults

        Raises
        ------
        ArgumentError
            Where the scene has no ``runup``.

        Examples
        --------
        >>> import sawflutter as sf
        >>> up = sf.Scene.paper().run_up(accuracy="draft")
        >>> up.bands[0].band.kind, up.rpm.shape == up.deflection_m.shape
        ('divergence', True)
        """
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, "steps") as told:
            text = _native.runup(scene._text, progress=told)
        return RunUpResults.computed(text)

    def run_deflect(
        self,
        *,
        force_n: Number = None,
        angle_deg: Number = None,
        to_rpm: Number = None,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> DeflectResults:
        """Follows where the blade stands while its speed slowly rises and falls.

        Parameters
        ----------
        force_n : float, optional
            Constant force across the blade at its rim, fixed in space; that of the scene's
            ``runup`` by default, or 1 N.
        angle_deg : float, optional
            Its angle; that of the scene's ``runup`` by default, or 0.
        to_rpm : float, optional
            Last speed; the end of the scene's sweep by default.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        DeflectResults

        Raises
        ------
        ArgumentError
            Where a number is none.
        AnalysisError
            Where nothing holds the blade, or no equilibrium was found.

        Examples
        --------
        >>> import sawflutter as sf
        >>> found = sf.Scene.paper().run_deflect(to_rpm=1000, accuracy="draft")
        >>> found.beyond_thickness_rpm is None
        True
        """
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, "equilibria") as told:
            text = _native.deflect(
                scene._text, force_n=force_n, angle_deg=angle_deg, to_rpm=to_rpm, progress=told
            )
        return DeflectResults.computed(text)

    def run_washboard(
        self,
        rpm: Number = None,
        *,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> WashboardResults:
        """Whether the teeth set the blade swinging, with the force that the scene's
        ``cut.washboarding`` names.

        Parameters
        ----------
        rpm : float, optional
            Speed to cut at; the scene's operating speed by default.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        WashboardResults

        Raises
        ------
        ArgumentError
            Where the scene has no ``cut.washboarding``, or no speed is known.
        SceneError
            Where the scene has no damping.

        Examples
        --------
        >>> import sawflutter as sf
        >>> spring = {"stiffness_n_per_m": 1e5, "overlap": 1.0}
        >>> changes = {"cut.washboarding": spring, "damping.air_n_s_per_m3": 50.0}
        >>> saw = sf.Scene.paper().replace(changes)
        >>> found = saw.run_washboard(1000, accuracy="draft")  # doctest: +SKIP
        >>> found.rpm  # doctest: +SKIP
        1000.0
        """
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, "speeds") as told:
            text = _native.washboard(scene._text, rpm, progress=told)
        return WashboardResults.computed(text)

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
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, "starts") as told:
            text = _native.fit(
                scene._text,
                table(measured),
                _bounds(free),
                to_rpm=to_rpm,
                confidence=confidence,
                starts=starts,
                seed=seed,
                progress=told,
            )
        return FitResults.computed(text)

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
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, "saws") as told:
            text = _native.place(
                scene._text,
                _bounds(free),
                goal=goal,
                min_critical_rpm=min_critical_rpm,
                samples=samples,
                refine=refine,
                map=map,
                radius_tolerance_m=radius_tolerance_m,
                angle_tolerance_deg=angle_tolerance_deg,
                guide_tolerance_share=guide_tolerance_share,
                other_tolerance_share=other_tolerance_share,
                progress=told,
            )
        return PlaceResults.computed(text)

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
        scene = self.with_accuracy(accuracy, tolerance)
        chosen = range(len(self.guides)) if guide is None else [int(guide)]
        stiffness = np.array(stiffness_n_per_m, float).ravel()
        reports = []
        with reporting(progress, "saws") as told:
            for done, value in enumerate(stiffness.tolist(), start=1):
                saw = scene.replace({f"guides[{at}].stiffness_n_per_m": value for at in chosen})
                reports.append(CampbellResults.from_json(_native.analyze(saw._text)))
                if told is not None:
                    told(done, len(stiffness), "")
        flutter = [np.nan if r.flutter_rpm is None else r.flutter_rpm for r in reports]
        critical = rows([r.critical_rpm for r in reports])
        return StiffnessMap(self.name, stiffness, critical, np.array(flutter))


def _bounds(free: Free) -> list[tuple[str, tuple[float, float] | None]]:
    if isinstance(free, str):
        free = [free]
    if not isinstance(free, Mapping):
        return [(path, None) for path in free or ()]
    return [(path, b if b is None else (float(b[0]), float(b[1]))) for path, b in free.items()]
