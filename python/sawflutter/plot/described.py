"""Charts as the program describes them."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Iterator
from typing import Any

import numpy as np

from .chart import Area, Bars, Chart, Heat, Item, Label, Line, Panel, Points, Shade, Upright, colours
from .chart import FACTS

# Narrower bands, as a share of the axis, get a stronger colour.
NARROW = 0.004


def read(text: str) -> Chart:
    """The chart that a JSON text of the program describes."""
    chart = json.loads(text)
    panels = tuple(_panel(panel) for panel in chart["panels"])
    key = tuple(item for of in chart["key"] for item in _items(of, None))
    return Chart(chart["title"], "; ".join(chart["facts"]), panels, key)


def _panel(panel: dict[str, Any]) -> Panel:
    x, y = panel["x"], panel["y"]
    x_range, y_range = (None if of["range"] is None else tuple(of["range"]) for of in (x, y))
    items = [item for of in panel["items"] for item in _items(of, x_range)]
    # A wide band must not hide a narrow one within it.
    items.sort(key=lambda item: item.start - item.end if isinstance(item, Shade) else 0.0)
    if y["names"] and y_range is not None:
        # Rows are listed downwards.
        y_range = y_range[::-1]
    return Panel(
        x_name=_axis(x),
        y_name=_axis(y),
        items=items,
        x_range=x_range,
        y_range=y_range,
        x_log=x["spread"] == "logarithmic",
        y_log=y["spread"] == "logarithmic",
        y_root=y["spread"] == "signed_root",
        x_ticks=x["ticks"],
        x_names=x["names"],
        y_ticks=y["ticks"],
        y_names=y["names"],
        share=panel["share"],
        title="\n".join([panel["title"], *textwrap.wrap("; ".join(panel["facts"]), FACTS)]),
        equal=panel["equal"],
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
        colour = _tinted(colours()[of["colour"]], of["tint"])
        yield Area(x, low, high, colour, of["name"], of["stepped"])
    elif of["item"] == "heat":
        x, y, z = (np.array(of[axis], float) for axis in "xyz")
        scale = ["#" + "".join(f"{c:02x}" for c in rgb) for rgb in of["colours"]]
        name, log = _axis(of), of["spread"] == "logarithmic"
        yield Heat(x, y, z, name, scale, (of["range"][0], of["range"][1]), log)
    elif of["item"] == "bars":
        edges, heights = (np.array(of[key], float) for key in ("edges", "heights"))
        yield Bars(edges, heights, _tinted(colours()[of["colour"]], of["tint"]), of["name"])
    elif of["item"] == "label":
        yield Label(of["x"], of["y"], colours()[of["colour"]], of["text"])
    elif of["item"] == "upright":
        yield Upright(of["x"], colours()[of["colour"]], of["dashed"], of["name"])
    else:
        x, y = (np.array(of[axis], float) for axis in "xy")
        colour, name, said = _tinted(colours()[of["colour"]], of["tint"]), of["name"], of["said"]
        if of["item"] == "points":
            yield Points(x, y, colour, name, of["shape"], of["size"], said)
            return
        yield Line(x, y, colour, name, of["width"], of["dashed"], said, of["end"])
        if of["label"]:
            ends = slice(0, 2) if len(x) == 2 else slice(len(x) // 2, len(x) // 2 + 1)
            yield Label(float(np.mean(x[ends])), float(np.mean(y[ends])), colour, of["label"])


def _tinted(colour: str, share: float) -> str:
    """A share of a colour on white paper."""
    channels = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return "#" + "".join(f"{round(255 - share * (255 - channel)):02x}" for channel in channels)
