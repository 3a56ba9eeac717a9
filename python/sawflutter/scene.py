"""A saw and what to find out about it."""

from __future__ import annotations

import copy
import json
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, cast, overload

import numpy as np
import numpy.typing as npt

from . import _native
from ._entry import FloatArray
from ._progress import Progress, reporting
from ._report_types import Mode
from ._scene_types import Accuracy, SceneDict
from .results import (
    CampbellResults,
    CheckResults,
    CutResults,
    FitResults,
    PlaceResults,
    RunUpResults,
    TradeoffResults,
    WashboardResults,
)

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from plotly.graph_objects import Figure

    from .plot.motion import Animation

# Paths of the scene and their bounds, or paths with the usual bounds.
Free: TypeAlias = "Mapping[str, tuple[float, float] | None] | Iterable[str] | None"
# A file, or rows of a speed in rpm and frequencies in Hz.
Measured: TypeAlias = "str | os.PathLike[str] | npt.NDArray[np.float64] | Iterable[tuple[float, Sequence[float]]] | None"


@dataclass(frozen=True)
class Matrices:
    """Matrices of the equation of motion, each of the shape (functions, functions).

    q'' + (2 Ω G + C) q' + (K + Ω² S + Ω N) q = 0, Ω in rad/s; the mass matrix is one. Unknowns are,
    for no nodal diameters, the radial functions times 1; for each further number n of them, first
    times cos nθ, then times sin nθ.
    """

    stiffness: FloatArray
    """K in 1/s²: bending, guides, membrane stress that does not depend on speed."""

    spin: FloatArray
    """S: centrifugal stress less the convective part."""

    gyroscopic: FloatArray
    """G, skew."""

    damping: FloatArray | None
    """C in 1/s; None without damping."""

    circulatory: FloatArray | None
    """N in 1/s; None without material damping."""

    max_diameters: int
    """Largest number of nodal diameters."""

    radial_functions: int
    """Radial functions of each."""

    @property
    def mass(self) -> FloatArray:
        """M, one."""
        return np.eye(len(self.stiffness))

    def companion(self, rpm: float) -> FloatArray:
        """Matrix of x' = A x with x = (q, q') at a speed: its eigenvalues are those of the saw, in
        1/s.

        Examples
        --------
        >>> import numpy as np
        >>> import sawflutter as sf
        >>> eigenvalues = np.linalg.eigvals(sf.Scene.paper().matrices(basis=(8, 5)).companion(0.0))
        >>> lowest_hz = np.sort(abs(eigenvalues.imag))[0] / (2 * np.pi)
        >>> round(float(lowest_hz), 1)
        7.8
        """
        speed = rpm * np.pi / 30.0
        size = len(self.stiffness)
        velocity = 2.0 * speed * self.gyroscopic
        position = self.stiffness + speed**2 * self.spin
        if self.damping is not None:
            velocity = velocity + self.damping
        if self.circulatory is not None:
            position = position + speed * self.circulatory
        return np.block([[np.zeros((size, size)), np.eye(size)], [-position, -velocity]])


class Scene:
    """A saw: blade, mount, guides and what to find out about it. It cannot be changed;
    :meth:`replace` makes another one.

    Parameters
    ----------
    data : dict
        The scene as in a scene file, see ``sawflutter schema`` or :data:`sawflutter.SceneDict`.

    Raises
    ------
    SceneError
        Where the scene is none; the error names the key, what is allowed, and what to do.

    Examples
    --------
    >>> import sawflutter as sf
    >>> saw = sf.Scene.paper()
    >>> saw["blade.thickness_m"]
    0.0028
    >>> thin = saw.replace({"blade.thickness_m": 2.6e-3, "guides[0].radius_m": 0.22})
    >>> thin
    <Scene 'Guided spline arbor saw': 710 mm outside, 2.6 mm thick, 1 guide>
    """

    __slots__ = ("_text",)
    _text: str

    def __init__(self, data: SceneDict | Mapping[str, Any]) -> None:
        object.__setattr__(self, "_text", _native.scene(_json(data)))

    @classmethod
    def from_json(cls, text: str) -> Scene:
        """The scene of a JSON text."""
        scene = cls.__new__(cls)
        object.__setattr__(scene, "_text", _native.scene(text))
        return scene

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Reads a scene file.

        Raises
        ------
        SceneError
            Where the scene is refused.
        OSError
            Where the file cannot be read.
        """
        scene = cls.__new__(cls)
        object.__setattr__(scene, "_text", _native.read_scene(path))
        return scene

    @classmethod
    def paper(cls) -> Scene:
        """The guided spline saw that comes with the program, with the numbers of a paper."""
        return cls.from_json(_native.paper())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a scene file."""
        text = json.dumps(self.to_dict(), indent=2, ensure_ascii=False)
        Path(path).write_text(text + "\n", encoding="utf-8")

    def to_dict(self) -> SceneDict:
        """The scene as a dict of its own, to be changed and made a scene of again."""
        return cast(SceneDict, json.loads(self._text))

    def to_json(self) -> str:
        """The scene as one line of JSON."""
        return self._text

    @property
    def name(self) -> str:
        """Title of reports and figures."""
        return self.to_dict()["name"]

    def __getitem__(self, path: str) -> Any:
        """The value at a path, like ``saw["guides[0].radius_m"]``."""
        value: Any = self.to_dict()
        for step in _steps(path):
            try:
                value = value[step]
            except (KeyError, IndexError, TypeError):
                raise KeyError(path) from None
        return value

    def replace(self, changes: Mapping[str, Any]) -> Scene:
        """The scene with other values, by their paths.

        Parameters
        ----------
        changes : dict
            New values by path, like ``"guides[0].radius_m"``. None takes a key out; a block that
            is not there, like ``damping`` in ``"damping.air_n_s_per_m3"``, is begun.

        Examples
        --------
        >>> import sawflutter as sf
        >>> free = sf.Scene.paper().replace({"guides": []})
        >>> round(float(free.run_campbell().critical_rpm[0]))
        1477
        """
        data = copy.deepcopy(dict(self.to_dict()))
        for path, value in changes.items():
            _put(data, path, value)
        return Scene(data)

    def with_accuracy(
        self, accuracy: Accuracy | None = None, tolerance: float | None = None
    ) -> Scene:
        """The scene with another accuracy, by name or as a relative error."""
        if accuracy is not None and tolerance is not None:
            raise TypeError("give accuracy or tolerance, not both")
        if accuracy is not None:
            return self.replace({"accuracy": accuracy, "tolerance": None})
        if tolerance is not None:
            return self.replace({"tolerance": tolerance})
        return self

    def run_campbell(
        self,
        *,
        accuracy: Accuracy | None = None,
        tolerance: float | None = None,
        sensitivity: bool = False,
        progress: Progress = None,
    ) -> CampbellResults:
        """Charts the saw: modes, critical speeds, bands of instability, certificate.

        Parameters
        ----------
        accuracy : {"draft", "design", "reference"}, optional
            Instead of the scene's.
        tolerance : float, optional
            Relative error allowed of critical speeds and onsets, instead of a name.
        sensitivity : bool
            Also how critical speeds and onsets move with the numbers of the scene.
        progress : bool or callable, optional
            True shows a bar, a callable is called with what is done and of how many.

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
        with reporting(progress, "speeds") as told:
            text = _native.analyze(scene._text, sensitivity=sensitivity, progress=told)
        return CampbellResults.from_json(text)

    def modes(self, rpm: float) -> tuple[Mode, ...]:
        """Modes at a speed within the sweep, ascending by frequency, with their shapes.

        Examples
        --------
        >>> import sawflutter as sf
        >>> modes = sf.Scene.paper().replace({"accuracy": "draft"}).modes(rpm=0)
        >>> f"{modes[0].frequency_hz:.1f} Hz"
        '7.7 Hz'
        """
        found = json.loads(_native.modes(self._text, float(rpm)))
        return tuple(Mode.from_dict(mode) for mode in found)

    def check(
        self,
        *,
        operating_rpm: float | None = None,
        margin: float = 0.85,
        min_flutter_rpm: float | None = None,
        min_critical_rpm: float | None = None,
        max_rim_m_per_s: float = 100.0,
        accept_unusual: bool = False,
        accuracy: Accuracy | None = None,
        tolerance: float | None = None,
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
        accept_unusual : bool
            Whether a saw may pass that has numbers no saw has.

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
            accept_unusual=accept_unusual,
        )
        return CheckResults.from_json(text)

    def run_cut(
        self,
        rpm: float | Sequence[float] = (),
        *,
        accuracy: Accuracy | None = None,
        tolerance: float | None = None,
        progress: Progress = None,
    ) -> CutResults:
        """Cuts wood: eigenvalues and a time history, with the forces of the scene's ``cut``.

        Parameters
        ----------
        rpm : float or list of float, optional
            Speeds to cut at, in place of the scene's.
        """
        speeds = [float(speed) for speed in np.atleast_1d(np.asarray(rpm, float))]
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, "points of the map") as told:
            text = _native.cut(scene._text, speeds, progress=told)
        return CutResults.from_json(text)

    def run_up(
        self,
        *,
        accuracy: Accuracy | None = None,
        tolerance: float | None = None,
        progress: Progress = None,
    ) -> RunUpResults:
        """Runs the saw up under a lateral force, both the scene's ``runup``."""
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, "steps") as told:
            text = _native.runup(scene._text, progress=told)
        return RunUpResults.from_json(text)

    def run_washboard(
        self,
        rpm: float | None = None,
        *,
        accuracy: Accuracy | None = None,
        tolerance: float | None = None,
        progress: Progress = None,
    ) -> WashboardResults:
        """Whether the teeth set the blade swinging, with the force that the scene's
        ``cut.washboarding`` names.

        Parameters
        ----------
        rpm : float, optional
            Speed to cut at; the scene's operating speed by default.
        """
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, "speeds") as told:
            text = _native.washboard(scene._text, rpm, progress=told)
        return WashboardResults.from_json(text)

    def fit(
        self,
        measured: Measured = None,
        *,
        free: Free = None,
        to_rpm: float | None = None,
        confidence: float = 0.95,
        starts: int = 12,
        seed: int = 0,
        accuracy: Accuracy | None = None,
        tolerance: float | None = None,
        progress: Progress = None,
    ) -> FitResults:
        """Fits guides, density or other numbers of the scene to measured frequencies.

        Parameters
        ----------
        measured : path or rows, optional
            A table of speeds in rpm and frequencies in Hz, ascending, blank where a mode was not
            seen; or the same as rows ``(rpm, [hz, hz, ...])`` or an array, with NaN for a blank.
            The scene's own without it.
        free : dict or list of str, optional
            Paths of the numbers to fit, with their bounds ``(from, to)`` or None for the usual
            ones. By default radius and stiffness of every guide, and angles between several.
        to_rpm : float, optional
            Leaves out measurements above this speed.
        confidence : float
            Probability with which the intervals cover the truth.
        starts, seed : int
            Number of starts, and which ones.
        """
        scene = self.with_accuracy(accuracy, tolerance)
        with reporting(progress, "starts") as told:
            text = _native.fit(
                scene._text,
                _table(measured),
                _bounds(free),
                to_rpm=to_rpm,
                confidence=confidence,
                starts=starts,
                seed=seed,
                progress=told,
            )
        return FitResults.from_json(text)

    def place(
        self,
        *,
        free: Free = None,
        goal: Literal["flutter", "window"] = "flutter",
        min_critical_rpm: float | None = None,
        samples: int = 64,
        refine: int = 60,
        map: int = 17,
        accuracy: Accuracy | None = None,
        tolerance: float | None = None,
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
                progress=told,
            )
        return PlaceResults.from_json(text)

    def tradeoff(self, *, progress: Progress = None) -> TradeoffResults:
        """Measures computing time against true error, for bases of several sizes."""
        with reporting(progress, "settings") as told:
            text = _native.tradeoff(self._text, progress=told)
        return TradeoffResults.from_json(text, self.name)

    def matrices(
        self,
        basis: tuple[int, int] | None = None,
        *,
        accuracy: Accuracy | None = None,
        tolerance: float | None = None,
    ) -> Matrices:
        """Matrices of the equation of motion, for eigenvalues of one's own.

        Parameters
        ----------
        basis : (int, int), optional
            Largest number of nodal diameters, and radial functions of each; by default what the
            accuracy takes.
        """
        scene = self.with_accuracy(accuracy, tolerance)
        found, diameters, functions = _native.matrices(scene._text, basis=basis)
        size = functions * (2 * diameters + 1)

        def array(name: str) -> FloatArray | None:
            if name not in found:
                return None
            return np.frombuffer(found[name], "<f8").reshape(size, size)

        stiffness, spin, gyroscopic = (array(n) for n in ("stiffness", "spin", "gyroscopic"))
        assert stiffness is not None and spin is not None and gyroscopic is not None
        damping, circulatory = array("damping"), array("circulatory")
        return Matrices(stiffness, spin, gyroscopic, damping, circulatory, diameters, functions)

    @overload
    def animate(
        self, mode: Mode, *, backend: Literal["plotly"] = "plotly", frames: int = 48
    ) -> Figure: ...
    @overload
    def animate(
        self, mode: Mode, *, backend: Literal["matplotlib"], frames: int = 48
    ) -> FuncAnimation: ...
    def animate(
        self, mode: Mode, *, backend: Literal["plotly", "matplotlib"] = "plotly", frames: int = 48
    ) -> Animation:
        """Sets a mode in motion on the blade, seen from space.

        Parameters
        ----------
        mode : Mode
            One of :meth:`modes`.
        backend : {"plotly", "matplotlib"}
            A plotly Figure with frames and a button, or a matplotlib FuncAnimation.
        frames : int
            Pictures a period.
        """
        from .plot.motion import animate

        return animate(self, mode, backend=backend, frames=frames)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("a scene cannot be changed; replace makes another one")

    def __eq__(self, other: object) -> bool:
        return self._text == other._text if isinstance(other, Scene) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._text)

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        return Scene.from_json, (self._text,)

    def __repr__(self) -> str:
        data = self.to_dict()
        blade, guides = data["blade"], data.get("guides", [])
        count = f"{len(guides) or 'no'} guide{'' if len(guides) == 1 else 's'}"
        return (
            f"<Scene {data['name']!r}: {1e3 * blade['outer_diameter_m']:.6g} mm outside, "
            f"{1e3 * blade['thickness_m']:.6g} mm thick, {count}>"
        )


def _json(data: Any) -> str:
    """JSON of plain and of NumPy's numbers."""

    def plain(value: Any) -> Any:
        if isinstance(value, (np.generic, np.ndarray)):
            return value.tolist()
        if isinstance(value, Mapping):
            return dict(value)
        raise TypeError(f"{value!r} is no value of a scene: {type(value).__name__}")

    return json.dumps(data if isinstance(data, dict) else dict(data), default=plain)


def _steps(path: str) -> list[str | int]:
    """Steps of a path: ``guides[0].radius_m`` is guides, 0, radius_m."""
    steps: list[str | int] = []
    for name, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", path):
        steps.append(name if name else int(index))
    if not steps:
        raise KeyError(path)
    return steps


def _put(data: dict[str, Any], path: str, value: Any) -> None:
    """Puts a value at a path, or takes it out where it is None."""
    *before, last = _steps(path)
    place: Any = data
    for step in before:
        if isinstance(place, dict) and isinstance(step, str):
            place = place.setdefault(step, {})
        else:
            place = _item(place, step, path)
    if value is None and isinstance(place, dict):
        place.pop(last, None)
        return
    _item(place, last, path, here=isinstance(place, list))
    place[last] = value


def _item(place: Any, step: str | int, path: str, here: bool = True) -> Any:
    """An entry of a list; KeyError of the whole path where there is none."""
    fits = isinstance(place, list) == isinstance(step, int) and isinstance(place, (list, dict))
    if not fits or (isinstance(place, list) and isinstance(step, int) and step >= len(place)):
        raise KeyError(path)
    return place[step] if here else None


def _bounds(free: Free) -> list[tuple[str, tuple[float, float] | None]]:
    if free is None:
        return []
    if isinstance(free, str):
        return [(free, None)]
    if isinstance(free, Mapping):
        return [
            (path, None if b is None else (float(b[0]), float(b[1]))) for path, b in free.items()
        ]
    return [(path, None) for path in free]


def _table(measured: Measured) -> tuple[str, str] | None:
    """Name and text of a table of frequencies."""
    if measured is None:
        return None
    if isinstance(measured, (str, os.PathLike)):
        return Path(measured).name, _native.read_text(measured, True)
    if isinstance(measured, np.ndarray):
        measured = [(row[0], row[1:]) for row in measured]
    rows = []
    for rpm, frequencies in measured:
        cells: npt.NDArray[np.float64] = np.asarray(frequencies, float)
        blank = ["" if np.isnan(hz) else repr(float(hz)) for hz in cells]
        rows.append(",".join([repr(float(rpm)), *blank]))
    width = max((row.count(",") for row in rows), default=0)
    header = ",".join(["rpm", *(f"mode {k + 1} [Hz]" for k in range(width))])
    lines = [header, *(row + "," * (width - row.count(",")) for row in rows)]
    return "measured", "\n".join(lines) + "\n"
