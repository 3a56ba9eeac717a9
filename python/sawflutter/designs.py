"""What a search over many saws finds: fits, places, and what accuracy takes."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._drawn import Drawn
from ._report_types import FitReport, PlaceReport, Setting
from ._result import Result
from ._table import frame

if TYPE_CHECKING:
    import pandas as pd

    from .plot.chart import Chart


class FitResults(Result, FitReport):
    """A saw fitted to measured frequencies: :attr:`saw` is the calibrated one."""

    command = "fit"
    figure_names = ("fit.svg", "fit.png")

    def to_dataframe(self) -> pd.DataFrame:
        """One row a fitted number; needs pandas.

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
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> free = ["guides[0].stiffness_n_per_m"]
        >>> found = saw.fit([7.9, 13.2, 25.9], free=free, starts=1)
        >>> found.to_dataframe()["path"].tolist()
        ['guides[0].stiffness_n_per_m']
        """
        return frame(self.parameters)

    def chart(self) -> Chart:
        """Measured and computed frequencies over speed.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> free = ["guides[0].stiffness_n_per_m"]
        >>> found = saw.fit([7.9, 13.2, 25.9], free=free, starts=1)
        >>> [panel.y_name for panel in found.chart().panels]
        ['frequency [Hz]', 'computed − measured [Hz]']
        """
        from .plot.design import fit

        return fit(self, self._facts())

    def _facts(self) -> str:
        found = ", ".join(f"{found.path} = {found.value:.4g}" for found in self.parameters)
        return f"{found}; {self.rms_hz:.3f} Hz rms, before {self.rms_before_hz:.3f} Hz"


class PlaceResults(Result, PlaceReport):
    """The best place found for the guides: :attr:`saw` is that saw."""

    command = "place"
    figure_names = ("place.svg", "place.png")

    def to_dataframe(self) -> pd.DataFrame:
        """One row a number that was moved; needs pandas.

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
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> free = {"guides[0].radius_m": (0.20, 0.28)}
        >>> found = saw.place(free=free, samples=2, refine=1, map=0)
        >>> found.to_dataframe()["path"].tolist()
        ['guides[0].radius_m']
        """
        return frame(self.parameters)

    def chart(self) -> Chart:
        """The goal over one or two numbers.

        Returns
        -------
        sawflutter.plot.Chart
            Without a panel where no map was asked for.

        Examples
        --------
        >>> import sawflutter as sf
        >>> saw = sf.Scene.paper().with_accuracy("draft")
        >>> free = {"guides[0].radius_m": (0.20, 0.28)}
        >>> found = saw.place(free=free, samples=2, refine=1, map=0)
        >>> found.chart().panels
        ()
        """
        from .plot.design import place

        return place(self, self._facts())

    def _facts(self) -> str:
        found = ", ".join(f"{found.path} = {found.value:.4g}" for found in self.parameters)
        robust = "fragile" if self.fragile else "robust"
        kept = "" if self.kept else ", but the lower limit of the first critical speed is NOT kept"
        goal = f"{self.best.goal_rpm:.0f} rpm, before {self.before.goal_rpm:.0f}"
        worst = f"{1e2 * self.worst_neighbour_share:.0f} % at the worst of its tolerances"
        return f"{found}; {goal}, {robust}: {worst}{kept}"


class TradeoffResults(Drawn):
    """Computing time against true error, for bases of several sizes."""

    def __init__(self, settings: Iterable[Setting], text: str, name: str) -> None:
        self.settings: tuple[Setting, ...] = tuple(settings)
        self.name = name
        self._text = text

    @classmethod
    def from_json(cls, text: str, name: str = "") -> TradeoffResults:
        """The result of a JSON text.

        Parameters
        ----------
        text : str
            As :meth:`save` writes it.
        name : str
            Title of the scene.

        Returns
        -------
        TradeoffResults

        Raises
        ------
        json.JSONDecodeError
            Where the text is no JSON.

        Examples
        --------
        >>> import sawflutter as sf
        >>> sf.TradeoffResults.from_json("[]", "none")
        <TradeoffResults 'none': 0 settings>
        """
        return cls((Setting.from_dict(setting) for setting in json.loads(text)), text, name)

    def recommended(self, error: float) -> Setting | None:
        """The fastest chart within a relative error.

        Parameters
        ----------
        error : float
            Largest true relative error.

        Returns
        -------
        Setting or None
            None where no chart is so accurate.

        Examples
        --------
        >>> import sawflutter as sf
        >>> sf.TradeoffResults.from_json("[]").recommended(1e-3) is None
        True
        """
        charts = [s for s in self.settings if s.speeds > 0 and s.error <= error]
        return min(charts, key=lambda setting: setting.seconds, default=None)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes ``tradeoff.json``.

        Parameters
        ----------
        path : str or path
            The file.

        Raises
        ------
        OSError
            Where it cannot be written.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> import sawflutter as sf
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "tradeoff.json"
        >>> sf.TradeoffResults.from_json("[]").save(path)
        >>> sf.load(path).settings
        ()
        """
        Path(path).write_bytes(self._text.encode())

    def to_dataframe(self) -> pd.DataFrame:
        """One row a setting; needs pandas.

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
        >>> len(sf.TradeoffResults.from_json("[]").to_dataframe())
        0
        """
        return frame(self.settings)

    def chart(self) -> Chart:
        """Error over time.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> sf.TradeoffResults.from_json("[]").chart().panels[0].y_name
        'time [s]'
        """
        from .plot.design import tradeoff

        return tradeoff(self.settings, self.name)

    def __eq__(self, other: object) -> bool:
        return self._text == other._text if isinstance(other, TradeoffResults) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._text)

    def __reduce__(self) -> tuple[Any, tuple[str, str]]:
        return TradeoffResults.from_json, (self._text, self.name)

    def __repr__(self) -> str:
        return f"<TradeoffResults {self.name!r}: {len(self.settings)} settings>"
