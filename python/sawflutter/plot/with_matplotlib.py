"""Charts drawn with matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from .._extras import extra
from .chart import Area, Bars, Chart, Heat, Item, Label, Line, Panel, Points, Shade, Upright, colours
from .chart import end_labels, is_at_the_top, root_ticks, signed_root

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

# Width of a figure, where those of the program are 1200 units wide.
WIDTH_INCHES = 10.0
MARKERS = {"disc": "o", "ring": "o", "square": "s", "cross": "x"}
FONTS = ["Inter", "Helvetica", "Arial", "DejaVu Sans"]


def draw(chart: Chart, ax: Axes | Sequence[Axes] | None = None) -> Axes:
    """Draws the panels of a chart into a new figure, or into given axes."""
    if ax is not None:
        into: list[Axes] = np.ravel(np.asarray(ax, object)).tolist()
        for own, panel in zip(into, chart.panels):
            _panel(own, panel, last=True)
        return into[0]
    with extra("plot"):
        import matplotlib.pyplot as plt

    panels, together = chart.shown(), chart.together()
    figure, axes = plt.subplots(
        len(panels),
        1,
        figsize=(WIDTH_INCHES, 2.2 + 2.2 * sum(panel.share for panel in panels)),
        height_ratios=[panel.share for panel in panels],
        sharex=together,
        squeeze=False,
        layout="constrained",
    )
    for number, panel in enumerate(panels, start=1):
        _panel(axes[number - 1, 0], panel, last=number == len(panels) or not together)
    ink, quiet = colours()["ink"], colours()["quiet"]
    figure.suptitle(chart.title, x=0.02, ha="left", fontsize=15, fontweight="bold", color=ink)
    # Above the title of the panel, where it has one.
    above = 8 + 15 * len(panels[0].title.splitlines())
    axes[0, 0].annotate(
        "\n".join(chart.lines()), (0.0, 1.0), (0, above), "axes fraction", "offset points", fontsize=10, color=quiet
    )
    if chart.key:
        samples = [_sample(item) for item in chart.key]
        figure.legend(handles=samples, loc="outside lower left", ncols=4, fontsize=9, frameon=False)
    return axes[0, 0]  # type: ignore[no-any-return]


def _sample(item: Item) -> Artist:
    """An entry of the key."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    if isinstance(item, Points):
        return Line2D(
            [], [], color=item.colour, linestyle="", marker=MARKERS[item.shape],
            markerfacecolor="none" if item.shape == "ring" else item.colour, label=item.name,
        )  # fmt: skip
    if isinstance(item, Line | Upright):
        style: Literal["dashed", "solid"] = "dashed" if item.dashed else "solid"
        return Line2D([], [], color=item.colour, linestyle=style, label=item.name)
    colour = item.scale[0] if isinstance(item, Heat) else item.colour
    return Patch(color=colour, label=item.name)


def _panel(ax: Axes, panel: Panel, last: bool) -> None:
    for item in panel.items:
        _add(ax, item, panel)
    _end_labels(ax, panel)
    if panel.note:
        ax.annotate(
            panel.note, (0.01, 0.5), xycoords="axes fraction", va="center", fontsize=9,
            color=colours()["quiet"], backgroundcolor=colours()["paper"],
        )  # fmt: skip
    if panel.x_log:
        ax.set_xscale("log")
    if panel.y_log:
        ax.set_yscale("log")
    if panel.x_range is not None:
        ax.set_xlim(*panel.x_range)
    if panel.y_root and panel.y_range is not None:
        ax.set_yscale("function", functions=(signed_root, lambda root: np.abs(root) * root))
        ax.set_yticks(root_ticks(*panel.y_range))
        ax.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    if panel.y_range is not None:
        ax.set_ylim(*panel.y_range)
    if panel.equal:
        ax.set_aspect("equal")
    if panel.x_names:
        ax.set_xticks(panel.x_ticks, panel.x_names)
        ax.minorticks_off()
    if panel.y_names or not panel.y_name:
        ax.set_yticks([])
    elif panel.y_ticks:
        ax.set_yticks(panel.y_ticks)
    for row, name in zip(panel.y_ticks, panel.y_names):
        ax.annotate(
            name, (0.0, row), (2, 6), ("axes fraction", "data"), "offset points", fontsize=9,
            fontweight="semibold", color=colours()["quiet"],
        )  # fmt: skip
    if last:
        ax.set_xlabel(panel.x_name, color=colours()["ink"])
    ax.set_ylabel(panel.y_name, color=colours()["ink"])
    if panel.title:
        ax.set_title(panel.title, loc="left", fontsize=11, color=colours()["ink"])
    ax.spines[["top", "right"]].set_visible(False)
    ax.spines[["left", "bottom"]].set_color(colours()["quiet"])
    ax.tick_params(colors=colours()["quiet"])
    if not any(isinstance(item, Heat) for item in panel.items):
        ax.grid(axis="y", color=colours()["grid"])
    ax.set_axisbelow(True)


def _add(ax: Axes, item: Item, panel: Panel) -> None:
    if isinstance(item, Shade):
        # The edge keeps a band visible that is narrower than a pixel.
        ax.axvspan(item.start, item.end, color=item.colour, linewidth=0.8, zorder=0.5)
    elif isinstance(item, Upright):
        style: Any = (0, (4, 4)) if item.dashed else "solid"
        ax.axvline(item.x, color=item.colour, linewidth=0.8, linestyle=style, zorder=1.5)
    elif isinstance(item, Area) and item.stepped:
        middles, widths = item.columns()
        ax.bar(
            middles, item.heights(), widths, np.nan_to_num(item.low, nan=1.0), color=item.colour,
            linewidth=0.0, antialiased=False, zorder=0.4, label=item.name,
        )  # fmt: skip
    elif isinstance(item, Area):
        ax.fill_between(
            item.x, item.low, item.high, where=list(item.high >= item.low), color=item.colour,
            linewidth=0.0, zorder=0.4, label=item.name,
        )  # fmt: skip
    elif isinstance(item, Heat):
        _heat(ax, item)
    elif isinstance(item, Bars):
        ax.stairs(item.heights, item.edges, fill=True, color=item.colour, label=item.name)
    elif isinstance(item, Label):
        below = is_at_the_top(item, panel)
        ax.annotate(
            item.name, (item.x, item.y), (0, -5 if below else 5), textcoords="offset points",
            ha="center", va="top" if below else "bottom", fontsize=9, color=item.colour, zorder=4.0,
            annotation_clip=True,
            bbox={"facecolor": colours()["paper"], "alpha": 0.75, "edgecolor": "none", "pad": 0.5},
        )  # fmt: skip
    elif isinstance(item, Points):
        style = {"facecolors": "none"} if item.shape == "ring" else {}
        style |= {"color" if item.shape != "ring" else "edgecolors": item.colour}
        ax.scatter(
            item.x, item.y, s=0.6 * item.size**2, marker=MARKERS[item.shape],
            linewidths=0.9, zorder=3.0, label=item.name, **style,
        )  # fmt: skip
    else:
        style = (0, (4, 2.5)) if item.dashed else "solid"
        width = 0.85 * item.width
        ax.plot(
            item.x, item.y, color=item.colour, linewidth=width, linestyle=style, label=item.name,
            solid_capstyle="butt",
        )


def _end_labels(ax: Axes, panel: Panel) -> None:
    for line, place in end_labels(panel, apart=0.07 / panel.share):
        ax.annotate(
            line.end, (float(line.x[-1]), place), (6, 0), textcoords="offset points",
            va="center", fontsize=9, color=line.colour,
        )  # fmt: skip


def _heat(ax: Axes, item: Heat) -> None:
    from matplotlib.colors import LinearSegmentedColormap, ListedColormap, LogNorm, Normalize

    low, high = item.range or (None, None)
    colours = list(item.scale)
    is_class = len(colours) == 1
    scale = ListedColormap(colours) if is_class else LinearSegmentedColormap.from_list(item.name, colours)
    # On a logarithmic scale, smaller values have the first colour.
    z = np.maximum(item.z, low) if item.log and low is not None else item.z
    norm = LogNorm(low, high) if item.log else Normalize(low, high)
    # A vector file would have a path for each cell.
    mesh = ax.pcolormesh(
        item.x, item.y, np.ma.masked_invalid(z), cmap=scale, norm=norm, shading="nearest", rasterized=True
    )
    if is_class:
        return
    bar = ax.figure.colorbar(mesh, ax=ax, label=item.name)
    bar.outline.set_visible(False)
