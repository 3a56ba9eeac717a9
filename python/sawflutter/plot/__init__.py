"""Figures in matplotlib and plotly.

Each result gives its chart as numbers, see :meth:`sawflutter.Result.chart`. Two small modules draw
a chart, one with plotly and one with matplotlib. Colours, dashes and symbols are those of the
program's figures.
"""

from __future__ import annotations

from .chart import Area, Bars, Chart, Heat, Label, Line, Panel, Points, Shade, Upright, colours
from .motion import Animation, animate

__all__ = [
    "Animation",
    "Area",
    "Bars",
    "Chart",
    "Heat",
    "Label",
    "Line",
    "Panel",
    "Points",
    "Shade",
    "Upright",
    "animate",
    "colours",
]
