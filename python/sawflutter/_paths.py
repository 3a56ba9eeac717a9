"""Paths of a scene, like ``guides[0].radius_m``."""

from __future__ import annotations

import re
from contextlib import suppress
from typing import Any

from .errors import PathError

_STEP = re.compile(r"(?:^|\.)([^.\[\]]+)|\[(\d+)\]")


def get(data: Any, path: str) -> Any:
    """The value at a path."""
    for at, step in _steps(path):
        data = _entry(data, step, at, path)
    return data


def put(data: Any, path: str, value: Any) -> None:
    """Sets the value at a path, or removes it if the value is None; a missing block is added."""
    *before, (at, last) = _steps(path)
    for of, step in before:
        if isinstance(data, dict) and isinstance(step, str):
            data.setdefault(step, {})
        data = _entry(data, step, of, path)
    if not isinstance(data, dict) or not isinstance(last, str):
        _entry(data, last, at, path)
        data[last] = value
    elif value is None:
        data.pop(last, None)
    else:
        data[last] = value


def _steps(path: str) -> list[tuple[str, str | int]]:
    """The steps of a path, and the path before each: of ``guides[0]``, guides and 0."""
    found = list(_STEP.finditer(path)) if isinstance(path, str) else []
    if not found or "".join(match[0] for match in found) != path:
        remedy = "write it like guides[0].radius_m"
        raise PathError(f"{path!r} is no path of a scene; {remedy}", str(path), None, None, remedy)
    return [(path[: match.start()], match[1] or int(match[2])) for match in found]


def _entry(place: Any, step: str | int, at: str, path: str) -> Any:
    """An entry of a block or a list; if it is missing, the error lists the existing ones."""
    if isinstance(place, (dict, list)):
        with suppress(LookupError, TypeError):
            return place[step]  # type: ignore[index]
    where = at or "the scene"
    if isinstance(place, list):
        allowed = f"{where} has {len(place)} entries, counted from 0"
        remedy = "add_guide adds a guide" if at == "guides" else "replace the list as a whole"
    elif isinstance(place, dict):
        allowed = f"{where} has {', '.join(place) or 'no keys'}"
        remedy = "name one of these; replace writes others"
    else:
        allowed, remedy = f"{where} is a single value", f"name it as {where}"
    raise PathError(f"the scene has no {path!r}: {allowed}; {remedy}", path, None, allowed, remedy)
