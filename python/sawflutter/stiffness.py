"""Critical speeds over the stiffness of the guides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ._drawn import Drawn
from ._entry import Entry, FloatArray

if TYPE_CHECKING:
    from .plot.chart import Chart


@dataclass(frozen=True, eq=False, repr=False)
class StiffnessMap(Drawn, Entry):
    """Critical speeds of a saw over the stiffness of its guides, like the critical speed map of
    rotor dynamics over bearing stiffness. :meth:`sawflutter.Scene.run_stiffness_map` returns
    it."""

    name: str
    """Title of the scene."""

    stiffness_n_per_m: FloatArray
    """Stiffness of each guide that is varied."""

    critical_rpm: FloatArray
    """Critical speeds within the sweep, ascending, a row each; NaN where there are fewer."""

    flutter_rpm: FloatArray
    """Flutter speed of each; NaN where there is none within the sweep."""

    def chart(self) -> Chart:
        """Critical speeds and flutter speed over the stiffness.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> found = sf.Scene.paper().run_stiffness_map([1e4, 1e8], accuracy="draft")
        >>> found.chart().panels[0].x_name
        'stiffness of each guide [N/m]'
        """
        from .plot.design import stiffness

        return stiffness(self)
