"""What can be drawn, with plotly or matplotlib."""

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
    """The arguments that all figures have, whatever draws them."""

    speed_units: Units
    """Units of rotation speeds; rpm by default."""

    frequency_units: Units
    """Units of frequencies; Hz by default."""

    harmonics: Iterable[SupportsFloat]
    """Multiples of the rotation speed that are drawn as lines over the frequencies."""


class Drawn:
    """Base of what has a chart."""

    __slots__ = ()

    def chart(self) -> Chart:
        """What the figures show: lines, points and bands as numbers.

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
        raise NotImplementedError

    def plot(self, fig: Figure | None = None, **look: Unpack[Look]) -> Figure:
        """Draws the chart with plotly.

        Parameters
        ----------
        fig : plotly.graph_objects.Figure, optional
            A figure to draw into, whose title and size stay as they are: all panels where
            ``make_subplots`` has given it as many rows, else the first one. By default a new figure.
        speed_units, frequency_units : {"rpm", "Hz", "rad/s"}, optional
            Units of the axes with rotation speeds, by default rpm, and of those with frequencies,
            by default Hz. Words in the figure keep the units that they name.
        harmonics : iterable of float, optional
            Multiples of the rotation speed that are drawn as lines over the frequencies, in
            addition to those of the scene's ``excitation``.

        Returns
        -------
        plotly.graph_objects.Figure

        Raises
        ------
        ImportError
            Where plotly is missing: it says how it is installed.
        ValueError
            Where units are none of these, or where harmonics are asked for and the figure does not
            show frequencies over the rotation speed.

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
            Those of the first panel.

        Raises
        ------
        ImportError
            Where matplotlib is missing: it says how it is installed.
        ValueError
            As in :meth:`plot`.

        Examples
        --------
        >>> import sawflutter as sf
        >>> check = sf.Scene.paper().check(operating_rpm=1250, accuracy="draft")
        >>> check.plot_matplotlib(speed_units="Hz").get_xlabel()
        'rotation speed [Hz]'
        """
        from .plot import with_matplotlib
        from .plot.look import looking

        return with_matplotlib.draw(looking(self.chart(), **look), ax)
