"""Progress of a computation: a bar, a callable, or nothing."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from typing_extensions import Self

# True shows a bar; a callable is called with the finished steps and their total.
Progress: TypeAlias = "bool | Callable[[int, int], object] | None"
Native: TypeAlias = "Callable[[int, int, str], object] | None"


@contextmanager
def reporting(progress: Progress, what: str) -> Iterator[Native]:
    """The function that the compiled part calls; a bar is closed at the end. Within a phase the
    number of finished steps never falls, and a bar names the phase."""
    if callable(progress):
        told = progress
        yield _rising(lambda done, of, _: told(done, of))
    elif progress:
        with _bar(what) as bar:
            shown = [(what, 0)]

            def show(done: int, of: int, step: str) -> None:
                phase = (step or what, of)
                if phase != shown[0]:
                    bar.reset(total=of)
                    shown[0] = phase
                bar.n = done
                bar.set_description(step or what)

            yield _rising(show)
    else:
        yield None


def _rising(tell: Callable[[int, int, str], object]) -> Callable[[int, int, str], object]:
    """Leaves out what would run back within a phase: steps end in any order on several threads."""
    last = [("", 0, 0)]

    def told(done: int, of: int, step: str) -> None:
        phase, total, before = last[0]
        if (step, of) == (phase, total) and done < before:
            return
        last[0] = (step, of, done)
        tell(done, of, step)

    return told


class _Line:
    """A line on the error stream that is overwritten, used without tqdm."""

    total, n = 0, 0

    def reset(self, total: int) -> None:
        if self.total:
            print(file=sys.stderr)
        self.total, self.n = total, 0

    def set_description(self, what: str) -> None:
        print(f"\r{what}: {self.n}/{self.total} ", end="", file=sys.stderr, flush=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        print(file=sys.stderr)


def _bar(what: str) -> Any:
    """A bar of tqdm, also in a notebook."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Line()
    return tqdm(total=None, desc=what)
