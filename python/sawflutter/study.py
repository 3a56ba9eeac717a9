"""Many saws: tolerances of making and grids of design."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from concurrent.futures import Executor, as_completed
from pathlib import Path
from typing import Any, cast

import numpy as np

from . import _native
from ._entry import FloatArray
from ._progress import Progress, reporting
from ._scene_types import StudyDict
from .results import StudyResults
from .scene import Scene, _json

# Saws a task: few enough that little is lost with a worker, and enough that the task is worth its
# way there.
SAWS_A_TASK = 16


class Study:
    """A scene and what varies in it.

    Parameters
    ----------
    scene : Scene
        The saw without deviations.
    study : dict or path
        What varies, how, and which limits the saws have to keep, see ``sawflutter schema --study``
        or :data:`sawflutter.StudyDict`.

    Examples
    --------
    >>> import tempfile
    >>> import sawflutter as sf
    >>> free = sf.Scene.paper().replace({"accuracy": "draft", "guides": []})
    >>> even = {"kind": "tolerance", "plus_minus": 5e-5}
    >>> study = sf.Study(free, {"name": "Thickness", "saws": 8, "parameters": [
    ...     {"path": "blade.thickness_m", "distribution": even}]})
    >>> result = study.run(tempfile.mkdtemp())
    >>> result.all.saws
    8
    """

    def __init__(
        self, scene: Scene, study: StudyDict | Mapping[str, Any] | str | os.PathLike[str]
    ) -> None:
        if isinstance(study, (str, os.PathLike)):
            text = _native.read_text(study, False)
        else:
            text = _json(study)
        self._setup(scene, text)

    def _setup(self, scene: Scene, text: str) -> None:
        self.scene = scene
        self._text = text
        self._native = _native.Study(scene.to_json(), text)

    @property
    def count(self) -> int:
        """Number of saws."""
        return self._native.count

    def to_dict(self) -> StudyDict:
        """The study as a dict of its own."""
        return cast(StudyDict, json.loads(self._text))

    def values(self, saws: Iterable[int] | None = None) -> FloatArray:
        """Values of the numbers that vary, of the shape (saws, numbers)."""
        chosen = range(self.count) if saws is None else saws
        return np.array([self._native.values(int(saw)) for saw in chosen])

    def run(
        self,
        folder: str | os.PathLike[str],
        *,
        executor: Executor | None = None,
        progress: Progress = None,
    ) -> StudyResults:
        """Analyses every saw and sums them up.

        Parameters
        ----------
        folder : path
            For the log, in which every finished saw is written down at once, and for the results,
            which are the files that the program writes. Run again after a stop, it goes on.
        executor : concurrent.futures.Executor, optional
            Where the saws are computed, by default on all cores of this machine. A range of saws is
            a task; the log is written here.
        progress : bool or callable, optional
            True shows a bar, a callable is called with what is done and of how many.
        """
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        with reporting(progress, "saws") as told:
            if executor is None:
                self._native.run(place, progress=told)
            else:
                self._run_on(executor, place, told)
        for name, content in self._native.files(place):
            _write(place / name, content)
        result = StudyResults.from_json((place / "study.json").read_text(encoding="utf-8"))
        object.__setattr__(result, "_folder", place)
        return result

    def _run_on(self, executor: Executor, folder: Path, told: Any) -> None:
        missing = self._native.missing(folder)
        done = self.count - len(missing)
        log = self._native.log(folder)
        parts = [missing[k : k + SAWS_A_TASK] for k in range(0, len(missing), SAWS_A_TASK)]
        tasks = [executor.submit(_saws, self.scene.to_json(), self._text, part) for part in parts]
        try:
            for task in as_completed(tasks):
                saws = task.result()
                log.append(saws)
                done += len(saws)
                if told is not None:
                    told(done, self.count, "")
        finally:
            for task in tasks:
                task.cancel()

    def __reduce__(self) -> tuple[Any, tuple[str, str]]:
        return _study, (self.scene.to_json(), self._text)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Study):
            return NotImplemented
        return (self.scene, self._text) == (other.scene, other._text)

    def __hash__(self) -> int:
        return hash((self.scene, self._text))

    def __repr__(self) -> str:
        return f"<Study {self.to_dict()['name']!r} of {self.scene.name!r}: {self.count} saws>"


def _study(scene: str, text: str) -> Study:
    study = Study.__new__(Study)
    study._setup(Scene.from_json(scene), text)
    return study


def _saws(scene: str, study: str, saws: list[int]) -> list[str]:
    """A task: some saws of a study, as the log takes them."""
    return _native.Study(scene, study).saws(saws)


def _write(path: Path, content: bytes) -> None:
    """A whole file, or none."""
    part = path.with_name(f".{path.name}.part")
    part.write_bytes(content)
    part.replace(path)
