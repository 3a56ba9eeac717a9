"""Methods of results that draw with plotly or matplotlib."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Literal, SupportsFloat, TypeAlias, TypedDict

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from plotly.graph_objects import Figure
    from typing_extensions import Unpack

    from .plot.chart import Chart

Units: TypeAlias = Literal["rpm", "Hz", "rad/s"]


class Look(TypedDict, total=False):
    """The arguments of all figures, for either library."""

    speed_units: Units
    """Units of rotation speeds; rpm by default."""

    frequency_units: Units
    """Units of frequencies; Hz by default."""

    harmonics: Iterable[SupportsFloat]
    """Multiples of the rotation speed that are drawn as lines over the frequencies."""


class Drawn:
    """Base of objects with a chart."""

    __slots__ = ()

    def chart(self) -> Chart:
        """Contents of the figures as lines, points and bands. A Campbell diagram shows frequencies
        over speed with growth rates below; a check the required and the computed speeds; a cut the
        deflection at the probe over time, in one panel for each speed; a run-up and a slow sweep
        this deflection over speed; a washboard the lowest cutting stiffness at which a motion
        grows, and its frequency, over speed; a fit measured and computed frequencies; a place the
        goal over one or two numbers; a study the shares of saws below a speed and of saws that can
        run at a speed; a tradeoff errors over time; a stiffness map speeds over the stiffness.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> chart = sf.Scene.paper().run_campbell(accuracy="draft").chart()
        >>> [panel.y_name for panel in chart.panels]
        ['Im λ / 2π [Hz]', 'Re λ [1/s], square root scale']
        """
        return self._chart()

    def _chart(self) -> Chart:
        raise NotImplementedError

    def plot(self, fig: Figure | None = None, **look: Unpack[Look]) -> Figure:
        """Draws the chart with plotly.

        Parameters
        ----------
        fig : plotly.graph_objects.Figure, optional
            Figure to draw into, with its title and size unchanged. All panels are drawn if
            ``make_subplots`` gave it as many rows, otherwise only the first. By default a new
            figure.
        speed_units, frequency_units : {"rpm", "Hz", "rad/s"}, optional
            Units of rotation speed axes, by default rpm, and of frequency axes, by default Hz.
            Text in the figure keeps its units.
        harmonics : iterable of float, optional
            Multiples of the rotation speed that are drawn as lines over the frequencies, in
            addition to those of the scene's ``excitation``.

        Returns
        -------
        plotly.graph_objects.Figure

        Raises
        ------
        ImportError
            If plotly is missing; the message says how to install it.
        ValueError
            If a unit is not one of these, or if harmonics are requested for a figure that does not
            show frequencies over rotation speed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> figure = r.plot(speed_units="rad/s", harmonics=[1, 2])
        >>> figure.layout.xaxis2.title.text
        'rotation speed Ω [rad/s]'
        """
        from .plot import with_plotly
        from .plot.look import looking

        return with_plotly.draw(looking(self.chart(), **look), fig)

    def plot_matplotlib(
        self, ax: Axes | Sequence[Axes] | None = None, **look: Unpack[Look]
    ) -> Axes:
        """Draws the chart with matplotlib.

        Parameters
        ----------
        ax : Axes or sequence of Axes, optional
            Axes to draw the first panel into, or axes for several panels. By default a new figure
            with all panels.
        speed_units, frequency_units, harmonics : optional
            As in :meth:`plot`.

        Returns
        -------
        matplotlib.axes.Axes
            Axes of the first panel.

        Raises
        ------
        ImportError
            If matplotlib is missing; the message says how to install it.
        ValueError
            As in :meth:`plot`.

        Examples
        --------
        >>> import sawflutter as sf
        >>> check = sf.Scene.paper().check(operating_rpm=1250, accuracy="draft")
        >>> check.plot_matplotlib(speed_units="Hz").figure.axes[-1].get_xlabel()
        'rotation speed Ω [Hz]'
        """
        from .plot import with_matplotlib
        from .plot.look import looking

        return with_matplotlib.draw(looking(self.chart(), **look), ax)
