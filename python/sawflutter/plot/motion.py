"""A mode in motion on the blade, in the fixed frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from .._entry import FloatArray
from .._extras import extra
from .._report_types import Mode
from ..errors import refused
from .chart import Line, colours

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from plotly.graph_objects import Figure

    from ..scene import Scene

    Animation: TypeAlias = Figure | FuncAnimation
else:
    Animation: TypeAlias = Any

# Points along the radius and around the blade.
GRID = (16, 121)
# Height of the largest deflection, as a share of the radius.
HEIGHT = 0.25
# Time between two frames.
INTERVAL_MS = 50


def animate(
    saw: Scene, mode: Mode, *, backend: Literal["plotly", "matplotlib"] = "plotly", frames: int = 48
) -> Animation:
    """One period of a mode; growth is left out. See :meth:`sawflutter.Scene.animate`."""
    if backend not in ("plotly", "matplotlib"):
        raise ValueError(f"backend must be 'plotly' or 'matplotlib' (you gave {backend!r})")
    if frames < 2:
        raise ValueError(f"frames must be at least 2 (you gave {frames}); 48 is usual")
    if not isinstance(mode, Mode):
        said = "one mode at a speed, like saw.modes(1800)[0]"
        raise refused("mode", type(mode), said, "modes at rest and tables of modes do not move")
    pads, radii = _outlines(saw)
    if not np.allclose(mode.radius_m[[0, -1]], radii, rtol=1e-9):
        raise refused("mode", mode.name, "a mode of this saw", "compute it with the modes of the same scene")
    radius, theta = grid(mode)
    pictures = deflections(mode, radius, theta, frames)
    title = f"{mode.name}, {mode.direction}<br>{mode.rpm:.0f} rpm, {mode.frequency_hz:.2f} Hz"
    if mode.growth_per_s > 0.0:
        title += f", grows by {mode.growth_per_s:.3g} 1/s"
    if backend == "plotly":
        return _plotly(pads, radius, theta, pictures, title)
    return _matplotlib(pads, radius, theta, pictures, title.replace("<br>", "\n"))


def _outlines(saw: Scene) -> tuple[list[Line], list[float]]:
    """Closed outlines of the guides, and inner and outer radius of the part of the blade that moves."""
    lines = [item for item in saw.chart().panels[0].items if isinstance(item, Line)]
    radii = {line.name: float(line.x[0]) for line in lines}
    pads = [line for line in lines if line.name.startswith("guides[")]
    return pads, [radii.get("collar", radii["bore"]), radii["rim"]]


def grid(mode: Mode) -> tuple[FloatArray, FloatArray]:
    """Radii and angles at which a mode is drawn, each of the shape (radii, angles)."""
    radii = np.linspace(mode.radius_m[0], mode.radius_m[-1], GRID[0])
    angles = np.linspace(0.0, 2.0 * np.pi, GRID[1])
    radius, theta = np.meshgrid(radii, angles, indexing="ij")
    return radius, theta


def deflections(mode: Mode, radius: FloatArray, theta: FloatArray, frames: int) -> FloatArray:
    """Deflections over one period, of the shape (frames, radii, angles), the largest of them 1."""
    shape = mode.shape(radius, np.degrees(theta))
    turns = np.exp(2j * np.pi * np.arange(frames) / frames)
    moving: FloatArray = (turns[:, None, None] * shape).real
    largest = float(np.max(np.abs(moving)))
    return moving / largest if largest > 0.0 else moving


def _scale() -> list[str]:
    return [colours()["backward"], colours()["paper"], colours()["forward"]]


def _plotly(
    pads: list[Line], radius: FloatArray, theta: FloatArray, pictures: FloatArray, title: str
) -> Figure:
    with extra("plot"):
        import plotly.graph_objects as go

    x, y = radius * np.cos(theta), radius * np.sin(theta)
    height = HEIGHT * float(radius[-1, 0])
    scale = [[place / 2.0, colour] for place, colour in enumerate(_scale())]

    def surface(w: FloatArray) -> Any:
        return go.Surface(
            x=x, y=y, z=height * w, surfacecolor=w, cmin=-1.0, cmax=1.0, colorscale=scale,
            showscale=False, hoverinfo="skip",
        )  # fmt: skip

    steps = [go.Frame(data=[surface(w)], name=str(k), traces=[0]) for k, w in enumerate(pictures)]
    outlines = [
        go.Scatter3d(
            x=pad.x, y=pad.y, z=np.zeros(len(pad.x)), mode="lines", name="guide",
            line={"color": colours()["ink"], "width": 4}, hoverinfo="name",
        )
        for pad in pads
    ]  # fmt: skip
    play: dict[str, Any] = {
        "frame": {"duration": INTERVAL_MS},
        "fromcurrent": True,
        "mode": "immediate",
    }
    stop: dict[str, Any] = {"frame": {"duration": 0}, "mode": "immediate"}
    buttons = [
        {"label": "Play", "method": "animate", "args": [None, play]},
        {"label": "Stop", "method": "animate", "args": [[None], stop]},
    ]
    axis = {"visible": False}
    return go.Figure(
        data=[surface(pictures[0]), *outlines],
        frames=steps,
        layout={
            "title": {"text": title, "x": 0.02},
            "scene": {"xaxis": axis, "yaxis": axis, "zaxis": {**axis, "range": [-height, height]},
                      "aspectmode": "data"},
            "updatemenus": [{"type": "buttons", "buttons": buttons, "direction": "left", "x": 0.02,
                             "y": 0.0, "xanchor": "left"}],
            "showlegend": False,
        },
    )  # fmt: skip


def _matplotlib(
    pads: list[Line], radius: FloatArray, theta: FloatArray, pictures: FloatArray, title: str
) -> FuncAnimation:
    with extra("plot"):
        import matplotlib.pyplot as plt
        from matplotlib.animation import FuncAnimation
        from matplotlib.colors import LinearSegmentedColormap

    figure, ax = plt.subplots(figsize=(6.0, 6.4), layout="constrained")
    scale = LinearSegmentedColormap.from_list("deflection", _scale())
    x, y = radius * np.cos(theta), radius * np.sin(theta)
    mesh = ax.pcolormesh(x, y, pictures[0], cmap=scale, vmin=-1.0, vmax=1.0, shading="gouraud")
    for pad in pads:
        ax.plot(pad.x, pad.y, color=colours()["ink"], linewidth=1.5)
    ax.set_aspect("equal")
    ax.set_axis_off()
    ax.set_title(title, loc="left", fontsize=11, color=colours()["ink"])

    def show(frame: int) -> tuple[Any, ...]:
        mesh.set_array(pictures[frame].ravel())
        return (mesh,)

    return FuncAnimation(figure, show, frames=len(pictures), interval=INTERVAL_MS, blit=False)
