"""Records of probes: files, spectra over speed, peaks, and fits to them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
import pytest

import sawflutter as sf
from sawflutter import _native
from sawflutter.plot import Heat, Line, Points

Array = npt.NDArray[Any]
RATE = 500.0
# Frequency at rest, change with the rotation speed in turns, amplitude.
WAVES = [(30.0, -1.0, 1.0), (45.0, 1.0, 0.3), (80.0, -2.0, 0.1), (90.0, 0.0, 0.03)]


def chirps(rpm: Array) -> Array:
    """Waves whose frequencies change with the speed in proportion."""
    turns = np.cumsum(rpm) / 60.0 / RATE
    time = np.arange(len(rpm)) / RATE
    waves = [a * np.cos(2.0 * np.pi * (f * time + n * turns) + f) for f, n, a in WAVES]
    return np.asarray(sum(waves))


@pytest.fixture(scope="module")
def ramp() -> Array:
    """The speed of a run-up in 40 s."""
    return np.linspace(0.0, 600.0, int(40 * RATE))


def test_peaks_of_chirps_are_at_their_frequencies(ramp: Array) -> None:
    noise = 1e-3 * np.random.default_rng(1).standard_normal(len(ramp))
    record = sf.Record(chirps(ramp) + noise, RATE, (0, 600), unit="mm")
    spectra = record.waterfall(to_hz=120)
    peaks = spectra.peaks(orders=())
    known = np.array([[f + n * rpm / 60.0 for f, n, _ in WAVES] for rpm in spectra.rpm])
    found = np.array([peaks.frequency_hz[peaks.rpm == rpm] for rpm in spectra.rpm])
    # All waves, and nothing else.
    assert found.shape == known.shape
    assert np.abs(found - np.sort(known)).max() < 0.05 * spectra.resolution_hz
    # The highest wave has the same frequency at all speeds, and so its full amplitude.
    sizes = np.array([peaks.amplitude[peaks.rpm == rpm] for rpm in spectra.rpm])
    assert np.abs(sizes[:, -1] - 0.03).max() < 0.05 * 0.03


def test_the_resolution_is_the_width_of_a_steady_sine(ramp: Array) -> None:
    tone = np.cos(2.0 * np.pi * 50.0 * np.arange(len(ramp)) / RATE)
    spectra = sf.Record(tone, RATE, ramp).waterfall(resolution_hz=1.0)
    middle = spectra.amplitude[len(spectra.rpm) // 2]
    above = spectra.frequency_hz[middle > 0.5 * middle.max()]
    assert abs(np.ptp(above) - 1.0) < 2.0 * spectra.frequency_hz[1]
    # A line between two frequencies of the spectrum is lower there, but not its peak.
    assert abs(middle.max() - 1.0) < 0.02
    peaks = spectra.peaks(orders=())
    assert np.abs(peaks.frequency_hz - 50.0).max() < 1e-3
    assert np.abs(peaks.amplitude - 1.0).max() < 1e-3


def test_peaks_at_multiples_of_the_speed_are_no_modes(ramp: Array) -> None:
    turns = 2.0 * np.pi * np.cumsum(ramp) / 60.0 / RATE
    mode = np.cos(2.0 * np.pi * 50.0 * np.arange(len(ramp)) / RATE)
    runout = 5.0 * np.cos(turns) + 2.0 * np.cos(2.0 * turns)
    peaks = sf.Record(mode + runout, RATE, ramp).waterfall(to_hz=100).peaks(orders=(1, 2))
    of_order = ~np.isnan(peaks.order)
    assert set(peaks.order[of_order]) == {1.0, 2.0}
    late = of_order & (peaks.rpm > 300)
    off = peaks.frequency_hz[late] - peaks.order[late] * peaks.rpm[late] / 60.0
    assert np.abs(off).max() < 0.2 * peaks.resolution_hz
    assert np.abs(peaks.frequency_hz[~of_order] - 50.0).max() < 0.1 * peaks.resolution_hz


def universal(path: Path, channels: list[tuple[str, str, Array]], binary: int = 0) -> None:
    """A universal file with time histories."""
    pyuff = pytest.importorskip("pyuff")
    file = pyuff.UFF(str(path))
    for name, unit, samples in channels:
        time = np.arange(len(samples)) / RATE
        data = pyuff.prepare_58(
            binary=binary, func_type=1, id1=name, rsp_node=1, rsp_dir=3, ref_node=1, ref_dir=3,
            data=samples, x=time, abscissa_spacing=1, abscissa_min=0.0, abscissa_inc=1.0 / RATE,
            num_pts=len(samples), abscissa_spec_data_type=17, ordinate_spec_data_type=8,
            ordinate_axis_units_lab=unit, orddenom_spec_data_type=0, abscissa_axis_units_lab="s",
        )  # fmt: skip
        file.write_sets(data, "add")


# pyuff does not close a binary file that it has written.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_files_of_all_kinds_give_the_same_record(tmp_path: Path, ramp: Array) -> None:
    wavfile = pytest.importorskip("scipy.io.wavfile")
    signal = chirps(ramp)
    time = np.arange(len(ramp)) / RATE
    commas = ["Zeit;Taster;Drehzahl", "s;mm;1/min"]
    commas += [f"{t:.4f};{x:.9f};{n:.6f}".replace(".", ",") for t, x, n in zip(time, signal, ramp)]
    (tmp_path / "german.csv").write_text("\n".join(commas), encoding="utf-16")
    table = np.column_stack([time, ramp, signal])
    np.savetxt(tmp_path / "plain.csv", table, delimiter=",", header="time_s,rpm,probe [mm]", comments="")
    np.savetxt(tmp_path / "bare.txt", signal)
    wavfile.write(tmp_path / "float.wav", int(RATE), signal.astype(np.float32))
    both = np.column_stack([signal / 2.0, np.zeros_like(signal)])
    wavfile.write(tmp_path / "whole.wav", int(RATE), np.round(32767 * both).astype(np.int16))
    ended = [f"{x:.9f};" for x in signal]
    (tmp_path / "ended.dat").write_text("\n".join(["x;", *ended]))
    universal(tmp_path / "text.uff", [("probe", "mm", signal), ("speed", "rpm", ramp)])
    universal(tmp_path / "binary.uff", [("probe", "mm", signal), ("speed", "rpm", ramp)], 1)
    records = {
        "german.csv": sf.read_record(tmp_path / "german.csv"),
        "plain.csv": sf.read_record(tmp_path / "plain.csv"),
        "bare.txt": sf.read_record(tmp_path / "bare.txt", rpm=(0, 600), rate_hz=RATE, unit="mm"),
        "ended.dat": sf.read_record(tmp_path / "ended.dat", rpm=(0, 600), rate_hz=RATE, unit="mm"),
        "float.wav": sf.read_record(tmp_path / "float.wav", rpm=(0, 600), unit="mm"),
        "whole.wav": sf.read_record(tmp_path / "whole.wav", signal=0, rpm=ramp, scale=2.0, unit="mm"),
        "text.uff": sf.read_record(tmp_path / "text.uff"),
        "binary.uff": sf.read_record(tmp_path / "binary.uff", signal="probe", speed=1),
    }
    for name, record in records.items():
        assert (record.name, record.unit) == (name, "mm")
        assert abs(record.rate_hz / RATE - 1.0) < 1e-6, name
        assert np.abs(record.samples - signal).max() < 2e-4, name
        assert np.abs(record.rpm - ramp).max() < 1e-3, name


@pytest.mark.parametrize("pulses", [1, 4])
def test_the_speed_follows_from_pulses(tmp_path: Path, pulses: int) -> None:
    rpm = np.interp(np.arange(0.0, 30.0, 1e-3), [0.0, 5.0, 30.0], [300.0, 300.0, 1500.0])
    turns = np.cumsum(rpm) / 60.0 * 1e-3
    # Slots that are not evenly spaced, and a level that is not zero.
    share = (pulses * turns + 0.05 * np.sin(2.0 * np.pi * turns) * (pulses > 1)) % 1.0
    tacho = 3.0 + np.where(share < 0.3, 1.0, -1.0)
    path = tmp_path / "tacho.csv"
    table = np.column_stack([np.arange(len(rpm)) * 1e-3, np.zeros(len(rpm)), tacho])
    np.savetxt(path, table, delimiter="\t", header="t\tprobe\ttacho", comments="", fmt="%.6g")
    record = sf.read_record(path, tacho="tacho", pulses_per_turn=pulses)
    within = slice(500, -500)
    assert np.abs(record.rpm / rpm - 1.0)[within].max() < 0.03


# A wheel of 20 teeth of which one is missing, while the speed rises from 300 to 600 rpm: in the middle it is 450 rpm. With 20 pulses a
# turn it would be 428.6 rpm, 20/21 of it.
def test_a_wheel_with_a_missing_tooth_has_its_own_speed(tmp_path: Path) -> None:
    time = np.arange(0.0, 5.0, 5e-4)
    turns = np.cumsum(300.0 + 60.0 * time) / 60.0 * 5e-4
    tooth = np.floor(20.0 * turns) % 20
    tacho = np.where((20.0 * turns % 1.0 < 0.5) & (tooth != 19), 5.0, 0.0)
    path = tmp_path / "wheel.csv"

    def write(tacho: Array) -> None:
        table = np.column_stack([time, np.sin(300.0 * time), tacho])
        np.savetxt(path, table, delimiter=",", header="time_s,probe,tacho", comments="", fmt="%.6g")

    write(tacho)
    for pulses_per_turn in (19, 20):
        record = sf.read_record(path, tacho="tacho", pulses_per_turn=pulses_per_turn)
        assert abs(record.rpm[5000] - 450.0) < 5.0
    with pytest.raises(sf.InputError, match="pulses_per_turn must be 19, or 20 with .*give 20"):
        sf.read_record(path, tacho="tacho", pulses_per_turn=36)
    # Every tooth is there, but for one once.
    whole = np.where(20.0 * turns % 1.0 < 0.5, 5.0, 0.0)
    write(whole)
    assert abs(sf.read_record(path, tacho="tacho", pulses_per_turn=20).rpm[5000] - 450.0) < 5.0
    whole[(turns > 8.0) & (turns < 8.05)] = 0.0
    write(whole)
    with pytest.raises(sf.InputError, match="none is missing"):
        sf.read_record(path, tacho="tacho", pulses_per_turn=20)


# The integrator of a run-up, with the mean acceleration of a step h, lowers a frequency f to
# atan(π f h) / (π h).
def unlowered(rows: list[tuple[float, list[float]]], step_s: float) -> list[tuple[float, list[float]]]:
    return [
        (rpm, [float(np.tan(np.pi * f * step_s) / (np.pi * step_s)) for f in hz]) for rpm, hz in rows
    ]


def test_a_fit_to_a_computed_run_up_finds_the_guide(draft: sf.Scene) -> None:
    pytest.importorskip("scipy")
    course = {"from_rpm": 0, "to_rpm": 1400, "duration_s": 60}
    saw = draft.replace({"cut": None, "measured": None, "runup": course, "side_force": {"force_n": 50}})
    up = saw.run_up()
    computed = sf.Record.of_run_up(up)
    turns = 2.0 * np.pi * np.cumsum(computed.rpm) / 60.0 / computed.rate_hz
    noise = 3e-8 * np.random.default_rng(0).standard_normal(len(turns))
    runout = 5e-6 * np.cos(turns) + 2e-6 * np.cos(2.0 * turns)
    record = sf.Record(computed.samples + noise + runout, computed.rate_hz, computed.rpm, unit="m")
    peaks = record.waterfall(to_hz=100).peaks()
    rough = saw.replace({"guides[0].radius_m": 0.22, "guides[0].stiffness_n_per_m": 1e7})
    rows = unlowered(peaks.rows(rough, lowest=4, within_hz=2.0), up.step_s)
    fit = rough.fit(rows, starts=1)
    radius, stiffness = fit.parameters
    for found, true in ((radius, 0.2), (stiffness, 2e7)):
        assert found.interval_from is not None and found.interval_to is not None
        assert found.interval_from < true < found.interval_to, found
    assert fit.rms_hz < 0.05 * peaks.resolution_hz
    assert abs(radius.value - 0.2) < 2e-3 and abs(stiffness.value / 2e7 - 1.0) < 0.05


def test_a_tap_test_at_rest_finds_the_stiffness(draft: sf.Scene, tmp_path: Path) -> None:
    pytest.importorskip("scipy")
    stiff = draft.replace({"guides[0].stiffness_n_per_m": 3e6, "measured": None})
    known = [mode.frequency_hz for mode in stiff.modes(0)[:4]]
    time = np.arange(0.0, 8.0, 1e-3)
    decays = sum(np.exp(-0.4 * time) * np.cos(2.0 * np.pi * hz * time) for hz in known)
    samples = np.concatenate([np.zeros(500), decays])
    samples += 1e-3 * np.random.default_rng(2).standard_normal(len(samples))
    peaks = sf.Record(samples, 1000.0, 0.0, unit="mm").spectrum(to_hz=60).peaks()
    assert np.abs(peaks.frequency_hz - known).max() < 0.1 * peaks.resolution_hz
    rows = peaks.rows(draft, lowest=4)
    assert [rpm for rpm, _ in rows] == [0.0]
    free = {"guides[0].stiffness_n_per_m": (1e6, 1e8)}
    fit = draft.fit(rows, free=free, starts=2)
    assert abs(fit.parameters[0].value / 3e6 - 1.0) < 0.02
    # The file for the program gives the same.
    peaks.to_csv(tmp_path / "taps.csv", rows)
    assert draft.fit(tmp_path / "taps.csv", free=free, starts=2).parameters[0].value == fit.parameters[0].value
    # Without rows all peaks are written, as `margin` reads them.
    peaks.to_csv(tmp_path / "peaks.csv")
    assert np.allclose(_native.peaks(tmp_path / "peaks.csv"), np.column_stack([peaks.rpm, peaks.frequency_hz]), atol=1e-6)


@pytest.mark.parametrize("rpm", [0.0, 900.0])
def test_resonances_of_a_frequency_response_are_the_modes(draft: sf.Scene, tmp_path: Path, rpm: float) -> None:
    pyuff = pytest.importorskip("pyuff")
    damped = draft.replace({"guides[0].damping_n_s_per_m": 5.0, "damping.air_n_s_per_m3": 1.0})
    space = damped.matrices(basis=(8, 5)).state_space(rpm, inputs=[(0.355, 20)], outputs=[(0.355, 20)])
    frequency = np.arange(0.0, 50.0, 0.02)
    response = space.reduced(to_hz=200).response(frequency)[:, 0, 0]
    table = np.column_stack([frequency, response.real, response.imag])
    np.savetxt(tmp_path / "frf.csv", table, delimiter=";", header="f;re;im", comments="")
    data = pyuff.prepare_58(
        binary=0, func_type=4, id1="rim", rsp_node=1, rsp_dir=3, ref_node=1, ref_dir=3, data=response,
        x=frequency, abscissa_spacing=1, abscissa_min=0.0, abscissa_inc=0.02, num_pts=len(frequency),
        abscissa_spec_data_type=18, ordinate_spec_data_type=8, orddenom_spec_data_type=13,
        ordinate_axis_units_lab="m", orddenom_axis_units_lab="N", z_axis_spec_data_type=19, z_axis_value=rpm,
    )  # fmt: skip
    pyuff.UFF(str(tmp_path / "frf.uff")).write_sets(data, "add")
    hz = np.sort(np.linalg.eigvals(space.A).imag) / (2.0 * np.pi)
    modes = hz[(hz > 0.0) & (hz < 49.0)]
    for spectrum in (sf.read_frf(tmp_path / "frf.csv", rpm=rpm), sf.read_frf(tmp_path / "frf.uff")):
        assert spectrum.rpm == rpm
        found = spectrum.peaks().frequency_hz
        assert len(found) == len(modes) and np.abs(found - modes).max() < 0.05, (found, modes)
    assert sf.read_frf(tmp_path / "frf.uff").unit == "m/N"


def test_the_chart_shows_spectra_branches_orders_and_peaks(report: sf.CampbellResults, ramp: Array) -> None:
    spectra = sf.Record(chirps(ramp), RATE, ramp, unit="mm").waterfall(to_hz=100)
    peaks = spectra.peaks()
    chart = spectra.chart(report, peaks, orders=(1, 2))
    (panel,) = chart.panels
    (heat,) = (item for item in panel.items if isinstance(item, Heat))
    assert heat.x.tolist() == spectra.rpm.tolist() and heat.z.shape == (len(heat.y), len(heat.x))
    names = {item.name for item in panel.items if isinstance(item, Line)}
    assert {"1× speed", "2× speed", report.branches[0].name} <= names
    rings = [item for item in panel.items if isinstance(item, Points)]
    drawn = {(x, y) for ring in rings for x, y in zip(ring.x.tolist(), ring.y.tolist())}
    assert drawn and drawn <= set(zip(peaks.rpm.tolist(), peaks.frequency_hz.tolist()))
    assert "mm" in chart.facts
    chart.plot()
    chart.plot_matplotlib(speed_units="Hz")
    plt.close("all")


@pytest.mark.parametrize(
    ("name", "text", "arguments", "said"),
    [
        ("a.csv", "t,x\n0,1\n1,b\n", {"rpm": 0}, "line 3 of .*column 2 must be a finite number .you gave 'b'"),
        ("a.csv", "t,x\n0,1\n1\n", {"rpm": 0}, "line 3 of .* has 1 columns"),
        ("a.csv", "t,x\n0,1\n1,nan\n", {"rpm": 0}, "line 3 .*finite"),
        ("a.csv", "t,x\n0,1\n1,2\n5,2\n", {"rpm": 0}, "not evenly spaced"),
        ("a.csv", "t,x\n", {"rpm": 0}, "no line of numbers"),
        ("a.csv", "t,x\n0,1\n1,2\n", {}, "no channel of a speed; give rpm=0"),
        ("a.csv", "t,x\n0,1\n1,2\n", {"rpm": -5}, "from 0 to"),
        ("a.csv", "t,x\n0,1\n1,2\n", {"rpm": [1, 2, 3]}, "pairs"),
        ("a.csv", "t,x\n0,1\n1,2\n", {"rpm": "n"}, "named by speed or tacho"),
        ("a.csv", "t,y,x\n0,1,0\n1,2,1\n", {"tacho": "x", "pulses_per_turn": 0}, "at least 1"),
        ("a.csv", "t,x\n0,1\n1,2\n", {"rpm": 0, "signal": "y"}, r"it has 0 \(x\)"),
        ("a.csv", "t,x,x\n0,1,2\n1,2,4\n", {"rpm": 0, "signal": "x"}, r"it has 0 \(x\), 1 \(x\)"),
        ("a.csv", "t,x\n0,1\n1,2\n", {"rpm": 0, "speed": 0}, "one source"),
        ("a.csv", "t,x,k\n0,1,0\n1,2,1\n", {"tacho": "k"}, "tacho must be .*you gave '1 pulses'"),
        ("a.csv", "t,x\n0,1\n1,2\n", {"rpm": 0, "rate_hz": 9}, "leave it out"),
        ("a.csv", "t,x,speed [1/s]\n0,1,0\n1,2,1\n", {"speed": 1}, "speed must be in rpm .you gave .*; convert"),
        ("a.csv", "t,x,speed [mm/s]\n0,1,0\n1,2,1\n", {}, "no channel of a speed"),
        ("a.csv", "t [h],x\n0,1\n1,2\n", {"rpm": 0}, "times of .* are in 'h'"),
        ("a.csv", "x,rpm\n0,1\n1,2\n", {}, "no column of time"),
        ("a.csv", "t,rpm\n0,1\n1,2\n", {}, "no channel beside"),
        ("a.mp3", "", {"rpm": 0}, r"must end in one of \.wav"),
        ("a.wav", "text", {"rpm": 0}, "no WAV file"),
        ("a.uff", "text", {"rpm": 0}, "no data set 58"),
    ],
)
def test_bad_files_are_refused_with_a_remedy(
    tmp_path: Path, name: str, text: str, arguments: dict[str, Any], said: str
) -> None:
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(sf.InputError, match=said):
        sf.read_record(path, **arguments)


def test_rounded_times_are_even_and_missing_samples_are_not(tmp_path: Path) -> None:
    time = np.arange(400) / 420.0
    rounded, probe = tmp_path / "rounded.csv", np.sin(40.0 * time)
    np.savetxt(rounded, np.column_stack([time, probe]), fmt="%.3f", delimiter=",", header="t,x", comments="")
    assert abs(sf.read_record(rounded, rpm=0).rate_hz - 420.0) < 0.6
    assert sf.read_record(rounded, rpm=0, rate_hz=420).rate_hz == 420.0
    for gone in (10, 200, 390):
        path = tmp_path / "gap.csv"
        table = np.delete(np.column_stack([time, probe]), gone, axis=0)
        np.savetxt(path, table, delimiter=",", header="t,x", comments="")
        with pytest.raises(sf.InputError, match="not evenly spaced"):
            sf.read_record(path, rpm=0)


def test_peaks_at_one_speed_have_orders_too() -> None:
    time = np.arange(0.0, 10.0, 2e-3)
    turning = np.cos(2.0 * np.pi * 20.0 * time) + np.exp(-time) * np.cos(2.0 * np.pi * 33.0 * time)
    for rpm, orders in ((1200.0, [1.0, np.nan]), (0.0, [np.nan, np.nan])):
        peaks = sf.Record(turning, 500, rpm).spectrum(to_hz=60).peaks()
        assert np.abs(peaks.frequency_hz - [20.0, 33.0]).max() < 0.1
        assert np.array_equal(peaks.order, orders, equal_nan=True)


def test_bad_arguments_are_refused_with_a_remedy(draft: sf.Scene, ramp: Array) -> None:
    record = sf.Record(chirps(ramp), RATE, ramp)
    still = sf.Record(chirps(ramp), RATE)
    peaks = record.waterfall(to_hz=100).peaks()
    for call, said in (
        (lambda: still.waterfall(), "rising or falling"),
        (lambda: record.spectrum(), "constant"),
        (lambda: record.waterfall(resolution_hz=0.01), "larger"),
        (lambda: record.waterfall(to_hz=300), "half of the sample rate"),
        (lambda: record.between(50, 60), "part"),
        (lambda: sf.Record([1.0, np.nan], 10), "finite"),
        (lambda: sf.Record([1.0, 2.0], 0), "above 0"),
        (lambda: peaks.rows(draft, lowest=0), "lowest"),
        (lambda: peaks.rows(draft, within_hz=1e-9), "within_hz"),
        (lambda: peaks.rows(draft.replace({"sweep.to_rpm": 100})), "rpm"),
    ):
        with pytest.raises(sf.InputError, match=said):
            call()


def test_numbers_in_place_of_a_file_are_refused() -> None:
    with pytest.raises(sf.ArgumentError, match=r"path must be the path of a file .*sf\.Record\("):
        sf.read_record(np.zeros(8))  # type: ignore[arg-type]
