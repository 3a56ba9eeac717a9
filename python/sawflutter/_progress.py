"""Progress of a computation: a bar, a callable, or nothing."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeAlias

Callback: TypeAlias = "Callable[[int, int, str], object]"
# True shows a bar; a callable is called with the finished steps, their total and the name of the phase.
Progress: TypeAlias = "bool | Callback | None"


@contextmanager
def reporting(progress: Progress, what: str) -> Iterator[Callback | None]:
    """The function that the compiled part calls with the finished steps, their total, and the name of
    the phase; where that is blank, the phase is ``what``."""
    if callable(progress):
        told = progress
        yield lambda done, of, step: told(done, of, step or what)
    elif progress:
        bar = _Bar(what)
        try:
            yield bar.show
            bar.fill()
        finally:
            bar.close()
    else:
        yield None


class _Bar:
    """A bar that begins with the first phase."""

    def __init__(self, what: str) -> None:
        self._what, self._phase = what, ""
        self._shown: Any = None

    def show(self, done: int, of: int, step: str) -> None:
        phase = step or self._what
        if self._shown is None:
            self._shown = _shown(phase, of)
        elif phase != self._phase:
            self._shown.reset(total=of)
        self._phase = phase
        # The total of a phase may rise while it is under way.
        self._shown.total, self._shown.n = of, done
        self._shown.set_description(phase)

    def fill(self) -> None:
        """Shows that the computation is complete, of which the last report may be missing."""
        if self._shown is not None:
            self.show(self._shown.total, self._shown.total, self._phase)

    def close(self) -> None:
        if self._shown is not None:
            self._shown.close()


class _Line:
    """A line on the error stream that is overwritten, used without tqdm."""

    def __init__(self, total: int) -> None:
        self.total, self.n = total, 0

    def reset(self, total: int) -> None:
        print(file=sys.stderr)
        self.total, self.n = total, 0

    def set_description(self, what: str) -> None:
        print(f"\r{what}: {self.n}/{self.total} ", end="", file=sys.stderr, flush=True)

    def close(self) -> None:
        print(file=sys.stderr)


def _shown(phase: str, total: int) -> Any:
    """A bar of tqdm, also in a notebook."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Line(total)
    return tqdm(desc=phase, total=total)
