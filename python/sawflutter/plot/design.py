"""Charts of checks, fits, places and studies, and of run time against accuracy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .._entry import FloatArray, array
from .._report_types import CheckReport, FitReport, PlaceReport, Setting, Speed, StudyReport
from .._values import unit
from .chart import (
    STRONG_CURVE,
    Bars,
    Chart,
    Heat,
    Item,
    Line,
    Panel,
    Points,
    Upright,
    colours,
    shade,
)

if TYPE_CHECKING:
    from ..designs import StiffnessMap


def named(path: str) -> str:
    """The path of a number as the name of an axis, with its unit.

    >>> named("guides[0].radius_m")
    'guides[0].radius [m]'
    """
    before, dot, key = path.rpartition(".")
    name, found = unit(key)
    shown = f" [{found.replace('**3', '³').replace('*', '·').replace('deg', '°')}]" if found else ""
    return f"{before}{dot}{name}".replace("_", " ") + shown


def check(r: CheckReport, facts: str) -> Chart:
    """The required speed of each limit (line) and the computed one (dot)."""
    items: list[Item] = []
    for band in r.instabilities:
        if band.peak_growth_per_s >= r.flutter_threshold_per_s or band.kind == "divergence":
            items.append(shade(band))
    items.append(
        Upright(r.operating_rpm, colours()["ink"], False, f"operating {r.operating_rpm:.0f} rpm")
    )
    for place, criterion in enumerate(reversed(r.criteria), start=1):
        word = "kept" if criterion.passed else "NOT kept"
        colour = colours()["forward" if criterion.passed else "alarm"]
        level = np.full(2, float(place))
        rpm = array([criterion.asked_rpm, criterion.found_rpm])
        said = [
            f"{criterion.name}: {name} {of:.1f} rpm, {word}"
            for name, of in zip(("asked", "found"), rpm)
        ]
        ink = colours()["ink"]
        items.append(Points(rpm[:1], level[:1], ink, "asked", hollow=True, hover=said[:1]))
        if criterion.found_rpm is not None:
            items.append(Line(rpm, level, colour, criterion.name))
            items.append(Points(rpm[1:], level[1:], colour, criterion.name, hover=said[1:]))
    names = [criterion.name for criterion in reversed(r.criteria)]
    limits = (0.0, len(names) + 1.0)
    panel = Panel("rotation speed [rpm]", "", items, y_range=limits, y_names=names)
    return Chart(r.scene["name"], facts, (panel,))


def fit(r: FitReport, facts: str) -> Chart:
    """Measured frequencies over the computed ones, before and after, with the residuals below."""
    items: list[Item] = []
    for values, colour, dashed, name in (
        (r.curves.before_hz, colours()["standing"], True, "before"),
        (r.curves.fitted_hz, colours()["forward"], False, "fitted"),
    ):
        for place, column in enumerate(values.T, start=1):
            items.append(
                Line(r.curves.rpm, column, colour, f"{name}, frequency {place}", dashed=dashed)
            )
    rows = [(s.rpm, s.measured_hz, s.fitted_hz - s.measured_hz, s.fitted) for s in r.residuals]
    table = np.array(rows, float).reshape(-1, 4)
    hover = [
        f"{rpm:.0f} rpm<br>{hz:g} Hz measured<br>{off:+.2f} Hz computed"
        for rpm, hz, off, _ in table
    ]
    items.append(
        Points(table[:, 0], table[:, 1], colours()["ink"], r.source, hollow=True, hover=hover)
    )
    left: list[Item] = [
        Line(
            np.array([table[:, 0].min(initial=0.0), table[:, 0].max(initial=1.0)]),
            np.zeros(2),
            colours()["quiet"],
            width=1.0,
        ),
        Points(
            table[:, 0], table[:, 2], colours()["forward"], "computed minus measured", hover=hover
        ),
    ]
    name = "rotation speed Ω [rpm]"
    upper = Panel(name, "frequency [Hz]", items, share=2.0, harmonics=True)
    return Chart(r.scene["name"], facts, (upper, Panel(name, "computed − measured [Hz]", left)))


def place(r: PlaceReport, facts: str) -> Chart:
    """The goal over one or two numbers, with the best saw marked."""
    found = r.map
    if found is None:
        return Chart(r.scene["name"], f"{facts}; no map was asked for")
    goal = "flutter speed [rpm]" if r.goal == "flutter_speed" else "stable window [rpm]"
    values = {parameter.path: parameter.value for parameter in r.parameters}
    kept = np.where(found.kept, found.goal_rpm, np.nan)
    x = np.array([values.get(found.x_path, np.nan)])
    said = [f"best saw: {r.best.goal_rpm:.0f} rpm"]
    if found.y_path is None:
        best = Points(x, np.array([r.best.goal_rpm]), colours()["alarm"], "best saw", hover=said)
        line = Line(found.x, kept[0], colours()["forward"], goal)
        panel = Panel(named(found.x_path), goal, [line, best])
    else:
        y = np.array([values.get(found.y_path, np.nan)])
        best = Points(x, y, colours()["alarm"], "best saw", hover=said)
        items: list[Item] = [Heat(found.x, found.y, kept, goal), *_fragile(r), best]
        panel = Panel(named(found.x_path), named(found.y_path), items)
    return Chart(r.scene["name"], facts, (panel,))


def _fragile(r: PlaceReport) -> list[Item]:
    """The saw that is better than the best one without tolerances, on a map of two numbers."""
    found, fragile = r.map, r.fragile_optimum
    if found is None or fragile is None or fragile.saw.outcome is None:
        return []
    values = dict(zip((p.path for p in r.parameters), fragile.saw.values, strict=True))
    x, y = (np.array([values.get(path or "", np.nan)]) for path in (found.x_path, found.y_path))
    said = [f"by itself {fragile.saw.outcome.goal_rpm:.0f} rpm, fragile"]
    return [Points(x, y, colours()["quiet"], "better nominally, fragile", hover=said)]


def tradeoff(settings: Sequence[Setting], name: str) -> Chart:
    """Computing time against true error."""
    shades = {"reduced": "forward", "dense": "backward", "critical_speeds": "divergence"}
    items: list[Item] = []
    for method in dict.fromkeys(setting.method for setting in settings):
        own = sorted((s for s in settings if s.method == method), key=lambda s: s.error)
        x, y = np.array([s.error for s in own]), np.array([s.seconds for s in own])
        said = [
            f"{method.replace('_', ' ')}<br>{s.functions} functions, {s.speeds} speeds<br>{1e3 * s.seconds:.1f} ms<br>error {s.error:.2g}"
            for s in own
        ]
        colour = colours()[shades.get(method, "standing")]
        items.append(Points(x, y, colour, method.replace("_", " "), hover=said))
    front = sorted((s for s in settings if s.on_front), key=lambda s: s.error)
    x, y = np.array([s.error for s in front]), np.array([s.seconds for s in front])
    items.append(Line(x, y, colours()["forward"], "best at their price", width=1.0))
    panel = Panel("true relative error", "time [s]", items, x_log=True, y_log=True)
    return Chart(
        name or "Time against accuracy", "true error of critical speeds and onsets", (panel,)
    )


def study(r: StudyReport, facts: str) -> Chart:
    """Saws by their lowest critical and their flutter speed."""
    asked = {} if r.all.passing is None else {c.key: c.asked_rpm for c in r.all.passing.criteria}
    panels = []
    for speed, colour, name, keys in (
        (
            r.all.lowest_critical,
            "forward",
            "lowest critical speed [rpm]",
            ("margin", "min_critical"),
        ),
        (r.all.flutter, "flutter_streak", "flutter speed [rpm]", ("min_flutter",)),
    ):
        limits = [
            Upright(asked[key], colours()["alarm"], name=f"asked {asked[key]:.0f} rpm")
            for key in keys
            if key in asked
        ]
        panels.append(Panel(name, "saws", [*_histogram(speed, colours()[colour]), *limits]))
    if r.reliability is not None:
        curve = r.reliability.curve
        x, y = np.array([p.operating_rpm for p in curve]), np.array([p.share for p in curve])
        name = f"up to {r.reliability.margin:g} of the lowest critical speed, and no flutter"
        line = Line(x, 1e2 * y, colours()["forward"], name)
        panels.append(Panel("operating speed [rpm]", "saws that can be run [%]", [line]))
    return Chart(r.study["name"], facts, tuple(panels))


def _histogram(speed: Speed, colour: str) -> list[Any]:
    bars = speed.histogram
    if bars is None:
        return []
    edges = np.linspace(bars.from_rpm, bars.to_rpm, len(bars.counts) + 1)
    quantiles = [
        Upright(q.rpm, colours()["quiet"], name=f"{1e2 * q.share:g} % below {q.rpm:.0f} rpm")
        for q in speed.quantiles
        if q.rpm is not None and q.share in (0.05, 0.5, 0.95)
    ]
    return [Bars(edges, bars.counts.astype(float), colour, f"{speed.saws} saws"), *quantiles]


def grid(r: StudyReport, rows: FloatArray, names: tuple[str, str], speed: str) -> Chart:
    """A speed over the two numbers of a grid; rows of both and of the speed."""
    x, y = np.unique(rows[:, 0]), np.unique(rows[:, 1])
    z = np.full((len(y), len(x)), np.nan)
    for row, column in ((row, column) for row in range(len(y)) for column in range(len(x))):
        of = rows[(rows[:, 0] == x[column]) & (rows[:, 1] == y[row]), 2]
        # The median represents several random saws of one point of the grid.
        z[row, column] = np.median(of) if len(of) else np.nan
    label = speed.removesuffix("_rpm").replace("_", " ") + " speed [rpm]"
    panel = Panel(named(names[0]), named(names[1]), [Heat(x, y, z, label)])
    return Chart(r.study["name"], label, (panel,))


def stiffness(of: StiffnessMap) -> Chart:
    """Critical speeds and flutter speed over the stiffness of the guides."""
    x = of.stiffness_n_per_m
    items: list[Item] = [
        Line(x, column, colours()["forward"], f"critical speed {place}")
        for place, column in enumerate(of.critical_rpm.T, start=1)
    ]
    items.append(Line(x, of.flutter_rpm, colours()["flutter"], "flutter speed", STRONG_CURVE))
    panel = Panel("stiffness of each guide [N/m]", "rotation speed [rpm]", items, x_log=True)
    return Chart(of.name, "critical speeds (thin) and flutter speed (thick)", (panel,))
