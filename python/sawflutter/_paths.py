"""Paths of a scene, like ``guides[0].radius_m``."""

from __future__ import annotations

import re
from typing import Any

from .errors import PathError

_STEP = re.compile(r"(?:^|\.)([^.\[\]]+)|\[(\d+)\]")


def get(data: Any, path: str) -> Any:
    """The value at a path."""
    place, at = data, ""
    for step in _steps(path):
        place, at = _entry(place, step, at, path), _joined(at, step)
    return place


def put(data: Any, path: str, value: Any) -> None:
    """Puts a value at a path, or takes it out where it is None; a block that is not there is begun."""
    *before, last = _steps(path)
    place, at = data, ""
    for step in before:
        if isinstance(place, dict) and isinstance(step, str):
            place.setdefault(step, {})
        place, at = _entry(place, step, at, path), _joined(at, step)
    if not isinstance(place, dict) or not isinstance(last, str):
        _entry(place, last, at, path)
        place[last] = value
    elif value is None:
        place.pop(last, None)
    else:
        place[last] = value


def _steps(path: str) -> list[str | int]:
    """``guides[0].radius_m`` is guides, 0, radius_m."""
    found = list(_STEP.finditer(path)) if isinstance(path, str) else []
    if not found or "".join(match[0] for match in found) != path:
        remedy = "write it like guides[0].radius_m"
        raise PathError(f"{path!r} is no path of a scene; {remedy}", str(path), None, None, remedy)
    return [match[1] if match[1] is not None else int(match[2]) for match in found]


def _joined(at: str, step: str | int) -> str:
    return f"{at}[{step}]" if isinstance(step, int) else f"{at}.{step}" if at else step


def _entry(place: Any, step: str | int, at: str, path: str) -> Any:
    """An entry of a block or a list; where there is none, the error says which there are."""
    if isinstance(place, dict) and step in place:
        return place[step]
    if isinstance(place, list) and isinstance(step, int) and step < len(place):
        return place[step]
    where = at or "the scene"
    if isinstance(place, list):
        allowed = f"{where} has {len(place)} entries, counted from 0"
        remedy = "add_guide adds a guide" if at == "guides" else "replace the list as a whole"
    elif isinstance(place, dict):
        allowed = f"{where} has {', '.join(place) or 'no keys'}"
        remedy = "name one of these; replace writes others"
    else:
        allowed = f"{where} is a single value"
        remedy = f"name it as {where}"
    raise PathError(f"the scene has no {path!r}: {allowed}; {remedy}", path, None, allowed, remedy)
