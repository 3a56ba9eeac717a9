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
from collections.abc import Callable, Iterable
from concurrent.futures import BrokenExecutor, CancelledError, Executor
from functools import lru_cache
from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeAlias

from . import _native
from .errors import AnalysisError

if TYPE_CHECKING:
    from distributed import Client

# A task takes about so long, in seconds: its way there and back costs milliseconds, and not much
# is lost with a worker.
SECONDS = 30.0
# Tasks under way and waiting for each worker: enough that none is idle while rows are written.
A_WORKER = 4
# The first tasks find out how long a saw takes.
FIRST = 2
# Of the saws that are left, every worker gets several tasks, so that all end at the same time; but
# tasks do not get shorter than this, in seconds.
LAST = 2
SHORTEST = 0.5
# How often it is looked for lost schedulers and new workers, in seconds.
LOOK = 1.0

Ranges: TypeAlias = tuple[tuple[int, int], ...]
"""Saws of a task: from the first of each pair up to the last, which is not in it."""


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


def rows(text: Text, ranges: Ranges) -> Rows:
    """A task."""
    try:
        # Saws are timed without the study, which a worker reads once.
        study = _study(text)
        begun = time.monotonic()
        found = study.rows(ranges)
    except Exception as error:  # noqa: BLE001 whatever it is, it goes back
        return Rows(b"", 0.0, who(), f"{type(error).__name__}: {error}")
    return Rows(found, time.monotonic() - begun, who())


def itself(text: Text) -> Text:
    """On a cluster the study is the result of a task: computed again where a worker that had it is
    lost, and sent to each worker once."""
    return Text(*text)


class Future(Protocol):
    """What executors give for a task."""

    def result(self) -> Any: ...
    def cancel(self) -> Any: ...
    def add_done_callback(self, fn: Any) -> Any: ...


class Place(Protocol):
    """Where tasks are done."""

    def workers(self) -> int:
        """How many tasks are done at the same time."""

    def known(self) -> Iterable[Worker]:
        """Those that compute, as far as one can ask them before a task."""

    def submit(self, ranges: Ranges) -> Future:
        """Begins a task."""

    def lost(self, error: BaseException) -> str | None:
        """What a lone saw is charged with that had this error: that it has ended its workers. None
        where the saw is not to blame."""

    def look(self) -> None:
        """Raises AnalysisError where no more tasks can be done here."""


class Pool:
    """Any executor of this machine or others."""

    def __init__(self, executor: Executor, text: Text) -> None:
        self.executor, self.text = executor, text

    def workers(self) -> int:
        return int(getattr(self.executor, "_max_workers", None) or os.cpu_count() or 1)

    def known(self) -> Iterable[Worker]:
        # Others are met by their rows.
        return [self.executor.submit(who).result()]

    def submit(self, ranges: Ranges) -> Future:
        return self.executor.submit(rows, self.text, ranges)

    def lost(self, error: BaseException) -> str | None:
        return None

    def look(self) -> None:
        pass


class Cluster:
    """A cluster of Dask."""

    def __init__(self, client: Client, text: Text) -> None:
        if client.asynchronous:
            raise TypeError("the client is asynchronous; give one that is not: Client(address)")
        # Of its methods some have types and some have none.
        self.client: Any = client
        self.text = text
        self.sent: Future | None = None

    def workers(self) -> int:
        return max(1, int(sum(self.client.nthreads().values())))

    def known(self) -> Iterable[Worker]:
        # A function of this package cannot be sent to where it cannot be imported, but the name of
        # the package can.
        self._asked(import_module, __package__)
        return [Worker(*worker) for worker in self._asked(who)]

    def _asked(self, function: Callable[..., Any], *arguments: str) -> list[Any]:
        """What every worker says to a question."""
        found: dict[str, Any] = {}
        # Those that were there a moment ago may be gone.
        while not found:
            self.client.wait_for_workers(1)
            found = self.client.run(function, *arguments, on_error="return")
        for address, said in found.items():
            if isinstance(said, ImportError):
                raise AnalysisError(
                    f"the worker {address} cannot import sawflutter ({said}); install version "
                    f"{who().version} there, with pip, and start it again"
                )
            if isinstance(said, BaseException):
                raise AnalysisError(f"the worker {address} does not answer: {said}")
        return list(found.values())

    def submit(self, ranges: Ranges) -> Future:
        if self.sent is None:
            self.sent = self.client.submit(itself, self.text, pure=False)
        future: Future = self.client.submit(rows, self.sent, ranges, pure=False)
        return future

    def lost(self, error: BaseException) -> str | None:
        from distributed import KilledWorker

        # Without the names of workers: a row says the same wherever it was computed.
        ended = "it has ended every worker that it was given to, without a word"
        return ended if isinstance(error, KilledWorker) else None

    def look(self) -> None:
        if self.client.status not in ("running", "connecting"):
            raise AnalysisError(f"the scheduler is lost: the client is {self.client.status}")


def place(executor: Any, text: Text) -> Place:
    """Where an executor, or a client of Dask, computes."""
    distributed = sys.modules.get("distributed")
    if distributed is not None:
        from distributed.cfexecutor import ClientExecutor

        if isinstance(executor, ClientExecutor):
            executor = executor._client
        if isinstance(executor, distributed.Client):
            return Cluster(executor, text)
    if not callable(getattr(executor, "submit", None)):
        raise TypeError(
            "executor must be a concurrent.futures.Executor or a dask.distributed.Client, "
            f"not {type(executor).__name__}"
        )
    return Pool(executor, text)


class Run:
    """Saws of a study that its log does not have, on an executor."""

    def __init__(self, study: _native.Study, log: _native.StudyLog, place: Place) -> None:
        self.study, self.log, self.place = study, log, place
        self.next = 0
        self.again: deque[Ranges] = deque()
        self.suspects: deque[Ranges] = deque()
        self.under_way: dict[Future, Ranges] = {}
        self.done: queue.SimpleQueue[Future] = queue.SimpleQueue()
        # Saws under way.
        self.saws_under_way = 0
        # Of the saws that are done here.
        self.seconds, self.saws, self.tasks = 0.0, 0, 0

    def __call__(self, told: Any = None) -> None:
        """Computes them; the log has what is done, whatever stops this."""
        if self.log.done == self.study.count:
            return
        for worker in self.place.known():
            _check(worker)
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
        while True:
            self._submit(workers)
            if not self.under_way:
                return
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

    def _submit(self, workers: int) -> None:
        while len(self.under_way) < A_WORKER * workers:
            ranges = self.again.popleft() if self.again else self._next(workers)
            if not ranges:
                break
            self._begin(ranges)
        # Nobody else is near a saw that may end its worker.
        if not self.under_way and self.suspects:
            self._begin(self.suspects[0])

    def _begin(self, ranges: Ranges) -> None:
        future = self.place.submit(ranges)
        self.under_way[future] = ranges
        self.saws_under_way += _count(ranges)
        self.tasks += 1
        future.add_done_callback(self.done.put)

    def _next(self, workers: int) -> Ranges:
        """The next saws that are missing, for a task."""
        size = FIRST
        if self.seconds > 0.0:
            each = self.seconds / self.saws
            left = self.study.count - self.log.done - self.saws_under_way
            fair = max(left / (LAST * workers), SHORTEST / each)
            size = max(1, math.ceil(min(SECONDS / each, fair)))
        ranges: list[tuple[int, int]] = []
        while size > 0 and (found := self.log.missing(self.next, size)) is not None:
            ranges.append(found)
            self.next = found[1]
            size -= found[1] - found[0]
        return tuple(ranges)

    def _take(self, future: Future) -> None:
        ranges = self.under_way.pop(future)
        self.saws_under_way -= _count(ranges)
        alone = bool(self.suspects) and ranges == self.suspects[0]
        try:
            found = Rows(*future.result())
        except Exception as error:
            reason = self.place.lost(error)
            if reason is None:
                raise
            self._divide(ranges, alone, reason)
            return
        if alone:
            self.suspects.popleft()
        worker = Worker(*found.worker)
        _check(worker)
        if found.error:
            raise AnalysisError(f"a task has failed on its worker: {found.error}")
        self.log.append_processor(worker.processor)
        self.log.append(found.rows)
        self.seconds += found.seconds
        self.saws += _count(ranges)

    def _divide(self, ranges: Ranges, alone: bool, reason: str) -> None:
        """Of saws that were with workers that ended, each half is a task. A single one may have
        waited behind the culprit: it is tried again when everything else is done, and is to blame
        where its workers end then, too."""
        saws = [saw for first, last in ranges for saw in range(first, last)]
        if alone:
            self.suspects.popleft()
            self.log.append(self.study.failed(saws[0], reason))
        elif len(saws) == 1:
            self.suspects.append(ranges)
        else:
            middle = len(saws) // 2
            self.again.extend(_ranges(half) for half in (saws[:middle], saws[middle:]))


def _count(ranges: Ranges) -> int:
    return sum(last - first for first, last in ranges)


def _ranges(saws: list[int]) -> Ranges:
    """Numbers, ascending, as ranges."""
    ranges: list[tuple[int, int]] = []
    for saw in saws:
        if ranges and ranges[-1][1] == saw:
            ranges[-1] = (ranges[-1][0], saw + 1)
        else:
            ranges.append((saw, saw + 1))
    return tuple(ranges)


def _check(worker: Worker) -> None:
    own = who()
    if worker.version != own.version:
        raise AnalysisError(
            f"a worker has sawflutter {worker.version}, and here it is {own.version}: their saws "
            "may differ; install the same version everywhere"
        )
