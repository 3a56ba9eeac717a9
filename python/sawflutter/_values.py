"""Values of a scene as JSON: plain numbers, NumPy numbers, and quantities with a unit."""

from __future__ import annotations

import json
from collections.abc import Mapping
from operator import index
from typing import Any, SupportsIndex

import numpy as np

from .errors import refused

# Units by the end of a key.
_NAMES = ("deg", "Hz", "K", "kg", "m", "N", "Pa", "rpm", "s", "W")
_UNITS = {"tooth": "", **{name.lower(): name for name in _NAMES}}
_POWERS = {"m2": "m**2", "m3": "m**3", "s2": "s**2"}


def whole(name: str, value: SupportsIndex) -> int:
    """A whole number within the range of the library, from an argument."""
    if isinstance(value, (bool, np.bool_)) or not hasattr(value, "__index__"):
        raise TypeError(f"{name} must be a whole number, like 3 (you gave {value!r})")
    number = index(value)
    if not 0 <= number < 2**64:
        allowed, remedy = "0 or more and below 2**64", "give such a number, or leave it out"
        raise refused(name, number, allowed, remedy)
    return number


def to_json(data: Any) -> str:
    """JSON of a scene or a study."""
    return json.dumps(plain(data, ""))


def plain(value: Any, key: str) -> Any:
    """A value as in JSON; a quantity of pint is converted to the unit in the name of its key."""
    if value is None or isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, Mapping):
        return {name: plain(inner, name) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(inner, key) for inner in value]
    if hasattr(value, "m_as"):
        value = _in_unit(value, key)
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    if hasattr(value, "__float__"):
        return float(value)
    kind = type(value).__name__
    raise TypeError(f"{key}: {value!r} is no value of a scene, but of the type {kind}")


def unit(key: str) -> tuple[str, str]:
    """The name of a number and its unit, from the end of its key.

    >>> unit("stiffness_n_per_m"), unit("poisson_ratio"), unit("convection_w_per_m2_k")
    (('stiffness', 'N/m'), ('poisson_ratio', ''), ('convection', 'W/m**2/K'))
    """
    words, found = key.replace("_3_2", "^(3/2)").split("_"), list[str]()
    while words and (words[-1] == "per" or _unit(words[-1]) is not None):
        if words[-1] == "tooth" and found:
            break
        found.insert(0, words.pop())
    cut = found.index("per") if "per" in found else len(found)
    above, below = (list(filter(None, map(_unit, part))) for part in (found[:cut], found[cut + 1 :]))
    # Each unit below is divided by: "/a*b" would multiply by b.
    named = "/".join(["*".join(above) or "1", *below]) if below else "*".join(above)
    return "_".join(words) or key, named


def _unit(word: str) -> str | None:
    base, _, power = word.partition("^")
    found = _POWERS.get(base, _UNITS.get(base))
    return found if not power or found is None else f"{found}**{power}"


def _in_unit(value: Any, key: str) -> Any:
    """The number of a quantity of pint in the unit of its key.

    To pint an angle has no dimension, so that 40 Hz would be 382 rpm and 0.3 would be 17.2 degrees.
    """
    needed = _needed_unit(key)
    own, other = (quantity.to_root_units().units for quantity in (type(value)(1, needed), value))
    if own != other and own.dimensionality == other.dimensionality:
        raise TypeError(
            f"{key} must be in {needed} (you gave {value}): turns, angles and plain numbers are not "
            "converted into each other; give it in the unit of the key"
        )
    return value.m_as(needed)


def _needed_unit(key: str) -> str:
    _, found = unit(key)
    if not found:
        raise TypeError(f"{key} has no unit: give a number in place of a quantity")
    return found
