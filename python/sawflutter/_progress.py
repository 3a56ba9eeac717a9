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
    """The function that the compiled part calls; a bar names the phase and is closed at the end."""
    if callable(progress):
        told = progress
        yield lambda done, of, _: told(done, of)
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

            yield show
    else:
        yield None


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
