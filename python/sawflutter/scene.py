"""Scene: a saw and its computations."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Literal, cast, overload

from . import _native
from ._questions import Questions
from ._report_types import Mode
from ._scene_types import SceneDict

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes
    from plotly.graph_objects import Figure
    from typing_extensions import Self

    from .plot.chart import Chart
    from .plot.motion import Animation


class Scene(Questions):
    """A saw (blade, mount, guides) with the conditions to compute. It is a mapping of the keys of
    a scene file and accepts paths too. It is read-only; :meth:`replace` returns a changed copy.

    Parameters
    ----------
    data : dict
        The scene as in a scene file, see :data:`sawflutter.SceneDict`; NumPy numbers and pint
        quantities are accepted.

    Raises
    ------
    SceneError
        If the scene is invalid; the error gives the key, the allowed values and advice.

    Examples
    --------
    >>> import sawflutter as sf
    >>> saw = sf.Scene.paper()
    >>> saw["blade.thickness_m"], saw.blade["thickness_m"], "damping" in saw
    (0.0028, 0.0028, False)
    >>> thin = saw.replace({"blade.thickness_m": 2.6e-3, "guides[0].radius_m": 0.22})
    >>> thin
    <Scene 'Guided spline arbor saw': 710 mm outside, 2.6 mm thick, 1 guide>
    """

    __slots__ = ()

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Reads a scene from JSON.

        Parameters
        ----------
        text : str
            The JSON text.

        Returns
        -------
        Scene

        Raises
        ------
        SceneError
            If the scene is refused.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> sf.Scene.from_json(saw.to_json()) == saw
        True
        """
        return cls._of(_native.scene(text))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Reads a scene file.

        Parameters
        ----------
        path : str or path
            The file.

        Returns
        -------
        Scene

        Raises
        ------
        SceneError
            If the scene is refused.
        OSError
            If the file cannot be read.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "saw.json"
        >>> saw.save(path)
        >>> sf.Scene.load(path) == saw
        True
        """
        return cls._of(_native.read_scene(path))

    @classmethod
    def paper(cls) -> Self:
        """The built-in guided spline saw, with the numbers of a paper.

        Returns
        -------
        Scene

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> saw.name
        'Guided spline arbor saw'
        """
        return cls._of(_native.paper())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a scene file.

        Parameters
        ----------
        path : str or path
            The file.

        Raises
        ------
        OSError
            If the file cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "saw.json"
        >>> saw.save(path)
        >>> sf.Scene.load(path) == saw
        True
        """
        text = json.dumps(self.to_dict(), indent=2, ensure_ascii=False)
        Path(path).write_text(text + "\n", encoding="utf-8")

    def to_dict(self) -> SceneDict:
        """A copy of the scene as a dict, which can be changed and converted to a scene again.

        Returns
        -------
        dict

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> data = saw.to_dict()
        >>> data["name"] = "Mine"
        >>> sf.Scene(data).name
        'Mine'
        """
        return cast(SceneDict, json.loads(self._text))

    def to_json(self) -> str:
        """The scene as one line of JSON.

        Returns
        -------
        str

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper()
        >>> sf.Scene.from_json(saw.to_json()) == saw
        True
        """
        return self._text

    def plot_saw(self, fig: Figure | None = None) -> Figure:
        """Draws the saw in axial view with plotly: blade, guides, cut, probe, and the positive
        directions of rotation and angles.

        Parameters
        ----------
        fig : plotly.graph_objects.Figure, optional
            A figure to draw into; by default a new one.

        Returns
        -------
        plotly.graph_objects.Figure

        Examples
        --------
        >>> import sawflutter as sf
        >>> figure = sf.Scene.paper().plot_saw()
        >>> [trace.name for trace in figure.data][:3]
        ['rim', 'bore', 'guides[0]']
        """
        return self.chart().plot(fig)

    def plot_saw_matplotlib(self, ax: Axes | None = None) -> Axes:
        """Draws the same as :meth:`plot_saw` with matplotlib.

        Parameters
        ----------
        ax : Axes, optional
            Axes to draw into; by default those of a new figure.

        Returns
        -------
        matplotlib.axes.Axes

        Examples
        --------
        >>> import sawflutter as sf
        >>> sf.Scene.paper().plot_saw_matplotlib().get_ylabel()
        'y [m]'
        """
        return self.chart().plot_matplotlib(ax)

    def chart(self) -> Chart:
        """Contents of :meth:`plot_saw` as numbers.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> len(sf.Scene.paper().chart().panels)
        1
        """
        from .plot.saw import saw

        return saw(self)

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
        """Animates a mode of the blade in the fixed frame.

        Parameters
        ----------
        mode : Mode
            One of :meth:`modes`.
        backend : {"plotly", "matplotlib"}
            A plotly Figure with frames and a button, or a matplotlib FuncAnimation.
        frames : int
            Number of frames in a period.

        Returns
        -------
        plotly.graph_objects.Figure or matplotlib.animation.FuncAnimation

        Raises
        ------
        ValueError
            If the backend is unknown or the number of frames is not positive.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> len(saw.animate(saw.modes(1800)[0], frames=12).frames)
        12
        """
        from .plot.motion import animate

        return animate(self, mode, backend=backend, frames=frames)
