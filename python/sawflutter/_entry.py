"""Base of all classes of a report, which are read from the JSON of the library."""

from __future__ import annotations

import dataclasses
import types
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from typing import Any, TypeAlias, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np
import numpy.typing as npt

FloatArray: TypeAlias = npt.NDArray[np.float64]
IntArray: TypeAlias = npt.NDArray[np.int64]
BoolArray: TypeAlias = npt.NDArray[np.bool_]
ComplexArray: TypeAlias = npt.NDArray[np.complex128]

E = TypeVar("E", bound="Entry")
Reader: TypeAlias = Callable[[Any], Any]

# Longest array that a repr shows.
_SHOWN = 6


class Entry:
    """Base of the frozen dataclasses of a report.

    Numbers that are null in the JSON are ``None``, or NaN within an array. Arrays are read-only.
    Two entries are equal if all of their numbers are.
    """

    @classmethod
    def _from_dict(cls: type[E], data: Mapping[str, Any]) -> E:
        """Reads an entry from an object of the JSON and ignores unknown keys."""
        readers = _readers(cls)  # type: ignore[arg-type]
        return cls(**{name: read(data[key]) for name, key, read in readers if key in data})

    @classmethod
    def _required_keys(cls) -> frozenset[str]:
        """Keys that are always present in the JSON."""
        fields = dataclasses.fields(cls)  # type: ignore[arg-type]
        always = (field for field in fields if field.default is dataclasses.MISSING)
        return frozenset(field.metadata.get("key", field.name) for field in always)

    def __setstate__(self, state: dict[str, Any]) -> None:
        # NumPy drops the read-only flag of an array in a pickle or a copy.
        for value in state.values():
            if isinstance(value, np.ndarray):
                value.setflags(write=False)
        vars(self).update(state)

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        names = [field.name for field in dataclasses.fields(self)]  # type: ignore[arg-type]
        return all(_same(getattr(self, name), getattr(other, name)) for name in names)

    def __hash__(self) -> int:
        plain = (value for value in vars(self).values() if isinstance(value, (str, int, float)))
        return hash((type(self), *plain))

    def __repr__(self) -> str:
        fields = dataclasses.fields(self)  # type: ignore[arg-type]
        shown = (f"{f.name}={_short(getattr(self, f.name))}" for f in fields if f.repr)
        return f"{type(self).__name__}({', '.join(shown)})"


def _same(first: Any, second: Any) -> bool:
    if isinstance(first, np.ndarray) and isinstance(second, np.ndarray):
        return np.array_equal(first, second, equal_nan=first.dtype.kind == "f")
    return bool(first == second)


def _short(value: Any) -> str:
    """A value on part of a line."""
    if isinstance(value, np.ndarray) and value.ndim == 1 and len(value) <= _SHOWN:
        return f"[{', '.join(f'{number:g}' for number in value)}]"
    if isinstance(value, np.ndarray):
        shape = " x ".join(str(length) for length in value.shape)
        return f"<{shape} numbers>"
    if isinstance(value, (tuple, list)) and value and (isinstance(value[0], (Entry, tuple)) or len(value) > _SHOWN):
        return f"<{len(value)} of {type(value[0]).__name__}>"
    if isinstance(value, dict):
        return f"<{value.get('name', 'dict')!r}>"
    return repr(value)


@cache
def _readers(cls: type[Entry]) -> list[tuple[str, str, Reader]]:
    """The name of each attribute, its key in the JSON, and its reader."""
    hints = get_type_hints(cls)
    return [
        (field.name, field.metadata.get("key", field.name), _reader(hints[field.name]))
        for field in dataclasses.fields(cls)  # type: ignore[arg-type]
    ]


def _reader(hint: Any) -> Reader:
    origin, arguments = get_origin(hint), get_args(hint)
    if origin is np.ndarray:
        (number,) = get_args(arguments[1])
        return partial(array, dtype=number)
    if origin in (Union, types.UnionType):
        (inner,) = [_reader(of) for of in arguments if of is not type(None)]
        return lambda value: None if value is None else inner(value)
    if origin is tuple:
        item = _reader(arguments[0])
        return lambda values: tuple(item(value) for value in values)
    if isinstance(hint, type) and issubclass(hint, Entry):
        return hint._from_dict
    return float if hint is float else lambda value: value


def array(values: Any, dtype: type[Any] = np.float64) -> npt.NDArray[Any]:
    """Read-only numbers in rows of one length; shorter rows and None become NaN if the numbers are
    floats."""
    if not isinstance(values, np.ndarray) and len(values) > 0 and isinstance(values[0], Sequence):
        width = max(len(row) for row in values)
        values = [[*row, *[None] * (width - len(row))] for row in values]
    numbers = np.array(values, dtype=dtype)
    numbers.setflags(write=False)
    return numbers
