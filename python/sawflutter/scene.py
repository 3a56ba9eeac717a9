"""Scene: a saw and its computations."""

from __future__ import annotations

import json
import math
import os
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, SupportsIndex, TypeAlias, cast, overload

import numpy as np

from . import _native
from ._drawn import Drawn
from ._entry import array
from ._measured import Measured, table
from ._progress import Progress, reporting
from ._report_types import Mode
from ._result import R
from ._scene_types import (
    Accuracy, BladeDict, ContactLaw, CutDict, GuideArmDict, GuideControllerDict, GuideDict, GuideFilmDict, GuideShape, GuideSide, MountDict, NumberPath, SceneDict,
)  # fmt: skip
from ._values import Number, number, numbers, optional, whole
from .checks import CheckResults
from .designs import DesignResults, FitResults, PlaceResults, SizeResults, Speeds, StiffnessMap, TradeoffResults
from .errors import refused, warned
from .matrices import Matrices
from .modes import Modes
from .motions import CutResults, DeflectResults, GapResults, ResponseResults, RunUpResults, WashboardResults
from .results import CampbellResults

if TYPE_CHECKING:
    import numpy.typing as npt
    from distributed import Client
    from matplotlib.animation import FuncAnimation
    from plotly.graph_objects import Figure
    from typing_extensions import Self

    from ._values import Numbers
    from .maps import Along, MapResults
    from .margins import MeasuredMargin
    from .plot.motion import Animation

Bounds: TypeAlias = "tuple[Number, Number] | None"
Free: TypeAlias = "Mapping[str, Bounds] | Iterable[str] | None"
"""Paths of the scene and their bounds, or paths with the default bounds."""
Each: TypeAlias = "Mapping[str, Number | Iterable[Number]] | None"
"""A path of the scene and its values."""
Value: TypeAlias = "float | str | list[Any] | dict[str, Any] | None"
"""A number, a word, or a block of a scene."""

_UNCHANGED = "a scene cannot be changed; replace({path: value}) makes another one"


class Block(dict[str, Any]):
    """A part of a scene: a read-only dict. ``dict(block)`` is a copy that can be changed."""

    def _refuse(self, *_: object, **__: object) -> Any:
        raise TypeError(_UNCHANGED)

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return dict, (dict(self),)


class Scene(Drawn, Mapping[str, Value]):
    """A saw (blade, mount, guides) with the conditions to compute. It is a mapping of the keys of
    a scene file and accepts paths too. It is read-only; :meth:`replace` returns a changed copy.
    :meth:`plot` draws it in axial view, with the positive directions of rotation and angles.

    Every number may be a plain or a NumPy number, a text with a unit such as ``"2.6 mm"``, or a
    quantity of pint. Input that is refused raises :class:`InputError`, with key, value, what is
    allowed and a remedy; a saw that cannot be analysed raises :class:`AnalysisError`; implausible
    numbers and results outside of the model are warned of by :class:`ModelWarning`.

    Parameters
    ----------
    data : dict
        The scene as in a scene file, see :data:`sawflutter.SceneDict`.

    Examples
    --------
    >>> import sawflutter as sf
    >>> saw = sf.Scene.paper()
    >>> saw["blade.thickness_m"], saw.blade["thickness_m"], "damping" in saw
    (0.0028, 0.0028, False)
    >>> saw.replace({"blade.thickness_m": "2.6 mm", "guides[0].radius_m": 0.22})
    <Scene 'Guided spline arbor saw': 710 mm outside, 2.6 mm thick, 1 guide>
    """

    __slots__ = ("_data", "_text")
    _text: str
    _data: Block

    def __init__(self, data: SceneDict | Mapping[str, Any]) -> None:
        if not isinstance(data, Mapping):
            raise TypeError(
                f"a scene is made of a dict, not of {data!r}: Scene.load reads a file, and "
                "Scene.from_json a text"
            )
        self._setup(_native.scene(data))
        self._warned()

    def _setup(self, text: str) -> None:
        object.__setattr__(self, "_text", text)
        object.__setattr__(self, "_data", json.loads(text, object_hook=Block))

    @classmethod
    def _of(cls, text: str) -> Self:
        """The scene of a text that the library has written."""
        scene = cls.__new__(cls)
        scene._setup(text)
        return scene

    def _warned(self, before: Scene | None = None) -> Self:
        """Warns of implausible numbers, apart from those of the scene ``before`` a change."""
        if unusual := _native.unusual_numbers(self._text):
            known = [] if before is None else _native.unusual_numbers(before._text)
            warned(text for text in unusual if text not in known)
        return self

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Reads a scene from a JSON text.

        Raises
        ------
        SceneError
            As of :class:`Scene`.
        """
        return cls._of(_native.scene(text))._warned()

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Reads a scene file at a path.

        Returns
        -------
        Scene

        Raises
        ------
        SceneError
            The file is no scene; the error names the key, or all keys that are missing.
        OSError
            The file cannot be read.
        """
        if isinstance(path, Mapping):
            raise TypeError("Scene.load reads a file at a path; a dict is made a scene by Scene(data)")
        return cls._of(_native.read_scene(path))._warned()

    @classmethod
    def paper(cls) -> Self:
        """The built-in guided spline saw, with the numbers of a paper."""
        return cls._of(_native.paper())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a scene file at a path."""
        text = json.dumps(self.to_dict(), indent=2, ensure_ascii=False)
        Path(path).write_text(text + "\n", encoding="utf-8")

    def to_dict(self) -> SceneDict:
        """A copy of the scene as a dict, which can be changed and converted to a scene again."""
        return cast(SceneDict, json.loads(self._text))

    def to_json(self) -> str:
        """The scene as one line of JSON."""
        return self._text

    @property
    def name(self) -> str:
        """Title of reports and figures."""
        return str(self._data["name"])

    @property
    def blade(self) -> BladeDict:
        """The blade, for instance ``saw.blade["thickness_m"]``."""
        return cast(BladeDict, self._data["blade"])

    @property
    def mount(self) -> MountDict | None:
        """The support of the blade at the bore."""
        return self._data.get("mount")

    @property
    def guides(self) -> tuple[GuideDict, ...]:
        """The guides, for instance ``saw.guides[0]["radius_m"]``."""
        return tuple(self._data.get("guides", ()))

    @property
    def cut(self) -> CutDict | None:
        """The cut: wood and cutting forces."""
        return self._data.get("cut")

    @property
    def operating_rpm(self) -> float | None:
        """The operating speed."""
        return self._data.get("operating_rpm")

    @property
    def accuracy(self) -> Accuracy | None:
        """The accuracy by its name, draft, design or reference; None if the scene has none."""
        return self._data.get("accuracy")

    @overload
    def __getitem__(self, path: NumberPath) -> float: ...
    @overload
    def __getitem__(self, path: Literal["guides"]) -> list[dict[str, Any]]: ...
    @overload
    def __getitem__(self, path: Literal["name", "accuracy"]) -> str: ...
    @overload
    def __getitem__(self, path: str) -> Value: ...
    def __getitem__(self, path: str) -> Any:
        """The value at a path, for instance ``saw["guides[0].radius_m"]``."""
        return json.loads(_native.value(self._text, path), object_hook=Block)

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def replace(self, changes: Mapping[str, object]) -> Self:
        """Returns the scene with other values at given paths.

        Parameters
        ----------
        changes : dict
            New values by path, such as ``"guides[0].radius_m"``. None removes a key. A missing
            block, such as ``damping`` in ``"damping.air_n_s_per_m3"``, is created.

        Returns
        -------
        Scene
            Of implausible numbers that this one has not, a :class:`ModelWarning` warns at once.

        Raises
        ------
        PathError
            The scene cannot have such a path.
        SceneError
            A value is out of range, or keys of a block are missing.
        """
        return self._of(_native.replace(self._text, changes))._warned(self)

    def with_accuracy(self, accuracy: Accuracy | None = None, tolerance: Number | None = None) -> Self:
        """Returns the scene with another ``accuracy`` by name, or with a ``tolerance``: the relative
        error that is allowed of critical speeds and onsets."""
        if accuracy is not None and tolerance is not None:
            raise TypeError("give accuracy or tolerance, not both")
        if accuracy is not None:
            return self.replace({"accuracy": accuracy, "tolerance": None})
        return self if tolerance is None else self.replace({"tolerance": tolerance})

    def _drawing(self) -> str:
        return _native.saw_chart(self._text)

    @overload
    def animate(self, mode: Mode, *, backend: Literal["plotly"] = "plotly", frames: int = 48) -> Figure: ...
    @overload
    def animate(self, mode: Mode, *, backend: Literal["matplotlib"], frames: int = 48) -> FuncAnimation: ...
    def animate(
        self, mode: Mode, *, backend: Literal["plotly", "matplotlib"] = "plotly", frames: int = 48
    ) -> Animation:
        """Animates a ``mode`` of :meth:`modes` in the fixed frame, with so many ``frames`` in a period;
        by ``backend`` a plotly Figure with a button, or a matplotlib FuncAnimation."""
        from .plot.motion import animate

        return animate(self, mode, backend=backend, frames=frames)

    def run_campbell(
        self,
        *,
        speed_range: Numbers | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        sensitivity: bool = False,
        amplitude: bool = False,
        shapes: bool | Numbers = False,
        in_cut_rpm: Number | None = None,
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
        accuracy, tolerance
            As in :meth:`with_accuracy`, instead of the scene's.
        sensitivity : bool
            Whether to compute the sensitivity of critical speeds and onsets to the numbers of the
            scene.
        amplitude : bool
            Whether to compute the amplitude that flutter in each band reaches:
            ``saturated_amplitude_m`` of the bands.
        shapes : bool or array_like
            Whether to compute the shape of the blade at every critical speed, in every band and at
            the operating speed; speeds in rpm are added to these.
        in_cut_rpm : float, optional
            Speed of the cut under whose forces the saw is charted, as ``cut.chart_rpm`` of the scene.
        progress : bool or callable, optional
            True shows a bar. A callable is called with the finished and the total number of items
            in each phase of the computation, and the name of the phase.

        Returns
        -------
        CampbellResults

        Raises
        ------
        InputError
            An argument is refused.
        AnalysisError
            The saw cannot be analysed, or that would take more than five minutes.
        """
        scene = self
        if speed_range is not None:
            # In the unit of the numbers of the scene that they replace.
            speeds = numbers("sweep.to_rpm", speed_range)
            if speeds.size < 2:
                raise refused("speed_range", speed_range, "a first and a last speed in rpm", "write it like (0, 3000)")
            scene = self.replace({"sweep.from_rpm": speeds.min(), "sweep.to_rpm": speeds.max()})
        if in_cut_rpm is not None:
            scene = scene.replace({"cut.chart_rpm": in_cut_rpm})
        is_flag = isinstance(shapes, (bool, np.bool_))
        asked = [] if is_flag else np.ravel(numbers("shapes", shapes)).tolist()
        return scene._asked(
            CampbellResults, accuracy, tolerance, progress, sensitivity=sensitivity, amplitude=amplitude,
            shapes_at_rpm=asked if not is_flag or shapes else None,
        )  # fmt: skip

    def speeds(self, beside: Scene | None = None) -> Speeds:
        """Critical speeds, flutter speed and bands, without branches and shapes: a cheap call for
        many similar saws, as of a study.

        Parameters
        ----------
        beside : Scene, optional
            A similar saw, the same for all calls, which gives the last speed and the basis, or a
            larger one where the accuracy needs it. Its basis is kept between calls. By default the
            saw has a basis of its own.

        Returns
        -------
        Speeds

        Raises
        ------
        AnalysisError
            The saw cannot be analysed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> for mm in (2.7, 2.8, 2.9):
        ...     thick = saw.replace({"blade.thickness_m": f"{mm} mm"})
        ...     print(round(thick.speeds(beside=saw).first_critical_rpm, -1))
        1480.0
        1530.0
        1580.0
        """
        text, to_rpm = _native.speeds(self._text, _beside(beside))
        warned(_native.unusual_numbers(self._text))
        found = json.loads(text)
        critical = [rpm for rpm in found["critical_rpm"] if rpm <= to_rpm]
        return Speeds._from_dict({**found, "name": self.name, "to_rpm": to_rpm, "critical_rpm": critical})

    @overload
    def modes(
        self, rpm: Numbers, *, to_hz: Number | None = None, n_modes: SupportsIndex | None = None,
        beside: Scene | None = None, progress: Progress = None,
    ) -> Modes[tuple[Mode, ...]]: ...  # fmt: skip
    @overload
    def modes(
        self, rpm: Number, *, to_hz: Number | None = None, n_modes: SupportsIndex | None = None,
        beside: Scene | None = None, progress: Progress = None,
    ) -> Modes[Mode]: ...  # fmt: skip
    def modes(
        self, rpm: Any, *, to_hz: Number | None = None, n_modes: SupportsIndex | None = None,
        beside: Scene | None = None, progress: Progress = None,
    ) -> Modes[Any]:  # fmt: skip
        """Modes at a speed within the sweep, or at several from one basis, ascending by frequency,
        with their shapes.

        Parameters
        ----------
        rpm : float or array_like
            The speed, or several.
        to_hz : float, optional
            Largest frequency; by default ``complete_to_hz`` of the result, up to which no mode is
            missing.
        n_modes : int, optional
            Largest number of modes at a speed, at least 1. If fewer modes are complete a
            :class:`ModelWarning` says so.
        beside : Scene, optional
            A similar saw whose basis is kept between calls, as in :meth:`speeds`.
        progress
            As in :meth:`run_campbell`.

        Returns
        -------
        Modes
            Of the shape (modes), or (speeds, modes) for several speeds.

        Raises
        ------
        ArgumentError
            A speed is not within the sweep, or a frequency above ``complete_to_hz``.
        AnalysisError
            The saw cannot be analysed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().replace({"accuracy": "draft"})
        >>> f"{saw.modes(rpm=0)[0].frequency_hz:.1f} Hz"
        '7.7 Hz'
        >>> saw.modes([0, 500, 1000], n_modes=3).frequency_hz[:, 0].round(1).tolist()
        [7.7, 5.2, 2.6]
        """
        speeds = numbers("rpm", rpm)
        most = None if n_modes is None else whole("n_modes", n_modes)
        if most == 0:
            raise refused("n_modes", most, "at least 1", "leave it out for all modes that are complete")
        options = {"at_rpm": speeds.ravel().tolist(), "to_hz": to_hz, "n_modes": most, "beside": _beside(beside)}
        with reporting(progress, "speeds") as told:
            found = json.loads(_run("modes", self._text, options, told)[0])
        fewest = min(map(len, found["modes"]), default=0)
        is_short = most is not None and to_hz is None and fewest < most
        short = f"{fewest} of {most} modes are complete, up to {found['complete_to_hz']:.4g} Hz"
        warned([*_native.unusual_numbers(self._text), *([short] if is_short else [])])
        return Modes._of(speeds, found)

    # Generated by tools/generate_types.py from the library's table of arguments and its schema; not to be edited.
    def add_guide(
        self,
        *,
        radius_m: Number | None = None,
        angle_deg: Number | None = None,
        radial_length_m: Number | None = None,
        tangential_length_m: Number | None = None,
        stiffness_n_per_m: Number | None = None,
        shape: GuideShape | None = None,
        damping_n_s_per_m: Number | None = None,
        gap_m: Number | None = None,
        contact: ContactLaw | None = None,
        side: GuideSide | None = None,
        film_stiffness_n_per_m: Number | None = None,
        offset_m: Number | None = None,
        arm: GuideArmDict | None = None,
        film: GuideFilmDict | None = None,
        controller: GuideControllerDict | None = None,
    ) -> Self:
        """Returns the scene with one more guide at the end of :attr:`guides`. The arguments are the
        keys of a guide in a scene file; those that are not given are copied from the last guide.
        """
        given = {key: value for key, value in locals().items() if key != "self" and value is not None}
        last: Mapping[str, Any] = self.guides[-1] if self.guides else {}
        return self.replace({"guides": [*self.guides, {**last, **given}]})

    def check(
        self,
        *,
        operating_rpm: Number | None = None,
        accept_unusual: bool = False,
        margin: Number | None = None,
        min_flutter_rpm: Number | None = None,
        min_critical_rpm: Number | None = None,
        max_rim_m_per_s: Number | None = None,
        max_amplitude_m: Number | None = None,
        max_deviation_m: Number | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
    ) -> CheckResults:
        """Checks the saw against limits. The result is true in a boolean context if every limit is kept:
        assert saw.check(...).

        Parameters
        ----------
        operating_rpm : float, optional
            Operating speed; by default that of the scene.
        accept_unusual : bool
            Let a saw with implausible numbers pass.
        margin : float, optional
            Largest allowed ratio of operating speed to first critical speed; 0.85 in a scene without one.
        min_flutter_rpm : float, optional
            Lowest allowed flutter speed.
        min_critical_rpm : float, optional
            Lowest allowed first critical speed.
        max_rim_m_per_s : float, optional
            Largest allowed speed of the rim; 100 m/s in a scene without one.
        max_amplitude_m : float, optional
            Largest allowed amplitude of flutter in any band up to the operating speed, without damping.
        max_deviation_m : float, optional
            Largest allowed deflection of the rim at the cut, at the operating speed.
        accuracy, tolerance
            As in :meth:`run_campbell`.

        Returns
        -------
        CheckResults

        Raises
        ------
        InputError
            An argument or a number of the scene is refused.
        AnalysisError
            The saw cannot be analysed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> saw.check(operating_rpm=1250, accuracy="draft").passed
        True
        >>> saw.check(operating_rpm=1400, accuracy="draft").failures
        ('85 % rule',)
        """
        return self._asked(CheckResults, accuracy, tolerance, None, operating_rpm=operating_rpm,
            accept_unusual=accept_unusual, margin=margin, min_flutter_rpm=min_flutter_rpm,
            min_critical_rpm=min_critical_rpm, max_rim_m_per_s=max_rim_m_per_s,
            max_amplitude_m=max_amplitude_m, max_deviation_m=max_deviation_m)

    def run_cut(
        self,
        rpm: Number | Numbers = (),
        *,
        power_w: Number | None = None,
        depth_m: Number | None = None,
        stretching: bool | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        progress: Progress = None,
    ) -> CutResults:
        """Computes eigenvalues and a time history under the cutting forces of cut in the scene. If the
        scene has no cut but the call a power or a depth, typical numbers are assumed for the others, and a
        ModelWarning names them.

        Parameters
        ----------
        rpm : float or array_like, optional
            Speed of the cut, or several, in place of those of the scene.
        power_w : float, optional
            Power of the cut.
        depth_m : float, optional
            Depth of cut.
        stretching : bool, optional
            Let the blade stretch where it bends by more than a part of its thickness.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        CutResults

        Raises
        ------
        InputError
            An argument or a number of the scene is refused.
        AnalysisError
            The saw cannot be analysed.
        """
        return self._asked(CutResults, accuracy, tolerance, progress, rpm=np.atleast_1d(numbers("rpm",
            rpm)), power_w=power_w, depth_m=depth_m, stretching=stretching)

    def run_up(
        self,
        *,
        to_rpm: Number | None = None,
        duration_s: Number | None = None,
        force_n: Number | None = None,
        stretching: bool | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        progress: Progress = None,
    ) -> RunUpResults:
        """Computes a run-up under the side force, from runup and side_force of the scene. If the scene has
        no runup but the call one of its numbers, typical numbers are assumed for the others, and a
        ModelWarning names them.

        Parameters
        ----------
        to_rpm : float, optional
            Last speed.
        duration_s : float, optional
            Time that the run-up takes.
        force_n : float, optional
            Constant side force, in place of side_force.force_n of the scene; 1 N in a scene without one.
        stretching : bool, optional
            Let the blade stretch where it bends by more than a part of its thickness.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        RunUpResults

        Raises
        ------
        InputError
            An argument or a number of the scene is refused.
        AnalysisError
            The saw cannot be analysed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> up = sf.Scene.paper().run_up(to_rpm=500, duration_s=5, accuracy="draft")
        >>> round(up.rpm[-1]), up.rpm.shape == up.deflection_m.shape
        (500, True)
        """
        return self._asked(RunUpResults, accuracy, tolerance, progress, to_rpm=to_rpm,
            duration_s=duration_s, force_n=force_n, stretching=stretching)

    def run_deflect(
        self,
        *,
        to_rpm: Number | None = None,
        force_n: Number | None = None,
        angle_deg: Number | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        progress: Progress = None,
    ) -> DeflectResults:
        """Computes the equilibrium deflection of the blade while its speed slowly rises and falls.

        Parameters
        ----------
        to_rpm : float, optional
            Last speed; by default the end of the scene's sweep.
        force_n : float, optional
            Constant side force, in place of side_force.force_n of the scene; 1 N in a scene without one.
        angle_deg : float, optional
            Angle of the side force, in place of that of the scene.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        DeflectResults

        Raises
        ------
        InputError
            An argument or a number of the scene is refused.
        AnalysisError
            The saw cannot be analysed.
        """
        return self._asked(DeflectResults, accuracy, tolerance, progress, to_rpm=to_rpm, force_n=force_n,
            angle_deg=angle_deg)

    def run_report(
        self,
        *,
        customer: str | None = None,
        date: str | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        progress: Progress = None,
    ) -> DesignResults:
        """Joins what decides on a saw in one report: the answer idling and in the cut, the deviation of the
        board over speed, margins with usual tolerances of production, and the changes that help most. Saved
        to a name that ends in .html it is a page to print.

        Parameters
        ----------
        customer : str, optional
            For whom the report is.
        date : str, optional
            Date of the report, as it is to be written.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        DesignResults

        Raises
        ------
        InputError
            An argument or a number of the scene is refused.
        AnalysisError
            The saw cannot be analysed.
        """
        return self._asked(DesignResults, accuracy, tolerance, progress, customer=customer, date=date)

    def run_response(
        self,
        *,
        rpm: Number | None = None,
        to_hz: Number | None = None,
        force_n: Number | None = None,
        angle_deg: Number | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        progress: Progress = None,
    ) -> ResponseResults:
        """Computes the steady state over the speed for the excitation of the blocks side_force and response
        of the scene, or for a side force of 1 N. For the response between points of one's own at one speed
        see Matrices.response.

        Parameters
        ----------
        rpm : float, optional
            Speed of the frequency response from the side force to the probe, within the sweep; by default
            the operating speed.
        to_hz : float, optional
            Largest frequency of that; by default that up to which the diagram is complete.
        force_n : float, optional
            Constant side force, in place of side_force.force_n of the scene; 1 N in a scene without one.
        angle_deg : float, optional
            Angle of the side force, in place of that of the scene.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        ResponseResults

        Raises
        ------
        InputError
            An argument or a number of the scene is refused.
        AnalysisError
            The saw cannot be analysed.
        """
        return self._asked(ResponseResults, accuracy, tolerance, progress, rpm=rpm, to_hz=to_hz,
            force_n=force_n, angle_deg=angle_deg)

    def run_gap(
        self,
        *,
        gap_m: Number | None = None,
        rpm: Number | None = None,
        max_deviation_m: Number | None = None,
        force_n: Number | None = None,
        oscillating_force_n: Number | None = None,
        oscillating_order: Number | None = None,
        friction: Number | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        progress: Progress = None,
    ) -> GapResults:
        """Evaluates guides with a gap: the chart over the amplitude at them, and the deflection at the cut
        over the gap.

        Parameters
        ----------
        gap_m : float, optional
            Gap of every guide, one-sided, in place of the contact of the guides of the scene.
        rpm : float, optional
            Speed of the map over gap and force; by default the operating speed, or half of the first
            critical speed.
        max_deviation_m : float, optional
            Largest allowed deflection of the rim at the cut, at the operating speed.
        force_n : float, optional
            Constant side force, in place of side_force.force_n of the scene; 1 N in a scene without one.
        oscillating_force_n : float, optional
            Amplitude of a side force that oscillates, in place of side_force.oscillating_n of the scene:
            the oscillation of the blade about its deflection is computed. Run-out, flatness and imbalance
            of response in the scene make it oscillate, too.
        oscillating_order : float, optional
            Ratio of the frequency of this force to that of rotation, in place of side_force.order of the
            scene; by default 1.
        friction : float, optional
            Coefficient of friction of the pads, in place of friction.coefficient of the scene: the heat of
            the pads is computed, and the deflection of the blade that it heats.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        GapResults

        Raises
        ------
        InputError
            An argument or a number of the scene is refused.
        AnalysisError
            The saw cannot be analysed.
        """
        return self._asked(GapResults, accuracy, tolerance, progress, gap_m=gap_m, rpm=rpm,
            max_deviation_m=max_deviation_m, force_n=force_n, oscillating_force_n=oscillating_force_n,
            oscillating_order=oscillating_order, friction=friction)

    def run_washboard(
        self,
        *,
        rpm: Number | None = None,
        stiffness_n_per_m: Number | None = None,
        overlap: Number | None = None,
        power_w: Number | None = None,
        depth_m: Number | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        progress: Progress = None,
    ) -> WashboardResults:
        """Determines whether washboarding occurs under the cutting force of cut.washboarding in the scene.
        If the scene has none but the call one of its numbers, typical numbers are assumed for the others,
        and a ModelWarning names them.

        Parameters
        ----------
        rpm : float, optional
            Speed of the cut; by default the operating speed of the scene.
        stiffness_n_per_m : float, optional
            Lateral cutting stiffness, in place of cut.washboarding.stiffness_n_per_m of the scene.
        overlap : float, optional
            Share of a tooth's cut on the surface left by the preceding one, in place of
            cut.washboarding.overlap of the scene.
        power_w : float, optional
            Power of the cut.
        depth_m : float, optional
            Depth of cut.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        WashboardResults

        Raises
        ------
        InputError
            An argument or a number of the scene is refused.
        AnalysisError
            The saw cannot be analysed.
        """
        return self._asked(WashboardResults, accuracy, tolerance, progress, rpm=rpm,
            stiffness_n_per_m=stiffness_n_per_m, overlap=overlap, power_w=power_w, depth_m=depth_m)

    def fit(
        self,
        measured: Measured = None,
        *,
        free: Free = None,
        to_rpm: Number | None = None,
        confidence: Number = 0.95,
        starts: SupportsIndex = 12,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        progress: Progress = None,
    ) -> FitResults:
        """Fits guides, density or other numbers of the scene to measured frequencies.

        Parameters
        ----------
        measured : path, DataFrame, array_like or rows, optional
            Table of measured frequencies; by default that of the scene. A file with speeds in rpm and
            frequencies in Hz, ascending, blank if a mode was not measured; or the same table as rows (rpm,
            hz, hz, ...) or (rpm, [hz, hz, ...]), as an array, or as a data frame with a column or an index
            rpm, with NaN for a blank. A list of frequencies alone is measured at rest.
        free : dict or list of str, optional
            Number to fit, or several, by its path in the scene, with or without bounds; by default radius
            and stiffness of every guide, and the angles between several guides. A dict gives a path its
            bounds (from, to), or None for the default ones.
        to_rpm : float, optional
            Leave out measurements above this speed.
        confidence : float
            Confidence level of the intervals.
        starts : int
            Starting points: the numbers of the scene, and others between the bounds.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        FitResults

        Raises
        ------
        InputError
            An argument or a number of the scene is refused.
        AnalysisError
            The saw cannot be analysed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> found = saw.fit([7.9, 13.2, 25.9], free=["guides[0].stiffness_n_per_m"], starts=1)
        >>> found.parameters[0].path
        'guides[0].stiffness_n_per_m'
        """
        return self._asked(FitResults, accuracy, tolerance, progress, measured=table(measured), free=free,
            to_rpm=to_rpm, confidence=confidence, starts=whole("starts", starts))

    def place(
        self,
        free: Free = None,
        *,
        goal: Literal["flutter", "window"] = "flutter",
        amplitude_m: Number | None = None,
        samples: SupportsIndex = 64,
        refine: SupportsIndex = 60,
        map: SupportsIndex = 0,
        radius_tolerance_m: Number = 0.002,
        angle_tolerance_deg: Number = 1.0,
        guide_tolerance_share: Number = 0.1,
        other_tolerance_share: Number = 0.01,
        min_critical_rpm: Number | None = None,
        max_deviation_m: Number | None = None,
        force_n: Number | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        progress: Progress = None,
    ) -> PlaceResults:
        """Finds the place of the guides with the highest flutter speed. This takes minutes.

        Parameters
        ----------
        free : dict or list of str, optional
            Number to vary, or several, by its path in the scene, with or without bounds; by default radius,
            angle and stiffness of the first guide. A dict gives a path its bounds (from, to), or None for
            the default ones.
        goal : {"flutter", "window"}
            Quantity to maximize: the flutter speed, or the stable window around the operating speed.
        amplitude_m : float, optional
            Amplitude at guides with a gap, with whose mean stiffness bands and critical speeds are
            computed; by default guides have their full stiffness.
        samples : int
            Saws in the first sampling of the bounds.
        refine : int
            Steps of the refinement of each of the best places, each a saw and those around it.
        map : int
            Points of the map along each axis; 0 for no map.
        radius_tolerance_m : float
            Manufacturing tolerance of radii; a saw is rated by the worst of its neighbours within the
            tolerances.
        angle_tolerance_deg : float
            Tolerance of angles.
        guide_tolerance_share : float
            Tolerance of the stiffness, damping or gap of a guide, as a share of it.
        other_tolerance_share : float
            Tolerance of other numbers, as a share of each.
        min_critical_rpm : float, optional
            Lowest allowed first critical speed.
        max_deviation_m : float, optional
            Largest allowed deflection of the rim at the cut, at the operating speed.
        force_n : float, optional
            Constant side force, in place of side_force.force_n of the scene; 1 N in a scene without one.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        PlaceResults

        Raises
        ------
        InputError
            An argument or a number of the scene is refused.
        AnalysisError
            The saw cannot be analysed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> free = {"guides[0].radius_m": ("200 mm", "280 mm")}
        >>> found = saw.place(free=free, samples=2, refine=1, map=0)
        >>> [parameter.path for parameter in found.parameters]
        ['guides[0].radius_m']
        """
        return self._asked(PlaceResults, accuracy, tolerance, progress, free=free, goal=goal,
            amplitude_m=amplitude_m, samples=whole("samples", samples), refine=whole("refine", refine),
            map=whole("map", map), radius_tolerance_m=radius_tolerance_m,
            angle_tolerance_deg=angle_tolerance_deg, guide_tolerance_share=guide_tolerance_share,
            other_tolerance_share=other_tolerance_share, min_critical_rpm=min_critical_rpm,
            max_deviation_m=max_deviation_m, force_n=force_n)

    def size(
        self,
        vary: Free = None,
        *,
        each: Each = None,
        points: SupportsIndex = 17,
        operating_rpm: Number | None = None,
        margin: Number | None = None,
        min_flutter_rpm: Number | None = None,
        min_critical_rpm: Number | None = None,
        max_rim_m_per_s: Number | None = None,
        max_amplitude_m: Number | None = None,
        max_deviation_m: Number | None = None,
        force_n: Number | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        progress: Progress = None,
    ) -> SizeResults:
        """Finds the values of a number of the scene with which the saw keeps all its limits at its
        operating speed: how thick, how stiff, how tight, how fast?.

        Parameters
        ----------
        vary : dict or list of str, optional
            The number, by its path in the scene, with or without bounds; `guides[*]` are all guides at
            once.
        each : dict, optional
            Another number of the scene, with values, for each of which the ranges are found too. A dict
            gives the path its values.
        points : int
            Number of saws between the bounds among which ranges are searched.
        operating_rpm : float, optional
            Operating speed, in place of that of the scene.
        margin : float, optional
            Largest allowed ratio of operating speed to first critical speed; 0.85 in a scene without one.
        min_flutter_rpm : float, optional
            Lowest allowed flutter speed.
        min_critical_rpm : float, optional
            Lowest allowed first critical speed.
        max_rim_m_per_s : float, optional
            Largest allowed speed of the rim; 100 m/s in a scene without one.
        max_amplitude_m : float, optional
            Largest allowed amplitude of flutter in any band up to the operating speed, without damping.
        max_deviation_m : float, optional
            Largest allowed deflection of the rim at the cut, at the operating speed.
        force_n : float, optional
            Constant side force, in place of side_force.force_n of the scene; 1 N in a scene without one.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        SizeResults

        Raises
        ------
        InputError
            An argument or a number of the scene is refused.
        AnalysisError
            The saw cannot be analysed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().replace({"accuracy": "draft", "operating_rpm": 1250, "sweep": None})
        >>> found = saw.size({"blade.thickness_m": ("2 mm", "3.2 mm")}, points=3)
        >>> found.windows[0].above is None, round(found.windows[0].from_, 4)
        (True, 0.0027)
        """
        return self._asked(SizeResults, accuracy, tolerance, progress, vary=vary, each=each,
            points=whole("points", points), operating_rpm=operating_rpm, margin=margin,
            min_flutter_rpm=min_flutter_rpm, min_critical_rpm=min_critical_rpm,
            max_rim_m_per_s=max_rim_m_per_s, max_amplitude_m=max_amplitude_m,
            max_deviation_m=max_deviation_m, force_n=force_n)
    # End of what is generated.

    def run_map(
        self,
        x: Along,
        y: Along | None = None,
        *,
        points: SupportsIndex | None = None,
        rpm: Number | None = None,
        to_rpm: Number | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
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
            With a saw for each point; those that cannot be analysed say why.

        Raises
        ------
        InputError
            An axis or another argument is refused.
        """
        from .maps import MapResults, axis
        from .study import Study

        scene = self.with_accuracy(accuracy, tolerance)
        native = _native.Map(
            scene._text,
            axis("x", x),
            None if y is None else axis("y", y),
            points=None if points is None else whole("points", points),
            rpm=optional("rpm", rpm),
            to_rpm=optional("to_rpm", to_rpm),
        )
        study = Study(scene, json.loads(native.study))
        with tempfile.TemporaryDirectory() as temporary:
            place = temporary if folder is None else os.fspath(folder)
            study._compute(place, executor, progress)
            result = MapResults._from_json(native.report(place))
        if folder is not None:
            result.save(os.path.join(place, "map.json"))
        warned(result._warnings())
        return result

    def measured_margin(
        self,
        rpm: npt.ArrayLike,
        peak_hz: npt.ArrayLike,
        free: Mapping[str, tuple[Number, Number]],
        *,
        orders: Sequence[Number] = (1, 2),
        margin: Number = 0.85,
        steps: SupportsIndex = 200,
        seed: SupportsIndex = 0,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
        progress: Progress = None,
    ) -> MeasuredMargin:
        """How fast the saw may turn if its frequencies were measured over the speed, without knowing of which
        modes they are; needs emcee and SciPy. If this takes more than about ten seconds, the logger
        ``sawflutter`` warns first with a rough estimate of the time.

        Each peak is of one of the lowest frequencies, with normal errors of a common unknown deviation, at
        a multiple of the speed, or of nothing. The free numbers are equally probable between their bounds,
        on a logarithmic scale if these are a decade apart. An ensemble sampler, emcee, draws saws from what
        follows for them; 100 of them are analysed fully. The saw idles: its cut is left out.

        Parameters
        ----------
        rpm, peak_hz : array_like
            Speed and frequency of each peak, such as those of :class:`Peaks`, of which up to 12 speeds are used.
        free : mapping
            Path of each number that is not known, with its bounds.
        orders : sequence of float
            Multiples of the speed at which peaks may be.
        margin : float
            Share of the deciding speed at which the saw may run.
        steps : int
            Steps of the ensemble, each with 48 saws.
        seed : int
            Seed of the sampler.
        accuracy, tolerance, progress
            As in :meth:`run_campbell`.

        Returns
        -------
        MeasuredMargin

        Raises
        ------
        ArgumentError
            An argument is refused, such as bounds that are too wide together.
        AnalysisError
            A saw between the bounds cannot be analysed.
        """
        from .margins import measured_margin

        # Peaks over the speed are those of the idle saw.
        saw = self.with_accuracy(accuracy, tolerance).replace({"cut": None})
        with reporting(progress, "saws") as told:
            return measured_margin(
                saw, rpm, peak_hz, free, orders, margin, whole("steps", steps), whole("seed", seed),
                told or (lambda *_: None),
            )  # fmt: skip

    def tradeoff(self, *, progress: Progress = None) -> TradeoffResults:
        """Measures computing time against true error, for bases of several sizes, up to one of some thousand
        functions: of the built-in saw it takes half a minute of processor time and 1 GB of memory.
        ``progress`` is as in :meth:`run_campbell`.

        Returns
        -------
        TradeoffResults

        Raises
        ------
        AnalysisError
            The saw cannot be analysed.
        """
        with reporting(progress, "settings") as told:
            text, _ = _run("tradeoff", self._text, {}, told)
        warned(_native.unusual_numbers(self._text))
        return TradeoffResults(text, self.name)

    def matrices(
        self,
        basis: tuple[SupportsIndex, SupportsIndex] | None = None,
        *,
        beside: Scene | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
    ) -> Matrices:
        """Matrices of the equation of motion, for custom eigenvalue and response computations.

        Parameters
        ----------
        basis : (int, int), optional
            Largest number of nodal diameters, and number of radial functions for each; by default
            as the accuracy requires.
        beside : Scene, optional
            A similar saw whose basis is kept between calls, as in :meth:`speeds`; without ``basis``.
        accuracy, tolerance
            As in :meth:`run_campbell`.

        Returns
        -------
        Matrices
            Each matrix has the shape (functions, functions).

        Raises
        ------
        ArgumentError
            The basis is refused.
        AnalysisError
            No basis has the accuracy.
        """
        if basis is not None and beside is not None:
            raise TypeError("give basis or beside, not both")
        if basis is not None:
            if not isinstance(basis, tuple) or len(basis) != 2:
                said = "two whole numbers, of nodal diameters and of radial functions for each"
                raise refused("basis", basis, said, "write it like (12, 6)")
            basis = (whole("basis", basis[0]), whole("basis", basis[1]))
        warned(_native.unusual_numbers(self._text))
        scene = self.with_accuracy(accuracy, tolerance)._text
        found, diameters, functions = _native.matrices(scene, basis=basis, beside=_beside(beside))
        arrays: dict[str, Any] = {"damping": None, "circulatory": None}
        for name, values in found.items():
            flat = np.frombuffer(values, "<f8")
            arrays[name] = flat.reshape(math.isqrt(flat.size), -1)
        return Matrices(**arrays, max_diameters=diameters, radial_functions=functions, _scene=scene)

    def run_stiffness_map(
        self,
        stiffness_n_per_m: Numbers,
        *,
        guide: SupportsIndex | None = None,
        accuracy: Accuracy | None = None,
        tolerance: Number | None = None,
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
        ArgumentError
            The scene has no guide.
        AnalysisError
            One of the saws cannot be analysed.
        """
        chosen = range(len(self.guides)) if guide is None else [whole("guide", guide)]
        if not chosen:
            raise refused("guides", None, "at least one guide in the scene", "add_guide adds one")
        stiffness = array(np.ravel(numbers("stiffness_n_per_m", stiffness_n_per_m)).tolist())
        saw = self.with_accuracy(accuracy, tolerance)
        plain = {"sensitivity": False, "amplitude": False, "shapes_at_rpm": None}
        reports = []
        with reporting(progress, "saws") as told:
            for done, value in enumerate(stiffness.tolist(), start=1):
                saw = saw.replace({f"guides[{at}].stiffness_n_per_m": value for at in chosen})
                reports.append(CampbellResults._from_json(_run("analyze", saw._text, plain, None)[0]))
                if told is not None:
                    told(done, len(stiffness), "")
        warned(text for report in reports for text in report._warnings())
        critical = array([report.critical_rpm.tolist() for report in reports])
        return StiffnessMap(self.name, stiffness, critical, array([r.flutter_rpm for r in reports]))

    def _asked(
        self, kind: type[R], accuracy: Accuracy | None, tolerance: Number | None, progress: Progress, **options: Any
    ) -> R:
        """The library's report of this scene at another accuracy, with its warnings."""
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, kind._steps) as told:
            report, assumed = _run(kind._command, scene._text, options, told)
        result = kind._from_json(report)
        warned([*([] if assumed is None else [assumed]), *result._warnings()])
        return result

    if not TYPE_CHECKING:

        def __setattr__(self, name: str, value: object) -> None:
            raise AttributeError(_UNCHANGED)

        def __setitem__(self, path: str, value: object) -> None:
            raise TypeError(_UNCHANGED)

    def __eq__(self, other: object) -> bool:
        return self._text == other._text if isinstance(other, Scene) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._text)

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        return type(self)._of, (self._text,)

    def __repr__(self) -> str:
        blade, guides = self.blade, len(self.guides)
        count = f"{guides or 'no'} guide{'' if guides == 1 else 's'}"
        return (
            f"<Scene {self.name!r}: {1e3 * blade['outer_diameter_m']:.6g} mm outside, "
            f"{1e3 * blade['thickness_m']:.6g} mm thick, {count}>"
        )

    def _repr_html_(self) -> str:
        """The blade and what holds it, for a notebook."""
        kinds = ("blade", "mount", "guides", "cut", "side_force", "operating_rpm", "sweep", "accuracy")
        return rows_in_html(self.name, ((key, json.dumps(self._data[key])) for key in kinds if key in self._data))


def keys(words: str = "", *, study: bool = False) -> str:
    """The keys of a scene, or of a `study`, with these `words` in their path or their text, each with its
    unit, default, usual range and meaning, as printed by ``sawflutter keys``; "" if none has them.
    """
    return _native.keys(words, study)


def schema(*, study: bool = False) -> dict[str, Any]:
    """The JSON schema of a scene, or of a study."""
    found: dict[str, Any] = json.loads(_native.schema())["study" if study else "scene"]
    return found


def rows_in_html(title: str, rows: Iterable[tuple[str, object]]) -> str:
    """A table of names and values, for a notebook."""
    cells = "".join(f"<tr><td>{escape(name)}</td><td>{escape(str(value))}</td></tr>" for name, value in rows)
    return f"<p><b>{escape(title)}</b></p><table>{cells}</table>"


def _run(command: str, scene: str, options: dict[str, Any], told: Any) -> tuple[str, str | None]:
    """The report of a command. Where it is refused the unusual numbers of the scene are named first,
    because one of them may be the reason; a report has them among its warnings."""
    try:
        return _native.run(command, scene, options, told)
    except Exception:
        warned(_native.unusual_numbers(scene))
        raise


def _beside(nominal: Scene | None) -> str | None:
    """The text of a saw beside which another one is analysed."""
    return None if nominal is None else _scene("beside", nominal)._text


def _scene(name: str, value: object) -> Scene:
    """An argument that must be a scene."""
    if isinstance(value, Scene):
        return value
    shown = value if isinstance(value, (str, int, float, type(None))) else type(value)
    raise refused(name, shown, "a Scene", "make one: Scene(dict), Scene.load(path)")
