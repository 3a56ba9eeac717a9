"""Scenes: read, written, changed, refused."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import numpy as np
import pytest

import sawflutter as sf


def test_every_scene_of_the_checkout_is_read_and_written(scenes: Path, tmp_path: Path) -> None:
    found = sorted(scenes.glob("*.json"))
    assert len(found) >= 6
    for path in found:
        saw = sf.Scene.load(path)
        saw.save(tmp_path / path.name)
        assert sf.Scene.load(tmp_path / path.name) == saw
        assert saw.to_dict()["name"] == json.loads(path.read_text())["name"]


def test_a_scene_is_made_of_a_dict_and_of_numpy_numbers() -> None:
    data = sf.Scene.paper().to_dict()
    data["blade"]["thickness_m"] = np.float64(2.6e-3)
    data["blade"]["teeth"] = np.int64(40)  # type: ignore[typeddict-item]
    saw = sf.Scene(data)
    assert saw["blade.thickness_m"] == 2.6e-3
    assert saw["blade.teeth"] == 40
    assert saw.name == "Guided spline arbor saw"


def test_replace_changes_one_number_and_not_the_scene_it_came_from() -> None:
    saw = sf.Scene.paper()
    other = saw.replace({"blade.thickness_m": 2.6e-3, "guides[0].radius_m": 0.22})
    assert (saw["blade.thickness_m"], saw["guides[0].radius_m"]) == (0.0028, 0.2)
    assert (other["blade.thickness_m"], other["guides[0].radius_m"]) == (2.6e-3, 0.22)
    assert other != saw and hash(other) != hash(saw)
    assert other.replace({"blade.thickness_m": 2.8e-3, "guides[0].radius_m": 0.2}) == saw


def test_replace_begins_and_removes_blocks() -> None:
    saw = sf.Scene.paper()
    damped = saw.replace({"damping.air_n_s_per_m3": 3.0})
    assert damped["damping"] == {"air_n_s_per_m3": 3.0}
    assert damped.replace({"damping": None}) == saw
    with pytest.raises(KeyError):
        saw["damping"]


@pytest.mark.parametrize(
    "path", ["guides[7].radius_m", "guides.radius_m", "blade[0]", "", "name.x"]
)
def test_a_path_that_no_scene_has_is_named(path: str) -> None:
    with pytest.raises(KeyError) as error:
        sf.Scene.paper().replace({path: 1.0})
    assert path in str(error.value)


def test_a_scene_cannot_be_changed_and_is_pickled() -> None:
    saw = sf.Scene.paper()
    with pytest.raises(AttributeError):
        saw.thickness = 3
    copy = pickle.loads(pickle.dumps(saw))
    assert copy == saw and hash(copy) == hash(saw)


def test_a_scene_says_what_it_is() -> None:
    expected = "<Scene 'Guided spline arbor saw': 710 mm outside, 2.8 mm thick, 1 guide>"
    assert repr(sf.Scene.paper()) == expected


def test_a_refused_number_has_key_value_allowed_and_remedy() -> None:
    with pytest.raises(sf.SceneError) as caught:
        sf.Scene.paper().replace({"guides[0].radius_m": 3.0})
    error = caught.value
    assert error.key == "guides[0].radius_m"
    assert error.value == "3"
    assert error.allowed and error.remedy
    for part in (error.key, error.value, error.allowed, error.remedy):
        assert part in str(error)
    copy = pickle.loads(pickle.dumps(error))
    assert (str(copy), copy.key, copy.remedy) == (str(error), error.key, error.remedy)
    assert isinstance(error, ValueError)


def test_a_misspelt_key_is_named() -> None:
    with pytest.raises(sf.SceneError) as caught:
        sf.Scene.paper().replace({"blade.thicknes_m": 0.003})
    assert "thicknes_m" in str(caught.value)
    assert caught.value.key is not None and caught.value.key.startswith("blade")


@pytest.mark.parametrize("text", ["", "{", "[]", "null", '{"name": NaN}'])
def test_text_that_is_no_scene_is_refused(text: str) -> None:
    with pytest.raises(sf.SceneError):
        sf.Scene.from_json(text)


def test_files_that_cannot_be_read_are_errors_of_the_system(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        sf.Scene.load(tmp_path / "none.json")
    with pytest.raises(IsADirectoryError):
        sf.Scene.load(tmp_path)


def test_nothing_but_json_goes_into_a_scene() -> None:
    with pytest.raises(TypeError):
        sf.Scene.paper().replace({"name": object()})
    with pytest.raises(sf.SceneError):
        sf.Scene.paper().replace({"blade.thickness_m": float("nan")})
