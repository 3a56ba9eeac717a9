"""A chart in other units, and with multiples of the rotation speed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import isfinite, tau
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from .._drawn import Look, Units
from .._values import numbers
from .chart import Chart, Heat, Item, Line, Panel, Points, colours

if TYPE_CHECKING:
    from typing_extensions import Unpack

# One rotation per second in each of the units.
TURN: dict[str, float] = {"rpm": 60.0, "Hz": 1.0, "rad/s": tau}


def looking(chart: Chart, method: str, **look: Unpack[Look]) -> Chart:
    """The chart as the arguments of a method like :meth:`sawflutter.Result.plot` ask for it."""
    for name in look.keys() - Look.__annotations__.keys():
        known = ", ".join(Look.__annotations__)
        raise TypeError(f"{method}() takes {known}, and no {name!r}; figures of one's own take axes as well")
    speed_units, frequency_units = look.get("speed_units", "rpm"), look.get("frequency_units", "Hz")
    harmonics = look.get("harmonics", ())
    for name, given in (("speed_units", speed_units), ("frequency_units", frequency_units)):
        if given not in TURN:
            allowed = ", ".join(map(repr, get_args(Units)))
            raise ValueError(f"{name} must be one of {allowed} (you gave {given!r})")
    panels = with_harmonics(chart.panels, np.atleast_1d(numbers("harmonics", harmonics)).tolist())
    units: dict[str, str] = {"rpm": speed_units, "Hz": frequency_units}
    return replace(chart, panels=tuple(_in_units(panel, units) for panel in panels))


def with_harmonics(panels: Sequence[Panel], orders: Sequence[float]) -> Sequence[Panel]:
    """The panels with lines at multiples of the rotation speed."""
    for order in orders:
        if not (isfinite(order) and order > 0.0):
            raise ValueError(f"a multiple in harmonics must be positive and finite (you gave {order:g})")
    if orders and not any(panel.harmonics for panel in panels):
        raise ValueError(
            "harmonics are lines of frequency over the rotation speed, which this figure does not "
            "show; leave the argument out"
        )
    return [
        replace(panel, items=[*panel.items, *(_harmonic(panel, order) for order in orders)])
        if panel.harmonics
        else panel
        for panel in panels
    ]


def _harmonic(panel: Panel, order: float) -> Line:
    """A line that ends where it leaves the panel."""
    first, last = panel.x_range or _reach(panel.items)
    top = panel.y_range[1] if panel.y_range is not None else np.inf
    end = max(first, min(last, 60.0 * top / order))
    rpm, name = np.array([first, end]), f"{order:g}× speed"
    hover = [f"{name}<br>{at:.1f} rpm<br>{order * at / 60.0:.3f} Hz" for at in rpm]
    label = name if end == last else ""
    return Line(rpm, order * rpm / 60.0, colours()["quiet"], name, 1.0, True, hover, label)


def _reach(items: Iterable[Item]) -> tuple[float, float]:
    """The range of speeds of the curves and points of a panel."""
    speeds = np.concatenate([np.ravel(of.x) for of in items if isinstance(of, Line | Points)])
    return float(np.nanmin(speeds)), float(np.nanmax(speeds))


def _in_units(panel: Panel, units: dict[str, str]) -> Panel:
    x_name, x = _axis(panel.x_name, units)
    y_name, y = _axis(panel.y_name, units)
    return replace(
        panel,
        x_name=x_name,
        y_name=y_name,
        items=[_scaled(item, x, y, units) for item in panel.items],
        x_range=_times(panel.x_range, x),
        y_range=_times(panel.y_range, y),
        x_ticks=[x * tick for tick in panel.x_ticks],
        y_ticks=[y * tick for tick in panel.y_ticks],
    )


def _axis(name: str, units: dict[str, str]) -> tuple[str, float]:
    """The name of an axis in other units, and the factor of its numbers."""
    for own, wanted in units.items():
        if own != wanted and f"[{own}]" in name:
            # The imaginary part of an eigenvalue is in rad/s.
            said = name.replace("Im λ / 2π", "Im λ" if wanted == "rad/s" else "frequency")
            return said.replace(f"[{own}]", f"[{wanted}]"), TURN[wanted] / TURN[own]
    return name, 1.0


def _scaled(item: Item, x: float, y: float, units: dict[str, str]) -> Item:
    factors = {"x": x, "start": x, "end": x, "edges": x, "y": y, "low": y, "high": y}
    # The end of a line is a label.
    changes = {
        name: factors[name] * value
        for name, value in vars(item).items()
        if name in factors and not isinstance(value, str)
    }
    if isinstance(item, Heat):
        name, z = _axis(item.name, units)
        changes |= {"z": z * item.z, "name": name, "range": _times(item.range, z)}
    return replace(item, **changes)


def _times(ends: tuple[float, float] | None, factor: float) -> Any:
    return None if ends is None else (factor * ends[0], factor * ends[1])
