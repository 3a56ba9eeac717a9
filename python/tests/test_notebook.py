"""Input types of a notebook, and the package's answers and errors."""

from __future__ import annotations

import copy
import pickle
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import sawflutter as sf
from sawflutter._measured import table

# A table as a person would write it, in which the second frequency at rest was not observed.
CSV = "0.0,10.0,,26.0\n500.0,4.5,15.5,28.0\n"
ROWS: list[list[float]] = [[0, 10.0, np.nan, 26.0], [500, 4.5, 15.5, 28.0]]


@pytest.mark.parametrize(
    "measured",
    [
        ROWS,
        np.array(ROWS),
        np.array(ROWS, np.float32),
        [(np.int64(0), [10.0, None, 26.0]), (500, np.array([4.5, 15.5, 28.0]))],
        ((row[0], tuple(row[1:])) for row in ROWS),
        pd.DataFrame(ROWS, columns=["rpm", "a", "b", "c"]),
        pd.DataFrame(ROWS, columns=["rpm", "a", "b", "c"])[["a", "rpm", "b", "c"]],
        pd.DataFrame(ROWS, columns=["rpm", "a", "b", "c"]).set_index("rpm"),
    ],
)
def test_measured_frequencies_come_as_a_notebook_has_them(measured: Any) -> None:
    assert table(measured) == ("measured", CSV)


@pytest.mark.parametrize(
    "at_rest", [[10.0, 15.5], (10, 15.5), np.array([10.0, 15.5]), pd.Series([10.0, 15.5])]
)
def test_frequencies_alone_are_those_at_rest(at_rest: Any) -> None:
    assert table(at_rest) == ("measured", "0.0,10.0,15.5\n")


def test_a_frame_may_name_its_columns_by_nodal_diameters() -> None:
    frame = pd.DataFrame([[152.6, 0.0, 127.1, np.nan]], columns=["n2", "rpm", "n0", "n1"])
    assert table(frame) == ("measured", "rpm,n2,n0,n1\n0.0,152.6,127.1,\n")


@pytest.mark.parametrize(
    "measured", [3.0, [["a", "b"]], pd.DataFrame({"speed": [1.0]}), [[0.0, [1.0, "x"]]]]
)
def test_what_is_no_table_of_frequencies_says_what_is(measured: Any) -> None:
    with pytest.raises(TypeError, match="rpm"):
        table(measured)


def test_numbers_of_numpy_go_wherever_numbers_go(draft: sf.Scene) -> None:
    speed = np.float32(1250.0)
    assert draft.check(operating_rpm=speed, margin=np.float64(0.85)) == draft.check(
        operating_rpm=1250.0, margin=0.85
    )
    assert draft.matrices(basis=(np.int64(6), np.int8(4))) == draft.matrices(basis=(6, 4))
    assert draft.run_campbell(tolerance=np.float64(3e-3)) == draft.run_campbell(tolerance=3e-3)
    assert draft.modes(np.int32(500)) == draft.modes(500.0)


def test_a_number_that_no_saw_has_is_warned_of_before_the_answer(draft: sf.Scene) -> None:
    """The density is in g/cm³, as in many tables."""
    wrong = draft.replace({"blade.material.density_kg_per_m3": 7.85, "guides": []})
    with pytest.warns(sf.ModelWarning, match="density") as told:
        r = wrong.run_campbell()
    # The warning names the user's line, and none within the package.
    assert {warning.filename for warning in told} == {__file__}
    shown = repr(r)
    assert "density" in shown
    assert shown.index("density") < shown.index("Can it run")
    assert "density" in r._repr_html_()
    # Reading a report computes nothing and gives no second warning.
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert sf.CampbellResults._from_json(r.to_json()) == r


def test_a_repr_says_what_has_happened(draft: sf.Scene) -> None:
    free = draft.replace({"guides": []}).run_campbell()
    assert f"No flutter of {free.flutter_threshold_per_s:g} 1/s" in repr(free)
    up = draft.run_up()
    assert f"Run-up from {up.rpm[0]:.0f} to {up.to_rpm:.0f} rpm" in repr(up)
    if up.linear_until_rpm is not None:
        assert "linear model ends" in repr(up)


def test_a_repr_has_the_numbers_that_were_asked_for() -> None:
    folder = Path(__file__).parents[2] / "tests" / "golden" / "reports"
    compared, fitted, failed = (sf.load(folder / f"{name}.json") for name in ("compare-two", "fit-paper", "check-failed"))
    assert repr(compared).count("flutter") == 2
    assert "guides[0].radius_m = 0." in repr(fitted) and "Hz rms" in repr(fitted)
    # pytest shows 240 letters of a failed assertion.
    assert "2800 rpm: 2256 rpm" in repr(failed)[:240]


def test_the_range_of_speeds_is_an_argument(draft: sf.Scene) -> None:
    r = draft.run_campbell(speed_range=(500, 1600.0))
    assert (r.campbell.from_rpm, r.campbell.to_rpm) == pytest.approx((500.0, 1600.0))
    assert r == draft.replace({"sweep": {"from_rpm": 500, "to_rpm": 1600}}).run_campbell()
    assert draft.run_campbell(speed_range=np.linspace(500, 1600, 5)) == r


def test_modes_at_several_speeds_are_arrays(draft: sf.Scene) -> None:
    speeds = [0.0, 500.0, 1200.0, 2275.0]
    found = draft.modes(speeds)
    assert found.rpm.tolist() == speeds
    assert found.frequency_hz.shape == found.growth_per_s.shape == found.krein_sign.shape
    for place, rpm in enumerate(speeds):
        alone = draft.modes(rpm)
        assert found[place] == alone.modes
        for name in ("frequency_hz", "growth_per_s", "krein_sign"):
            row = getattr(found, name)[place, : len(alone)]
            assert row.tolist() == [getattr(mode, name) for mode in alone]
    tidy = found.to_dataframe()
    assert len(tidy) == sum(len(of) for of in found.modes)
    assert {"rpm", "frequency_hz", "direction", "nodal_diameters", "krein_sign"} <= set(tidy)
    with pytest.raises(sf.ArgumentError, match="rpm"):
        draft.modes([0.0, 1e6])


def test_basis_functions_are_orthonormal_over_the_mass_of_the_blade(draft: sf.Scene) -> None:
    """∫ ρ h φᵢ φⱼ dA is one, by Gauss and the rectangle rule: the mass matrix of the package."""
    free = draft.replace({"guides": []})
    m = free.matrices(basis=(3, 3))
    inner, outer = (free.blade[f"{end}_diameter_m"] / 2 for end in ("inner", "outer"))  # type: ignore[literal-required]
    nodes, weights = np.polynomial.legendre.leggauss(12)
    radius = inner + (outer - inner) * (nodes + 1) / 2
    around = np.linspace(0.0, 360.0, 16, endpoint=False)
    phi = m.at(radius[:, None], around)
    assert phi.shape == (12, 16, len(m.stiffness))
    surface = free["blade.material.density_kg_per_m3"] * free["blade.thickness_m"]
    area = surface * (weights * radius * (outer - inner) / 2)[:, None] * (2 * np.pi / 16)
    mass = np.einsum("ra,rai,raj->ij", np.broadcast_to(area, (12, 16)), phi, phi)
    assert np.allclose(mass, m.mass, atol=1e-10)
    with pytest.raises(sf.ArgumentError, match="radius_m"):
        m.at(outer + 0.01, 0.0)


def test_matrices_compare_and_cannot_be_written_to(draft: sf.Scene) -> None:
    m = draft.matrices(basis=(6, 4))
    assert m == draft.matrices(basis=(6, 4)) and m != draft.matrices(basis=(6, 5))
    for array in (m.stiffness, m.spin, m.gyroscopic, m.mass):
        with pytest.raises(ValueError):
            array[0, 0] = 1.0
    assert pickle.loads(pickle.dumps(m)) == m


def test_copies_cannot_be_written_to_either(report: sf.CampbellResults) -> None:
    branch = report.branches[0]
    for again in (pickle.loads(pickle.dumps(branch)), copy.deepcopy(branch)):
        assert again == branch
        with pytest.raises(ValueError):
            again.rpm[0] = 1.0
    with pytest.raises(ValueError):
        report.critical_rpm[0] = 1.0


def test_a_branch_knows_the_edges_of_its_bands(draft: sf.Scene, report: sf.CampbellResults) -> None:
    """One rpm beside a band the saw is stable, by NumPy's eigenvalues and for the branch."""
    matrices = draft.matrices()
    looked = 0
    for band in report.bands[:4]:
        for rpm in (band.from_rpm - 1.0, band.to_rpm + 1.0):
            eigenvalues = np.linalg.eigvals(matrices.companion(rpm))
            if max(eigenvalues.real) > 1e-2 or not 0.0 < rpm < 3000.0:
                continue
            looked += 1
            for number in band.branches:
                _, growth = report.branches[number - 1].at(rpm)
                assert np.isnan(growth) or abs(growth) < 1e-3, (band, rpm, growth)
        inside = [float(report.branches[n - 1].at(band.peak_rpm)[1]) for n in band.branches]
        assert max(inside) > 0.0
    assert looked >= 4


def test_tables_have_directions_and_nodal_diameters(report: sf.CampbellResults) -> None:
    bands = report.to_dataframe("bands")
    assert len(bands) == len(report.bands)
    assert bands["from_rpm"].tolist() == [band.from_rpm for band in report.bands]
    assert bands["nodal_diameters"][0] == "2"
    assert all(bands["directions"].str.len() > 0)
    rest = report.to_dataframe("modes_at_rest")
    assert rest["nodal_diameters"].tolist() == [m.nodal_diameters for m in report.modes_at_rest]
    assert report.to_dataframe("critical_speeds")["rpm"].tolist() == report.critical_rpm.tolist()
    with pytest.raises(ValueError, match="modes_at_rest"):
        report.to_dataframe("modes")  # type: ignore[arg-type]


def test_a_report_of_another_kind_is_refused(report: sf.CampbellResults, tmp_path: Path) -> None:
    report.save(tmp_path / "report.json")
    assert sf.load(tmp_path / "report.json") == report
    (tmp_path / "other.json").write_text('{"sawflutter": "9.9"}', encoding="utf-8")
    with pytest.raises(sf.InputError, match=r"one of 9\.9"):
        sf.load(tmp_path / "other.json")
    (tmp_path / "notes.txt").write_text("no JSON", encoding="utf-8")
    with pytest.raises(sf.InputError, match="notes.txt"):
        sf.load(tmp_path / "notes.txt")


def test_guides_without_stiffness_leave_the_free_blade(draft: sf.Scene) -> None:
    """Its first critical speed is exact, 1476.6 rpm; that of the paper's saw is 1530.7 rpm."""
    own = draft["guides[0].stiffness_n_per_m"]
    found = draft.run_stiffness_map([1e-3, own])
    assert found.critical_rpm[:, 0] == pytest.approx([1476.6, 1530.7], rel=1e-3)
    assert np.isnan(found.flutter_rpm[0]) and found.flutter_rpm[1] == pytest.approx(
        2256.0, rel=5e-3
    )
    with pytest.raises(sf.PathError, match="add_guide"):
        draft.run_stiffness_map([1e6], guide=3)


@pytest.mark.parametrize(
    ("module", "extra", "use"),
    [
        ("plotly.subplots", "plot", lambda r: r.plot()),
        ("pandas", "pandas", lambda r: r.to_dataframe()),
        ("xarray", "xarray", lambda r: r.to_xarray()),
        ("scipy.io", "records", lambda _: sf.read_record("a.wav", rpm=0)),
    ],
)
def test_a_missing_package_says_how_it_is_installed(
    report: sf.CampbellResults,
    monkeypatch: pytest.MonkeyPatch,
    module: str,
    extra: str,
    use: Callable[[sf.CampbellResults], object],
) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    said = rf"needs {module.partition('.')[0]}: pip install \"sawflutter\[{extra}\]\""
    with pytest.raises(ImportError, match=said):
        use(report)
