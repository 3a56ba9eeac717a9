"""Texts of help() for the public interface."""

from __future__ import annotations

import inspect
import re
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
    assert {"Scene.run_campbell", "Branch.at", "CampbellResults.critical_rpm", "load.load"} <= names
    assert len(names) > 80
    assert all(getattr(sf, name).__doc__ for name in sf.__all__)


def test_every_member_has_a_docstring_that_names_its_parameters() -> None:
    for name, function, _ in MEMBERS:
        doc = inspect.getdoc(function) or ""
        assert doc, name
        names = [key for key in inspect.signature(function).parameters if key not in ("self", "cls", "look")]
        # A single argument is what the first line says; the keys of a guide are those of its schema.
        if len(names) > 1 and name != "Scene.add_guide":
            missing = [key for key in names if not re.search(rf"\b{key}\b", doc)]
            assert not missing, f"{name}: {missing}"


def test_no_internal_name_is_public() -> None:
    for name in sf.__all__:
        members = {key for key in dir(getattr(sf, name)) if not key.startswith("_")}
        assert not members & {"of", "from_dict", "required_keys", "raw"}, name
    assert not {name for name in dir(sf) if inspect.ismodule(getattr(sf, name))} - {"errors"}


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
