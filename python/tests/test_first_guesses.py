"""Where a first guess lands: an error that names what is wrong and what works, or the right answer."""

from __future__ import annotations

import tracemalloc
import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
import pytest

import sawflutter as sf


@pytest.mark.parametrize(
    ("guess", "words"),
    [
        (lambda saw: sf.compare(saw, {}), "saws\\[1\\] must be a Scene.*Scene.load"),  # type: ignore[call-overload]
        (lambda saw: sf.Study(saw.to_dict(), {}), "scene must be a Scene.*Scene.load"),
        (lambda saw: saw.run_map("blade.thickness_m"), "x must be a path.*write it like"),
        (lambda saw: saw.replace(None), "changes must be values by their paths, like"),
        (lambda saw: saw.replace([("name", "other")]), "changes must be values by their paths, like"),
        (lambda saw: saw.matrices(basis=3), "basis must be two whole numbers.*12, 6"),
        (lambda saw: saw.run_campbell(speed_range=[]), "speed_range must be a first and a last speed"),
        (lambda saw: saw.fit(free={"guides[0].radius_m": (0.1, 0.12, 0.13)}), "must be two bounds"),
        (lambda saw: saw.fit(free={"guides[0].radius_m": 0.1}), "must be two bounds"),
        (lambda saw: saw.fit(free=3), "free must be paths of numbers.*radius_m"),
        (lambda saw: saw.fit(saw.modes([0, 500, 900]).frequency_hz), "measured must be a speed in rpm"),
        (lambda saw: saw.fit(pd.DataFrame({"rpm": [0.0], "f1": [7.9], "amplitude": [1.0]})), "a column 'amplitude'"),
        (lambda saw: saw.fit(sf.Record(np.ones(40), 10).spectrum()), r"rows\(saw\)"),
        (lambda saw: saw.replace({"runup": None}).run_up(), r"to_rpm, duration_s.*run_up\(to_rpm="),
        (lambda saw: saw.replace({"guides": []}).run_stiffness_map([1e6]), "add_guide"),
        (lambda saw: saw.animate(saw.modes([900])), "mode must be one mode at a speed"),
        (lambda saw: saw.animate(sf.Scene.paper().replace({"blade.outer_diameter_m": 0.8}).modes(0)[0]), "of this saw"),
        (lambda saw: saw.modes(float("nan")), "rpm must be"),
        (lambda saw: saw.modes(900, to_hz=1e5), "to_hz must be above 0 and at most.*complete"),
        (lambda saw: saw.matrices(basis=(6, 4)).companion(float("nan")), "rpm must be finite"),
        (lambda saw: saw.matrices(basis=(6, 4)).at(0.2, float("nan")), "angle_deg must be finite"),
        (lambda saw: saw.matrices(basis=(6, 4)).state_space(9, inputs=[], outputs=[(0.2, 3)]), "inputs must be points"),
        (lambda saw: saw.modes(900)[0].deflection(0.2, 0.0, float("nan")), "time_s must be finite"),
        (lambda saw: saw.run_campbell(speed_range=("0 Hz", "40 Hz")), "sweep.to_rpm must be a number in rpm"),
        (lambda saw: saw.check(operating_rpm="fast"), "operating_rpm must be a number in rpm.*30 rev/s"),
        (lambda saw: saw.check(operating_rpm="40 Hz"), "operating_rpm must be a number in rpm"),
        (lambda saw: saw.check(min_flutter_rpm=[1]), "min_flutter_rpm must be a number in rpm"),
    ],
)  # fmt: skip
def test_a_first_guess_says_what_works(draft: sf.Scene, guess: Callable[[Any], object], words: str) -> None:
    with pytest.raises(sf.InputError, match=words) as caught:
        guess(draft)
    for inner in ("SceneData", "Questions", "Searches", "looking"):
        assert inner not in str(caught.value)


def test_an_unknown_keyword_names_the_method_and_those_it_takes(draft: sf.Scene, report: sf.CampbellResults) -> None:
    with pytest.raises(TypeError, match=r"plot\(\) takes speed_units, frequency_units, harmonics"):
        report.plot(frequency_range=(0, 100))  # type: ignore[call-arg]
    with pytest.raises(TypeError, match=r"Scene\.replace\(\)"):
        draft.replace(thickness=1)  # type: ignore[call-arg]


def test_unknown_keys_and_words_say_what_is_allowed() -> None:
    for changes, key, allowed in (
        ({"accuracy": "perfect"}, "accuracy", "draft, design, reference"),
        ({"blade.thicknes_m": 0.003}, "blade.thicknes_m", "thickness_m"),
        ({"blade.thickness_m": True}, "blade.thickness_m", "a number"),
    ):
        with pytest.raises(sf.SceneError) as caught:
            sf.Scene.paper().replace(changes)
        assert caught.value.key == key and caught.value.remedy and "line" not in str(caught.value)
        assert caught.value.remedy.partition(";")[0] in f"{caught.value}; give {caught.value.allowed}"
        assert caught.value.allowed is not None and allowed in caught.value.allowed


def test_units_go_wherever_numbers_go(draft: sf.Scene) -> None:
    assert sf.Scene({**draft.to_dict(), "operating_rpm": "40 rev/s"})["operating_rpm"] == pytest.approx(2400.0)
    swept = draft.run_campbell(speed_range=("0 rpm", "10 rev/s"))
    assert swept.saw["sweep.to_rpm"] == pytest.approx(600.0)
    check = draft.check(operating_rpm="20 rev/s", max_rim_m_per_s="6 km/min")
    assert check == draft.check(operating_rpm=1200.0, max_rim_m_per_s=100.0)
    bounds = {"guides[0].radius_m": ("200 mm", "240 mm")}
    (radius,) = draft.place(free=bounds, samples=1, refine=1, map=0).parameters
    assert (radius.bound_from, radius.bound_to) == (0.2, 0.24)
    cut = {f"cut.{key}": None for key in ("speeds", "tangential_n_per_tooth", "teeth_in_cut")}
    assert draft.replace(cut).run_cut(2000, power_w="9 kW", depth_m="80 mm").runs[0].rpm == 2000.0


def test_blocks_that_the_scene_lacks_are_assumed_and_named(draft: sf.Scene) -> None:
    bare = draft.replace({"runup": None})
    with pytest.warns(sf.ModelWarning, match=r"no runup; assumed.*duration_s = 60") as told:
        up = bare.run_up(to_rpm=400, force_n=2.0)
    assert {warning.filename for warning in told} == {__file__}
    assert up.rpm[-1] == pytest.approx(400.0) and up.saw["side_force.force_n"] == 2.0


@pytest.mark.parametrize(
    "ask",
    [
        lambda saw: saw.modes(300),
        lambda saw: saw.matrices(basis=(6, 4)),
        lambda saw: saw.speeds(),
        lambda saw: sf.compare(saw, saw),
        lambda saw: saw.run_stiffness_map([1e5]),
    ],
)
def test_every_method_that_answers_warns_of_a_number_that_no_saw_has(
    draft: sf.Scene, ask: Callable[[sf.Scene], object]
) -> None:
    wrong = draft.replace({"blade.material.density_kg_per_m3": 785.0, "sweep.to_rpm": 900})
    with pytest.warns(sf.ModelWarning, match="density") as told:
        ask(wrong)
    assert {warning.filename for warning in told} == {__file__}


def test_a_study_whose_saws_are_refused_warns(draft: sf.Scene, tmp_path: Any) -> None:
    even = {"kind": "tolerance", "plus_minus": 5}
    free = draft.replace({"guides": []})
    study = sf.Study(free, {"name": "metres", "saws": 2, "parameters": [{"path": "blade.thickness_m", "distribution": even}]})
    with pytest.warns(sf.ModelWarning, match="saws refused"):
        study.run(tmp_path)


def test_modes_name_their_speed_exactly_and_where_they_end(draft: sf.Scene) -> None:
    found = draft.modes([1000, 1234.5])
    assert [at[0].rpm for at in found] == [1000.0, 1234.5]
    eigenvalues = np.linalg.eigvals(draft.matrices().companion(1000))
    hz = np.sort(eigenvalues.imag[eigenvalues.imag > 1e-3]) / (2 * np.pi)
    # No eigenvalue of the whole matrix below the end is missing.
    assert len(found[0]) == np.count_nonzero(hz < found.complete_to_hz)
    low = draft.modes(1000, to_hz=50, n_modes=4)
    assert len(low) == 4 and low.frequency_hz.shape == (4,)
    assert len(draft.modes(1000, to_hz=50)) == np.count_nonzero(hz < 50.0)


def test_a_branch_between_its_speeds_is_near_the_modes(draft: sf.Scene) -> None:
    """Half way between samples of a damped saw, against modes at those speeds: 0.12 1/s by lines."""
    saw = draft.replace({"guides[0].damping_n_s_per_m": 20.0})
    r = saw.run_campbell()
    branches = r.branches[:8]
    middles = np.unique(np.concatenate([(b.rpm[1:] + b.rpm[:-1]) / 2 for b in branches]))[::12]
    off, lines = [], []
    for rpm, modes in zip(middles, saw.modes(middles)):
        values = np.array([(m.frequency_hz, m.growth_per_s) for m in modes])
        for branch in branches:
            hz, growth = branch.at(rpm)
            if not np.isnan(hz):
                k = np.argmin(np.abs(values[:, 0] - hz) + np.abs(values[:, 1] - growth))
                off.append(abs(values[k, 1] - growth))
                lines.append(abs(values[k, 1] - np.interp(rpm, branch.rpm, branch.growth_per_s)))
    assert np.quantile(off, 0.99) < 0.25 * np.quantile(lines, 0.99)


def test_the_response_of_many_frequencies_takes_little_memory(draft: sf.Scene) -> None:
    m = draft.replace({"damping.air_n_s_per_m3": 100.0}).matrices(basis=(12, 6))
    rim, hz = [(0.355, 0.0), (0.3, 90.0)], np.linspace(1.0, 90.0, 60)
    tracemalloc.start()
    found = m.response(900, hz, inputs=rim, outputs=rim)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert found.shape == (60, 2, 2) and peak < 200e6
    # Maxwell's reciprocity holds for the second-order system at rest, written out.
    speed, omega = 900 * np.pi / 30, 2 * np.pi * hz[7]
    phi = m.at(*np.transpose(rim))
    matrix = m.stiffness + speed**2 * m.spin - omega**2 * m.mass + 1j * omega * 2 * speed * m.gyroscopic
    assert m.damping is not None
    matrix = matrix + 1j * omega * m.damping
    if m.circulatory is not None:
        matrix = matrix + speed * m.circulatory
    assert np.allclose(found[7], phi @ np.linalg.solve(matrix, phi.T), rtol=1e-9)


def test_a_force_that_swings_ends_in_its_response(draft: sf.Scene) -> None:
    """After the transient the history is |H| sin(ωt + arg H), with H of the frequency domain."""
    m = draft.replace({"damping.air_n_s_per_m3": 4000.0}).matrices(basis=(6, 4))
    rim, hz = [(0.355, 0.0)], 6.0
    times = np.linspace(0.0, 4.0, 4001)
    forces = np.sin(2 * np.pi * hz * times)[:, None]
    history = m.run_time_response(600, forces, times, inputs=rim, outputs=rim, to_hz=60)[:, 0]
    h = m.state_space(600, inputs=rim, outputs=rim, to_hz=60).response(hz)[0, 0]
    steady = np.abs(h) * np.sin(2 * np.pi * hz * times + np.angle(h))
    assert np.allclose(history[-500:], steady[-500:], atol=2e-3 * abs(h))


def test_speeds_are_those_of_the_chart(draft: sf.Scene) -> None:
    """On the basis of a similar saw, within the estimated errors of both."""
    thin = draft.replace({"blade.thickness_m": 2.7e-3})
    found, r = thin.speeds(beside=draft), thin.run_campbell()
    assert found.first_critical_rpm == pytest.approx(r.first_critical_rpm, rel=2e-3)
    assert found.flutter_rpm == pytest.approx(r.flutter_rpm, rel=5e-3)
    assert found.critical_rpm == pytest.approx(r.critical_rpm, rel=5e-3)
    assert [band.kind for band in found.bands[:3]] == [band.kind for band in r.bands[:3]]
    assert thin.speeds(beside=draft) == found and found.to_rpm == pytest.approx(3000.0)
    # A saw alone has a basis of its own.
    own = thin.speeds()
    assert own.flutter_rpm == pytest.approx(r.flutter_rpm, rel=5e-3) and own.to_rpm == found.to_rpm
    assert own.critical_rpm == pytest.approx(r.critical_rpm, rel=5e-3)


def test_what_is_shown_is_short(draft: sf.Scene, report: sf.CampbellResults) -> None:
    for shown in (draft.modes([0, 500]), draft.modes(500), report.branches[0], report.chart(), draft.speeds()):
        assert len(repr(shown)) < 1000, type(shown)
    assert "[0, 0.5]" in repr(sf.Record([0.0, 1.0], 2).time_s) or "0.5" in repr(sf.Record([0.0, 1.0], 2).time_s)
    for table in (draft, draft.modes(500)):
        assert "<table>" in table._repr_html_()


def test_progress_never_runs_back(draft: sf.Scene) -> None:
    told: list[tuple[int, int]] = []
    draft.run_campbell(progress=lambda done, of, _: told.append((done, of)))
    for before, after in zip(told, told[1:]):
        assert after[0] >= before[0] or after[1] != before[1]


def test_keys_and_schema_are_those_of_the_program() -> None:
    assert "guides[].gap_m  [m]" in sf.keys("guides[].gap_m")
    assert "blade" in sf.schema()["properties"] and "saws" in sf.schema(study=True)["properties"]


def test_a_call_gives_no_warning_where_there_is_none(draft: sf.Scene) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error", sf.ModelWarning)
        draft.modes(500), draft.speeds()


if TYPE_CHECKING:
    from typing_extensions import assert_type

    def types_are_what_mypy_says(saw: sf.Scene, speeds: np.ndarray[Any, np.dtype[np.float64]]) -> None:
        """Checked by mypy: an assignment that is no error would be an unused ignore."""
        assert_type(saw["blade.thickness_m"], float)
        assert_type(saw["guides[1].radius_m"], float)
        assert_type(saw.modes(speeds), sf.Modes[tuple[sf.Mode, ...]])
        assert_type(saw.modes(900.0), sf.Modes[sf.Mode])
        assert_type(saw.modes(900)[0], sf.Mode)
        saw["x"] = 3  # type: ignore[index]
        saw["x"] + 3  # type: ignore[operator]
        saw.fit([(0.0, speeds)])
