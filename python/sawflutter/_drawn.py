"""Methods of results that draw with plotly or matplotlib."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Literal, TypeAlias, TypedDict

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from plotly.graph_objects import Figure
    from typing_extensions import Unpack

    from ._values import Number
    from .plot.chart import Chart

Units: TypeAlias = Literal["rpm", "Hz", "rad/s"]


class Look(TypedDict, total=False):
    """The arguments of all figures, for either library."""

    speed_units: Units
    """Units of rotation speeds; rpm by default."""

    frequency_units: Units
    """Units of frequencies; Hz by default."""

    harmonics: Iterable[Number]
    """Multiples of the rotation speed that are drawn as lines over the frequencies."""


class Drawn:
    """Base of objects with a chart."""

    __slots__ = ()

    def chart(self) -> Chart:
        """Contents of the figure as lines, points and bands."""
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
        """
        from .plot import with_plotly
        from .plot.look import looking

        return with_plotly.draw(looking(self.chart(), "plot", **look), fig)

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
        """
        from .plot import with_matplotlib
        from .plot.look import looking

        return with_matplotlib.draw(looking(self.chart(), "plot_matplotlib", **look), ax)
