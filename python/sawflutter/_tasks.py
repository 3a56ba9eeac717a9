"""Saws on an executor: a task computes a range of them, and its result is their rows.

A saw depends on its number alone, so that every process computes the same row for it, and the log
keeps the first one. A task may be done twice or not at all, and each saw is in the log once.
"""

from __future__ import annotations

import math
import os
import queue
import sys
import time
from collections import deque
from collections.abc import Iterable
from concurrent.futures import BrokenExecutor, CancelledError
from functools import lru_cache
from importlib import import_module
from typing import Any, NamedTuple, TypeAlias

from . import _native
from .errors import AnalysisError

# Running and waiting tasks for each worker: enough that none is idle while rows are written.
A_WORKER = 4
# Longest duration of a task, in seconds: its transfer takes milliseconds, and the loss of a worker
# costs little.
LONGEST = 30.0
# The first tasks measure the time of a saw.
FIRST = 2
# Guided self-scheduling (Polychronopoulos and Kuck, 1987): every worker gets several tasks of the
# remaining saws, so that all end at the same time; but no task is shorter than this, in seconds.
LAST = 2
SHORTEST = 0.5
# Interval of the search for lost schedulers and new workers, in seconds.
LOOK = 1.0

Range: TypeAlias = tuple[int, int]
"""Saws of a task: from the first up to the second, which is not in it."""


class Worker(NamedTuple):
    """A process that computes."""

    version: str
    processor: str


class Rows(NamedTuple):
    """The result of a task: rows of the log, and their time."""

    rows: bytes
    seconds: float
    worker: Worker
    error: str = ""
    """Message of the exception that has ended it, because not every exception can be sent back."""


class Text(NamedTuple):
    """A study in the form that is sent to workers."""

    scene: str
    study: str


def who() -> Worker:
    """The process that runs this function."""
    import sawflutter

    return Worker(sawflutter.__version__, _native.processor())


@lru_cache(maxsize=4)
def _study(text: Text) -> _native.Study:
    return _native.Study(text.scene, text.study)


def rows(text: Text, saws: Range) -> Rows:
    """Computes the rows of a task."""
    try:
        # The time of a saw excludes the study, which a worker reads once.
        study = _study(text)
        begun = time.monotonic()
        found = study.rows(*saws)
    except Exception as error:  # noqa: BLE001 whatever it is, it goes back
        return Rows(b"", 0.0, who(), f"{type(error).__name__}: {error}")
    return Rows(found, time.monotonic() - begun, who())


def itself(text: Text) -> Text:
    """Gives the study itself. On a cluster it is the result of a task, so that it is sent to each
    worker once, and is computed again if its worker is lost."""
    return Text(*text)


class Place:
    """A place for tasks: any executor, on this machine or others."""

    def __init__(self, executor: Any, text: Any, **options: Any) -> None:
        # Executors and clients of Dask have no type in common, nor have their futures.
        self.executor, self.text, self.options = executor, text, options

    def submit(self, saws: Range) -> Any:
        """Begins a task."""
        return self.executor.submit(rows, self.text, saws, **self.options)

    def workers(self) -> int:
        """The number of tasks that run at the same time."""
        return int(getattr(self.executor, "_max_workers", None) or os.cpu_count() or 1)

    def check(self) -> None:
        """Refuses workers of another version, if they can be asked before a task."""
        _check(self.executor.submit(who).result())

    def lost(self, error: Exception) -> str | None:
        """The reason to blame a single saw for this error, that it has ended its workers; None if
        the error has another cause."""
        return None

    def look(self) -> None:
        """Raises BrokenExecutor if no more tasks can run here."""

    def cancel(self, tasks: Iterable[Any]) -> None:
        """Gives up tasks that are under way."""
        for task in tasks:
            task.cancel()


class Cluster(Place):
    """A cluster of Dask: its client, because its executor does not pass on the error that has ended
    a task."""

    def __init__(self, client: Any, text: Text) -> None:
        if client.asynchronous:
            raise TypeError("the client is asynchronous; give one that is not: Client(address)")
        super().__init__(client, text, pure=False)

    def submit(self, saws: Range) -> Any:
        try:
            return super().submit(saws)
        except Exception:
            # A client that has lost its scheduler closes itself at any moment.
            self.look()
            raise

    def workers(self) -> int:
        try:
            threads = self.executor.nthreads()
        except OSError as error:
            raise BrokenExecutor(f"the connection to the scheduler is closed: {error}") from error
        except Exception:
            self.look()
            raise
        return max(1, int(sum(threads.values())))

    def check(self) -> None:
        # A function of this package can be sent only to a worker that can import it, but the name
        # of the package can be sent anywhere.
        self._ask(import_module, __package__)
        for worker in self._ask(who):
            _check(Worker(*worker))
        self.text = self.executor.submit(itself, self.text, pure=False)

    def _ask(self, *question: Any) -> list[Any]:
        """The answers of all workers to a question."""
        said: dict[str, Any] = {}
        # The workers may have ended since the scheduler named them.
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

        # The names of workers are left out: a row does not depend on its worker.
        ended = "it has ended every worker that it was given to, without an error message"
        return ended if isinstance(error, KilledWorker) else None

    def look(self) -> None:
        if self.executor.status not in ("running", "connecting"):
            raise BrokenExecutor(f"the scheduler is lost: the client is {self.executor.status}")

    def cancel(self, tasks: Iterable[Any]) -> None:
        # A closed client has cancelled its tasks, and refuses to do so again.
        if self.executor.status == "running":
            super().cancel(tasks)


def place(executor: Any, text: Text) -> Place:
    """The place where an executor, or a client of Dask, computes."""
    if (distributed := sys.modules.get("distributed")) is not None:
        # An executor of Dask refers to its client.
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
    """The saws of a study that its log lacks, on an executor."""

    def __init__(self, study: _native.Study, log: _native.StudyLog, place: Place) -> None:
        self.study, self.log, self.place = study, log, place
        self.next = 0
        # Numbers of finished tasks and of their saws, and the time of these.
        self.tasks, self.saws, self.seconds = 0, 0, 0.0
        self.again: deque[Range] = deque()
        self.suspects: deque[Range] = deque()
        self.under_way: dict[Any, Range] = {}
        self.done: queue.SimpleQueue[Any] = queue.SimpleQueue()

    def __call__(self, told: Any = None) -> None:
        """Computes the saws; if this is stopped, the log has the finished ones."""
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
            self.place.cancel(self.under_way)

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
        """Begins tasks while workers have room, and gives whether any is running."""
        while len(self.under_way) < A_WORKER * workers:
            saws = self.again.popleft() if self.again else self._next(workers)
            if saws is None:
                break
            self._begin(saws)
        # No other task runs beside a saw that may end its worker.
        if not self.under_way and self.suspects:
            self._begin(self.suspects[0])
        return bool(self.under_way)

    def _begin(self, saws: Range) -> None:
        future = self.place.submit(saws)
        self.under_way[future] = saws
        future.add_done_callback(self.done.put)

    def _next(self, workers: int) -> Range | None:
        """The next missing saws, for a task."""
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
        """Divides the saws of workers that have ended: each half becomes a task. A single saw may
        have waited behind the saw that ended the worker: it is tried again after all others, and is
        blamed if its workers end then, too."""
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
