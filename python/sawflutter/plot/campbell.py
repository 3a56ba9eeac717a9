"""The Campbell diagram and root loci."""

from __future__ import annotations

import numpy as np

from .._entry import BoolArray, FloatArray, IntArray
from .._methods import NEGLIGIBLE_PER_S
from .._report_types import Branch, CampbellReport, Direction, Instability
from .chart import CURVE, STRONG_CURVE, Chart, Item, Line, Panel, Points, Shade, Upright, colours

LOWEST_BRANCHES = 6
HEADROOM = 1.1
# Narrower bands, as a share of the axis, get a stronger colour.
NARROW = 0.004


def campbell(r: CampbellReport, facts: str) -> Chart:
    """Frequencies over speed, growth rates below."""
    speeds = (r.campbell.from_rpm, r.campbell.to_rpm)
    marks: list[Item] = [*bands(r, speeds), *_uprights(r)]
    upper = Panel(
        x_name="rotation speed Ω [rpm]",
        y_name="Im λ / 2π [Hz]",
        items=[*marks, *_branches(r), *_excitation(r), *_measured(r), _critical(r)],
        x_range=speeds,
        y_range=(0.0, highest_shown_hz(r)),
        share=2.0,
        harmonics=True,
    )
    growth, range_per_s = _growth(r)
    lower = Panel(
        x_name="rotation speed Ω [rpm]",
        y_name="Re λ [1/s], square root scale",
        items=[*marks, *growth],
        x_range=speeds,
        y_range=range_per_s,
        y_root=True,
    )
    # Where a line leaves the panel above, there is no room for its name.
    lines = [line.name for line in r.excitation.lines] if r.excitation else []
    facts = "; ".join([facts, *([f"lines {', '.join(lines)}"] if lines else [])])
    return Chart(r.scene["name"], facts, (upper, lower))


def colour_of(direction: Direction) -> str:
    """Blue forward, red backward, grey standing; a reflected wave is a backward one."""
    return colours()["backward" if direction == "reflected" else direction]


def bands(r: CampbellReport, speeds: tuple[float, float]) -> list[Shade]:
    """Bands of instability, narrow ones in a stronger colour and on top."""
    found = []
    for band in r.instabilities:
        narrow = band.to_rpm - band.from_rpm < NARROW * (speeds[1] - speeds[0])
        colour = colours()[f"{band.kind}_{'streak' if narrow else 'shade'}"]
        name = f"{band.kind} {band.from_rpm:.0f}–{band.to_rpm:.0f} rpm"
        found.append((narrow, Shade(band.from_rpm, band.to_rpm, colour, name)))
    return [shade for _, shade in sorted(found, key=lambda pair: pair[0])]


def highest_shown_hz(r: CampbellReport) -> float:
    """High enough for the lowest branches, reflected waves, bands and measured points."""
    first = r.campbell.from_rpm
    at_first = (b for b in r.campbell.branches if len(b.rpm) and b.rpm[0] == first)
    starts = sorted(branch.frequency_hz[0] for branch in at_first)
    wanted = [*starts[:LOWEST_BRANCHES], *(band.frequency_hz for band in r.instabilities)]
    for branch in r.campbell.branches:
        wanted += branch.frequency_hz[branch.krein_sign < 0].tolist()
    measured = r.scene.get("measured")
    for row in measured["rows"] if measured else []:
        wanted += [hz for hz in row["frequencies_hz"] if hz is not None]
    top = HEADROOM * max(wanted, default=0.0)
    complete = r.campbell.complete_to_hz
    top = min(top, complete) if complete > 0.0 else top
    return top if top > 0.0 else 1.0


def _uprights(r: CampbellReport) -> list[Upright]:
    quiet = colours()["divergence"]
    lines = [Upright(c.rpm, quiet, name=f"critical {c.rpm:.0f} rpm, {c.name}") for c in r.critical_speeds]
    if r.operating is not None:
        rpm = r.operating.rpm
        lines.append(Upright(rpm, colours()["ink"], dashed=False, name=f"operating {rpm:.0f} rpm"))
    return lines


def _hover(branch: Branch) -> list[str]:
    values = (branch.rpm, branch.frequency_hz, branch.growth_per_s, branch.krein_sign)
    signs = {1: "+1", -1: "−1, reflected", 0: "none"}
    return [
        f"{branch.name}, {direction}<br>{rpm:.1f} rpm<br>{hz:.3f} Hz<br>growth {growth:.3g} 1/s"
        f"<br>Krein sign {signs[int(sign)]}"
        for rpm, hz, growth, sign, direction in zip(*values, branch.direction)
    ]


def _branches(r: CampbellReport) -> list[Item]:
    """Solid where a wave has positive energy, dashed where reflected, thick where unstable."""
    items: list[Item] = []
    last = r.campbell.to_rpm
    # From the highest down, so that the lowest branches lie on top.
    for branch in reversed(r.campbell.branches):
        hover = _hover(branch)
        if len(branch.rpm) == 1:
            colour = colour_of(branch.direction[0])
            items.append(Points(branch.rpm, branch.frequency_hz, colour, branch.name, hover=hover))
            continue
        looks = _looks(r, branch)
        for look in dict.fromkeys(looks):
            stretch, colour = look
            places = _stretches(np.array([other == look for other in looks]))
            x, y = (_picked(values, places) for values in (branch.rpm, branch.frequency_hz))
            said = [hover[place] if place >= 0 else "" for place in places]
            end = branch.label if look == looks[-1] and branch.rpm[-1] == last else ""
            width = STRONG_CURVE if stretch == "unstable" else CURVE
            dashed = stretch == "reflected"
            items.append(Line(x, y, colour, branch.name, width, dashed, said, end))
    return items


def _looks(r: CampbellReport, branch: Branch) -> list[tuple[str, str]]:
    """What each segment of a branch looks like: what it is, and its colour."""
    grows = branch.growth_per_s > NEGLIGIBLE_PER_S
    reflected = branch.krein_sign == -1
    middle = (branch.rpm[:-1] + branch.rpm[1:]) / 2.0
    within = np.zeros(len(middle), bool)
    for band in r.instabilities:
        within |= (band.from_rpm <= middle) & (middle <= band.to_rpm)
    unstable = within & (grows[:-1] | grows[1:])
    dashed = reflected[:-1] | reflected[1:]
    looks = np.where(unstable, "unstable", np.where(dashed, "reflected", "plain"))
    # Guides let waves stand at rest, whatever they do from there on: the end of a segment counts.
    runs = (colour_of(direction) for direction in branch.direction[1:])
    return list(zip(looks.tolist(), runs))


def _stretches(
    chosen: BoolArray,
) -> IntArray:
    """Places of the ends of the chosen segments, −1 between stretches."""
    places: list[int] = []
    for segment in np.flatnonzero(chosen):
        if places and places[-1] == segment:
            places.append(int(segment) + 1)
        else:
            places += [-1] * bool(places) + [int(segment), int(segment) + 1]
    return np.array(places, dtype=np.int64)


def _picked(
    values: FloatArray,
    places: IntArray,
) -> FloatArray:
    return np.where(places >= 0, values[np.maximum(places, 0)], np.nan)


def _excitation(r: CampbellReport) -> list[Item]:
    """Lines at multiples of the rotation speed, and where they cross the branches."""
    if r.excitation is None:
        return []
    quiet, items = colours()["quiet"], list[Item]()
    speeds = np.array([r.campbell.from_rpm, r.campbell.to_rpm])
    top = highest_shown_hz(r)
    for line in r.excitation.lines:
        # A line ends where it leaves the panel.
        rpm = np.minimum(speeds, 60.0 * top / line.order)
        if rpm[0] < rpm[1]:
            hover = [f"{line.name}<br>{at:.1f} rpm" for at in rpm]
            end = line.name if rpm[1] == speeds[1] else ""
            items.append(
                Line(rpm, line.order * rpm / 60.0, quiet, line.name, 1.0, True, hover, end)
            )
    found = r.excitation.crossings
    hover = [
        f"{c.order}× crosses {c.mode}<br>{c.rpm:.1f} rpm<br>{c.frequency_hz:.3f} Hz" for c in found
    ]
    x, y = (
        np.array(values, float)
        for values in ([c.rpm for c in found], [c.frequency_hz for c in found])
    )
    return [*items, Points(x, y, quiet, "crossing", hollow=True, size=5.0, hover=hover)]


def _measured(r: CampbellReport) -> list[Item]:
    measured = r.scene.get("measured")
    if not measured:
        return []
    rows = ((row["rpm"], hz) for row in measured["rows"] for hz in row["frequencies_hz"])
    pairs = [(rpm, hz) for rpm, hz in rows if hz is not None]
    x, y = np.array(pairs, float).reshape(-1, 2).T
    hover = [f"{measured['source']}<br>{rpm:.0f} rpm<br>{hz:g} Hz" for rpm, hz in pairs]
    return [Points(x, y, colours()["ink"], measured["source"], hollow=True, hover=hover)]


def _critical(r: CampbellReport) -> Points:
    speeds = np.array([critical.rpm for critical in r.critical_speeds])
    hover = [f"critical speed {rpm:.1f} rpm" for rpm in speeds]
    return Points(speeds, np.zeros(len(speeds)), colours()["ink"], "critical speed", hover=hover)


def _growth(r: CampbellReport) -> tuple[list[Item], tuple[float, float]]:
    """Growth rates; of an undamped saw within the bands alone, for each has a mirror image."""
    damped = any("damping" in term for term in r.terms)
    items: list[Item] = []
    if damped:
        for branch in r.campbell.branches:
            colour = colour_of(branch.direction[-1])
            hover = _hover(branch)
            items.append(Line(branch.rpm, branch.growth_per_s, colour, branch.name, hover=hover))
    for band in r.instabilities:
        colour = colours()[band.kind]
        x, y = _band_growth(r, band)
        hover = [f"{band.kind}<br>{rpm:.1f} rpm<br>{growth:.3g} 1/s" for rpm, growth in zip(x, y)]
        if not damped:
            items.append(Line(x, y, colour, band.kind, hover=hover))
        peak = (
            f"{band.kind} of {band.name}<br>largest growth "
            f"{band.peak_growth_per_s:.3g} 1/s<br>{band.peak_rpm:.1f} rpm<br>{band.frequency_hz:.2f} Hz"
        )
        at = (np.array([band.peak_rpm]), np.array([band.peak_growth_per_s]))
        items.append(Points(*at, colour, band.kind, hover=[peak]))
    top = max([band.peak_growth_per_s for band in r.instabilities], default=NEGLIGIBLE_PER_S)
    top = max(top, NEGLIGIBLE_PER_S)
    decay = [float(-np.min(b.growth_per_s)) for b in r.campbell.branches if len(b.rpm)]
    low = -min(max(decay, default=0.0), 4.0 * top) if damped else 0.0
    return items, (1.15 * low, 1.15 * top)


def _band_growth(r: CampbellReport, band: Instability) -> tuple[FloatArray, FloatArray]:
    """Growth within a band: from zero at its edges, through the growing branch and the peak."""
    first, last = r.campbell.from_rpm, r.campbell.to_rpm
    points = {band.peak_rpm: band.peak_growth_per_s}
    for number in band.branches:
        branch = r.campbell.branches[number - 1]
        inside = (band.from_rpm < branch.rpm) & (branch.rpm < band.to_rpm)
        for rpm, growth in zip(branch.rpm[inside], branch.growth_per_s[inside]):
            if growth > 0.0:
                points[float(rpm)] = max(points.get(float(rpm), 0.0), float(growth))
    for edge in (band.from_rpm, band.to_rpm):
        if band.closed or first < edge < last:
            points[edge] = 0.0
    rows = np.array(sorted(points.items()))
    return rows[:, 0], rows[:, 1]


def root_loci(r: CampbellReport) -> Chart:
    """The two modes that meet at the flutter speed, in the complex plane."""
    loci = r.root_loci
    if loci is None:
        return Chart(r.scene["name"], "no two modes meet within the sweep")
    items: list[Item] = []
    for path, name in zip(loci.paths, ("forward", "backward")):
        rows = zip(loci.rpm, path.frequency_hz, path.growth_per_s)
        hover = [
            f"{path.name}<br>{rpm:.1f} rpm<br>{hz:.3f} Hz<br>{growth:.3g} 1/s"
            for rpm, hz, growth in rows
        ]
        items.append(
            Line(path.growth_per_s, path.frequency_hz, colours()[name], path.name, hover=hover)
        )
    panel = Panel("Re λ [1/s]", "Im λ / 2π [Hz]", [Upright(0.0, colours()["quiet"]), *items])
    facts = f"{loci.rpm[0]:.0f} to {loci.rpm[-1]:.0f} rpm, flutter from {loci.onset_rpm:.1f} to {loci.end_rpm:.1f} rpm"
    return Chart(r.scene["name"], facts, (panel,))
