"""Progress of a computation: a bar, a callable, or nothing."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeAlias

# True shows a bar, a callable is called with what is done and of how many.
Progress: TypeAlias = "bool | Callable[[int, int], object] | None"
Native: TypeAlias = "Callable[[int, int, str], object] | None"


@contextmanager
def reporting(progress: Progress, what: str) -> Iterator[Native]:
    """What the compiled part is to call; a bar is closed in the end."""
    if not progress:
        yield None
    elif callable(progress):
        told = progress
        yield lambda done, of, _: told(done, of)
    else:
        bar = _bar(what)
        try:
            yield bar.show
        finally:
            bar.close()


class _Line:
    """A line on the error stream that is written over, where there is no tqdm."""

    def __init__(self, what: str) -> None:
        self.what = what

    def show(self, done: int, of: int, what: str) -> None:
        sys.stderr.write(f"\r{what or self.what}: {done}/{of} ")
        sys.stderr.flush()

    def close(self) -> None:
        sys.stderr.write("\n")


class _Tqdm:
    """A bar of tqdm, in a notebook too."""

    def __init__(self, tqdm: Any, what: str) -> None:
        self.what = what
        self.bar = tqdm(total=None, desc=what)

    def show(self, done: int, of: int, what: str) -> None:
        if (what or self.what) != self.bar.desc.removesuffix(": "):
            self.bar.set_description(what or self.what, refresh=False)
        self.bar.total = of
        self.bar.n = done
        self.bar.refresh()

    def close(self) -> None:
        self.bar.close()


def _bar(what: str) -> _Line | _Tqdm:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Line(what)
    return _Tqdm(tqdm, what)
