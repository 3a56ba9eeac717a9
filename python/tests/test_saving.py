"""Files of results by the endings of their names, and tables of all results."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import sawflutter as sf


@pytest.mark.parametrize("name", ["r.xlsx", "r.txt", "r.parquet", "r.pkl", "r", "sensitivity.svg"])
def test_a_file_that_is_not_written_is_refused(report: sf.CampbellResults, tmp_path: Path, name: str) -> None:
    with pytest.raises(sf.ArgumentError, match="path must be"):
        report.save(tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_figure_is_saved_by_its_name(report: sf.CampbellResults, tmp_path: Path) -> None:
    for name, figure in [("root-loci.svg", "root-loci.svg"), ("any.png", "campbell.png"), ("my.svg", "campbell.svg")]:
        report.save(tmp_path / name)
        assert (tmp_path / name).read_bytes() == report.figure(figure)


def test_every_result_saves_its_table(draft: sf.Scene, tmp_path: Path) -> None:
    checked = draft.check(operating_rpm=1250)
    checked.save(tmp_path / "check.csv")
    assert pd.read_csv(tmp_path / "check.csv")["name"].tolist() == checked.to_dataframe()["name"].tolist()


def test_speeds_have_a_table_and_files(draft: sf.Scene, tmp_path: Path) -> None:
    found = draft.speeds()
    table = found.to_dataframe()
    assert table["from_rpm"].is_monotonic_increasing
    assert table.loc[table["event"] == "critical speed", "from_rpm"].tolist() == found.critical_rpm.tolist()
    assert (table["event"] != "critical speed").sum() == len(found.bands)
    found.save(tmp_path / "speeds.json")
    read = json.loads((tmp_path / "speeds.json").read_text(encoding="utf-8"))
    assert read["critical_rpm"] == found.critical_rpm.tolist()
    assert read["bands"][0]["from_rpm"] == found.bands[0].from_rpm
    found.save(tmp_path / "speeds.csv")
    assert len(pd.read_csv(tmp_path / "speeds.csv")) == len(table)
    with pytest.raises(sf.ArgumentError, match=r"\.json, \.csv \(you gave 'speeds.png'\)"):
        found.save(tmp_path / "speeds.png")


def test_a_stiffness_map_has_tables(draft: sf.Scene, tmp_path: Path) -> None:
    found = draft.run_stiffness_map([1e6, 1e7])
    table, labelled = found.to_dataframe(), found.to_xarray()
    assert table["critical_1_rpm"].tolist() == found.critical_rpm[:, 0].tolist()
    assert np.array_equal(labelled["critical_rpm"].sel(stiffness_n_per_m=1e7), found.critical_rpm[1], equal_nan=True)
    found.save(tmp_path / "map.json")
    # There is no NaN in JSON.
    assert None in json.loads((tmp_path / "map.json").read_text(encoding="utf-8"))["critical_rpm"][1]


def test_a_comparison_has_the_columns_of_its_text(draft: sf.Scene) -> None:
    thin = draft.replace({"blade.thickness_m": "2.6 mm"})
    found = sf.compare([draft, thin])
    assert found == sf.compare(draft, thin)
    assert f"1 {draft.name}"[:20] in found.summary() and "1 1 " not in found.summary()
    table = sf.compare({"now": draft, "thin": thin}).to_dataframe()
    assert table["name"].tolist() == ["now", "thin"]
    assert table["first_critical_rpm"].round().tolist() == [1531, 1426]
    assert table["bands"].tolist() == [len(saw.bands) for saw in found.saws]
    assert table["verdict"].tolist() == [saw.verdict.answer for saw in found.saws]


@pytest.mark.parametrize("saws", [[], ["saw"], {}])
def test_a_comparison_of_one_saw_is_refused(draft: sf.Scene, saws: list[str] | dict[str, sf.Scene]) -> None:
    with pytest.raises(sf.InputError, match=r"saws must be two saws or more .*compare\(\[saw, other\]\)"):
        sf.compare([draft for _ in saws])


def test_a_map_is_named_by_its_paths(draft: sf.Scene) -> None:
    found = draft.run_map(("blade.thickness_m", "2.6 mm", "2.8 mm"), points=2)
    table = found.to_dataframe()
    assert table.columns[0] == "blade.thickness_m" and not {"x", "y"} & set(table.columns)
    assert table["verdict"].tolist() == [saw.verdict.answer for saw in found.saws if saw.verdict is not None]


def test_a_refused_axis_is_named_by_its_path(draft: sf.Scene) -> None:
    with pytest.raises(sf.SceneError) as caught:
        draft.run_map(("blade.thickness_m", 2, 3))
    assert caught.value.key == "blade.thickness_m" and str(caught.value).startswith("blade.thickness_m must be")
