"""Numbers of a user as those of the library: plain, of NumPy, with a unit as text or as a quantity of pint."""

from __future__ import annotations

from operator import index
from typing import TYPE_CHECKING, Any, Protocol, SupportsIndex, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _native
from ._entry import FloatArray
from .errors import refused


class Quantity(Protocol):
    """A quantity of pint."""

    def m_as(self, units: Any) -> Any:
        """The magnitude in a unit."""


Number: TypeAlias = "float | np.floating[Any] | np.integer[Any] | str | Quantity"
"""A number in the unit of its name, a text with a unit, or a quantity of pint."""
if TYPE_CHECKING:
    Numbers: TypeAlias = npt.NDArray[Any] | list[Any] | tuple[Any, ...] | range
    """Several numbers."""


number = _native.number
"""A number of an argument or of a path of a scene, in the unit of its name."""


def optional(name: str, value: Number | None) -> float | None:
    """A number of an argument that may be left out."""
    return None if value is None else number(name, value)


def numbers(name: str, values: Any) -> FloatArray:
    """Finite numbers of an argument, in any shape."""
    if hasattr(values, "m_as"):
        values = _native.magnitude(name, values)
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
