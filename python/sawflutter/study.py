"""Studies of many saws: manufacturing tolerances and design grids."""

from __future__ import annotations

import json
import os
import sys
import tempfile
from collections.abc import Iterable, Mapping
from concurrent.futures import Executor
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from . import _native, _tasks
from ._entry import FloatArray
from ._progress import Progress, reporting
from ._scene_types import StudyDict
from ._values import whole
from .errors import warned
from .results import load
from .scene import Scene, _scene, rows_in_html
from .studies import StudyResults

if TYPE_CHECKING:
    from distributed import Client


class Study:
    """A scene with varied numbers.

    Parameters
    ----------
    scene : Scene
        The nominal saw.
    study : dict or path
        Varied numbers, their distributions or grids, and limits for the saws, see
        :data:`sawflutter.StudyDict`.

    Examples
    --------
    >>> import sawflutter as sf
    >>> free = sf.Scene.paper().replace({"accuracy": "draft", "guides": []})
    >>> even = {"kind": "tolerance", "plus_minus": 5e-5}
    >>> study = sf.Study(free, {"name": "Thickness", "saws": 8, "parameters": [
    ...     {"path": "blade.thickness_m", "distribution": even}]})
    >>> result = study.run()
    >>> result.all.saws
    8
    """

    def __init__(
        self, scene: Scene, study: StudyDict | Mapping[str, Any] | str | os.PathLike[str]
    ) -> None:
        if isinstance(study, (str, os.PathLike)):
            text = _native.read_text(study, False)
        else:
            text = _native.plain(study)
        _scene("scene", scene)
        self.scene, self._native = scene, _native.Study(scene.to_json(), text)
        self._text = json.dumps(json.loads(text))

    @property
    def count(self) -> int:
        """Number of saws."""
        return self._native.count

    def to_dict(self) -> StudyDict:
        """A copy of the study as a dict."""
        return cast(StudyDict, json.loads(self._text))

    def values(self, saws: Iterable[int] | None = None) -> FloatArray:
        """Values of the varied numbers, of the shape (saws, numbers), by default of all ``saws``; they
        are counted from 0."""
        chosen = range(self.count) if saws is None else saws
        return np.array([self._native.values(whole("saws", saw)) for saw in chosen])

    def run(
        self,
        folder: str | os.PathLike[str] | None = None,
        *,
        executor: Executor | Client | None = None,
        progress: Progress = None,
    ) -> StudyResults:
        """Analyses every saw and summarizes the results.

        Parameters
        ----------
        folder : path, optional
            Folder for the log of finished saws and for the results, the files of the program. A
            stopped run continues when started again. By default nothing is kept on the disk.
        executor : concurrent.futures.Executor or dask.distributed.Client, optional
            Executor for the saws; by default all cores of this machine. A task is a range of saws
            that takes about half a minute; only this process writes the log. With a client of
            Dask, the run continues when workers are lost. A saw that ends every worker that
            computes it becomes a row "failed", and the other saws are still computed.
        progress : bool or callable, optional
            As of :meth:`Scene.run_campbell`. With a client of Dask the address of its dashboard is
            printed, too.

        Returns
        -------
        StudyResults

        Raises
        ------
        StudyError
            The folder belongs to another study.
        AnalysisError
            The executor has stopped, or the saw of the scene itself cannot be analysed.
        """
        with tempfile.TemporaryDirectory() as temporary:
            place = Path(temporary if folder is None else folder)
            self._compute(place, executor, progress)
            self._sum_up(place)
            result = load(place / "study.json")
            assert isinstance(result, StudyResults)
            if folder is None:
                result = StudyResults._with_table(result.to_json(), result._csv())
        warned([*_native.unusual_numbers(self.scene.to_json()), *result._warnings()])
        return result

    def _compute(
        self,
        folder: str | os.PathLike[str],
        executor: Executor | Client | None,
        progress: Progress,
    ) -> None:
        """Adds the saws that its log does not have to a folder."""
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        if progress and (dashboard := getattr(executor, "dashboard_link", None)):
            print(f"dashboard {dashboard}", file=sys.stderr)
        with reporting(progress, "saws") as told:
            if executor is None:
                self._native.run(place, progress=told)
            else:
                self._fill(executor, place, told)

    def _fill(self, executor: Executor | Client, folder: Path, told: Any = None) -> None:
        """Adds the saws that its log does not have to a folder, without summing them up."""
        text = _tasks.Text(self.scene.to_json(), self._text)
        log = self._native.log(folder)
        try:
            _tasks.Run(self._native, log, _tasks.place(executor, text))(told)
        finally:
            # A stored exception keeps the log alive, and other runs must be able to open it.
            log.close()

    def _sum_up(self, folder: Path) -> None:
        """Writes the files of the program: all are on the disk before the first gets its name, and
        while there is a report, every other file belongs to it."""
        tables = [folder / f".{name}.part" for name in ("study.csv", "study.parquet")]
        parts = list(tables)
        try:
            for name, content in self._native.sum_up(folder, *tables):
                parts.append(folder / f".{name}.part")
                parts[-1].write_bytes(content)
            (folder / "study.json").unlink(missing_ok=True)
            for part in parts:
                part.replace(folder / part.name.removeprefix(".").removesuffix(".part"))
        finally:
            for part in parts:
                part.unlink(missing_ok=True)

    def __reduce__(self) -> tuple[type[Study], tuple[Scene, StudyDict]]:
        return Study, (self.scene, self.to_dict())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Study):
            return NotImplemented
        return (self.scene, self._text) == (other.scene, other._text)

    def __hash__(self) -> int:
        return hash((self.scene, self._text))

    def __repr__(self) -> str:
        return f"<Study {self.to_dict()['name']!r} of {self.scene.name!r}: {self.count} saws>"

    def _repr_html_(self) -> str:
        """The numbers that vary, for a notebook."""
        data = self.to_dict()
        return rows_in_html(
            f"{data['name']}: {self.count} saws of {self.scene.name}",
            ((entry["path"], json.dumps(entry["distribution"])) for entry in data["parameters"]),
        )
