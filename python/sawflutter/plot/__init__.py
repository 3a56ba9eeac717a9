"""Figures in matplotlib and plotly.

Each result describes what is drawn as numbers, :meth:`sawflutter.Result.chart`; two small modules
draw such a description, one with plotly and one with matplotlib. Colours, dashes and signs are
those of the program's own figures.
"""

from __future__ import annotations

from .chart import Bars, Chart, Heat, Line, Panel, Points, Shade, Upright, colours
from .motion import Animation, animate

__all__ = [
    "Animation",
    "Bars",
    "Chart",
    "Heat",
    "Line",
    "Panel",
    "Points",
    "Shade",
    "Upright",
    "animate",
    "colours",
]
