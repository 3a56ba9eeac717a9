"""Charts: the numbers of the library's own tests, and their conversion by Python."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import numpy as np
import pytest

import sawflutter as sf


def test_the_free_blade_has_its_exact_critical_speed() -> None:
    # Exact, 1476.6 rpm.
    free = sf.Scene.paper().replace({"guides": []})
    lowest = free.run_campbell().critical_rpm[0]
    assert lowest == pytest.approx(1476.6, abs=0.2)


def test_the_guided_saw_has_its_bands() -> None:
    r = sf.Scene.paper().run_campbell()
    assert r.critical_rpm[:4] == pytest.approx([1530.7, 1551.6, 2090.7, 2129.8], rel=1e-3)
    assert r.flutter_rpm is not None and r.flutter_rpm == pytest.approx(2256.0, rel=1e-3)
    first = r.bands[0]
    assert (first.kind, first.closed) == ("divergence", True)
    assert [first.from_rpm, first.to_rpm] == pytest.approx(r.critical_rpm[:2])
    assert r.certificate.statement.startswith("Krein index matches at ")
    assert r.certificate.krein_violations == 0 and r.certificate.speeds_checked > 50


def test_branches_are_arrays_that_cannot_be_written_to(report: sf.CampbellResults) -> None:
    for branch in report.branches:
        names = ("rpm", "frequency_hz", "body_frequency_hz", "growth_per_s")
        arrays = [getattr(branch, name) for name in names]
        assert all(array.dtype == np.float64 for array in arrays)
        assert {array.shape for array in arrays} == {branch.rpm.shape}
        assert branch.krein_sign.dtype == np.int64
        assert branch.dominant_harmonics.shape == (len(branch.rpm), 2)
        with pytest.raises(ValueError):
            branch.rpm[0] = 1.0
        assert np.all(np.diff(branch.rpm) > 0.0)
    with pytest.raises(AttributeError):
        report.bands[0].from_rpm = 3.0  # type: ignore[misc]


def test_numpy_finds_the_same_eigenvalues(draft: sf.Scene) -> None:
    """The modes of the package agree with NumPy's eigenvalues of the exported matrices."""
    matrices = draft.matrices()
    for rpm in (0.0, 500.0, 1200.0, 1800.0, 2275.0, 2975.0):
        eigenvalues = np.linalg.eigvals(matrices.companion(rpm))
        modes = draft.modes(rpm)
        for mode in modes[:6]:
            value = mode.growth_per_s + 2j * np.pi * mode.frequency_hz
            off = np.min(np.abs(eigenvalues - value))
            assert off < 1e-4 * max(abs(value), 1.0), (rpm, mode.name, off)
        fastest = max((mode.growth_per_s for mode in modes), default=0.0)
        low = eigenvalues[np.abs(eigenvalues.imag) < 2 * np.pi * modes[-1].frequency_hz]
        assert fastest == pytest.approx(max(low.real), abs=2e-3)


def test_modes_lie_on_the_branches(draft: sf.Scene, report: sf.CampbellResults) -> None:
    # Modes at rest are computed; others are interpolated, within the stated share of the height of the diagram.
    speeds = report.branches[0].rpm
    between = float(speeds[np.argmin(abs(speeds - 1000.0))])
    for rpm, error in (0.0, 1e-3), (between, 5e-4 * report.campbell.complete_to_hz):
        modes = draft.modes(rpm)
        drawn = sorted(float(b.at(rpm)[0]) for b in report.branches if not np.isnan(b.at(rpm)[0]))
        for mode, frequency in zip(modes, drawn):
            assert mode.frequency_hz == pytest.approx(frequency, abs=error)
    assert [m.frequency_hz for m in report.saw.modes(rpm)] == [m.frequency_hz for m in modes.modes]


def test_a_mode_at_rest_of_the_free_blade_has_its_nodal_diameters() -> None:
    free = sf.Scene.paper().replace({"guides": [], "accuracy": "draft"})
    mode = next(
        m
        for m in free.run_campbell().modes_at_rest
        if m.nodal_circles == 0 and m.nodal_diameters == 2
    )
    around = np.linspace(0.0, 360.0, 400, endpoint=False)
    w = mode.shape(0.355, around)
    assert np.max(np.abs(w)) == pytest.approx(1.0, abs=1e-2)
    assert np.count_nonzero(np.diff(np.sign(w))) in (3, 4)
    for beside_m in (0.36, 0.09, 200):
        with pytest.raises(sf.ArgumentError, match=r"radius_m must be from 0\.1 to 0\.355, the radii of the blade"):
            mode.shape([0.2, beside_m], 0.0)


def test_a_reflected_wave_turns_with_the_rotation_and_a_backward_one_against(
    draft: sf.Scene,
) -> None:
    """The direction is that of the phase of the dominant harmonic along θ, from the shape alone."""
    seen = set()
    for mode in draft.modes(rpm=1800.0):
        # A single harmonic of a mixture does not determine the direction of the whole.
        if mode.harmonics[0].share < 0.67 or (mode.krein_sign > 0 and mode.direction != "backward"):
            continue
        n = mode.harmonics[0].nodal_diameters
        around = np.linspace(0.0, 360.0, 256, endpoint=False)
        w = mode.shape(0.35, around)
        # e^{i(ωt − nθ)} moves forward.
        forward = abs(np.mean(w * np.exp(1j * n * np.radians(around))))
        backward = abs(np.mean(w * np.exp(-1j * n * np.radians(around))))
        assert (forward > backward) == (mode.krein_sign < 0), mode.name
        seen.add(mode.direction)
    assert {"reflected", "backward"} <= seen


def test_a_speed_outside_the_sweep_is_refused(draft: sf.Scene) -> None:
    for rpm, said in ((-1.0, "3000"), (3001.0, "3000"), (float("nan"), "finite")):
        with pytest.raises(sf.ArgumentError, match=said) as caught:
            draft.modes(rpm)
        assert caught.value.key == "rpm"


def test_a_number_of_modes_that_is_not_complete_is_warned_of(draft: sf.Scene) -> None:
    with pytest.warns(sf.ModelWarning, match=r"12 of 500 modes are complete, up to 167\.4 Hz"):
        assert len(draft.modes(0, n_modes=500)) == 12
    with pytest.raises(sf.ArgumentError, match="n_modes must be at least 1"):
        draft.modes(0, n_modes=0)


def test_modes_and_matrices_have_the_basis_of_a_similar_saw(draft: sf.Scene) -> None:
    fine, thin = draft.with_accuracy("design"), draft.replace({"blade.thickness_m": "2.6 mm"})
    sizes = [len(of.stiffness) for of in (thin.matrices(), thin.matrices(beside=fine), fine.matrices())]
    assert sizes[0] < sizes[1] and sizes[1] == sizes[2]
    # A larger basis lowers frequencies at rest.
    alone, beside = thin.modes(0)[0], thin.modes(0, beside=fine)[0]
    assert beside.frequency_hz < alone.frequency_hz < beside.frequency_hz * 1.001
    with pytest.raises(TypeError, match="not both"):
        thin.matrices((8, 5), beside=fine)


def test_every_key_of_the_report_is_an_attribute(report: sf.CampbellResults) -> None:
    names = {"instabilities": "bands", "flutter_rpm": "flutter_rpm"}
    for key, value in report.to_dict().items():
        found = getattr(report, names.get(key, key))
        if isinstance(value, (str, int, float, type(None))):
            assert found == value, key
    raw = report.to_dict()["campbell"]["branches"][3]
    for key, value in raw.items():
        found = getattr(report.branches[3], key)
        read = found.tolist() if isinstance(found, np.ndarray) else found
        assert (list(read) if isinstance(read, tuple) else read) == value, key


def test_a_report_with_keys_that_are_not_known_yet_is_read(report: sf.CampbellResults) -> None:
    data = report.to_dict()
    data["of_tomorrow"] = {"x": 1}
    data["bands_of_tomorrow"] = []
    data["certificate"]["of_tomorrow"] = 3
    read = sf.CampbellResults._from_json(json.dumps(data))
    assert read.to_dict()["of_tomorrow"] == {"x": 1}
    assert read.bands == report.bands


def test_a_result_is_saved_loaded_and_pickled(report: sf.CampbellResults, tmp_path: Path) -> None:
    report.save(tmp_path / "report.json")
    loaded = sf.load(tmp_path / "report.json")
    assert loaded == report and hash(loaded) == hash(report)
    copy = pickle.loads(pickle.dumps(report))
    assert copy == report and copy.bands == report.bands
    assert pickle.loads(pickle.dumps(report.bands[0])) == report.bands[0]
    report.saw.save(tmp_path / "scene.json")
    with pytest.raises(ValueError, match="no report"):
        sf.load(tmp_path / "scene.json")


def test_a_table_has_a_row_a_branch_and_speed(report: sf.CampbellResults, tmp_path: Path) -> None:
    frame = report.to_dataframe()
    assert len(frame) == sum(len(branch.rpm) for branch in report.branches)
    third = frame[frame["branch"] == report.branches[2].branch]
    assert np.array_equal(third["frequency_hz"].to_numpy(), report.branches[2].frequency_hz)
    report.save(tmp_path / "campbell.csv")
    assert (tmp_path / "campbell.csv").read_text().startswith("branch,name,rpm,frequency_hz")


def test_a_notebook_shows_the_verdict_and_the_chart(report: sf.CampbellResults) -> None:
    # The answer is that of the program's text.
    assert "Can it run at 1800 rpm?" in repr(report) and "Flutter speed" in repr(report)
    assert repr(report).partition("? ")[2][:10] in report.summary()
    shown = report._repr_html_()
    assert "data:image/svg+xml;base64," in shown
    assert report.saw.name in shown and "<script" not in shown
    assert "Flutter speed" in shown and "Critical speeds" in shown


def test_sensitivities_are_asked_for(draft: sf.Scene) -> None:
    r = draft.run_campbell(sensitivity=True)
    paths = [s.parameter for s in r.sensitivities]
    assert "blade.thickness_m" in paths
    thickness = r.sensitivities[paths.index("blade.thickness_m")]
    # Compared with the critical speed of a blade that is 1 % thicker.
    thicker = draft.replace({"blade.thickness_m": 1.01 * draft["blade.thickness_m"]})
    moved = 100.0 * (thicker.run_campbell().critical_rpm[0] / r.critical_rpm[0] - 1.0)
    assert thickness.critical_speeds_percent[0] == pytest.approx(moved, rel=0.05)


def test_the_certificate_says_what_it_compared(draft: sf.Scene) -> None:
    damped = draft.replace({"guides[0].damping_n_s_per_m": 20.0}).run_campbell()
    assert "growing modes" in damped.certificate.statement
    report = draft.run_campbell()
    assert "Krein index matches" in report.certificate.statement
    assert not report.certificate.gave_up and not len(report.certificate.violating_rpm)


def test_accuracy_and_tolerance_are_chosen(draft: sf.Scene) -> None:
    r = draft.run_campbell(tolerance=3e-3)
    assert r.accuracy.tolerance == 3e-3
    assert draft.run_campbell(accuracy="design").accuracy.name == "design"
    with pytest.raises(TypeError):
        draft.run_campbell(accuracy="design", tolerance=1e-3)
    with pytest.raises(sf.SceneError):
        draft.run_campbell(tolerance=7.0)
    with pytest.raises(sf.SceneError):
        draft.run_campbell(accuracy="perfect")  # type: ignore[arg-type]


def test_branches_are_labelled_arrays(report: sf.CampbellResults) -> None:
    chart = report.to_xarray()
    assert chart.sizes["branch"] == len(report.branches)
    for branch in report.branches:
        row = chart.sel(branch=branch.branch)
        own = row.sel(rpm=branch.rpm)
        assert (own.frequency_hz.values == branch.frequency_hz).all()
        assert int(row.frequency_hz.notnull().sum()) == len(branch.rpm)
