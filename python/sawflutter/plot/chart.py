"""Contents of a figure as numbers and text."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from types import MappingProxyType
from typing import Any, Literal, TypeAlias

import numpy as np

from .. import _native
from .._drawn import Drawn
from .._entry import Entry, FloatArray

# Letters in a line below the title.
FACTS = 110


@cache
def colours() -> Mapping[str, str]:
    """Colours of the program's figures by subject, as #rrggbb."""
    palette = json.loads(_native.palette())
    named = {name: "#" + "".join(f"{c:02x}" for c in rgb) for name, rgb in palette.items()}
    return MappingProxyType(named)


@dataclass(frozen=True, eq=False, repr=False)
class Line(Entry):
    """A curve, interrupted by NaN."""

    x: FloatArray
    y: FloatArray
    colour: str
    name: str = ""
    width: float = 1.6
    dashed: bool = False
    hover: Sequence[str] = ()
    """Text of each point, on lines of its own."""
    end: str = ""
    """Label at the last point."""


@dataclass(frozen=True, eq=False, repr=False)
class Points(Entry):
    """Marks, each a disc, a ring, a square or a cross."""

    x: FloatArray
    y: FloatArray
    colour: str
    name: str = ""
    shape: Shape = "disc"
    size: float = 7.0
    hover: Sequence[str] = ()


@dataclass(frozen=True, eq=False, repr=False)
class Bars(Entry):
    """A histogram."""

    edges: FloatArray
    heights: FloatArray
    colour: str
    name: str = ""


@dataclass(frozen=True, eq=False, repr=False)
class Heat(Entry):
    """Values over two axes, with one row of z for each y; NaN is blank. One colour is that of a class
    of cells, whose values have no meaning."""

    x: FloatArray
    y: FloatArray
    z: FloatArray
    name: str
    scale: Sequence[str]
    range: tuple[float, float] | None = None
    log: bool = False
    """Whether the colours follow the logarithm of the values."""


@dataclass(frozen=True, eq=False, repr=False)
class Area(Entry):
    """Columns from a lower to an upper value; without steps, their ends are connected."""

    x: FloatArray
    low: FloatArray
    high: FloatArray
    colour: str
    name: str = ""
    stepped: bool = True
    """Whether a column reaches half way to the next ones."""

    def columns(self) -> tuple[FloatArray, FloatArray]:
        """Middles and widths of the columns."""
        edges = np.concatenate([self.x[:1], (self.x[1:] + self.x[:-1]) / 2.0, self.x[-1:]])
        return (edges[1:] + edges[:-1]) / 2.0, np.diff(edges)

    def heights(self) -> FloatArray:
        """Heights of the columns; zero where there is no area."""
        return np.nan_to_num(np.maximum(self.high - self.low, 0.0))


@dataclass(frozen=True, eq=False, repr=False)
class Label(Entry):
    """A text at a point."""

    x: float
    y: float
    colour: str
    name: str


@dataclass(frozen=True, eq=False, repr=False)
class Shade(Entry):
    """An interval of the x axis, coloured over the height of the panel."""

    start: float
    end: float
    colour: str
    name: str = ""


@dataclass(frozen=True, eq=False, repr=False)
class Upright(Entry):
    """A vertical line over the height of the panel."""

    x: float
    colour: str
    dashed: bool = True
    name: str = ""


Item: TypeAlias = "Line | Points | Area | Bars | Heat | Label | Shade | Upright"
Shape: TypeAlias = Literal["disc", "ring", "square", "cross"]


@dataclass(frozen=True, eq=False, repr=False)
class Panel(Entry):
    """Axes and their contents."""

    x_name: str
    y_name: str
    items: Sequence[Item]
    x_range: tuple[float, float] | None = None
    y_range: tuple[float, float] | None = None
    x_log: bool = False
    y_log: bool = False
    y_root: bool = False
    """Whether the y axis shows signed square roots, so that small values next to large ones are
    seen."""
    x_ticks: Sequence[float] = ()
    """Values of an axis that have a number; empty if the range determines them."""
    x_names: Sequence[str] = ()
    """Words at these values, or names of rows, in place of numbers."""
    y_ticks: Sequence[float] = ()
    y_names: Sequence[str] = ()
    share: float = 1.0
    """Height beside that of the other panels."""
    title: str = ""
    equal: bool = False
    """Whether a metre is as long on both axes."""
    harmonics: bool = False
    """Whether it shows frequencies over the rotation speed, so that its multiples are lines."""
    note: str = ""
    """Text shown instead of data."""

    def __repr__(self) -> str:
        return f"<Panel {self.y_name!r} over {self.x_name!r}: {len(self.items)} items>"


@dataclass(frozen=True, eq=False, repr=False)
class Chart(Drawn, Entry):
    """Panels one above the other, which share the x axis if it is the same in all."""

    title: str
    facts: str
    panels: Sequence[Panel] = field(default_factory=tuple)
    key: Sequence[Item] = ()
    """Samples of lines, points and areas, each named by its meaning."""

    def chart(self) -> Chart:
        return self

    def __repr__(self) -> str:
        return f"<Chart {self.title[:80]!r}: {list(self.panels)}>"

    def lines(self) -> list[str]:
        """The facts in lines as long as the figure is wide."""
        return textwrap.wrap(self.facts, FACTS)

    def shown(self) -> Sequence[Panel]:
        """The panels, or an empty one if there are none."""
        return self.panels or (Panel("", "", ()),)

    def together(self) -> bool:
        """Whether the panels share their x axis."""
        return len({(panel.x_name, panel.x_range) for panel in self.shown()}) == 1


def end_labels(panel: Panel, apart: float) -> list[tuple[Line, float]]:
    """Lines with a label at their end, and the height of the label: the labels are so far apart, as
    a share of the axis, that they do not overlap."""
    low, high = panel.y_range or (0.0, 1.0)
    if panel.y_log:
        low, high = np.log10([low, high]).tolist()
    lines = [item for item in panel.items if isinstance(item, Line) and item.end]
    heights = [float(np.log10(line.y[-1]) if panel.y_log else line.y[-1]) for line in lines]
    ends = sorted(zip(heights, lines), key=lambda pair: pair[0])
    placed: list[tuple[Line, float]] = []
    lowest = low
    for y, line in ends:
        if low <= y <= high:
            place = max(y, lowest)
            placed.append((line, 10.0**place if panel.y_log else place))
            lowest = place + apart * (high - low)
    return placed


def is_at_the_top(label: Label, panel: Panel) -> bool:
    """Whether there is no room for a label above its point."""
    low, high = panel.y_range or (-np.inf, np.inf)
    ends = np.log10([low, high, label.y]) if panel.y_log else np.array([low, high, label.y])
    return bool(np.isfinite(ends).all() and ends[2] > ends[1] - 0.08 * (ends[1] - ends[0]))


def signed_root(values: Any) -> Any:
    """Positions on an axis of signed square roots."""
    return np.sign(values) * np.sqrt(np.abs(values))


def root_ticks(low: float, high: float) -> list[float]:
    """Round values for an axis of signed square roots."""
    top = max(abs(low), abs(high))
    steps = [float(f"{digit}e{power}") for power in range(-6, 13) for digit in (1, 3)]
    positive = [step for step in steps if 0.02 * top <= step <= top]
    values = [-step for step in reversed(positive)] + [0.0] + positive
    return [value for value in values if low <= value <= high]
