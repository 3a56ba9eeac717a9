"""Charts drawn with plotly."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._extras import extra
from .chart import (
    Bars,
    Chart,
    Heat,
    Item,
    Line,
    Panel,
    Points,
    Shade,
    Upright,
    colours,
    end_labels,
    root_ticks,
)

if TYPE_CHECKING:
    from plotly.graph_objects import Figure


def draw(chart: Chart) -> Figure:
    """A figure with the panels of a chart, one above the other."""
    with extra("plot"):
        import plotly.graph_objects as go
        from plotly.subplots import make_subplots

    panels = chart.panels or (Panel("", "", ()),)
    figure = make_subplots(
        rows=len(panels),
        cols=1,
        row_heights=[panel.share for panel in panels],
        shared_xaxes=len({panel.x_name for panel in panels}) == 1,
        vertical_spacing=0.05 if len({panel.x_name for panel in panels}) == 1 else 0.14,
        subplot_titles=[panel.title for panel in panels] if any(p.title for p in panels) else None,
    )
    for row, panel in enumerate(panels, start=1):
        for item in panel.items:
            _add(go, figure, item, panel, row)
        for line, place in end_labels(panel, apart=0.08 / panel.share):
            figure.add_annotation(
                x=float(line.x[-1]), y=place, text=line.end, font={"color": line.colour, "size": 12},
                showarrow=False, xanchor="left", xshift=6, row=row, col=1,
            )  # fmt: skip
        _axes(figure, panel, row, last=row == len(panels))
    facts = f"<br><span style='font-size:13px;color:{colours()['quiet']}'>{'<br>'.join(chart.lines())}</span>"
    figure.update_layout(
        title={
            "text": f"<b>{chart.title}</b>{facts}", "x": 0.02, "font": {"size": 20},
            "y": 1.0, "yanchor": "top", "pad": {"t": 16},
        },
        template="simple_white",
        font={
            "family": "Inter, Helvetica, Arial, sans-serif",
            "color": colours()["ink"],
            "size": 13,
        },
        hovermode="closest",
        showlegend=False,
        height=320 + 240 * len(panels),
        margin={
            "r": 190 if any(end_labels(panel, 0.0) for panel in panels) else 40,
            # Title, facts and the title of the panel, one above the other.
            "t": 56 + 18 * len(chart.lines()) + 24 * bool(panels[0].title),
        },
    )  # fmt: skip
    return figure


def _scaled(values: Any, panel: Panel) -> Any:
    """Places on the y axis."""
    values = np.asarray(values, float)
    return np.sign(values) * np.sqrt(np.abs(values)) if panel.y_root else values


def _add(go: Any, figure: Figure, item: Item, panel: Panel, row: int) -> None:
    at = {"row": row, "col": 1}
    # Plotly leaves out what is drawn into panels that are still empty, and its template draws the
    # rest with an opacity of 30 %, which narrow bands are not seen with.
    opaque = {**at, "exclude_empty_subplots": False, "opacity": 1.0}
    if isinstance(item, Shade):
        figure.add_vrect(
            item.start, item.end, fillcolor=item.colour, line_width=0, layer="below", **opaque
        )
    elif isinstance(item, Upright):
        dash = "dash" if item.dashed else "solid"
        figure.add_vline(item.x, line={"color": item.colour, "width": 1, "dash": dash}, **opaque)
    elif isinstance(item, Heat):
        low, high = item.range or (None, None)
        scale = [[k / (len(item.scale) - 1), colour] for k, colour in enumerate(item.scale)]
        figure.add_trace(
            go.Heatmap(
                x=item.x, y=item.y, z=item.z, zmin=low, zmax=high, colorscale=scale,
                colorbar={"title": item.name}, name=item.name,
            ),
            **at,
        )  # fmt: skip
    elif isinstance(item, Bars):
        centres, widths = (item.edges[:-1] + item.edges[1:]) / 2.0, np.diff(item.edges)
        bar = go.Bar(
            x=centres, y=item.heights, width=widths, marker_color=item.colour, name=item.name
        )
        figure.add_trace(bar, **at)
    else:
        figure.add_trace(_curve(go, item, panel), **at)


def _curve(go: Any, item: Line | Points, panel: Panel) -> Any:
    said: dict[str, Any] = {"hoverinfo": "name"}
    if item.hover:
        said = {"text": list(item.hover), "hovertemplate": "%{text}<extra></extra>"}
    shared = {"x": item.x, "y": _scaled(item.y, panel), "name": item.name, **said}
    if isinstance(item, Points):
        symbol = "circle-open" if item.hollow else "circle"
        marker = {"color": item.colour, "size": item.size, "symbol": symbol}
        return go.Scatter(mode="markers", marker=marker, **shared)
    line = {"color": item.colour, "width": item.width, "dash": "dash" if item.dashed else "solid"}
    return go.Scatter(mode="lines", line=line, **shared)


def _axes(figure: Figure, panel: Panel, row: int, last: bool) -> None:
    quiet = {"linecolor": colours()["quiet"], "tickcolor": colours()["quiet"]}
    figure.update_xaxes(
        range=panel.x_range, type="log" if panel.x_log else None, row=row, col=1, **quiet
    )
    if last or not panel.x_range:
        figure.update_xaxes(title_text=panel.x_name, row=row, col=1)
    figure.update_yaxes(
        title_text=panel.y_name, type="log" if panel.y_log else None,
        showgrid=True, gridcolor=colours()["grid"], row=row, col=1, **quiet,
    )  # fmt: skip
    if panel.y_range is not None:
        low, high = panel.y_range
        figure.update_yaxes(range=_scaled([low, high], panel).tolist(), row=row, col=1)
        if panel.equal:
            figure.update_yaxes(scaleanchor="x", row=row, col=1)
        if panel.y_names:
            places = list(range(1, len(panel.y_names) + 1))
            figure.update_yaxes(tickvals=places, ticktext=list(panel.y_names), row=row, col=1)
        if panel.y_root:
            ticks = root_ticks(low, high)
            figure.update_yaxes(
                tickvals=_scaled(ticks, panel).tolist(), ticktext=[f"{tick:g}" for tick in ticks],
                row=row, col=1,
            )  # fmt: skip
