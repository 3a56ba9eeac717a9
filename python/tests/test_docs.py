"""Texts of help() for the public interface."""

from __future__ import annotations

import doctest
import inspect
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import sawflutter as sf


def public() -> Iterator[tuple[str, Callable[..., Any], bool]]:
    """Functions, methods and properties of the public interface, each once."""
    seen = set()
    for name in sf.__all__:
        of: Any = getattr(sf, name)
        members: list[tuple[str, Any]] = [(name, of)] if inspect.isfunction(of) else []
        if inspect.isclass(of):
            members = [(key, inspect.getattr_static(of, key)) for key in dir(of)]
        for key, member in members:
            is_property = isinstance(member, property)
            function = member.fget if is_property else getattr(member, "__func__", member)
            own = inspect.isfunction(function) and function.__module__.startswith("sawflutter")
            if own and not key.startswith("_") and function not in seen:
                seen.add(function)
                yield f"{name}.{key}", function, is_property


MEMBERS = list(public())


def test_the_public_interface_is_walked() -> None:
    names = {name for name, _, _ in MEMBERS}
    assert {"Scene.run_campbell", "Branch.at", "CampbellResults.bands", "load.load"} <= names
    assert len(names) > 80
    assert all(getattr(sf, name).__doc__ for name in sf.__all__)


@pytest.mark.parametrize(("name", "function", "is_property"), MEMBERS, ids=lambda v: str(v)[:60])
def test_docstrings_have_parameters_returns_raises_and_an_example(
    name: str, function: Callable[..., Any], is_property: bool
) -> None:
    doc = inspect.getdoc(function) or ""
    signature = inspect.signature(function)
    names = [key for key in signature.parameters if key not in ("self", "cls")]
    missing = [key for key in names if key not in _section(doc, "Parameters")]
    # Parameters of figures, which are described once.
    assert not missing or missing == ["look"], f"{name}: {missing} are not among its parameters"
    gives = signature.return_annotation not in ("None", None)
    assert is_property or not gives or _section(doc, "Returns"), f"{name} does not say what it gives"
    raises = "raise " in inspect.getsource(function).replace("raise NotImplementedError", "")
    assert not raises or _section(doc, "Raises"), f"{name} does not say what it raises"
    assert doctest.DocTestParser().get_examples(doc), f"{name} has no example"


def _section(doc: str, title: str) -> str:
    """The text below the title of a section, up to the next one."""
    _, found, text = doc.partition(f"{title}\n{'-' * len(title)}\n")
    return text.partition("\n---")[0] if found else ""


@pytest.mark.parametrize("of", [sf.Branch, sf.Instability, sf.CampbellResults, sf.Matrices])
def test_help_describes_every_field(of: type[Any]) -> None:
    attributes = _section(inspect.getdoc(of) or "", "Attributes")
    for field in of.__dataclass_fields__.values():
        if field.repr:
            assert f"{field.name} : " in attributes, field.name
    if of is sf.Branch:
        assert "Rotation speeds, ascending." in attributes
