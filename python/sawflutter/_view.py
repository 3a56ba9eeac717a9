"""The display of a result in a notebook."""

from __future__ import annotations

import base64
from html import escape


def html(text: str, svg: str | None) -> str:
    """HTML of a text and a figure beside it. The figure is an image, so that its styles and scripts
    and those of the page do not affect each other."""
    parts = [f"<pre style='line-height:1.25;margin:0'>{escape(text)}</pre>"]
    if svg is not None:
        image = base64.b64encode(svg.encode()).decode()
        parts.append(
            f"<img alt='' style='width:34em;max-width:100%' src='data:image/svg+xml;base64,{image}'>"
        )
    style = "display:flex;flex-wrap:wrap;gap:1.5em;align-items:flex-start"
    return f"<div style='{style}'>{''.join(parts)}</div>"
