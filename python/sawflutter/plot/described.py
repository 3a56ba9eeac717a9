"""Charts as the program describes them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from .. import _native
from .chart import Area, Chart, Item, Line, Panel, Points, Shade, Upright, colours
from .design import check, fit, place, study
from .histories import cut

# The program does not describe the figures of these commands. A function makes the chart of a report
# and of its answer in one line.
OWN: dict[str, Callable[[Any, str], Chart]] = {
    "check": check,
    "cut": cut,
    "fit": fit,
    "place": place,
    "study": study,
}
# Narrower bands, as a share of the axis, get a stronger colour.
NARROW = 0.004


def described(command: str, name: str, report: str) -> Chart | None:
    """The chart of a figure of the program, by its name without an ending; None if the report has
    no data for it."""
    text = _native.chart(command, name, report)
    if text is None:
        return None
    chart = json.loads(text)
    panels = tuple(_panel(panel) for panel in chart["panels"])
    return Chart(chart["title"], "; ".join(chart["facts"]), panels)


def _panel(panel: dict[str, Any]) -> Panel:
    x, y = panel["x"], panel["y"]
    x_range, y_range = (None if of["range"] is None else tuple(of["range"]) for of in (x, y))
    items = [item for of in panel["items"] for item in _items(of, x_range)]
    # A wide band must not hide a narrow one within it.
    items.sort(key=lambda item: item.start - item.end if isinstance(item, Shade) else 0.0)
    return Panel(
        x_name=_axis(x),
        y_name=_axis(y),
        items=items,
        x_range=x_range,
        y_range=y_range,
        x_log=x["spread"] == "logarithmic",
        y_log=y["spread"] == "logarithmic",
        y_root=y["spread"] == "signed_root",
        y_ticks=y["ticks"],
        y_names=y["names"],
        share=panel["share"],
        title=panel["title"],
        harmonics=panel["harmonics"],
        note=panel["note"],
    )


def _axis(axis: dict[str, Any]) -> str:
    unit = f" [{axis['unit']}]" if axis["unit"] else ""
    spread = ", square root scale" if axis["spread"] == "signed_root" else ""
    return f"{axis['name']}{unit}{spread}"


def _items(of: dict[str, Any], x_range: tuple[float, float] | None) -> Iterator[Item]:
    if of["item"] == "band":
        for start, end in of["shaded"]:
            narrow = x_range is not None and end - start < NARROW * (x_range[1] - x_range[0])
            colour = colours()[of["streak" if narrow else "shade"]]
            yield Shade(start, end, colour, of["name"])
    elif of["item"] == "area":
        x, low, high = (np.array(of[edge], float) for edge in ("x", "low", "high"))
        yield Area(x, low, high, _tinted(colours()[of["colour"]], of["tint"]), of["name"])
    elif of["item"] == "upright":
        yield Upright(of["x"], colours()[of["colour"]], of["dashed"], of["name"])
    else:
        x, y = (np.array(of[axis], float) for axis in "xy")
        colour, name, said = _tinted(colours()[of["colour"]], of["tint"]), of["name"], of["said"]
        if of["item"] == "points":
            yield Points(x, y, colour, name, of["hollow"], of["size"], said)
        else:
            yield Line(x, y, colour, name, of["width"], of["dashed"], said, of["end"])


def _tinted(colour: str, share: float) -> str:
    """A share of a colour on white paper."""
    channels = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return "#" + "".join(f"{round(255 - share * (255 - channel)):02x}" for channel in channels)
