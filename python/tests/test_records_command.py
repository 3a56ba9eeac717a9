"""``sawflutter records``: what the files of a lab give on the command line."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import sawflutter as sf

FILES = Path(__file__).parent / "records"


def ran(program: str, out: Path, *arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [program, "records", *map(str, arguments), "--out", str(out)],
        check=False, capture_output=True, text=True, encoding="utf-8", timeout=300,
        env={"SAWFLUTTER_PYTHON": sys.executable, "PATH": ""},
    )  # fmt: skip


# The frequencies of the response are 100, 125, 150 and 260 Hz, that of the decays is 60 Hz.
@pytest.mark.parametrize(
    ("name", "options", "said", "peaks_hz"),
    [
        ("frf-magnitude-phase.csv", (), "(mm/N), 640 lines up to 319.5 Hz, 0 rpm", [100, 125, 150, 260]),
        ("record-x-value.csv", ("--rpm", "0"), "record of probe (mm), 600 samples at 500 Hz", [60]),
        ("record.lvm", ("--rpm", "0"), "(mm), 600 samples at 500 Hz", [60]),
        ("record.lvm", ("--rpm", "0", "--signal", "0"), "(mm), 600 samples at 500 Hz", [60]),
    ],
)
def test_files_of_a_lab_are_read(
    programs: list[str], tmp_path: Path, name: str, options: tuple[str, ...], said: str, peaks_hz: list[float]
) -> None:
    for number, program in enumerate(programs):
        out = tmp_path / str(number)
        done = ran(program, out, FILES / name, *options)
        assert done.returncode == 0, done.stderr
        named = ("Written to ", "Next: ")
        assert all(len(line) <= 80 for line in done.stdout.splitlines() if not line.startswith(named))
        assert said in " ".join(done.stdout.split())
        lines = (out / "peaks.csv").read_text(encoding="utf-8").splitlines()[1:]
        assert [float(line.split(",")[2]) for line in lines] == pytest.approx(peaks_hz, abs=0.05)
        assert (out / f"{Path(name).stem}.png").exists() == bool(peaks_hz)
        # The rows are those that a fit reads.
        assert ("Next: sawflutter fit my-saw.json" in done.stdout) == bool(peaks_hz)
        assert (out / "measured.csv").exists() == bool(peaks_hz)
        if peaks_hz:
            row = np.loadtxt(out / "measured.csv", delimiter=",", skiprows=1)
            assert row == pytest.approx([0.0, *peaks_hz], abs=0.05)


@pytest.mark.parametrize(
    ("name", "options", "said"),
    [
        ("record-x-value.csv", (), "--rpm must be given, .*give --rpm 0 for a tap test"),
        ("record.lvm", ("--rpm", "0", "--rate", "3"), "--rate must be left out"),
        ("key-phase.csv", ("--rate", "2000"), "give --tacho 'speed'"),
        ("frf-magnitude-phase.csv", ("--rpm", "0..900"), "at one speed; give --rpm one number"),
        ("uff-stopped-early.uff", ("--rpm", "0"), "18 of 25 samples are there"),
        ("missing.csv", ("--rpm", "0"), "cannot read .*missing.csv"),
    ],
)
def test_what_is_refused_leaves_no_file(
    programs: list[str], tmp_path: Path, name: str, options: tuple[str, ...], said: str
) -> None:
    out = tmp_path / "out"
    done = ran(programs[0], out, FILES / "frf-magnitude-phase.csv", FILES / name, *options)
    assert done.returncode == 2 and not done.stdout
    assert done.stderr.startswith("error: ") and len(done.stderr.splitlines()) == 1
    assert re.search(said, done.stderr), done.stderr
    assert not out.exists()


@pytest.mark.parametrize(
    ("name", "options", "said"),
    [
        ("uff-padded.uff", ("--rpm", "0"), "largest at 0.11 s of 0.24 s, but this must be followed by at least 16 samples"),
        ("uff-ms-axis.uff", ("--rpm", "0"), "no spectrum: the samples of uff-ms-axis.uff"),
        ("key-phase.csv", ("--rate", "2kHz", "--tacho", "speed"), "torque does not change; name another --signal: vibration_x"),
    ],
)
def test_a_record_without_a_spectrum_leaves_no_file_alone(
    programs: list[str], tmp_path: Path, name: str, options: tuple[str, ...], said: str
) -> None:
    out = tmp_path / "out"
    done = ran(programs[0], out, FILES / name, *options)
    assert done.returncode == 2 and not done.stdout and not out.exists()
    assert re.search(said, done.stderr), done.stderr
    if "--rpm" in options:
        # Beside a file with a spectrum it is a remark.
        done = ran(programs[0], out, FILES / "frf-magnitude-phase.csv", FILES / name, *options)
        assert done.returncode == 0 and "no spectrum: " in done.stdout


def test_peaks_of_a_run_up_become_rows_by_the_saw(
    programs: list[str], draft: sf.Scene, tmp_path: Path
) -> None:
    """A probe sees the third branch and runout; the guide of the scene is a little too soft."""
    rate, seconds = 400.0, 40.0
    time = np.arange(0.0, seconds, 1.0 / rate)
    rpm = 100.0 + 700.0 * time / seconds
    speeds = np.linspace(100.0, 800.0, 29)
    branch_hz = draft.modes(speeds.tolist()).frequency_hz[:, 2]
    phase = 2.0 * np.pi * np.cumsum(np.interp(rpm, speeds, branch_hz)) / rate
    turns = 2.0 * np.pi * np.cumsum(rpm) / 60.0 / rate
    probe = np.cos(phase) + 3.0 * np.cos(turns)
    record, saw = tmp_path / "run up.csv", tmp_path / "my saw.json"
    columns = np.column_stack([time, rpm, probe])
    np.savetxt(record, columns, delimiter=",", header="time_s,rpm,probe [mm]", comments="")
    guess = draft.replace({"guides[0].stiffness_n_per_m": 1.8e7})
    saw.write_text(guess.to_json(), encoding="utf-8")
    program, out = programs[0], tmp_path / "out"
    done = ran(program, out, record, "--saw", saw)
    assert done.returncode == 0, done.stderr
    assert (out / "run up.png").read_bytes().startswith(b"\x89PNG")
    assert f"Next: sawflutter fit '{saw}' {out / 'measured.csv'}" in done.stdout
    fit = guess.fit(out / "measured.csv", free=["guides[0].stiffness_n_per_m"], starts=1)
    assert fit.rms_hz < 0.1
    assert fit.parameters[0].value == pytest.approx(2e7, rel=0.05)
    # Without the saw there are peaks, but no rows, and those of the earlier run are removed.
    bare = ran(program, out, record)
    assert "give the saw by --saw" in " ".join(bare.stdout.split())
    assert not (out / "measured.csv").exists()


def test_a_part_of_a_record_is_its_run_up(programs: list[str], tmp_path: Path) -> None:
    """A speed that rises and falls is refused with the times of its run-up, which the option takes."""
    time = np.arange(0.0, 12.0, 2e-3)
    rpm = np.interp(time, [0.0, 6.0, 12.0], [300.0, 900.0, 300.0]) + np.random.default_rng(1).standard_normal(len(time))
    path = tmp_path / "both.csv"
    columns = np.column_stack([time, np.cos(2.0 * np.pi * 60.0 * time), rpm])
    np.savetxt(path, columns, delimiter=",", header="time_s,probe [mm],rpm", comments="")
    program, out = programs[0], tmp_path / "out"
    refused = ran(program, out, path)
    assert refused.returncode == 2 and not out.exists()
    cure = re.search(r"--between (0\.\.[\d.]+)", refused.stderr)
    assert cure is not None, refused.stderr
    done = ran(program, out, path, "--between", cure[1])
    assert done.returncode == 0, done.stderr
    rows = np.genfromtxt(out / "peaks.csv", delimiter=",", skip_header=1, usecols=(1, 2))
    assert abs(np.median(rows[:, 1]) - 60.0) < 0.1 and rows[-1, 0] > rows[0, 0] + 300.0


def test_a_fit_that_misses_writes_no_scene(programs: list[str], draft: sf.Scene, tmp_path: Path) -> None:
    """Frequencies ten times too high are those of no saw with this guide."""
    saw = draft.replace({"cut": None, "measured": None})
    known = np.array([mode.frequency_hz for mode in saw.modes(0)[:8]])
    scene, out = tmp_path / "saw.json", tmp_path / "out"
    scene.write_text(saw.to_json(), encoding="utf-8")
    for factor, is_met in ((1.0, True), (10.0, False)):
        table = tmp_path / "taps.csv"
        hz = np.sort(factor * known)
        table.write_text(f"rpm,{','.join(f'f{k}' for k in range(1, 9))}\n0,{','.join(f'{x:.3f}' for x in hz)}\n")
        free = ("--free", "guides[0].stiffness_n_per_m=1e7..4e7", "--starts", "1", "--out", str(out))
        done = subprocess.run(
            [programs[0], "fit", str(scene), str(table), *free],
            check=False, capture_output=True, text=True, encoding="utf-8", timeout=300,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        assert (out / "fitted-scene.json").exists() == is_met
        assert ("no fitted scene is made of it" in " ".join(done.stdout.split())) != is_met
