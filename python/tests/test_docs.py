"""Texts of help() for the public interface."""

from __future__ import annotations

import inspect
import pydoc
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import sawflutter as sf

NAMES = [name for name in dir(sf) if name != "errors" and not name.startswith("_")]


def public() -> Iterator[tuple[str, Callable[..., Any], bool]]:
    """Functions, methods and properties of the public interface, each once."""
    seen = set()
    for name in NAMES:
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
    assert all(getattr(sf, name).__doc__ for name in NAMES)


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
    for name in NAMES:
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


# The methods that are used most.
MOST_USED = [
    "Scene.load", "Scene.replace", "Scene.run_campbell", "Scene.speeds", "Scene.modes", "Scene.matrices", "Scene.check",
    "Scene.run_cut", "Scene.run_up", "Scene.run_response", "Scene.fit", "Scene.place", "Scene.size", "Scene.run_map",
    "Scene.measured_margin", "Study.run", "compare.compare", "load.load", "Matrices.response",
]  # fmt: skip


@pytest.mark.parametrize("name", MOST_USED)
def test_the_most_used_methods_say_what_they_return_and_raise(name: str) -> None:
    (function,) = (function for member, function, _ in MEMBERS if member == name)
    doc = inspect.getdoc(function) or ""
    assert _section(doc, "Returns") and _section(doc, "Raises")


def test_arrays_of_results_have_a_shape() -> None:
    attributes = _section(inspect.getdoc(sf.Branch) or "", "Attributes")
    assert re.search(r"frequency_hz : .*\n?.*Shape\s+\(n\)\.", attributes)


def test_help_is_the_table_of_calls() -> None:
    text = pydoc.plain(pydoc.render_doc(sf))
    assert "run_campbell(" in text and len(text.splitlines()) < 200
    _, _, table = (sf.__doc__ or "").partition("I want: the call\n\n")
    calls = [line.strip() for line in table.splitlines()][1::2]
    methods = {name for call in calls for name in re.findall(r"\bsaw\.(\w+)\(", call)}
    assert {name for name in dir(sf.Scene) if name.startswith("run_")} <= methods
    assert all(hasattr(sf.Scene, name) for name in methods)
    assert all(hasattr(sf, name) for call in calls for name in re.findall(r"\bsf\.(\w+)", call))
