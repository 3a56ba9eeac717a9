"""Computations for a saw."""

from __future__ import annotations

import json
from collections.abc import Iterable
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
from .motions import CutResults, DeflectResults, GapResults, ResponseResults, RunUpResults, WashboardResults
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
        """Computes modes, critical speeds, bands of instability and certificate. If this takes
        more than about ten seconds, the logger ``sawflutter`` warns first with a rough estimate of
        the time.

        Parameters
        ----------
        speed_range : (float, float) or array_like, optional
            First and last speed in rpm, instead of the scene's ``sweep``. If more speeds are
            given, only the lowest and the highest count, because the program chooses those
            between.
        accuracy : {"draft", "design", "reference"}, optional
            Instead of the scene's.
        tolerance : float, optional
            Relative error allowed of critical speeds and onsets, instead of a name.
        sensitivity : bool
            Whether to compute the sensitivity of critical speeds and onsets to the numbers of the
            scene.
        amplitude : bool
            Whether to compute the amplitude that flutter in each band reaches:
            ``saturated_amplitude_m`` of the bands.
        shapes : bool or array_like
            Whether to compute the shape of the blade at every critical speed, in every band and at
            the operating speed; speeds in rpm are added to these.
        progress : bool or callable, optional
            True shows a bar. A callable is called with the finished and the total number of items
            in each step of the computation.

        Returns
        -------
        CampbellResults

        Raises
        ------
        SceneError
            If the range or the accuracy is invalid.
        AnalysisError
            If the program cannot analyse the saw; the message says what to do.

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
        return scene._asked(
            CampbellResults,
            accuracy,
            tolerance,
            progress,
            sensitivity=sensitivity,
            amplitude=amplitude,
            shapes_at_rpm=shapes_at_rpm,
        )

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
            The speed, or several, which share one basis.

        Returns
        -------
        tuple of Mode
            At one speed.
        Modes
            At several speeds, with frequencies and growth rates as arrays.

        Raises
        ------
        ArgumentError
            If a speed is outside of the sweep.

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
        options = {"at_rpm": speeds.ravel().tolist()}
        found = json.loads(_native.run("modes", self._text, options))
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
        """Checks the saw against limits.

        Parameters
        ----------
        operating_rpm : float, optional
            Operating speed; by default that of the scene.
        margin : float
            Largest allowed ratio of operating speed to first critical speed.
        min_flutter_rpm, min_critical_rpm : float, optional
            Lowest allowed flutter speed and first critical speed.
        max_rim_m_per_s : float
            Largest allowed rim speed.
        max_amplitude_mm : float, optional
            Largest allowed amplitude of flutter, in millimetres, in any band up to the operating
            speed, without damping.
        accept_unusual : bool
            Whether a saw with implausible numbers may pass.
        accuracy, tolerance
            As in :meth:`run_campbell`.

        Returns
        -------
        CheckResults
            True in a boolean context if every limit is kept: ``assert saw.check(...)``.

        Raises
        ------
        ArgumentError
            If a limit is invalid, or if neither the scene nor the call gives an operating speed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> saw.check(operating_rpm=1250, accuracy="draft").passed
        True
        >>> saw.check(operating_rpm=1400, accuracy="draft").failures
        ('85 % rule',)
        """
        return self._asked(
            CheckResults,
            accuracy,
            tolerance,
            None,
            operating_rpm=operating_rpm,
            margin=margin,
            min_flutter_rpm=min_flutter_rpm,
            min_critical_rpm=min_critical_rpm,
            max_rim_m_per_s=max_rim_m_per_s,
            max_amplitude_mm=max_amplitude_mm,
            accept_unusual=accept_unusual,
        )

    def run_cut(
        self,
        rpm: npt.ArrayLike = (),
        *,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> CutResults:
        """Computes eigenvalues and a time history under the cutting forces of the scene's ``cut``.

        Parameters
        ----------
        rpm : float or array_like, optional
            Speeds of the cut, instead of those of the scene.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        CutResults

        Raises
        ------
        ArgumentError
            If the scene has no ``cut``.

        Examples
        --------
        >>> import sawflutter as sf
        >>> cut = sf.Scene.paper().run_cut([1800, 2800], accuracy="draft")
        >>> cut.runs[1].verdict
        'unstable'
        """
        speeds = np.atleast_1d(np.asarray(rpm, float)).tolist()
        return self._asked(CutResults, accuracy, tolerance, progress, rpm=speeds)

    def run_up(
        self,
        *,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> RunUpResults:
        """Computes a run-up under the side force, from the scene's ``runup`` and ``side_force``.

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
            If the scene has no ``runup``.

        Examples
        --------
        >>> import sawflutter as sf
        >>> up = sf.Scene.paper().run_up(accuracy="draft")
        >>> up.bands[0].band.kind, up.rpm.shape == up.deflection_m.shape
        ('divergence', True)
        """
        return self._asked(RunUpResults, accuracy, tolerance, progress)

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
        """Computes the equilibrium deflection of the blade while its speed slowly rises and falls.

        Parameters
        ----------
        force_n : float, optional
            Constant lateral force, fixed in space, in place of the scene's ``side_force.force_n``;
            1 N in a scene without one.
        angle_deg : float, optional
            Angle of the force, in place of the scene's ``side_force.angle_deg``.
        to_rpm : float, optional
            Last speed; by default the end of the scene's sweep.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        DeflectResults

        Raises
        ------
        ArgumentError
            If an argument is out of range.
        AnalysisError
            If the blade is unsupported, or no equilibrium was found.

        Examples
        --------
        >>> import sawflutter as sf
        >>> found = sf.Scene.paper().run_deflect(to_rpm=1000, accuracy="draft")
        >>> found.beyond_thickness_rpm is None
        True
        """
        scene = self._with({"side_force.force_n": force_n, "side_force.angle_deg": angle_deg})
        return scene._asked(DeflectResults, accuracy, tolerance, progress, to_rpm=to_rpm)

    def run_response(
        self,
        *,
        rpm: Number = None,
        to_hz: Number = None,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> ResponseResults:
        """Computes the steady state over the speed for the excitation of the blocks ``side_force``
        and ``response`` of the scene, or for a side force of 1 N.

        Parameters
        ----------
        rpm : float, optional
            Speed of the frequency response from the side force to the probe, within the sweep; the
            operating speed by default.
        to_hz : float, optional
            Largest frequency of that; by default that up to which the diagram is complete.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        ResponseResults

        Raises
        ------
        ArgumentError
            If a number is out of range, or the scene has a run-out that its blade cannot have.
        AnalysisError
            If the program cannot analyse the saw.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().replace({"side_force": {"force_n": 2.0}})
        >>> r = saw.run_response(accuracy="draft")
        >>> [line.name for line in r.lines]
        ['side force, static']
        """
        return self._asked(ResponseResults, accuracy, tolerance, progress, rpm=rpm, to_hz=to_hz)

    def run_gap(
        self,
        *,
        force_n: Number = None,
        rpm: Number = None,
        max_deviation_mm: Number = None,
        oscillating_force_n: Number = None,
        oscillating_order: int | None = None,
        friction: Number = None,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> GapResults:
        """Evaluates guides with a gap: the chart over the amplitude at them, and the deflection at
        the cut over the gap.

        Parameters
        ----------
        force_n : float, optional
            Constant side force, in place of the scene's ``side_force.force_n``; 1 N in a scene
            without one.
        rpm : float, optional
            Speed of the map over gap and force; the operating speed by default, or half of the
            first critical speed.
        max_deviation_mm : float, optional
            Largest deflection at the cut that is allowed.
        oscillating_force_n : float, optional
            Amplitude of a side force that oscillates, in place of the scene's
            ``side_force.oscillating_n``. With it, or with ``runout_m``, ``flatness_m`` or
            ``imbalance_kg_m2`` in the scene's ``response``, the oscillation of the blade about its
            deflection is computed.
        oscillating_order : int, optional
            Ratio of the frequency of this force to that of rotation, in place of the scene's
            ``side_force.order``; 1 in a scene without one.
        friction : float, optional
            Coefficient of friction of the pads in place of the scene's ``friction.coefficient``. With
            friction the heat of the pads is computed, and the deflection of the blade that it heats.
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
        >>> bool(r.free.critical_rpm[0] < r.linear.critical_rpm[0])
        True
        """
        numbers = {
            "side_force.force_n": force_n,
            "side_force.oscillating_n": oscillating_force_n,
            "side_force.order": oscillating_order,
            "friction.coefficient": friction,
        }
        return self._with(numbers)._asked(
            GapResults,
            accuracy,
            tolerance,
            progress,
            rpm=rpm,
            max_deviation_mm=max_deviation_mm,
        )

    def run_washboard(
        self,
        rpm: Number = None,
        *,
        accuracy: Accuracy | None = None,
        tolerance: Number = None,
        progress: Progress = None,
    ) -> WashboardResults:
        """Determines whether washboarding occurs under the cutting force of the scene's
        ``cut.washboarding``.

        Parameters
        ----------
        rpm : float, optional
            Speed of the cut; by default the scene's operating speed.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        WashboardResults

        Raises
        ------
        ArgumentError
            If the scene has no ``cut.washboarding``, or no speed is given.
        SceneError
            If the scene has no damping.

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
        return self._asked(WashboardResults, accuracy, tolerance, progress, rpm=rpm)
