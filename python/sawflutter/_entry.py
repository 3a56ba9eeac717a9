"""What all classes of a report share: they are made of the JSON that the library writes."""

from __future__ import annotations

import ast
import dataclasses
import inspect
import sys
import textwrap
import types
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeAlias, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np
import numpy.typing as npt

FloatArray: TypeAlias = npt.NDArray[np.float64]
IntArray: TypeAlias = npt.NDArray[np.int64]
BoolArray: TypeAlias = npt.NDArray[np.bool_]
ComplexArray: TypeAlias = npt.NDArray[np.complex128]

E = TypeVar("E", bound="Entry")
Reader: TypeAlias = Callable[[Any], Any]


class Entry:
    """Base of the frozen dataclasses of a report.

    Numbers that the JSON leaves out as null are ``None``, or NaN within an array. Arrays cannot be
    written to. Two entries are equal where all of their numbers are.
    """

    @classmethod
    def from_dict(cls: type[E], data: Mapping[str, Any]) -> E:
        """Makes an entry of an object of the JSON; keys that it does not know are left out.

        Parameters
        ----------
        data : dict
            The object.

        Returns
        -------
        Entry
            Of the class that is asked.

        Raises
        ------
        TypeError
            Where a key is missing.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> sf.CriticalSpeed.from_dict(r.raw["critical_speeds"][0]) == r.critical_speeds[0]
        True
        """
        return cls(**{name: read(data[key]) for name, key, read in _readers(cls) if key in data})

    @classmethod
    def required_keys(cls) -> frozenset[str]:
        """The keys of the JSON that are always there.

        Returns
        -------
        frozenset of str

        Examples
        --------
        >>> import sawflutter as sf
        >>> 'rpm' in sf.CriticalSpeed.required_keys()
        True
        """
        fields = dataclasses.fields(cls)  # type: ignore[arg-type]
        always = (field for field in fields if field.default is dataclasses.MISSING)
        return frozenset(field.metadata.get("key", field.name) for field in always)

    def __setstate__(self, state: dict[str, Any]) -> None:
        # NumPy forgets in a pickle or a copy that an array cannot be written to.
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


def describe(module: str) -> None:
    """Adds the descriptions below the fields of the classes of a module to their docstrings, so that
    ``help()`` shows them: without this only who reads the source sees them."""
    try:
        tree = ast.parse(inspect.getsource(sys.modules[module]))
    except (OSError, TypeError):
        # Without the source, as in a frozen program, there is none to be shown.
        return
    for node in tree.body:
        cls = getattr(sys.modules[module], node.name, None) if isinstance(node, ast.ClassDef) else None
        if isinstance(node, ast.ClassDef) and isinstance(cls, type) and issubclass(cls, Entry):
            _DESCRIBED[cls] = dict(_below(node))
            if dataclasses.is_dataclass(cls) and cls.__doc__:
                cls.__doc__ = f"{inspect.cleandoc(cls.__doc__)}\n\n{_attributes(cls)}"


_DESCRIBED: dict[type[Entry], dict[str, tuple[str, str]]] = {}


def _below(node: ast.ClassDef) -> Iterator[tuple[str, tuple[str, str]]]:
    """Of each field its name, type and what the words below it say."""
    for field, words in zip(node.body, node.body[1:]):
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name):
            value = words.value if isinstance(words, ast.Expr) else None
            said = value.value if isinstance(value, ast.Constant) else ""
            yield field.target.id, (ast.unparse(field.annotation), inspect.cleandoc(str(said)))


def _attributes(cls: type[Entry]) -> str:
    lines = ["Attributes", "----------"]
    for field in dataclasses.fields(cls):  # type: ignore[arg-type]
        known = (_DESCRIBED.get(base, {}).get(field.name) for base in cls.__mro__)
        kind, said = next((found for found in known if found), (str(field.type), ""))
        if field.repr:
            lines += [f"{field.name} : {kind}", textwrap.indent(said, "    ")]
    return "\n".join(lines)


def _same(first: Any, second: Any) -> bool:
    if isinstance(first, np.ndarray) and isinstance(second, np.ndarray):
        return np.array_equal(first, second, equal_nan=first.dtype.kind == "f")
    return bool(first == second)


def _short(value: Any) -> str:
    """A value on part of a line."""
    if isinstance(value, np.ndarray):
        shape = " x ".join(str(length) for length in value.shape)
        return f"<{shape} numbers>"
    if isinstance(value, tuple) and value and isinstance(value[0], Entry):
        return f"<{len(value)} of {type(value[0]).__name__}>"
    if isinstance(value, dict):
        return f"<{value.get('name', 'dict')!r}>"
    return repr(value)


_KNOWN: dict[type[Entry], list[tuple[str, str, Reader]]] = {}


def _readers(cls: type[Entry]) -> list[tuple[str, str, Reader]]:
    """Of each attribute its name, its key in the JSON, and how it is read."""
    if cls not in _KNOWN:
        hints = get_type_hints(cls)
        fields = dataclasses.fields(cls)  # type: ignore[arg-type]
        _KNOWN[cls] = [
            (field.name, field.metadata.get("key", field.name), _reader(hints[field.name]))
            for field in fields
        ]
    return _KNOWN[cls]


def _reader(hint: Any) -> Reader:
    origin, arguments = get_origin(hint), get_args(hint)
    if hint == FloatArray:
        return _floats
    if hint == IntArray:
        return _integers
    if hint == BoolArray:
        return _truths
    if origin in (Union, types.UnionType):
        (inner,) = [_reader(of) for of in arguments if of is not type(None)]
        return lambda value: None if value is None else inner(value)
    if origin is tuple:
        item = _reader(arguments[0])
        return lambda values: tuple(item(value) for value in values)
    if isinstance(hint, type) and issubclass(hint, Entry):
        return hint.from_dict
    if hint is float:
        return float
    return _as_it_is


def _as_it_is(value: Any) -> Any:
    return value


def _floats(values: list[Any]) -> FloatArray:
    """Numbers in rows of one length: shorter ones and null are filled with NaN."""
    if values and isinstance(values[0], list):
        width = max(len(row) for row in values)
        values = [row + [None] * (width - len(row)) for row in values]
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array


def _integers(values: list[Any]) -> IntArray:
    array = np.array(values, dtype=np.int64)
    array.setflags(write=False)
    return array


def _truths(values: list[Any]) -> BoolArray:
    array = np.array(values, dtype=np.bool_)
    array.setflags(write=False)
    return array
