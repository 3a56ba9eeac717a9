"""Every command of the program has its method; the numbers are those of the library's tests."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sawflutter as sf


def test_check_holds_a_saw_against_limits(draft: sf.Scene) -> None:
    passed = draft.check(operating_rpm=1250, min_critical_rpm=1500, min_flutter_rpm=2200)
    assert passed.passed and passed.failures == ()
    failed = draft.check(operating_rpm=1250, min_critical_rpm=1600, min_flutter_rpm=2500)
    assert not failed.passed
    assert [c.key for c in failed.verdict.limits if c.answer != "yes"] == ["min_critical", "min_flutter"]
    asked = {c.key: c.asked_rpm for c in failed.verdict.limits}
    assert asked["min_flutter"] == pytest.approx(2500.0)
    assert asked["margin"] == pytest.approx(1250.0 / 0.85)
    assert list(failed.to_dataframe()["answer"]) == [c.answer for c in failed.verdict.limits]
    # The default speed is that of the scene: 1800 rpm.
    assert draft.check().operating_rpm == pytest.approx(1800.0)


def test_the_truth_of_a_check_is_whether_it_passed(draft: sf.Scene) -> None:
    assert draft.check(operating_rpm=1250, min_critical_rpm=1500)
    failed = draft.check(operating_rpm=1250, min_critical_rpm=1600)
    assert not failed
    # pytest shows for a failed assertion: the limit, the value found, the value required.
    with pytest.raises(AssertionError) as raised:
        assert draft.check(operating_rpm=1250, min_critical_rpm=1600)
    shown = str(raised.value)
    assert "first critical speed" in shown and "1600" in shown and "153" in shown


def test_a_number_in_another_unit_fails_a_check_unless_it_is_accepted(draft: sf.Scene) -> None:
    failed = draft.check(operating_rpm=1.25)
    assert not failed.passed
    assert "thousands of rpm? That would be 1250 rpm" in failed.failures[0]
    assert failed.unusual_numbers == failed.failures[:1] and "1250 rpm" in repr(failed)
    accepted = draft.check(operating_rpm=1.25, accept_unusual=True)
    assert accepted.passed and accepted.failures == ()


def test_a_refused_computation_names_unusual_numbers(draft: sf.Scene) -> None:
    saw = draft.replace({"operating_rpm": 1.25})
    named = pytest.warns(sf.ModelWarning, match="operating_rpm is 1.25")
    with named, pytest.raises(sf.ArgumentError, match="to_rpm"):
        saw.run_deflect(to_rpm=-1)


def test_a_sized_number_is_where_a_check_passes(draft: sf.Scene) -> None:
    saw = draft.replace({"operating_rpm": 1300, "sweep": None})
    found = saw.size({"blade.thickness_m": ("2 mm", "3.2 mm")}, points=5)
    (window,) = found.windows
    assert window.above is None and "85 % rule" in (window.below or "")
    for thickness_m, passes in [(window.from_, True), (0.999 * window.from_, False)]:
        assert bool(saw.replace({"blade.thickness_m": thickness_m}).check()) is passes
    assert found.answer is not None and found.answer.value == 0.0028
    assert found.saw["blade.thickness_m"] == 0.0028
    assert found.plot_matplotlib() is not None
    with pytest.raises(sf.ArgumentError, match="one number"):
        saw.size(["blade.thickness_m", "guides[0].radius_m"])


def test_limits_that_no_check_has_are_refused(draft: sf.Scene) -> None:
    for arguments, key in [
        ({"operating_rpm": -3.0}, "operating_rpm"),
        ({"operating_rpm": float("nan")}, "operating_rpm"),
        ({"margin": 1.2}, "limits.margin"),
        ({"min_flutter_rpm": 0.0}, "limits.min_flutter_rpm"),
        ({"min_critical_rpm": float("inf")}, "limits.min_critical_rpm"),
        ({"max_deviation_m": -1e-4}, "limits.max_deviation_m"),
    ]:
        with pytest.raises(sf.InputError) as caught:
            draft.check(**arguments)  # type: ignore[arg-type]
        assert caught.value.key == key
        assert caught.value.allowed is not None and caught.value.allowed in str(caught.value)
    nowhere = draft.replace({"operating_rpm": None, "cut": None})
    with pytest.raises(sf.ArgumentError, match="operating_rpm"):
        nowhere.check()


def test_cut_is_stable_at_1800_and_flutters_at_2800() -> None:
    # docs/tutorials/stable-in-the-cut.md: 5.67 1/s at 4.53 Hz.
    cut = sf.Scene.paper().run_cut()
    slow, fast = cut.runs
    assert [slow.stability, fast.stability] == ["stable", "unstable"]
    assert [slow.verdict.answer, fast.verdict.answer] == ["at_risk", "no"]
    assert [slow.rpm, fast.rpm] == pytest.approx([1800.0, 2800.0])
    assert fast.growth_per_s == pytest.approx(5.67, abs=0.03)
    assert fast.frequency_hz == pytest.approx(4.53, abs=0.02)
    assert fast.time_s.shape == fast.deflection_m.shape
    shape = (len(fast.map.load_level), len(fast.map.guide_angle_deg))
    assert fast.map.growth_per_s.shape == shape
    assert "Can it cut at 2800 rpm? NO: growth of 5.6" in repr(cut)
    assert len(cut.to_dataframe()) == 2


def test_cut_takes_other_speeds(draft: sf.Scene) -> None:
    cut = draft.run_cut(2000.0)
    assert [run.rpm for run in cut.runs] == pytest.approx([2000.0])
    with pytest.raises(sf.SceneError):
        draft.run_cut(-1.0)
    with pytest.raises(sf.ArgumentError, match="cut"):
        draft.replace({"cut": None}).run_cut()


def test_run_up_crosses_bands(draft: sf.Scene) -> None:
    up = draft.run_up()
    assert up.rpm.shape == up.deflection_m.shape
    assert up.bands and up.bands[0].band.kind == "divergence"
    assert up.bands[0].growth_exponent > 0.0
    response = up.response
    shape = (len(response.rpm), len(response.frequency_hz))
    assert response.receptance_m_per_n.shape == shape
    table = up.to_dataframe()
    assert len(table) == len(up.rpm) and list(table) == ["rpm", "deflection_m"]
    with pytest.raises(sf.ArgumentError, match="runup"):
        draft.replace({"runup": None}).run_up()


def test_washboarding_grows_with_the_cutting_stiffness(resaw: sf.Scene) -> None:
    found = resaw.run_washboard()
    assert found.verdict == "unstable" and found.growing_eigenvalues == 2
    assert found.modes[0].growth_per_s > 0.0 > found.modes[-1].growth_per_s
    least = found.critical_stiffness_n_per_m
    assert least is not None and least < found.stiffness_n_per_m
    lobes = found.lobes
    shape = lobes.rpm.shape
    assert lobes.critical_stiffness_n_per_m.shape == lobes.frequency_hz.shape == shape
    assert len(found.to_dataframe()) == len(found.modes)
    below = resaw.replace({"cut.washboarding.stiffness_n_per_m": 0.9 * least})
    assert below.run_washboard().verdict == "stable"
    assert "2400 rpm: UNSTABLE" in repr(found)


def test_washboarding_without_damping_or_a_stiffness_is_refused(resaw: sf.Scene) -> None:
    with pytest.raises(sf.SceneError, match="damping") as refused:
        resaw.replace({"damping": None}).run_washboard()
    assert refused.value.key == "damping"
    with pytest.raises(sf.ArgumentError, match="cut.washboarding"):
        resaw.replace({"cut.washboarding": None}).run_washboard()
    with pytest.raises(sf.ArgumentError, match="rpm"):
        resaw.replace({"operating_rpm": None}).run_washboard()


def test_fit_finds_the_guide_of_the_paper(tmp_path: Path) -> None:
    # docs/tutorials/measured-to-guide.md: 0.194 m and 2.08e7 N/m at 0.983 Hz rms.
    saw = sf.Scene.paper()
    found = saw.fit(to_rpm=1250, starts=3)
    values = {parameter.path: parameter.value for parameter in found.parameters}
    assert values["guides[0].radius_m"] == pytest.approx(0.194, abs=0.001)
    assert values["guides[0].stiffness_n_per_m"] == pytest.approx(2.08e7, rel=0.01)
    assert found.rms_hz == pytest.approx(0.983, abs=0.002)
    assert found.saw["guides[0].radius_m"] == values["guides[0].radius_m"]
    # The same table as rows, as a file and as an array.
    table = saw.to_dict()["measured"]
    assert table is not None
    rows = [(row["rpm"], np.array(row["frequencies_hz"], float)) for row in table["rows"]]
    again = saw.fit(rows, to_rpm=1250, starts=3)
    assert again.rms_hz == found.rms_hz
    path = tmp_path / "measured.csv"
    path.write_text(
        "rpm,f1_hz,f2_hz,f3_hz,f4_hz\n" + "\n".join(f"{r},{','.join(map(str, f))}" for r, f in rows)
    )
    assert saw.fit(path, to_rpm=1250, starts=3).rms_hz == found.rms_hz


def test_fit_frees_what_is_named(draft: sf.Scene) -> None:
    table = np.array([[0.0, 10.0, np.nan, 26.0], [500.0, 4.5, 15.5, 28.0]])
    found = draft.fit(table, free={"guides[0].stiffness_n_per_m": (1e6, 1e8)}, starts=2)
    assert [p.path for p in found.parameters] == ["guides[0].stiffness_n_per_m"]
    assert (found.parameters[0].bound_from, found.parameters[0].bound_to) == (1e6, 1e8)
    assert found.measured_frequencies == 5


def test_what_cannot_be_fitted_is_refused(draft: sf.Scene, tmp_path: Path) -> None:
    with pytest.raises(sf.ArgumentError, match="confidence"):
        draft.fit(confidence=1.0)
    with pytest.raises(sf.ArgumentError, match="starts"):
        draft.fit(starts=0)
    with pytest.raises(sf.SceneError, match="range"):
        draft.fit(free={"guides[0].radius_m": (0.3, 0.2)})
    with pytest.raises(sf.SceneError, match="guides\\[4\\]"):
        draft.fit(free=["guides[4].radius_m"])
    with pytest.raises(sf.ArgumentError, match="measured"):
        draft.replace({"measured": None}).fit()
    with pytest.raises(FileNotFoundError):
        draft.fit("no-such-table.csv")
    table = tmp_path / "measured.csv"
    table.write_text("rpm,f1_hz,f2_hz\n100,20,30\n200,21,thirty\n")
    with pytest.raises(sf.InputError, match="line 3"):
        draft.fit(table)


def test_place_moves_what_is_named_within_its_bounds(draft: sf.Scene) -> None:
    bounds = (0.18, 0.28)
    found = draft.place(free={"guides[0].radius_m": bounds}, samples=4, refine=6, map=0)
    (radius,) = found.parameters
    assert (found.goal, radius.path) == ("flutter_speed", "guides[0].radius_m")
    assert (radius.bound_from, radius.bound_to) == bounds
    assert bounds[0] <= radius.value <= bounds[1]
    assert found.saw["guides[0].radius_m"] == radius.value
    assert found.before.goal_rpm == pytest.approx(2256.0, rel=5e-3)
    worst, before = found.worst_neighbour, found.worst_before
    assert worst is not None and worst.outcome is not None and before.outcome is not None
    assert worst.outcome.goal_rpm >= before.outcome.goal_rpm
    # In lines of 80 columns.
    assert found.certificate.statement in " ".join(found.summary(details=True).split())
    assert found.certificate.statement not in " ".join(found.summary().split())


def test_what_cannot_be_placed_is_refused(draft: sf.Scene) -> None:
    with pytest.raises(sf.ArgumentError, match="goal"):
        draft.place(goal="noise")  # type: ignore[arg-type]
    with pytest.raises(sf.SceneError, match="guides"):
        draft.replace({"guides": []}).place()
    with pytest.raises(sf.ArgumentError, match="operating_rpm"):
        draft.replace({"operating_rpm": None, "cut": None}).place(goal="window")
    with pytest.raises(sf.ArgumentError, match="map"):
        draft.place(map=1)
    with pytest.raises(sf.ArgumentError, match="radius_tolerance_m"):
        draft.place(radius_tolerance_m=2.0)


def test_tradeoff_measures_time_and_error(draft: sf.Scene, tmp_path: Path) -> None:
    found = draft.replace({"sweep.to_rpm": 1600}).tradeoff()
    assert {s.method for s in found.settings} >= {"reduced", "dense", "critical_speeds"}
    coarse, fine = found.recommended(1e-2), found.recommended(1e-3)
    assert coarse is not None and fine is not None and coarse.seconds <= fine.seconds
    assert found.recommended(0.0) is None
    found.save(tmp_path / "tradeoff.json")
    read = sf.load(tmp_path / "tradeoff.json")
    assert isinstance(read, sf.TradeoffResults) and read == found
    assert pickle.loads(pickle.dumps(found)) == found
    assert len(found.to_dataframe()) == len(found.settings)


def test_matrices_are_symmetric_and_skew(draft: sf.Scene) -> None:
    m = draft.matrices(basis=(6, 4))
    size = 4 * (2 * 6 + 1)
    assert m.stiffness.shape == m.spin.shape == m.gyroscopic.shape == (size, size)
    assert np.allclose(m.stiffness, m.stiffness.T) and np.allclose(m.spin, m.spin.T)
    assert np.allclose(m.gyroscopic, -m.gyroscopic.T)
    assert np.array_equal(m.mass, np.eye(size))
    assert m.damping is None and m.circulatory is None
    with pytest.raises(sf.ArgumentError, match="basis"):
        draft.matrices(basis=(1, 4))


def test_a_critical_speed_makes_the_stiffness_singular() -> None:
    saw = sf.Scene.paper()
    m = saw.matrices()
    for rpm in saw.run_campbell().critical_rpm[:4]:
        speed = rpm * np.pi / 30.0
        eigenvalues = np.linalg.eigvalsh(m.stiffness + speed**2 * m.spin)
        assert np.min(np.abs(eigenvalues)) < 1e-9 * np.max(np.abs(eigenvalues))


def test_every_result_is_saved_loaded_and_pickled(
    draft: sf.Scene, resaw: sf.Scene, tmp_path: Path
) -> None:
    results = (draft.check(), draft.run_cut(1800.0), draft.run_up(), draft.fit(starts=1))
    for result in (*results, resaw.run_washboard()):
        result.save(tmp_path / "result.json")
        loaded = sf.load(tmp_path / "result.json")
        assert loaded == result and type(loaded) is type(result)
        assert pickle.loads(pickle.dumps(result)) == result
        assert "<img" in result._repr_html_()
        assert result.saw.name in result.summary()


def test_a_saw_that_cannot_be_analysed_says_why(draft: sf.Scene) -> None:
    with pytest.raises(sf.AnalysisError, match="sweep.to_rpm"):
        draft.replace({"sweep.to_rpm": 900000}).run_campbell()


@pytest.mark.parametrize(
    ("ask", "key"),
    [
        (lambda saw, number: saw.place(map=number), "map"),
        (lambda saw, number: saw.place(samples=number), "samples"),
        (lambda saw, number: saw.place(refine=number), "refine"),
        (lambda saw, number: saw.fit([7.9], starts=number), "starts"),
        (lambda saw, number: saw.matrices(basis=(number, 4)), "basis"),
        (lambda saw, number: saw.matrices(basis=(6, number)), "basis"),
        (lambda saw, number: saw.run_stiffness_map([1e5], guide=number), "guide"),
    ],
)
def test_whole_numbers_that_are_none_are_named(
    draft: sf.Scene, ask: Callable[[sf.Scene, Any], object], key: str
) -> None:
    for number in (-1, 2**64, np.int64(-1)):
        with pytest.raises(sf.ArgumentError, match=rf"{key} must be .*\(you gave {number}\)") as caught:
            ask(draft, number)
        assert caught.value.key == key and caught.value.remedy
    for other in (2.0, True, np.bool_(True), "2"):
        with pytest.raises(TypeError, match=f"{key} must be a whole number"):
            ask(draft, other)


def test_a_response_takes_the_side_force(draft: sf.Scene) -> None:
    found = draft.run_response(rpm=1200, to_hz=50, force_n="2 N", angle_deg=30)
    assert found.constant_force_n == 2.0 and found.saw["side_force.angle_deg"] == 30.0
