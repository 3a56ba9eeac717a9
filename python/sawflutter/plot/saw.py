"""The saw in axial view."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _native
from .._entry import FloatArray
from .chart import Chart, Item, Line, Panel, Points, colours

if TYPE_CHECKING:
    from ..scene import Scene

# Arcs, in degrees: the cut where the scene gives no number of teeth in it, and the arrow of the
# rotation.
CUT_DEG = 12.0
ARROW_DEG = (20.0, 60.0)


def saw(scene: Scene) -> Chart:
    """Blade, guides, cut and probe, and the positive directions of angles and rotation."""
    blade, ink, quiet = scene.blade, colours()["ink"], colours()["quiet"]
    rim, bore = blade["outer_diameter_m"] / 2.0, blade["inner_diameter_m"] / 2.0
    items: list[Item] = [_arc(rim, 0.0, 360.0, ink, "rim"), _arc(bore, 0.0, 360.0, ink, "bore")]
    mount: Mapping[str, Any] = scene.mount or {}
    if "diameter_m" in mount:
        items.append(_arc(mount["diameter_m"] / 2.0, 0.0, 360.0, quiet, "collar"))
    for place, (x, y) in enumerate(pads(scene)):
        guide = scene.guides[place]
        said = (
            f"guides[{place}]<br>{1e3 * guide['radius_m']:.4g} mm, {guide['angle_deg']:g}°"
            f"<br>{guide['stiffness_n_per_m']:.4g} N/m"
        )
        items.append(Line(x, y, colours()["forward"], f"guides[{place}]", hover=[said] * len(x)))
    if scene.cut is not None:
        middle = float(scene.cut.get("angle_deg", 0.0))
        teeth, of = scene.cut.get("teeth_in_cut"), blade.get("teeth")
        depth_m = scene.cut.get("depth_m")
        if teeth and of:
            half = 180.0 * teeth / of
        else:
            half = np.degrees(depth_m / rim) / 2.0 if depth_m else CUT_DEG / 2.0
        ends = (middle - half, middle + half)
        items.append(_arc(rim, *ends, colours()["alarm"], "cut", width=4.0, end="cut"))
    probe: Mapping[str, Any] = scene.to_dict().get("probe") or {}
    if "angle_deg" in probe:
        x, y = _points(probe.get("radius_m") or rim, probe["angle_deg"])
        items.append(Points(x, y, colours()["backward"], "probe"))
    radius = 1.08 * rim
    items.append(_arc(radius, *ARROW_DEG, quiet, "rotation", end="rotation, positive angles"))
    tip = np.array([ARROW_DEG[1] - 4.0, ARROW_DEG[1], ARROW_DEG[1] - 4.0])
    head = np.array([0.97, 1.0, 1.03]) * radius
    items.append(Line(*_points(head, tip), quiet, "rotation"))
    frame = (-1.2 * rim, 1.2 * rim)
    panel = Panel("x [m], angle 0 to the right", "y [m]", items, frame, frame, equal=True)
    facts = f"{1e3 * blade['outer_diameter_m']:.6g} mm outside, {len(scene.guides)} guides"
    return Chart(scene.name, facts, (panel,))


def pads(scene: Scene) -> list[tuple[FloatArray, FloatArray]]:
    """Closed outlines of the guides."""
    corners = [np.array(outline) for outline in _native.outlines(scene.to_json())]
    closed = [np.vstack([outline, outline[:1]]) for outline in corners]
    return [(outline[:, 0], outline[:, 1]) for outline in closed]


def _points(radius_m: Any, angle_deg: Any) -> tuple[FloatArray, FloatArray]:
    angle = np.radians(np.atleast_1d(np.asarray(angle_deg, float)))
    return radius_m * np.cos(angle), radius_m * np.sin(angle)


def _arc(
    radius_m: float, begin: float, end_deg: float, colour: str, name: str, **look: Any
) -> Line:
    x, y = _points(radius_m, np.linspace(begin, end_deg, 181))
    return Line(x, y, colour, name, **look)
