"""How fast a measured saw may turn: peaks of simulated saws, of which some are of no mode."""

from __future__ import annotations

import json
import logging
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import sawflutter as sf
from sawflutter import _margin_command, _native, _posterior, margins
from sawflutter._reduced import Reduced

Array = npt.NDArray[np.float64]

RADIUS, STIFFNESS = "guides[0].radius_m", "guides[0].stiffness_n_per_m"
FREE = {RADIUS: (0.18, 0.24), STIFFNESS: (3e6, 6e7)}
TRUTH = {RADIUS: 0.21, STIFFNESS: 9e6}
SPEEDS = np.linspace(100.0, 1200.0, 6)
DEVIATION_HZ = 0.1


@pytest.fixture(scope="module")
def saw(draft: sf.Scene) -> sf.Scene:
    return draft.replace({"cut": None, "measured": None})


@pytest.fixture(scope="module")
def peaks(saw: sf.Scene) -> tuple[Array, Array, Array]:
    """Speeds and frequencies, and the true mode of each: two thirds of the lowest frequencies, both
    multiples of the speed, and one peak of nothing at each speed."""
    noise = np.random.default_rng(7)
    rows: list[tuple[float, float, float]] = []
    for rpm, computed in zip(SPEEDS, saw.replace(TRUTH).modes(SPEEDS.tolist()).frequency_hz[:, :6]):
        seen = np.flatnonzero(noise.random(6) < 0.67)
        rows += [(rpm, computed[mode], float(mode + 1)) for mode in seen]
        rows += [(rpm, order * rpm / 60.0, 0) for order in (1, 2)]
        rows += [(rpm, noise.uniform(5.0, 60.0), -1)]
    speeds, hz, modes = np.array(rows, float).T
    return speeds, hz + DEVIATION_HZ * noise.standard_normal(len(hz)), modes


@pytest.fixture(scope="module")
def computed(
    saw: sf.Scene, peaks: tuple[Array, Array, Array]
) -> tuple[sf.MeasuredMargin, set[str], list[logging.LogRecord]]:
    """The margin, the phases of its progress, and its announcements."""
    phases, said = set[str](), list[logging.LogRecord]()

    def tell(done: int, of: int, phase: str) -> None:
        assert 0 < done <= of
        phases.add(phase)

    class Handler(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            said.append(record)

    handler = Handler()
    logging.getLogger("sawflutter").addHandler(handler)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(margins, "_FIRST", 256)
        patch.setattr(margins, "_ANALYSED", 40)
        patch.setattr(margins, "_LONG_S", 0.1)
        begin = time.perf_counter()
        result = saw.measured_margin(peaks[0], peaks[1], FREE, steps=60, accuracy="draft", progress=tell)
        said.append(logging.makeLogRecord({"args": (time.perf_counter() - begin,)}))
    logging.getLogger("sawflutter").removeHandler(handler)
    return result, phases, said


@pytest.fixture(scope="module")
def found(
    computed: tuple[sf.MeasuredMargin, set[str], list[logging.LogRecord]]
) -> sf.MeasuredMargin:
    return computed[0]


def test_its_time_is_estimated_and_its_phases_are_named(
    computed: tuple[sf.MeasuredMargin, set[str], list[logging.LogRecord]]
) -> None:
    _, phases, (said, taken) = computed
    assert phases == {"saws between the bounds", "steps", "analyses"}
    assert "a rough estimate" in said.getMessage()
    assert isinstance(said.args, tuple) and isinstance(taken.args, tuple)
    assert isinstance(said.args[0], float) and isinstance(taken.args[0], float)
    # Other work on the machine changes both.
    assert 0.2 < said.args[0] / taken.args[0] < 5.0


def test_the_intervals_contain_the_true_saw(saw: sf.Scene, found: sf.MeasuredMargin) -> None:
    true = saw.replace(TRUTH).speeds(beside=saw)
    assert true.first_critical_rpm is not None and true.flutter_rpm is not None
    for values, truth in [
        (found.numbers[:, 0], TRUTH[RADIUS]), (found.numbers[:, 1], TRUTH[STIFFNESS]),
        (found.critical_rpm, true.first_critical_rpm), (found.flutter_rpm, true.flutter_rpm),
        (found.deviation_hz, DEVIATION_HZ),
    ]:  # fmt: skip
        assert values.min() < truth < values.max()
    # The intervals are far narrower than the bounds.
    assert np.ptp(found.numbers[:, 0]) < 0.7 * 0.06
    assert found.at_most_rpm == pytest.approx(0.85 * np.quantile(found.critical_rpm, 0.05))
    assert 0.95 * 0.85 * true.first_critical_rpm < found.at_most_rpm < 0.85 * true.first_critical_rpm
    assert found.independent > 100.0 and found.error_hz < 0.2
    assert str(found).startswith(f"Run at most {found.at_most_rpm:.0f} rpm: 85 % of")


def test_each_peak_has_its_mode(found: sf.MeasuredMargin, peaks: tuple[Array, Array, Array]) -> None:
    speeds, hz, modes = peaks
    true = {(rpm, one): mode for rpm, one, mode in zip(speeds, hz, modes)}
    right = [true[rpm, one] == mode for rpm, one, mode in zip(found.rpm, found.peak_hz, found.mode)]
    # A peak where a branch crosses a multiple of the speed may be of either, and one of nothing may be near a branch.
    assert np.mean(right) > 0.85
    sure = found.probability > 0.95
    assert np.mean(np.array(right)[sure]) > 0.9


def test_the_figure_shows_the_peaks_by_kind(found: sf.MeasuredMargin) -> None:
    chart = found.chart()
    names = [item.name for item in chart.key]
    assert names[:2] == ["95 % of the saws", "peak of a mode"] and names[-1].startswith("at most ")
    assert found.plot_matplotlib().figure is not None


def test_small_matrices_have_the_frequencies_of_the_full_ones(saw: sf.Scene) -> None:
    bounds = [(path, low, high) for path, (low, high) in FREE.items()]
    reduced = Reduced(saw, bounds, 1200.0, lambda seconds: None, lambda *_: None)
    numbers = np.array(list(TRUTH.values()))
    rpm = np.array([0.0, 600.0, 1200.0])
    small = reduced.frequencies_hz(numbers[None], rpm)[0, :, :5]
    full = saw.replace(TRUTH).modes(rpm.tolist()).frequency_hz[:, :5]
    assert np.abs(small - full).max() < 0.05
    assert reduced.error_hz < 0.2


def test_the_next_measurement_is_of_what_decides() -> None:
    """The deciding speed follows the second frequency at the last speed; the first one varies more."""
    noise = np.random.default_rng(0)
    of_deciding, other = noise.standard_normal((2, 4000))
    computed = np.full((4000, 2, 2), 10.0)
    computed[:, :, 0] += 5.0 * other[:, None]
    computed[:, 1, 1] += 0.5 * of_deciding
    rpm, hz, mode, share = _posterior.most_telling(np.array([0.0, 900.0]), computed, 1500.0 + 20.0 * of_deciding, 0.5)
    assert (rpm, mode) == (900.0, 2) and hz == pytest.approx(10.0, abs=0.05)
    # The error is as large as the spread, so that half of the variance remains.
    assert share == pytest.approx(0.5, abs=0.03)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"margin": 1.2}, "margin must be above 0 and at most 1"),
        ({"steps": 3}, "steps must be at least 20"),
        ({"free": {}}, "free must be given"),
        ({"peak_hz": [10.0]}, "one for each of 2 speeds"),
        ({"peak_hz": [10.0, -3.0]}, "peak_hz must be above 0"),
        ({"peak_hz": [10.0, 11.0]}, "more than 2 below"),
    ],
)
def test_bad_arguments_are_refused(saw: sf.Scene, arguments: dict[str, Any], said: str) -> None:
    given: dict[str, Any] = {"rpm": [0.0, 900.0], "peak_hz": [10.0, 20.0], "free": FREE, **arguments}
    with pytest.raises(sf.ArgumentError, match=said):
        saw.measured_margin(**given)


def test_the_command_writes_saws_modes_and_a_figure(
    saw: sf.Scene, found: sf.MeasuredMargin, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sf.Scene, "measured_margin", lambda *_, **__: found)
    table = tmp_path / "peaks.csv"
    table.write_text('file,rpm,frequency_hz,amplitude,order\n"a",100,7.5,1,\n"a",100,1.7,1,1\n')
    given = {
        "scene": json.loads(saw.to_json()), "peaks": str(table), "free": [[RADIUS, 0.18, 0.24]], "orders": [1, 2],
        "margin": 0.85, "steps": 60, "out": str(tmp_path),
    }  # fmt: skip
    text = _margin_command.run(given)
    assert all(len(line) <= 80 for line in text.splitlines() if not line.startswith("Written to "))
    saws = np.genfromtxt(tmp_path / "margin.csv", delimiter=",", skip_header=1)
    assert saws == pytest.approx(np.column_stack([found.numbers, found.deviation_hz, found.critical_rpm, found.flutter_rpm]))
    assert len((tmp_path / "peak-modes.csv").read_text().splitlines()) == 1 + len(found.mode)
    assert (tmp_path / "margin.png").read_bytes().startswith(b"\x89PNG")
    # Tables of a spreadsheet are read, too.
    for text in ("rpm,f1,f2\n0,7.9,\n600,7.1,12.5\n", "rpm;frequency_hz\n0;7,9\n600;7,1\n600;12,5\n"):
        for encoding in ("utf-8", "utf-16"):
            table.write_text(text, encoding=encoding)
            assert _native.peaks(table) == [(0.0, 7.9), (600.0, 7.1), (600.0, 12.5)]


@pytest.mark.parametrize(
    ("text", "options", "said"),
    [
        ("100;7,5\n200;7,6\n", (), "name the columns rpm and frequency_hz"),
        ("rpm,frequency_hz\n100,fast\n", (), "line 2 of .*column 2 must be a number .*'fast'|\"fast\""),
        ("frequency_hz,rpm\n7.5,100\n8.5\n", (), "line 3 of .*column 2 must be a number"),
        ("\0\x01rpm", (), "is not text"),
        ("rpm,frequency_hz\n100,7.5\n", (), "the peaks of .* must be more than 2"),
        ("rpm,frequency_hz\n100,7.5\n", ("--margin", "2"), "--margin must be above 0 and at most 1"),
    ],
)
def test_the_program_refuses_what_it_cannot_use(
    programs: list[str], tmp_path: Path, saw: sf.Scene, text: str, options: tuple[str, ...], said: str
) -> None:
    table, scene, out = tmp_path / "peaks.csv", tmp_path / "saw.json", tmp_path / "out"
    table.write_text(text)
    scene.write_text(saw.to_json(), encoding="utf-8")
    free = [word for path, (low, high) in FREE.items() for word in ("--free", f"{path}={low}..{high}")]
    done = subprocess.run(
        [programs[0], "margin", str(scene), str(table), *free, *options, "--out", str(out)],
        check=False, capture_output=True, text=True, encoding="utf-8", timeout=300,
        env={"SAWFLUTTER_PYTHON": sys.executable, "PATH": ""},
    )  # fmt: skip
    assert done.returncode == 2 and not done.stdout
    assert done.stderr.splitlines()[-1].startswith("error: ")
    assert re.search(said, done.stderr), done.stderr
    assert not out.exists()
