"""Saws on an executor: a range of them is a task, its rows are the result.

A saw depends on its number alone. Whoever computes it gives the same row, and the log takes the
first: a task may be done twice or not at all, and each saw is in the log once.
"""

from __future__ import annotations

import math
import os
import queue
import sys
import time
from collections import deque
from concurrent.futures import BrokenExecutor, CancelledError
from functools import lru_cache
from importlib import import_module
from typing import Any, NamedTuple, TypeAlias

from . import _native
from .errors import AnalysisError

# Tasks under way and waiting for each worker: enough that none is idle while rows are written.
A_WORKER = 4
# A task takes about so long at most, in seconds: its way there and back costs milliseconds, and not much
# is lost with a worker.
LONGEST = 30.0
# The first tasks find out how long a saw takes.
FIRST = 2
# Guided self-scheduling (Polychronopoulos and Kuck, 1987): every worker gets several tasks of the saws that
# are left, so that all end at the same time; but tasks do not get shorter than this, in seconds.
LAST = 2
SHORTEST = 0.5
# How often it is looked for lost schedulers and new workers, in seconds.
LOOK = 1.0

Range: TypeAlias = tuple[int, int]
"""Saws of a task: from the first up to the second, which is not in it."""


class Worker(NamedTuple):
    """Who computes."""

    version: str
    processor: str


class Rows(NamedTuple):
    """What a task gives: rows of the log, and what they took."""

    rows: bytes
    seconds: float
    worker: Worker
    error: str = ""
    """What has ended it before its end, in words: not every exception finds its way back."""


class Text(NamedTuple):
    """A study, as it is sent to workers."""

    scene: str
    study: str


def who() -> Worker:
    """Who computes here."""
    import sawflutter

    return Worker(sawflutter.__version__, _native.processor())


@lru_cache(maxsize=4)
def _study(text: Text) -> _native.Study:
    return _native.Study(text.scene, text.study)


def rows(text: Text, saws: Range) -> Rows:
    """A task."""
    try:
        # Saws are timed without the study, which a worker reads once.
        study = _study(text)
        begun = time.monotonic()
        found = study.rows([saws])
    except Exception as error:  # noqa: BLE001 whatever it is, it goes back
        return Rows(b"", 0.0, who(), f"{type(error).__name__}: {error}")
    return Rows(found, time.monotonic() - begun, who())


def itself(text: Text) -> Text:
    """On a cluster the study is the result of a task: computed again where a worker that had it is
    lost, and sent to each worker once."""
    return Text(*text)


class Place:
    """Where tasks are done: any executor, of this machine or others."""

    def __init__(self, executor: Any, text: Any, **options: Any) -> None:
        # Executors and clients of Dask have no type in common, nor have their futures.
        self.executor, self.text, self.options = executor, text, options

    def submit(self, saws: Range) -> Any:
        """Begins a task."""
        return self.executor.submit(rows, self.text, saws, **self.options)

    def workers(self) -> int:
        """How many tasks are done at the same time."""
        return int(getattr(self.executor, "_max_workers", None) or os.cpu_count() or 1)

    def check(self) -> None:
        """Refuses workers of another version, as far as one can ask them before a task."""
        _check(self.executor.submit(who).result())

    def lost(self, error: Exception) -> str | None:
        """What a lone saw is charged with that had this error: that it has ended its workers. None
        where the saw is not to blame."""
        return None

    def look(self) -> None:
        """Raises AnalysisError where no more tasks can be done here."""


class Cluster(Place):
    """A cluster of Dask: its client, for the executor that this gives does not pass on which error has
    ended a task."""

    def __init__(self, client: Any, text: Text) -> None:
        if client.asynchronous:
            raise TypeError("the client is asynchronous; give one that is not: Client(address)")
        super().__init__(client, text, pure=False)

    def workers(self) -> int:
        return max(1, int(sum(self.executor.nthreads().values())))

    def check(self) -> None:
        # A function of this package cannot be sent to where it cannot be imported, but the name of
        # the package can.
        self._ask(import_module, __package__)
        for worker in self._ask(who):
            _check(Worker(*worker))
        self.text = self.executor.submit(itself, self.text, pure=False)

    def _ask(self, *question: Any) -> list[Any]:
        """What every worker says to a question."""
        said: dict[str, Any] = {}
        # Those that were there a moment ago may be gone.
        while not said:
            self.executor.wait_for_workers(1)
            said = self.executor.run(*question, on_error="return")
        for address, error in said.items():
            if isinstance(error, ImportError):
                raise AnalysisError(
                    f"the worker {address} cannot import sawflutter ({error}); install version "
                    f"{who().version} there, with pip, and start it again"
                )
            if isinstance(error, BaseException):
                raise AnalysisError(f"the worker {address} does not answer: {error}")
        return list(said.values())

    def lost(self, error: Exception) -> str | None:
        from distributed import KilledWorker

        # Without the names of workers: a row says the same wherever it was computed.
        ended = "it has ended every worker that it was given to, without a word"
        return ended if isinstance(error, KilledWorker) else None

    def look(self) -> None:
        if self.executor.status not in ("running", "connecting"):
            raise AnalysisError(f"the scheduler is lost: the client is {self.executor.status}")


def place(executor: Any, text: Text) -> Place:
    """Where an executor, or a client of Dask, computes."""
    if (distributed := sys.modules.get("distributed")) is not None:
        # The executor of a client.
        client = getattr(executor, "_client", executor)
        if isinstance(client, distributed.Client):
            return Cluster(client, text)
    if not callable(getattr(executor, "submit", None)):
        raise TypeError(
            "executor must be a concurrent.futures.Executor or a dask.distributed.Client, "
            f"not {type(executor).__name__}"
        )
    return Place(executor, text)


class Run:
    """Saws of a study that its log does not have, on an executor."""

    def __init__(self, study: _native.Study, log: _native.StudyLog, place: Place) -> None:
        self.study, self.log, self.place = study, log, place
        self.next = 0
        # What is done here.
        self.tasks, self.saws, self.seconds = 0, 0, 0.0
        self.again: deque[Range] = deque()
        self.suspects: deque[Range] = deque()
        self.under_way: dict[Any, Range] = {}
        self.done: queue.SimpleQueue[Any] = queue.SimpleQueue()

    def __call__(self, told: Any = None) -> None:
        """Computes them; the log has what is done, whatever stops this."""
        if self.log.done == self.study.count:
            return
        self.place.check()
        try:
            self._run(told)
        except (BrokenExecutor, CancelledError) as error:
            raise AnalysisError(
                f"the executor has stopped ({type(error).__name__}: {error}); {self.log.done} of "
                f"{self.study.count} saws are in the log: run the study again with a new executor, "
                "and it goes on"
            ) from error
        finally:
            for future in self.under_way:
                future.cancel()

    def _run(self, told: Any) -> None:
        workers, looked = self.place.workers(), time.monotonic()
        while self._submit(workers):
            if time.monotonic() - looked > LOOK:
                self.place.look()
                workers, looked = self.place.workers(), time.monotonic()
            try:
                future = self.done.get(timeout=LOOK)
            except queue.Empty:
                continue
            self._take(future)
            if told is not None:
                told(self.log.done, self.study.count, "")

    def _submit(self, workers: int) -> bool:
        """Begins tasks as long as workers have room; whether any is under way."""
        while len(self.under_way) < A_WORKER * workers:
            saws = self.again.popleft() if self.again else self._next(workers)
            if saws is None:
                break
            self._begin(saws)
        # Nobody else is near a saw that may end its worker.
        if not self.under_way and self.suspects:
            self._begin(self.suspects[0])
        return bool(self.under_way)

    def _begin(self, saws: Range) -> None:
        future = self.place.submit(saws)
        self.under_way[future] = saws
        future.add_done_callback(self.done.put)

    def _next(self, workers: int) -> Range | None:
        """The next saws that are missing, for a task."""
        size = FIRST
        if self.seconds > 0.0:
            a_second = self.saws / self.seconds
            share = (self.study.count - self.next) / (LAST * workers)
            size = math.ceil(min(LONGEST * a_second, max(share, SHORTEST * a_second)))
        saws = self.log.missing(self.next, size)
        if saws is not None:
            self.next = saws[1]
        return saws

    def _take(self, future: Any) -> None:
        saws = self.under_way.pop(future)
        is_alone = bool(self.suspects) and saws == self.suspects[0]
        try:
            found = Rows(*future.result())
        except Exception as error:
            reason = self.place.lost(error)
            if reason is None:
                raise
            self._divide(saws, is_alone, reason)
            return
        if is_alone:
            self.suspects.popleft()
        worker = Worker(*found.worker)
        _check(worker)
        if found.error:
            raise AnalysisError(f"a task has failed on its worker: {found.error}")
        self.log.append_processor(worker.processor)
        self.log.append(found.rows)
        self.tasks += 1
        self.saws += saws[1] - saws[0]
        self.seconds += found.seconds

    def _divide(self, saws: Range, is_alone: bool, reason: str) -> None:
        """Of saws that were with workers that ended, each half is a task. A single one may have
        waited behind the culprit: it is tried again when everything else is done, and is to blame
        where its workers end then, too."""
        first, last = saws
        if is_alone:
            self.log.append(self.study.failed(self.suspects.popleft()[0], reason))
        elif last - first == 1:
            self.suspects.append(saws)
        else:
            middle = (first + last) // 2
            self.again.extend([(first, middle), (middle, last)])


def _check(worker: Worker) -> None:
    own = who()
    if worker.version != own.version:
        raise AnalysisError(
            f"a worker has sawflutter {worker.version}, and here it is {own.version}: their saws "
            "may differ; install the same version everywhere"
        )
