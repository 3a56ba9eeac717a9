"""What the blade does over time: in the cut, in a run-up, under a force, and between the teeth."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._extras import extra
from ._report_types import CutReport, DeflectReport, RunUpReport, WashboardReport
from ._result import Result
from ._table import frame

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure
    from typing_extensions import Unpack

    from ._drawn import Look
    from .plot.chart import Chart


class CutResults(Result, CutReport):
    """A saw in the wood, at one or several speeds."""

    command = "cut"
    figure_names = (
        "cut.svg",
        "cut.png",
        "cut-map.svg",
        "cut-map.png",
        "spline-orbit.svg",
        "spline-orbit.png",
    )

    def to_dataframe(self) -> pd.DataFrame:
        """One row a speed, without the histories and maps; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            Where pandas is missing: it says how it is installed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> cut = sf.Scene.paper().run_cut(1800, accuracy="draft")
        >>> cut.to_dataframe()["rpm"].tolist()
        [1800.0]
        """
        return frame(self.runs)

    def chart(self) -> Chart:
        """Deflection at the probe over time, one panel a speed.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> cut = sf.Scene.paper().run_cut(1800, accuracy="draft")
        >>> len(cut.chart().panels) == len(cut.runs)
        True
        """
        from .plot.histories import cut

        return cut(self, self._facts())

    def map_chart(self, run: int = 0) -> Chart:
        """Growth over guide angle and load, of one of the runs.

        Parameters
        ----------
        run : int
            Which of :attr:`runs`, counted from 0.

        Returns
        -------
        sawflutter.plot.Chart

        Raises
        ------
        IndexError
            Where there is no such run.

        Examples
        --------
        >>> import sawflutter as sf
        >>> cut = sf.Scene.paper().run_cut(1800, accuracy="draft")
        >>> cut.map_chart().panels[0].y_name
        'multiple of the forces'
        """
        from .plot.histories import cut_map

        return cut_map(self, run)

    def plot_map(
        self, run: int = 0, fig: Figure | None = None, **look: Unpack[Look]
    ) -> Figure:
        """Draws :meth:`map_chart` with plotly.

        Parameters
        ----------
        run : int
            Which of :attr:`runs`, counted from 0.
        fig : plotly.graph_objects.Figure, optional
            A figure to draw into; by default a new one.
        **look
            Units and harmonics, as in :meth:`plot`.

        Returns
        -------
        plotly.graph_objects.Figure

        Examples
        --------
        >>> import sawflutter as sf
        >>> cut = sf.Scene.paper().run_cut(1800, accuracy="draft")
        >>> cut.plot_map().layout.yaxis.title.text
        'multiple of the forces'
        """
        return self.map_chart(run).plot(fig, **look)

    def _facts(self) -> str:
        verdicts = ", ".join(
            f"{run.verdict.replace('_', ' ')} at {run.rpm:.0f} rpm" for run in self.runs
        )
        stretched = any(run.stretching is not None for run in self.runs)
        return f"{verdicts}, with stretching" if stretched else verdicts


class RunUpResults(Result, RunUpReport):
    """A run-up under a lateral force."""

    command = "runup"
    figure_names = (
        "runup.svg",
        "runup.png",
        "response-map.svg",
        "response-map.png",
        "runup-map.svg",
        "runup-map.png",
    )

    def to_dataframe(self) -> pd.DataFrame:
        """Speed and deflection, one row a sample; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            Where pandas is missing: it says how it is installed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> short = {"runup.to_rpm": 500, "runup.duration_s": 5}
        >>> up = sf.Scene.paper().replace(short).run_up(accuracy="draft")
        >>> list(up.to_dataframe())
        ['rpm', 'deflection_m']
        """
        with extra("pandas"):
            import pandas as pd

        return pd.DataFrame({"rpm": self.rpm, "deflection_m": self.deflection_m})

    def chart(self) -> Chart:
        """Deflection at the probe over speed.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> short = {"runup.to_rpm": 500, "runup.duration_s": 5}
        >>> up = sf.Scene.paper().replace(short).run_up(accuracy="draft")
        >>> up.chart().panels[0].y_name
        'deflection [mm], square root scale'
        """
        from .plot.histories import run_up

        return run_up(self, self._facts())

    def response_chart(self) -> Chart:
        """Deflection per newton over speed and frequency, with the branches on top.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> short = {"runup.to_rpm": 500, "runup.duration_s": 5}
        >>> up = sf.Scene.paper().replace(short).run_up(accuracy="draft")
        >>> up.response_chart().panels[0].y_name
        'frequency of the force [Hz]'
        """
        from .plot.histories import response

        return response(self)

    def plot_response(
        self, fig: Figure | None = None, **look: Unpack[Look]
    ) -> Figure:
        """Draws :meth:`response_chart` with plotly.

        Parameters
        ----------
        fig : plotly.graph_objects.Figure, optional
            A figure to draw into; by default a new one.
        **look
            Units and harmonics, as in :meth:`plot`.

        Returns
        -------
        plotly.graph_objects.Figure

        Examples
        --------
        >>> import sawflutter as sf
        >>> short = {"runup.to_rpm": 500, "runup.duration_s": 5}
        >>> up = sf.Scene.paper().replace(short).run_up(accuracy="draft")
        >>> up.plot_response(harmonics=[1]).layout.xaxis.title.text
        'rotation speed Ω [rpm]'
        """
        return self.response_chart().plot(fig, **look)

    def _facts(self) -> str:
        last = self.rpm[-1]
        crossed = sum(entry.band.from_rpm < last for entry in self.bands)
        doubling = self.first_doubling_rpm
        at = "none" if doubling is None else f"the first at {doubling:.0f} rpm"
        facts = f"{self.rpm[0]:.0f} to {last:.0f} rpm, {crossed} bands crossed"
        if self.linear_until_rpm is not None:
            facts += f", where the linear model ends; asked up to {self.to_rpm:.0f} rpm"
        if self.stretching is not None:
            facts += ", with stretching"
        return f"{facts}; bands that more than double a motion: {at}"


class DeflectResults(Result, DeflectReport):
    """Where the blade stands while its speed slowly rises and falls."""

    command = "deflect"
    figure_names = ("deflect.svg", "deflect.png")

    def to_dataframe(self) -> pd.DataFrame:
        """Stable equilibria, one row each, without the frequencies; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            Where pandas is missing: it says how it is installed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> found = sf.Scene.paper().run_deflect(to_rpm=1000, accuracy="draft")
        >>> sorted(set(found.to_dataframe()["direction"]))
        ['down', 'up']
        """
        with extra("pandas"):
            import pandas as pd

        rows = []
        for direction, sweep in {"up": self.up, "down": self.down}.items():
            for number, arc in enumerate(sweep.arcs):
                table = {
                    "direction": direction,
                    "arc": number,
                    "rpm": arc.rpm,
                    "deflection_m": arc.deflection_m,
                    "largest_deflection_m": arc.largest_deflection_m,
                    "largest_slope": arc.largest_slope,
                }
                rows.append(pd.DataFrame(table))
        return pd.concat(rows, ignore_index=True)

    def chart(self) -> Chart:
        """Deflection at the probe over speed.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> found = sf.Scene.paper().run_deflect(to_rpm=1000, accuracy="draft")
        >>> found.chart().panels[0].y_name
        'deflection [mm]'
        """
        from .plot.histories import deflection

        return deflection(self, self._facts())

    def _facts(self) -> str:
        jumps = f"{len(self.up.jumps)} ends of stable stretches while the speed rises"
        return f"{self.force_n:g} N across the rim, {jumps}, {len(self.down.jumps)} while it falls"


class WashboardResults(Result, WashboardReport):
    """Whether the teeth set the blade swinging, each on the surface left by the one before."""

    command = "washboard"
    figure_names = ("washboard.svg", "washboard.png")

    def to_dataframe(self) -> pd.DataFrame:
        """One row a mode; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            Where pandas is missing: it says how it is installed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> spring = {"stiffness_n_per_m": 1e5, "overlap": 1.0}
        >>> changes = {"cut.washboarding": spring, "damping.air_n_s_per_m3": 50.0}
        >>> saw = sf.Scene.paper().replace(changes)
        >>> found = saw.run_washboard(1000, accuracy="draft")  # doctest: +SKIP
        >>> len(found.to_dataframe()) == len(found.modes)  # doctest: +SKIP
        True
        """
        return frame(self.modes)

    def chart(self) -> Chart:
        """Least cutting stiffness at which a motion grows, and its frequency, over the speed.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> spring = {"stiffness_n_per_m": 1e5, "overlap": 1.0}
        >>> changes = {"cut.washboarding": spring, "damping.air_n_s_per_m3": 50.0}
        >>> saw = sf.Scene.paper().replace(changes)
        >>> found = saw.run_washboard(1000, accuracy="draft")  # doctest: +SKIP
        >>> found.chart().panels[0].y_name  # doctest: +SKIP
        'cutting stiffness [N/m]'
        """
        from .plot.washboard import lobes

        return lobes(self, self._facts())

    def _facts(self) -> str:
        least = self.critical_stiffness_n_per_m
        beyond = f"none up to {self.ceiling_n_per_m:.3g}" if least is None else f"{least:.4g}"
        return f"{self.verdict} at {self.rpm:.0f} rpm, critical cutting stiffness {beyond} N/m"
