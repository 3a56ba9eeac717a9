"""What can be asked of a saw."""

from __future__ import annotations

import json
from collections.abc import Iterable
from functools import partial
from typing import Any, SupportsFloat, overload

import numpy as np
import numpy.typing as npt

from . import _native
from ._progress import Progress
from ._report_types import Mode
from ._scene_data import Number
from ._scene_types import Accuracy
from ._searches import Searches
from .checks import CheckResults
from .modes import Modes
from .motions import CutResults, DeflectResults, GapResults, RunUpResults, WashboardResults
from .results import CampbellResults


class Questions(Searches):
    """The methods of a scene that compute."""

    __slots__ = ()

    def run_campbell(
        self,
        *,
        speed_range: npt.ArrayLike | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        sensitivity: bool = False,
        amplitude: bool = False,
        shapes: bool | Iterable[SupportsFloat] = False,
        progress: Progress = None,
    ) -> CampbellResults:
        """Charts the saw: modes, critical speeds, bands of instability, certificate. Before a search of
        more than some ten seconds the logger ``sawflutter`` warns with a rough estimate of its time.

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
        shapes : bool or array_like
            Also the shape of the blade at every critical speed, in every band and at the
            operating speed, and at the speeds given here in rpm.
        progress : bool or callable, optional
            True shows a bar, a callable is called with what is done of a step and of how many, one
            step of the computation after the other.

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
        scene = self
        if speed_range is not None:
            speeds = np.asarray(speed_range, float)
            scene = self.replace({"sweep.from_rpm": speeds.min(), "sweep.to_rpm": speeds.max()})
        shapes_at_rpm: list[float] | None
        if isinstance(shapes, (bool, np.bool_)):
            shapes_at_rpm = [] if shapes else None
        else:
            shapes_at_rpm = [float(rpm) for rpm in shapes]
        ask = partial(
            _native.analyze,
            sensitivity=sensitivity,
            amplitude=amplitude,
            shapes_at_rpm=shapes_at_rpm,
        )
        return scene._asked(CampbellResults, ask, "speeds", accuracy, tolerance, progress)

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
        ask = partial(
            _native.check,
            operating_rpm=operating_rpm,
            margin=margin,
            min_flutter_rpm=min_flutter_rpm,
            min_critical_rpm=min_critical_rpm,
            max_rim_m_per_s=max_rim_m_per_s,
            max_amplitude_mm=max_amplitude_mm,
            accept_unusual=accept_unusual,
        )
        return self._asked(CheckResults, ask, "speeds", accuracy, tolerance, None)

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
        ask = partial(_native.cut, rpm=speeds)
        return self._asked(CutResults, ask, "points of the map", accuracy, tolerance, progress)

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
        return self._asked(RunUpResults, _native.runup, "steps", accuracy, tolerance, progress)

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
        ask = partial(_native.deflect, force_n=force_n, angle_deg=angle_deg, to_rpm=to_rpm)
        return self._asked(DeflectResults, ask, "equilibria", accuracy, tolerance, progress)

    def run_gap(
        self,
        *,
        force_n: Number = None,
        rpm: Number = None,
        max_deviation_mm: Number = None,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> GapResults:
        """Evaluates guides with a gap: the chart over the amplitude at them, and the deflection at
        the cut over the gap.

        Parameters
        ----------
        force_n : float, optional
            Side force at the rim at the cut; that of the scene's ``runup`` by default, or 1 N.
        rpm : float, optional
            Speed of the map over gap and force; the operating speed by default, or half of the
            first critical speed.
        max_deviation_mm : float, optional
            Largest deflection at the cut that is allowed.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        GapResults

        Raises
        ------
        ArgumentError
            Where a number is none, or no guide of the scene is one-sided.
        AnalysisError
            Where the side force finds no guide to press on.

        Examples
        --------
        >>> import sawflutter as sf
        >>> pad = {"guides[0].contact": "one_sided", "guides[0].gap_m": 4e-5}
        >>> saw = sf.Scene.paper().replace({**pad, "sweep.to_rpm": 1700, "operating_rpm": 1000})
        >>> r = saw.run_gap(force_n=2.0, max_deviation_mm=0.3, accuracy="draft")
        >>> r.free.critical_rpm[0] < r.linear.critical_rpm[0]
        True
        """
        ask = partial(_native.gap, force_n=force_n, rpm=rpm, max_deviation_mm=max_deviation_mm)
        return self._asked(GapResults, ask, "amplitudes", accuracy, tolerance, progress)

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
        >>> stiff = {"guides": [], "blade.thickness_m": 6e-3, "blade.teeth": 12}
        >>> collar = {"mount": {"kind": "collar", "diameter_m": 0.3, "in_plane": "fixed"}}
        >>> spring = {"cut.washboarding": {"stiffness_n_per_m": 1e5, "overlap": 1.0}}
        >>> air = {"damping.air_n_s_per_m3": 50.0}
        >>> saw = sf.Scene.paper().replace({**stiff, **collar, **spring, **air})
        >>> saw.run_washboard(600, accuracy="draft").verdict
        'unstable'
        """
        ask = partial(_native.washboard, rpm=rpm)
        return self._asked(WashboardResults, ask, "speeds", accuracy, tolerance, progress)
