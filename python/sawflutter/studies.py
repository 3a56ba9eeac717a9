"""Results of a study of many saws."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _native
from ._extras import csv_frame, extra
from ._report_types import StudyReport
from ._result import Result
from ._saving import Contents
from .plot.chart import Chart
from .plot.described import read

if TYPE_CHECKING:
    import pandas as pd


class StudyResults(Result, StudyReport):
    """Summary of many saws; :meth:`sawflutter.Study.run` returns it."""

    _command = "study"

    # ``study.csv``: where it is, or what is in it.
    _table: Path | str | None = None

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file as :meth:`Result.save` does, and beside .json the table of its saws as .csv.

        Raises
        ------
        ArgumentError
            As in :meth:`Result.save`.
        """
        super().save(path)
        table, beside = self._csv(), Path(path).with_suffix(".csv")
        if Path(path).suffix.lower() == ".json" and table is not None and self._table != beside.absolute():
            beside.write_bytes(table.encode())

    def _contents(self, name: str) -> Contents:
        return {**super()._contents(name), ".csv": lambda: self._known_csv().encode()}

    def to_dataframe(self) -> pd.DataFrame:
        """One row for each saw, from the table beside the report; needs pandas."""
        return csv_frame(self._known_csv())

    def _known_csv(self) -> str:
        table = self._csv()
        if table is None:
            raise FileNotFoundError(
                "the table of the saws is study.csv beside the report: load it there"
            )
        return table

    def _csv(self) -> str | None:
        if isinstance(self._table, Path):
            return self._table.read_bytes().decode() if self._table.exists() else None
        return self._table

    @staticmethod
    def _with_table(text: str, table: str | None) -> StudyResults:
        result = StudyResults._from_json(text)
        object.__setattr__(result, "_table", table)
        return result

    def __reduce__(self) -> tuple[Any, ...]:
        return StudyResults._with_table, (self._text, self._csv())

    def sensitivity(self, *, confidence: float = 0.95, seed: int = 0) -> pd.DataFrame:
        """First-order Sobol' indices: the share of the variance of a speed that each number causes
        by itself. If their sum is below 1, the rest is due to interactions. Needs SALib, which
        estimates them by RBD-FAST from the saws of the study (Tarantola, Gatelli and Mara,
        Reliability Engineering and System Safety 91 (2006), 717).

        The table has a row for each number, with the columns ``first_critical``, ``flutter``, and
        their half-widths ``first_critical_confidence``, ``flutter_confidence`` at a level of
        ``confidence``, from saws that are resampled with a ``seed``. A column is NaN if all saws have
        the same speed. A saw without such a speed counts with the last speed of its sweep; saws
        without an analysis are left out.
        """
        with extra("sensitivity"):
            import pandas as pd
            from SALib.analyze import rbd_fast

        table = self.to_dataframe()
        table = table[table["status"] == "analysed"]
        names = [parameter["path"] for parameter in self.study["parameters"]]
        numbers = table[names].to_numpy(dtype=float)
        # Ranks: an index depends on the order of the saws by each number, not on its distribution.
        bounds = [[low, high] for low, high in zip(numbers.min(axis=0), numbers.max(axis=0))]
        problem = {"num_vars": len(names), "names": names, "bounds": bounds}
        columns: dict[str, Any] = {}
        for key, column in (("first_critical", "first_critical_rpm"), ("flutter", "flutter_rpm")):
            speeds = table[column].astype(float).fillna(self.swept_to_rpm).to_numpy()
            columns[key] = columns[f"{key}_confidence"] = np.full(len(names), np.nan)
            if len(speeds) > 1 and np.ptp(speeds) > 0.0:
                found = rbd_fast.analyze(problem, numbers, speeds, conf_level=confidence, seed=seed)
                columns[key] = np.array(found["S1"])
                columns[f"{key}_confidence"] = np.array(found["S1_conf"])
        return pd.DataFrame(columns, index=pd.Index(names, name="number"))

    def map_chart(
        self, speed: Literal["first_critical_rpm", "flutter_rpm"] = "flutter_rpm"
    ) -> Chart:
        """A ``speed`` over the two numbers of a grid, as a heat map of the median where a point of the
        grid has several random saws; needs pandas."""
        paths = [
            parameter["path"]
            for parameter in self.study["parameters"]
            if parameter["distribution"]["kind"] == "grid"
        ]
        if len(paths) != 2:
            raise ValueError(f"a map needs a grid of two numbers, and this study has {len(paths)}")
        rows = self.to_dataframe()[[*paths, speed]].to_numpy(dtype=float).tolist()
        return read(_native.grid_chart(self.study["name"], paths, speed, rows))

    def _warnings(self) -> tuple[str, ...]:
        lost = ((self.all.refused, "refused"), (self.all.failed, "failed"))
        said = (f"{count} of {self.all.saws} saws {word}; the table says why" for count, word in lost if count)
        return (*super()._warnings(), *said)
