"""Pictures of a saw and of its modes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, cast, overload

from ._report_types import Mode

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes
    from plotly.graph_objects import Figure

    from .plot.chart import Chart
    from .plot.motion import Animation
    from .scene import Scene


class Pictures:
    """The methods of a scene that draw it."""

    __slots__ = ()

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

        return saw(cast("Scene", self))

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

        return animate(cast("Scene", self), mode, backend=backend, frames=frames)
