"""Root loci."""

from __future__ import annotations

from .._report_types import CampbellReport, Direction
from .chart import Chart, Item, Line, Panel, Upright, colours


def colour_of(direction: Direction) -> str:
    """Blue forward, red backward, grey standing; a reflected wave is a backward one."""
    return colours()["backward" if direction == "reflected" else direction]


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
