"""Charts drawn with plotly."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._extras import extra
from .chart import Area, Bars, Chart, Heat, Item, Label, Line, Panel, Points, Shade, Upright, colours
from .chart import end_labels, is_at_the_top, root_ticks, signed_root

SYMBOLS = {"disc": "circle", "ring": "circle-open", "square": "square", "cross": "x-thin-open"}

if TYPE_CHECKING:
    from plotly.graph_objects import Figure


def draw(chart: Chart, fig: Figure | None = None) -> Figure:
    """A figure with the panels of a chart, one above the other, or a given one with as many of them
    as it has rows."""
    if fig is None:
        return _laid_out(chart)
    rows = _rows(fig)
    panels = chart.panels[: max(rows, 1)]
    for row, panel in enumerate(panels, start=1):
        at = {"row": row, "col": 1} if rows else {}
        _panel(fig, panel, at, last=row == len(panels))
    return fig


def _rows(fig: Figure) -> int:
    """Rows of a figure of ``make_subplots``; zero for another figure."""
    rows = 0
    try:
        while fig.get_subplot(rows + 1, 1) is not None:
            rows += 1
    except Exception:  # noqa: BLE001 plotly raises nothing narrower
        pass
    return rows


def _laid_out(chart: Chart) -> Figure:
    with extra("plot"):
        import plotly.graph_objects as go
        from plotly.subplots import make_subplots

    panels, together = chart.shown(), chart.together()
    figure = make_subplots(
        rows=len(panels),
        cols=1,
        row_heights=[panel.share for panel in panels],
        shared_xaxes=together,
        vertical_spacing=0.05 if together else 0.14,
        subplot_titles=[panel.title.replace("\n", "<br>") for panel in panels]
        if any(panel.title for panel in panels)
        else None,
    )
    for row, panel in enumerate(panels, start=1):
        _panel(figure, panel, {"row": row, "col": 1}, last=row == len(panels))
    figure.update_traces(showlegend=False)
    for item in chart.key:
        figure.add_trace(_sample(go, item))
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
        showlegend=bool(chart.key),
        legend={"orientation": "h", "x": 0.0, "y": 0.01, "yref": "container", "yanchor": "bottom"},
        height=320 + 240 * len(panels) + (30 if chart.key else 0),
        margin={
            "b": 110 if chart.key else 80,
            "r": 190 if any(end_labels(panel, 0.0) for panel in panels) else 40,
            # Title, facts and the title of the panel, one above the other.
            "t": 56 + 18 * len(chart.lines()) + 24 * len(panels[0].title.splitlines()),
        },
    )  # fmt: skip
    return figure


def _panel(figure: Figure, panel: Panel, at: dict[str, int], last: bool) -> None:
    for item in panel.items:
        _add(figure, item, panel, at)
    for line, place in end_labels(panel, apart=0.08 / panel.share):
        figure.add_annotation(
            x=_at(line.x[-1], panel.x_log), y=_at(place, panel.y_log), text=line.end, font={"color": line.colour, "size": 12},
            showarrow=False, xanchor="left", xshift=6, **at,
        )  # fmt: skip
    for at_row, name in zip(panel.y_ticks, panel.y_names):
        figure.add_annotation(
            x=0.0, xref="x domain", y=at_row, text=f"<b>{name}</b>", showarrow=False, xanchor="left",
            yanchor="bottom", font={"color": colours()["quiet"], "size": 12}, **at,
        )  # fmt: skip
    if panel.note:
        figure.add_annotation(
            x=0.01, xref="x domain", y=0.5, yref="y domain", text=panel.note, showarrow=False,
            xanchor="left", font={"color": colours()["quiet"], "size": 12},
            bgcolor=colours()["paper"], **at,
        )  # fmt: skip
    _axes(figure, panel, at, last)


def _at(value: float, log: bool) -> float:
    """Coordinate of an annotation, which is a logarithm on a logarithmic axis."""
    return float(np.log10(value) if log else value)


def _scaled(values: Any, panel: Panel) -> Any:
    """Positions on the y axis."""
    values = np.asarray(values, float)
    return signed_root(values) if panel.y_root else values


def _add(figure: Figure, item: Item, panel: Panel, at: dict[str, int]) -> None:
    import plotly.graph_objects as go

    # Plotly skips shapes in panels that are still empty, and its template draws shapes with an
    # opacity of 30 %, so faint that narrow bands are invisible.
    opaque: dict[str, Any] = {**at, "opacity": 1.0}
    if at:
        opaque["exclude_empty_subplots"] = False
    if isinstance(item, Shade):
        # The edge keeps a band visible that is narrower than a pixel.
        edge = {"color": item.colour, "width": 1}
        figure.add_vrect(
            item.start, item.end, fillcolor=item.colour, line=edge, layer="below", **opaque
        )
    elif isinstance(item, Upright):
        dash = "dash" if item.dashed else "solid"
        figure.add_vline(item.x, line={"color": item.colour, "width": 1, "dash": dash}, **opaque)
    elif isinstance(item, Heat):
        figure.add_trace(_cells(go, item, panel), **at)
    elif isinstance(item, Label):
        figure.add_annotation(
            x=_at(item.x, panel.x_log), y=_at(item.y, panel.y_log), text=item.name, showarrow=False,
            yshift=-11 if is_at_the_top(item, panel) else 11, font={"color": item.colour, "size": 12},
            bgcolor="rgba(255, 255, 255, 0.75)", borderpad=0, **at,
        )  # fmt: skip
    elif isinstance(item, Area):
        figure.add_trace(_area(go, item), **at)
    elif isinstance(item, Bars):
        centres, widths = (item.edges[:-1] + item.edges[1:]) / 2.0, np.diff(item.edges)
        bar = go.Bar(
            x=centres, y=item.heights, width=widths, marker_color=item.colour, name=item.name
        )
        figure.add_trace(bar, **at)
    else:
        figure.add_trace(_curve(go, item, panel), **at)


def _cells(go: Any, item: Heat, panel: Panel) -> Any:
    low, high = item.range or (None, None)
    colours = [*item.scale, *item.scale] if len(item.scale) == 1 else item.scale
    scale = [[k / (len(colours) - 1), colour] for k, colour in enumerate(colours)]
    # Labels at the ends of lines are between the axes and the bar.
    bar: dict[str, Any] = {"title": item.name, "xpad": 70 if end_labels(panel, 0.0) else 10}
    said: dict[str, Any] = {}
    z = item.z
    if item.log and low is not None and high is not None:
        z = np.log10(np.maximum(item.z, low))
        low, high = np.log10(low), np.log10(high)
        decades = np.arange(np.ceil(low), np.floor(high) + 1)
        bar |= {"tickvals": decades.tolist(), "ticktext": [f"{10.0**power:g}" for power in decades]}
        said = {
            "customdata": item.z,
            "hovertemplate": "%{x:.4g}, %{y:.4g}<br>%{customdata:.3g}<extra>" + item.name + "</extra>",
        }
    if len(item.scale) == 1:
        said = {"showscale": False, "hoverinfo": "name"}
    return go.Heatmap(
        x=item.x, y=item.y, z=z, zmin=low, zmax=high, colorscale=scale, colorbar=bar,
        name=item.name, **said,
    )  # fmt: skip


def _area(go: Any, item: Area) -> Any:
    if not item.stepped:
        known = item.high >= item.low
        x = np.concatenate([item.x[known], item.x[known][::-1]])
        y = np.concatenate([item.low[known], item.high[known][::-1]])
        return go.Scatter(
            x=x, y=y, fill="toself", fillcolor=item.colour, mode="none", name=item.name,
            hoverinfo="name",
        )  # fmt: skip
    middles, widths = item.columns()
    return go.Bar(
        x=middles, y=item.heights(), base=np.nan_to_num(item.low, nan=1.0), width=widths, name=item.name, marker={"color": item.colour, "line": {"width": 0}},
    )  # fmt: skip


def _sample(go: Any, item: Item) -> Any:
    """An entry of the key: a trace without points."""
    shared: dict[str, Any] = {"x": [None], "y": [None], "name": item.name, "showlegend": True}
    if isinstance(item, Points):
        symbol = SYMBOLS[item.shape]
    elif isinstance(item, Line | Upright):
        line = {"color": item.colour, "dash": "dash" if item.dashed else "solid"}
        return go.Scatter(mode="lines", line=line, **shared)
    else:
        symbol = "square"
    colour = item.scale[0] if isinstance(item, Heat) else item.colour
    return go.Scatter(mode="markers", marker={"color": colour, "symbol": symbol, "size": 9}, **shared)


def _curve(go: Any, item: Line | Points, panel: Panel) -> Any:
    said: dict[str, Any] = {"hoverinfo": "name"}
    if item.hover:
        lines = [text.replace("\n", "<br>") for text in item.hover]
        said = {"text": lines, "hovertemplate": "%{text}<extra></extra>"}
    shared = {"x": item.x, "y": _scaled(item.y, panel), "name": item.name, **said}
    if isinstance(item, Points):
        marker = {"color": item.colour, "size": item.size, "symbol": SYMBOLS[item.shape]}
        return go.Scatter(mode="markers", marker=marker, **shared)
    line = {"color": item.colour, "width": item.width, "dash": "dash" if item.dashed else "solid"}
    return go.Scatter(mode="lines", line=line, **shared)


def _axes(figure: Figure, panel: Panel, at: dict[str, int], last: bool) -> None:
    quiet = {"linecolor": colours()["quiet"], "tickcolor": colours()["quiet"]}
    # The range of a logarithmic axis of plotly is given by logarithms.
    across = None if panel.x_range is None else [_at(end, panel.x_log) for end in panel.x_range]
    figure.update_xaxes(range=across, type="log" if panel.x_log else None, **at, **quiet)
    if panel.x_names:
        figure.update_xaxes(tickvals=list(panel.x_ticks), ticktext=list(panel.x_names), **at)
    if last or not panel.x_range:
        figure.update_xaxes(title_text=panel.x_name, **at)
    figure.update_yaxes(
        title_text=panel.y_name, type="log" if panel.y_log else None,
        showgrid=True, gridcolor=colours()["grid"], **at, **quiet,
    )  # fmt: skip
    if panel.y_range is not None:
        low, high = panel.y_range
        # The range of a logarithmic axis of plotly is given by logarithms.
        ends = np.log10([low, high]) if panel.y_log else _scaled([low, high], panel)
        figure.update_yaxes(range=ends.tolist(), **at)
        if panel.equal:
            figure.update_yaxes(scaleanchor="x", **at)
        if panel.y_names or not panel.y_name:
            figure.update_yaxes(showticklabels=False, ticks="", **at)
        if panel.y_ticks:
            figure.update_yaxes(tickvals=list(panel.y_ticks), **at)
        if panel.y_root:
            ticks = root_ticks(low, high)
            figure.update_yaxes(
                tickvals=_scaled(ticks, panel).tolist(), ticktext=[f"{tick:g}" for tick in ticks],
                **at,
            )  # fmt: skip
