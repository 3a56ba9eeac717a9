"""The schemas of the program accept its published files, and refuse the files that it refuses."""

from __future__ import annotations

import copy
import json
import subprocess
from pathlib import Path
from typing import Any

import jsonschema
import pytest

import sawflutter as sf


def validator(programs: list[str], *arguments: str) -> Any:
    said = subprocess.run(
        [programs[-1], "schema", *arguments], check=True, capture_output=True, text=True
    )
    schema = json.loads(said.stdout)
    kind = jsonschema.validators.validator_for(schema)
    kind.check_schema(schema)
    return kind(schema)


def faults(of: Any, instance: object) -> list[str]:
    return [f"{error.json_path}: {error.message}" for error in of.iter_errors(instance)]


def test_every_scene_satisfies_the_schema(programs: list[str], scenes: Path) -> None:
    schema = validator(programs)
    paths = [*scenes.glob("*.json"), *scenes.glob("gallery/*.json")]
    # The paper's saw, the same blade unguided, a collar saw, a saw with two pads.
    assert len(paths) >= 4
    for path in paths:
        assert faults(schema, json.loads(path.read_text(encoding="utf-8"))) == [], path


def test_every_study_satisfies_the_schema(programs: list[str], scenes: Path) -> None:
    schema = validator(programs, "--study")
    paths = [*scenes.glob("studies/*.json")]
    assert paths
    for path in paths:
        assert faults(schema, json.loads(path.read_text(encoding="utf-8"))) == [], path


@pytest.mark.parametrize(
    ("place", "key", "value"),
    [
        ((), "speed", 3),
        (("blade",), "thicknes_m", 3),
        (("blade",), "thickness_m", "thin"),
        (("mount",), "kind", "glue"),
        ((), "accuracy", "perfect"),
    ],
)
def test_the_schema_refuses_what_the_program_refuses(
    programs: list[str], scenes: Path, place: tuple[str, ...], key: str, value: object
) -> None:
    """A schema that accepts everything would pass the tests above."""
    scene = json.loads((scenes / "paper.json").read_text(encoding="utf-8"))
    schema = validator(programs)
    assert faults(schema, scene) == []
    bad = copy.deepcopy(scene)
    part = bad
    for name in place:
        part = part[name]
    part[key] = value
    assert faults(schema, bad) != []
    with pytest.raises(sf.SceneError):
        sf.Scene(bad)


@pytest.mark.parametrize(
    "bad",
    [
        {"name": "x"},
        {"name": "x", "parameters": [], "points": 3},
        {"name": "x", "parameters": [{"path": "y", "distribution": {"kind": "even"}}]},
        {
            "name": "x",
            "parameters": [
                {"path": "y", "distribution": {"kind": "tolerance", "plus_minus": 1, "to": 2}}
            ],
        },
    ],
)
def test_the_schema_of_a_study_refuses_what_the_program_refuses(
    programs: list[str], draft: sf.Scene, bad: dict[str, Any]
) -> None:
    assert faults(validator(programs, "--study"), bad) != []
    with pytest.raises(sf.StudyError):
        sf.Study(draft, bad)
