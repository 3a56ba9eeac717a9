"""What a notebook shows of a result."""

from __future__ import annotations

import base64
from html import escape


def html(text: str, svg: str | None) -> str:
    """Text, and beside it a figure. The figure is an image of its own, so that nothing in it can
    meet the styles or scripts of the page."""
    parts = [f"<pre style='line-height:1.25;margin:0'>{escape(text)}</pre>"]
    if svg is not None:
        image = base64.b64encode(svg.encode()).decode()
        parts.append(
            f"<img alt='' style='width:34em;max-width:100%' src='data:image/svg+xml;base64,{image}'>"
        )
    style = "display:flex;flex-wrap:wrap;gap:1.5em;align-items:flex-start"
    return f"<div style='{style}'>{''.join(parts)}</div>"
