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
    """The arguments of all figures, for either library; see :meth:`Drawn.plot`."""

    speed_units: Units
    frequency_units: Units
    harmonics: Iterable[Number]


class Drawn:
    """Base of objects with a chart."""

    __slots__ = ()

    def chart(self) -> Chart:
        """Contents of the figure as lines, points and bands."""
        from .plot.described import read

        return read(self._drawing())

    def _drawing(self) -> str:
        """The chart as the program describes it, in JSON."""
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
        """Draws the chart with matplotlib as :meth:`plot` does with plotly, and gives the axes of its first
        panel. ``ax`` are axes to draw the first panel into, or axes for several panels."""
        from .plot import with_matplotlib
        from .plot.look import looking

        return with_matplotlib.draw(looking(self.chart(), "plot_matplotlib", **look), ax)
