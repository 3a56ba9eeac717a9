"""Results equal the program's to the last bit."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

import sawflutter as sf


def ran(program: str, *arguments: object) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [program, *map(str, arguments)], check=False, capture_output=True, timeout=300
    )


def same(folder: Path, name: str, content: bytes) -> None:
    assert (folder / name).read_bytes() == content, f"{name} differs"


def same_report(programs: list[str], found: sf.Result, folder: Path, *arguments: object) -> None:
    """The command of a result prints its summary, and writes its report and its figures."""
    name = {"analyze": "report", "report": "design"}.get(found._command, found._command)
    for number, program in enumerate(programs):
        out = folder / str(number)
        done = ran(program, found._command, *arguments, "--accuracy", "draft", "--out", out, "--details")
        assert done.returncode == 0, done.stderr
        assert done.stdout.decode().startswith(found.summary(details=True))
        same(out, f"{name}.json", found.to_json().encode())
        for picture in found.figure_names:
            content = found.figure(picture)
            assert (out / picture).exists() == (content is not None), picture
            if content is not None:
                same(out, picture, content)


@pytest.mark.parametrize("scene", ["paper", "collar-400mm-tensioned", "free-blade", "two-pads"])
def test_the_report_of_a_chart(
    scene: str, programs: list[str], scenes: Path, tmp_path: Path
) -> None:
    path = scenes / f"{scene}.json"
    r = sf.Scene.load(path).run_campbell(accuracy="draft")
    same_report(programs, r, tmp_path, path)
    r.save(tmp_path / "ours.json")
    same(tmp_path, "ours.json", r.to_json().encode())
    r.save(tmp_path / "ours.csv")
    for number in range(len(programs)):
        same(tmp_path / str(number), "campbell.csv", (tmp_path / "ours.csv").read_bytes())


def test_the_reports_of_cut_and_run_up(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    path = scenes / "paper.json"
    saw = sf.Scene.load(path).with_accuracy("draft")
    for result in (saw.run_cut(), saw.run_up()):
        same_report(programs, result, tmp_path, path)


def test_the_report_of_deflect(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    path = scenes / "paper.json"
    found = sf.Scene.load(path).run_deflect(force_n=2.0, to_rpm=1600, accuracy="draft")
    same_report(programs, found, tmp_path, path, "--force", 2, "--to", 1600)
    table = found.to_dataframe()
    assert len(table) > 20 and set(table["direction"]) == {"up", "down"}


def test_the_report_of_a_response(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    causes = {"flatness_m": 5e-5}
    saw = sf.Scene.load(scenes / "paper.json").replace(
        {"response": causes, "sweep.to_rpm": 1000, "runup": None}
    )
    path = tmp_path / "saw.json"
    saw.save(path)
    found = saw.run_response(rpm=900, to_hz=50, accuracy="draft")
    same_report(programs, found, tmp_path, path, "--rpm", 900, "--to-frequency", 50)
    table = found.to_dataframe()
    assert len(table) == len(found.rpm)
    assert list(table) == ["rpm", *(line.name for line in found.lines), "board_deviation_m"]


def test_the_report_of_gap(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    pad = {"guides[0].contact": "one_sided", "guides[0].gap_m": 4e-5}
    saw = sf.Scene.load(scenes / "paper.json").replace({**pad, "sweep.to_rpm": 1700})
    path = tmp_path / "saw.json"
    saw.save(path)
    found = saw.run_gap(force_n=2.0, rpm=1000, max_deviation_m=3e-4, accuracy="draft")
    options = ["--force", 2, "--rpm", 1000, "--max-deviation", "0.3mm"]
    same_report(programs, found, tmp_path, path, *options)
    assert found.oscillation is None and found.friction is None
    rows = found.deviation.deflection_m
    table = found.to_dataframe()
    assert len(table) == sum(len(row) for row in rows)
    assert list(table) == ["gap_factor", "force_n", "deflection_m", "largest_deflection_m"]


def test_the_report_for_a_decision(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    saw = sf.Scene.load(scenes / "paper.json")
    found = saw.run_report(customer="A. Miller", date="2027-01-15", accuracy="draft")
    options = ["--customer", "A. Miller", "--date", "2027-01-15"]
    same_report(programs, found, tmp_path, scenes / "paper.json", *options)
    assert "A. Miller, 2027-01-15" in found.summary()


def test_the_report_of_washboarding(
    programs: list[str], scenes: Path, resaw: sf.Scene, tmp_path: Path
) -> None:
    found = resaw.run_washboard(rpm=2300.0)
    same_report(programs, found, tmp_path, scenes / "gallery/washboarding.json", "--rpm", 2300)


def test_the_report_of_a_check(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    saw = sf.Scene.load(scenes / "paper.json")
    check = saw.check(operating_rpm=1400, min_flutter_rpm=2000, accuracy="draft")
    for program in programs:
        done = ran(
            program, "check", scenes / "paper.json", "--rpm", 1400,
            "--min-flutter", 2000, "--accuracy", "draft", "--json",
        )  # fmt: skip
        assert done.returncode == (0 if check.passed else 1)
        assert done.stdout.decode().strip() == check.to_json()


def test_the_report_of_a_comparison(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    path = scenes / "paper.json"
    saw = sf.Scene.load(path).with_accuracy("draft")
    thin = saw.replace({"blade.thickness_m": "2.6 mm"})
    found = sf.compare(saw, thin, names=["paper", "thickness_m=2.6mm"])
    same_report(programs, found, tmp_path, path, "--variant", "blade.thickness_m=2.6mm")
    assert sf.load(tmp_path / "0" / "compare.json") == found
    chart = saw.run_campbell()
    by_charts = sf.compare(chart, thin.run_campbell())
    assert by_charts.saws[1].critical_speeds[0].rpm == found.saws[1].critical_speeds[0].rpm
    assert len(by_charts.chart().panels) == 2
    with pytest.raises(ValueError, match="two saws or more"):
        sf.compare(saw)


def test_the_page(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    checked = sf.Scene.load(scenes / "paper.json").check(operating_rpm=1400, accuracy="draft")
    checked.save(tmp_path / "own.html")
    for program in programs:
        options = ["--rpm", 1400, "--accuracy", "draft", "--report", page]
        assert ran(program, "check", scenes / "paper.json", *options).returncode == 1
        assert page.read_bytes() == (tmp_path / "own.html").read_bytes()


def test_the_report_of_a_map(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    saw = sf.Scene.load(scenes / "paper.json").with_accuracy("draft")
    x = ("blade.thickness_m", "2.6 mm", 0.003)
    found = saw.run_map(x, points=3, rpm=1800, folder=tmp_path / "own")
    options = ["--x", "blade.thickness_m=2.6mm..3mm", "--points", 3, "--rpm", 1800]
    same_report(programs, found, tmp_path, scenes / "paper.json", *options)
    out = tmp_path / "0"
    assert sf.load(out / "map.json") == found
    # The log of the program has the saws of the same study.
    (out / "map.json").unlink()
    assert saw.run_map(x, points=3, rpm=1800, folder=out) == found
    two = saw.run_map(x, ("guides[0].stiffness_n_per_m", 1e6, 1e8), points=2)
    assert two.shape == (2, 2)
    assert (two.first_critical_rpm[1] > two.first_critical_rpm[0]).all()
    with pytest.raises(sf.StudyError, match=r"points must be .*\(you gave 1\)"):
        saw.run_map(x, points=1)


def test_the_shapes(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    found = sf.Scene.load(scenes / "paper.json").run_campbell(accuracy="draft", shapes=[1000])
    assert found.shapes[-1].rpm == pytest.approx(1000)
    (tmp_path / "own").mkdir()
    found.save(tmp_path / "own" / "modes.pvd")
    for program in programs:
        options = ["--accuracy", "draft", "--rpm", 1000, "--vtk", "--out", tmp_path]
        assert ran(program, "analyze", scenes / "paper.json", *options).returncode == 0
        assert (tmp_path / "modes.svg").read_bytes() == found.figure("modes.svg")
        for path in (tmp_path / "own").iterdir():
            assert (tmp_path / path.name).read_bytes() == path.read_bytes()


def test_the_matrices(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    import numpy as np

    saw = sf.Scene.load(scenes / "paper.json").replace(
        {"damping": {"material_retardation_time_s": 1e-6, "air_n_s_per_m3": 1.0}}
    )
    saw.save(tmp_path / "scene.json")
    found = saw.matrices(basis=(6, 4))
    for program in programs:
        done = ran(
            program, "export", "--matrices", tmp_path / "scene.json", "--basis", "6,4",
            "--out", tmp_path,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        for name in ("stiffness", "spin", "gyroscopic", "damping", "circulatory"):
            assert np.array_equal(np.load(tmp_path / f"{name}.npy"), getattr(found, name)), name


def test_the_program_that_pip_installs_is_the_program(programs: list[str]) -> None:
    helps = {ran(program, "--help").stdout for program in programs}
    assert len(helps) == 1
    text = helps.pop().decode()
    assert "explore" in text and "analyze" in text
    assert all(ran(program, "analyze", "no-such-file.json").returncode == 2 for program in programs)


def test_the_chart_in_the_cut(programs: list[str], scenes: Path, tmp_path: Path) -> None:
    found = sf.Scene.load(scenes / "paper.json").run_campbell(accuracy="draft", in_cut_rpm="30 rev/s")
    for program in programs:
        options = ["--accuracy", "draft", "--in-cut", 1800, "--out", tmp_path]
        assert ran(program, "analyze", scenes / "paper.json", *options).returncode == 0
        assert (tmp_path / "report.json").read_text() == found.to_json()
