"""Scenes: read, written, changed, refused."""

from __future__ import annotations

import copy
import json
import pickle
import warnings
from pathlib import Path

import numpy as np
import pytest

import sawflutter as sf
from sawflutter import _native


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


def test_a_scene_cannot_be_changed_and_is_pickled() -> None:
    saw = sf.Scene.paper()
    with pytest.raises(AttributeError):
        saw.thickness = 3  # type: ignore[attr-defined]
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


def test_a_scene_is_a_mapping_in_full() -> None:
    saw = sf.Scene.paper()
    assert dict(saw) == saw.to_dict() and list(saw) == list(saw.to_dict())
    assert "guides[0].radius_m" in saw and "damping" not in saw and len(saw) > 5
    assert saw.get("damping.air_n_s_per_m3", 0.0) == 0.0
    assert sf.Scene(saw) == saw
    assert saw.blade["thickness_m"] == saw["blade.thickness_m"] == 0.0028
    assert saw.guides[0]["radius_m"] == 0.2 and saw.mount is not None and saw.cut is not None
    # An assignment to the scene is refused, with the remedy.
    for change in (
        lambda: saw.__setitem__("name", "other"),  # type: ignore[index]
        lambda: saw._data["blade"].update(thickness_m=0.003),
        lambda: saw["guides"][0].__setitem__("radius_m", 0.3),
    ):
        with pytest.raises(TypeError, match="replace"):
            change()
    own = copy.deepcopy(saw.blade)
    own["thickness_m"] = 0.003
    assert saw.blade["thickness_m"] == 0.0028


def test_what_is_no_scene_says_what_is() -> None:
    with pytest.raises(TypeError, match="Scene.load"):
        sf.Scene("saw.json")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="dict"):
        sf.Scene([1, 2])  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("guides[7].radius_m", "guides has 1 entry.*add_guide"),
        ("guides.radius_m", "guides has 1 entry"),
        ("blade.thickness_m.x", "single value"),
        ("name[0]", "single value"),
        ("name.x", "single value"),
        ("blade[0]", "blade has "),
        ("", "is no path"),
        ("guides[0", "is no path"),
        ("guides[0]radius_m", "is no path"),
    ],
)
def test_a_wrong_path_says_what_there_is(path: str, said: str) -> None:
    with pytest.raises(sf.PathError, match=said) as caught:
        sf.Scene.paper().replace({path: 1.0})
    assert caught.value.key == path and caught.value.remedy
    assert isinstance(caught.value, KeyError) and isinstance(caught.value, sf.SceneError)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (str(again), again.key) == (str(caught.value), path)


def test_a_guide_is_added_with_what_the_last_one_has() -> None:
    saw = sf.Scene.paper()
    two = saw.add_guide(angle_deg=120.0, radius_m=np.float32(0.25))
    assert two.guides[1] == {**saw.guides[0], "angle_deg": 120.0, "radius_m": 0.25}
    assert two.guides[0] == saw.guides[0]
    with pytest.raises(sf.SceneError, match="stiffness_n_per_m|radial_length_m"):
        saw.replace({"guides": []}).add_guide(radius_m=0.2, angle_deg=0.0)


def test_texts_with_a_unit_are_numbers() -> None:
    saw = sf.Scene.paper()
    paths = ("blade.thickness_m", "guides[0].stiffness_n_per_m", "operating_rpm")
    typed = saw.replace(dict(zip(paths, ("2.6 mm", "20 kN/mm", "20 rev/s"))))
    guide = {**saw.guides[0], "stiffness_n_per_m": "20 kN/mm", "radius_m": "20 cm"}
    stiff = saw.replace({"guides[0].stiffness_n_per_m": 2e7})
    assert saw.replace({"guides": [guide]}) == stiff
    assert saw.replace({"probe": {"radius_m": "30 cm", "angle_deg": 0}})["probe.radius_m"] == 0.3
    assert typed == saw.replace(dict(zip(paths, (0.0026, 2e7, 1200))))
    with pytest.raises(sf.SceneError, match="must be a number in m") as refused:
        saw.replace({"blade.thickness_m": "2.6 N"})
    assert refused.value.key == "blade.thickness_m"


def test_pint_understands_every_unit() -> None:
    pint = pytest.importorskip("pint")
    units = pint.UnitRegistry()
    saw = sf.Scene.paper()
    other = saw.replace(
        {
            "blade.thickness_m": units.Quantity(2.6, "mm"),
            "blade.material.youngs_modulus_pa": units.Quantity(205.0, "GPa"),
            "blade.material.density_kg_per_m3": units.Quantity(7.85, "g/cm**3"),
            "guides[0].stiffness_n_per_m": units.Quantity(20.0, "kN/mm"),
            "damping.air_n_s_per_m3": units.Quantity(3.0, "N*s/m**3"),
        }
    )
    assert other["blade.thickness_m"] == pytest.approx(2.6e-3)
    assert other["blade.material.youngs_modulus_pa"] == pytest.approx(2.05e11)
    assert other["blade.material.density_kg_per_m3"] == pytest.approx(7850.0)
    assert other["guides[0].stiffness_n_per_m"] == pytest.approx(2e7)
    # A length is not a pressure.
    with pytest.raises(pint.DimensionalityError):
        saw.replace({"blade.material.youngs_modulus_pa": units.Quantity(1.0, "m")})
    with pytest.raises(TypeError, match="poisson_ratio has no unit"):
        saw.replace({"blade.material.poisson_ratio": units.Quantity(0.3, "m")})


def test_turns_and_radians_are_not_mistaken_for_each_other() -> None:
    pint = pytest.importorskip("pint")
    units = pint.UnitRegistry()
    saw = sf.Scene.paper()
    for speed in (units.Quantity(1200.0, "rpm"), units.Quantity(20.0, "turn/s")):
        assert saw.replace({"operating_rpm": speed})["operating_rpm"] == pytest.approx(1200.0)
    for key, value in (
        ("operating_rpm", units.Quantity(20.0, "Hz")),
        ("guides[0].angle_deg", units.Quantity(0.3)),
    ):
        with pytest.raises(TypeError, match=r"must be in (rpm|deg) \(you gave"):
            saw.replace({key: value})


def test_arguments_and_keys_have_a_unit_by_their_names() -> None:
    for name, unit in (
        ("blade.thickness_m", "m"), ("guides[2].stiffness_n_per_m", "N/m"), ("operating_rpm", "rpm"), ("to_hz", "Hz"),
        ("max_rim_m_per_s", "m/s"), ("angle_deg", "°"), ("force_n", "N"), ("duration_s", "s"), ("power_w", "W"),
        ("margin", ""), ("blade.material.poisson_ratio", ""),
    ):  # fmt: skip
        assert _native.number(name, f"0.5 {unit}") == 0.5, name


def test_all_missing_keys_are_named_at_once(draft: sf.Scene) -> None:
    with pytest.raises(sf.SceneError, match="angle_deg.*radial_length_m.*stiffness_n_per_m"):
        draft.replace({"guides": None}).add_guide(radius_m=0.2)
    with pytest.raises(sf.SceneError, match="name: it is missing .*blade, mount"):
        sf.Scene({})


def test_an_implausible_number_is_warned_of_at_once(draft: sf.Scene) -> None:
    with pytest.warns(sf.ModelWarning, match="thickness_m"):
        thick = draft.replace({"blade.thickness_m": 0.05})
    with warnings.catch_warnings():
        warnings.simplefilter("error", sf.ModelWarning)
        # The number is no news.
        thick.replace({"name": "thick"})
    with pytest.warns(sf.ModelWarning, match="thickness_m"):
        sf.Scene(thick.to_dict())


def test_values_of_numpy_may_be_arrays_of_one_element(draft: sf.Scene) -> None:
    assert draft.replace({"operating_rpm": np.array([1200.0])}).operating_rpm == 1200.0
    with pytest.raises(sf.SceneError, match=r"operating_rpm: must be a number \(you gave true\)"):
        draft.replace({"operating_rpm": True})
    assert draft.accuracy == "draft" and draft.replace({"operating_rpm": None}).operating_rpm is None


def test_a_dict_is_not_loaded(draft: sf.Scene) -> None:
    with pytest.raises(TypeError, match=r"Scene\(data\)"):
        sf.Scene.load(draft.to_dict())  # type: ignore[arg-type]
