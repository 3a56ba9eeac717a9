"""Studies: the same files as the program's, wherever the saws are computed."""

from __future__ import annotations

import pickle
import subprocess
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sawflutter as sf
from sawflutter.plot import Heat

VARIED: dict[str, Any] = {
    "name": "Thickness and modulus",
    "saws": 24,
    "parameters": [
        {
            "path": "blade.thickness_m",
            "distribution": {"kind": "tolerance", "plus_minus": 5e-5},
        },
        {
            "path": "blade.material.youngs_modulus_pa",
            "distribution": {"kind": "uniform", "from": 2.0e11, "to": 2.1e11},
        },
    ],
    "limits": {"operating_rpm": 1200, "min_critical_rpm": 1470},
}


def _rows(folder: Path) -> list[str]:
    """Rows of saws in the log of a folder."""
    lines = (folder / "study.log").read_text().splitlines()[2:]
    return [line for line in lines if not line.startswith("#")]


@pytest.fixture(scope="module")
def study(draft: sf.Scene) -> sf.Study:
    return sf.Study(draft.replace({"guides": []}), VARIED)


def test_the_files_are_those_of_the_program(
    study: sf.Study, programs: list[str], tmp_path: Path
) -> None:
    import json

    result = study.run(tmp_path / "ours")
    study.scene.save(tmp_path / "scene.json")
    (tmp_path / "study-file.json").write_text(json.dumps(study.to_dict()))
    for number, program in enumerate(programs):
        out = tmp_path / str(number)
        arguments = ["study", tmp_path / "scene.json", tmp_path / "study-file.json", "--out", out]
        done = subprocess.run([program, *map(str, arguments)], check=False, capture_output=True)
        assert done.returncode == 0, done.stderr
        for name in ("study.json", "study.csv", "study.parquet", "study.png", "study.svg"):
            assert (out / name).read_bytes() == (tmp_path / "ours" / name).read_bytes(), name
    assert sf.load(tmp_path / "ours" / "study.json") == result


def test_executors_give_the_same_saws(study: sf.Study, tmp_path: Path) -> None:
    alone = study.run(tmp_path / "alone")
    told: list[tuple[int, int]] = []
    with ThreadPoolExecutor(2) as threads:
        threaded = study.run(
            tmp_path / "threads",
            executor=threads,
            progress=lambda done, of, _: told.append((done, of)),
        )
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as processes:
        spread = study.run(tmp_path / "processes", executor=processes)
    assert alone == threaded == spread
    assert told[-1] == (24, 24)


def test_a_stopped_study_goes_on(study: sf.Study, tmp_path: Path) -> None:
    class Enough(Exception):
        pass

    def stop(done: int, of: int, phase: str) -> None:
        if done >= 8:
            raise Enough

    with ThreadPoolExecutor(1) as threads, pytest.raises(Enough):
        study.run(tmp_path, executor=threads, progress=stop)
    logged = len(_rows(tmp_path))
    assert 0 < logged < 24 and not (tmp_path / "study.json").exists()
    told: list[int] = []
    result = study.run(tmp_path, progress=lambda done, of, _: told.append(done))
    assert result.all.saws == 24 and min(told) >= logged


def test_saws_vary_as_they_are_told(study: sf.Study, tmp_path: Path) -> None:
    values = study.values()
    assert values.shape == (24, 2)
    assert np.all(abs(values[:, 0] - 0.0028) <= 5e-5)
    assert np.all((2.0e11 <= values[:, 1]) & (values[:, 1] <= 2.1e11))
    frame = study.run(tmp_path).to_dataframe()
    assert np.array_equal(frame["blade.thickness_m"].to_numpy(), values[:, 0])
    # A free blade's critical speeds are proportional to thickness and the root of the modulus.
    scale = values[:, 0] * np.sqrt(values[:, 1])
    ratios = frame["first_critical_rpm"].to_numpy() / scale
    # Saws can have different bases; this is exact on one basis, and accurate to the estimate
    # between two.
    for functions in set(frame["functions"]):
        own = ratios[frame["functions"] == functions]
        assert np.allclose(own, own[0], rtol=1e-9)
    assert np.allclose(ratios, ratios[0], rtol=frame["estimated_relative_error"].max())
    assert np.allclose(study.values([3, 5]), values[[3, 5]])


def test_sobol_indices_are_shares_of_the_variance(study: sf.Study, tmp_path: Path) -> None:
    """A free blade's critical speeds are proportional to thickness and to the root of the modulus:
    the variance of the logarithm is the sum of two, var h / h² = (Δ/h)²/3 and var E / 4E²."""
    more = sf.Study(study.scene, {**VARIED, "saws": 1024})
    found = more.run(tmp_path).sensitivity()
    thickness = (5e-5 / 0.0028) ** 2 / 3
    modulus = (0.05e11 / 2.05e11) ** 2 / 12
    exact = np.array([thickness, modulus]) / (thickness + modulus)
    indices = found["first_critical"].to_numpy()
    # The estimator's own error at 1024 saws, several times less than the half-widths.
    assert np.all(abs(indices - exact) < 0.02), (indices, exact)
    assert np.all(abs(indices - exact) < found["first_critical_confidence"])
    # No saw flutters, so that there is no variance.
    assert found["flutter"].isna().all()


def test_worst_saws_and_reliability_are_those_of_the_table(study: sf.Study, tmp_path: Path) -> None:
    result = study.run(tmp_path)
    table = result.to_dataframe()
    worst = table.sort_values("first_critical_rpm").head(10)
    assert [saw.saw for saw in result.worst_first_critical] == list(worst["saw"])
    assert result.worst_first_critical[0].rpm == worst["first_critical_rpm"].iloc[0]
    assert np.array_equal(
        result.worst_first_critical[0].values, study.values([worst["saw"].iloc[0]])[0]
    )
    assert result.worst_flutter == ()
    reliability = result.reliability
    assert reliability is not None and reliability.margin == 0.85
    allowed = 0.85 * table["first_critical_rpm"].to_numpy()
    for point in reliability.curve:
        assert point.share == np.mean(allowed >= point.operating_rpm)
    for fastest in reliability.fastest:
        assert fastest.rpm is not None and np.mean(allowed >= fastest.rpm) >= fastest.share
        above = allowed[allowed > fastest.rpm]
        assert len(above) == 0 or np.mean(allowed >= above.min()) < fastest.share
    assert len(result.chart().panels) == 3


def test_what_is_no_study_is_refused(draft: sf.Scene, tmp_path: Path) -> None:
    with pytest.raises(sf.StudyError) as caught:
        sf.Study(draft, {**VARIED, "saws": 0})
    assert caught.value.key == "saws"
    with pytest.raises(sf.StudyError, match="parameters"):
        sf.Study(draft, {"name": "nothing", "parameters": []})
    with pytest.raises(sf.StudyError, match="swas"):
        sf.Study(draft, {**VARIED, "swas": 3})
    with pytest.raises(FileNotFoundError):
        sf.Study(draft, tmp_path / "none.json")


def test_a_folder_of_another_study_is_refused(study: sf.Study, tmp_path: Path) -> None:
    study.run(tmp_path)
    other = sf.Study(study.scene, {**VARIED, "seed": 7})
    with pytest.raises(sf.StudyError, match="another study"):
        other.run(tmp_path)


def test_a_study_is_pickled(study: sf.Study) -> None:
    copy = pickle.loads(pickle.dumps(study))
    assert copy == study and copy.count == 24
    assert "24 saws" in repr(copy)
    with pytest.raises(sf.ArgumentError):
        study.values([24])
    with pytest.raises(sf.ArgumentError, match=r"saws must be .*\(you gave -1\)"):
        study.values([-1])


def test_a_study_keeps_its_table(study: sf.Study, tmp_path: Path) -> None:
    result = study.run(tmp_path / "runs")
    table = result.to_dataframe()
    saved = tmp_path / "elsewhere" / "kept.json"
    saved.parent.mkdir()
    result.save(saved)
    pickled = pickle.dumps(result)
    (tmp_path / "runs" / "study.csv").unlink()
    for again in (sf.load(saved), sf.load(saved), pickle.loads(pickled)):
        assert isinstance(again, sf.StudyResults) and again == result
        assert again.to_dataframe().equals(table)
    with pytest.raises(FileNotFoundError, match="study.csv"):
        result.to_dataframe()


def test_a_grid_is_a_map_of_its_speeds(draft: sf.Scene, tmp_path: Path) -> None:
    values = {"blade.thickness_m": [2.7e-3, 2.9e-3], "blade.inner_diameter_m": [0.19, 0.2, 0.21]}
    grid = {
        "name": "Grid",
        "parameters": [
            {"path": path, "distribution": {"kind": "grid", "values": of}}
            for path, of in values.items()
        ],
    }
    result = sf.Study(draft.replace({"guides": []}), grid).run(tmp_path)
    (heat,) = result.map_chart("first_critical_rpm").panels[0].items
    assert isinstance(heat, Heat)
    assert (heat.x.tolist(), heat.y.tolist()) == tuple(values.values())
    # Critical speeds of a free blade are proportional to its thickness.
    assert heat.z[:, 1] / heat.z[:, 0] == pytest.approx(2.9 / 2.7, rel=1e-3)
    assert result.map_chart("first_critical_rpm").plot().data
    with pytest.raises(ValueError, match="two numbers"):
        sf.Study(draft.replace({"guides": []}), {**VARIED, "saws": 2}).run(
            tmp_path / "no"
        ).map_chart()


def test_the_dashboard_of_a_cluster_is_named(
    study: sf.Study, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    class Cluster(ThreadPoolExecutor):
        dashboard_link = "http://127.0.0.1:8787/status"

    told: list[tuple[int, int]] = []
    with Cluster(1) as executor:
        study.run(tmp_path, executor=executor, progress=lambda done, of, _: told.append((done, of)))
    assert f"dashboard {Cluster.dashboard_link}" in capsys.readouterr().err
    assert told[-1] == (24, 24) and told == sorted(told)


def test_a_study_needs_no_folder(study: sf.Study, tmp_path: Path) -> None:
    result = study.run()
    assert len(result.to_dataframe()) == study.count
    result.save(tmp_path / "kept.json")
    again = sf.load(tmp_path / "kept.json")
    assert isinstance(again, sf.StudyResults) and again.to_dataframe().equals(result.to_dataframe())
