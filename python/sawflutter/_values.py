"""Numbers of a user as those of the library: plain, of NumPy, with a unit as text or as a quantity of pint."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from operator import index
from typing import TYPE_CHECKING, Any, Protocol, SupportsIndex, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _native
from ._entry import FloatArray
from .errors import SceneError, refused


class Quantity(Protocol):
    """A quantity of pint."""

    def m_as(self, units: Any) -> Any:
        """The magnitude in a unit."""


Number: TypeAlias = "float | np.floating[Any] | np.integer[Any] | str | Quantity"
"""A number in the unit of its name, a text with a unit, or a quantity of pint."""
if TYPE_CHECKING:
    Numbers: TypeAlias = npt.NDArray[Any] | list[Any] | tuple[Any, ...] | range
    """Several numbers."""


def number(name: str, value: Number | None) -> float:
    """A number of an argument or of a path of a scene, in the unit of its name."""
    if isinstance(value, str):
        return _native.number(name, value)
    if hasattr(value, "m_as"):
        value = _in_unit(value, name)
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        unit = _native.unit(name)
        said = f"a number in {unit}, or a text with a unit" if unit else "a number"
        raise refused(name, value, said, "give one number, like 3") from None


def optional(name: str, value: Number | None) -> float | None:
    """A number of an argument that may be left out."""
    return None if value is None else number(name, value)


def numbers(name: str, values: Any) -> FloatArray:
    """Finite numbers of an argument, in any shape."""
    if hasattr(values, "m_as"):
        values = _in_unit(values, name)
    if not isinstance(values, (np.ndarray, list, tuple, range)) and not np.isscalar(values):
        values = list(values) if hasattr(values, "__iter__") else number(name, values)
    if isinstance(values, (str, list, tuple)):
        found = np.vectorize(lambda of: number(name, of), otypes=[float])(np.array(values, object))
    else:
        found = np.asarray(values, float)
    if not np.isfinite(found).all():
        raise refused(name, float(found[~np.isfinite(found)].flat[0]), "finite", "leave out what is no number")
    return np.asarray(found, float)


def whole(name: str, value: SupportsIndex) -> int:
    """A whole number within the range of the library, from an argument."""
    if isinstance(value, (bool, np.bool_)) or not hasattr(value, "__index__"):
        raise TypeError(f"{name} must be a whole number, like 3 (you gave {value!r})")
    found = index(value)
    if not 0 <= found < 2**64:
        raise refused(name, found, "0 or more and below 2**64", "give such a number, or leave it out")
    return found


def to_json(data: Any, path: str = "") -> str:
    """JSON of a scene, a part of one at a path, or a study."""
    return json.dumps(_plain(data, path))


def _plain(value: Any, path: str) -> Any:
    if value is None or isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, Mapping):
        dot = "." if path else ""
        return {name: _plain(inner, f"{path}{dot}{name}") for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(inner, f"{path}[{place}]") for place, inner in enumerate(value)]
    if hasattr(value, "m_as"):
        value = _in_unit(value, path)
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
        return _plain(value, path) if isinstance(value, (list, float)) else value
    if hasattr(value, "__float__"):
        if not math.isfinite(value := float(value)):
            allowed, remedy = "a finite number", "give a number, or None to leave the key out"
            raise SceneError(f"{path} must be {allowed} (you gave {value}); {remedy}", path, str(value), allowed, remedy)
        return value
    raise TypeError(f"{path}: {value!r} is no value of a scene, but of the type {type(value).__name__}")


def _in_unit(value: Any, name: str) -> Any:
    """The number of a quantity of pint in the unit of a path or of an argument.

    To pint an angle has no dimension, so that 40 Hz would be 382 rpm and 0.3 would be 17.2 degrees.
    """
    unit = _native.unit(name)
    if not unit:
        raise TypeError(f"{name} has no unit: give a number in place of a quantity")
    for sign, word in (("·", "*"), ("²", "**2"), ("³", "**3"), ("°", "deg"), ("^", "**")):
        unit = unit.replace(sign, word)
    own, other = (quantity.to_root_units().units for quantity in (type(value)(1, unit), value))
    if own != other and own.dimensionality == other.dimensionality:
        raise TypeError(
            f"{name} must be in {unit} (you gave {value}): turns, angles and plain numbers are not "
            "converted into each other; give it in the unit of the key"
        )
    return value.m_as(unit)
