"""Files of records and of frequency responses, as instruments and spreadsheets write them."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import sawflutter as sf

Array = npt.NDArray[Any]
RATE = 500.0
TIME = np.arange(64) / RATE
PROBE = np.round(np.sin(0.3 * RATE * TIME) + 0.3 * np.sin(1.1 * RATE * TIME), 6)
SPEED = np.linspace(600.0, 1200.0, len(TIME)) + 5.0 * PROBE


def table(titles: str, columns: list[Array], mark: str = ";", decimal: str = ".") -> str:
    """Lines of titles and of numbers."""
    rows = [mark.join(f"{x:.10g}".replace(".", decimal) for x in row) for row in zip(*columns)]
    return "\n".join([titles, *rows, ""])


def assert_is_probe(record: sf.Record, unit: str = "mm", rpm: Array | float = 0.0) -> None:
    assert abs(record.rate_hz / RATE - 1.0) < 1e-6
    assert record.unit == unit
    assert record.samples.shape == PROBE.shape and np.abs(record.samples - PROBE).max() < 1e-5
    assert np.abs(record.rpm - rpm).max() < 1e-2


@pytest.mark.parametrize(
    ("title", "per_second"),
    [
        ("X_Value", 1.0), ("timestamp", 1.0), ("seconds", 1.0), ("Elapsed Time (s)", 1.0), ("Zeit in s", 1.0),
        ("t/s", 1.0), ("Zeit / ms", 1e3), ("Temps écoulé [s]", 1.0), ("Time Stamp", 1.0), ("Time - Plot 0", 1.0),
        ("time 1 - default sample rate [s]", 1.0), ("Time ms", 1e3), ("Time [µs]", 1e6), ("Zeit [min]", 1.0 / 60.0),
    ],
)  # fmt: skip
def test_a_time_has_many_names_and_units(tmp_path: Path, title: str, per_second: float) -> None:
    path = tmp_path / "record.csv"
    path.write_text(table(f"{title};probe [mm]", [TIME * per_second, PROBE]), encoding="utf-8")
    assert_is_probe(sf.read_record(path, rpm=0))
    # A given rate is that of the times.
    assert sf.read_record(path, rpm=0, rate_hz=RATE).rate_hz == RATE
    with pytest.raises(sf.InputError, match="rate_hz must be left out .*500 Hz"):
        sf.read_record(path, rpm=0, rate_hz=400)


def test_a_time_of_an_unknown_name_is_no_signal(tmp_path: Path) -> None:
    path = tmp_path / "record.csv"
    path.write_text(table("A;probe [mm]", [TIME, PROBE]))
    assert_is_probe(sf.read_record(path, rpm=0, rate_hz=RATE))
    with pytest.raises(sf.InputError, match="name this column time_s"):
        sf.read_record(path, rpm=0)
    with pytest.raises(sf.InputError, match="rises evenly .*name it time_s"):
        sf.read_record(path, rpm=0, rate_hz=RATE, signal=0)
    path.write_text(table("n;probe [mm]", [np.arange(64), PROBE]))
    assert_is_probe(sf.read_record(path, rpm=0, rate_hz=RATE))
    with pytest.raises(sf.InputError, match="no channel of a speed"):
        sf.read_record(path, rate_hz=RATE)


@pytest.mark.parametrize(
    "text",
    [
        "\ufeff" + table("Zeit [s];Weg [mm];Drehzahl [1/min]", [TIME, PROBE, SPEED], decimal=","),
        table("Messung 4\nZeit;Weg;Drehzahl\ns;mm;U/min", [TIME, PROBE, SPEED], decimal=","),
        table("Time\tProbe\tSpeed\n(ms)\t(mm)\t(rpm)", [1e3 * TIME, PROBE, SPEED], "\t"),
        table("Temps (s);Déplacement (mm);Vitesse (tr/min)", [TIME, PROBE, SPEED], decimal=","),
        table("t in s;x(t) in mm;n in min⁻¹", [TIME, PROBE, SPEED]),
        table("# time_s,probe [mm],rpm", [TIME, PROBE, SPEED], ","),
        table("% time_s probe_mm rpm", [TIME, PROBE, SPEED], " "),
        table(",Time (s),Probe (mm),Spindle speed", [np.arange(64), TIME, PROBE, SPEED], ","),
        table(";time_s;probe_mm;rpm;", [TIME, PROBE, SPEED]).replace("\n", ";\n;"),
        table("time_s;Spindle Speed [rad/s];probe_mm", [TIME, SPEED * np.pi / 30.0, PROBE]),
        table("Time;ch 1 [mm];Time;rpm", [TIME, PROBE, TIME, SPEED]),
    ],
)
def test_titles_in_any_form_give_names_and_units(tmp_path: Path, text: str) -> None:
    path = tmp_path / "record.csv"
    path.write_text(text, encoding="utf-8")
    assert_is_probe(sf.read_record(path), rpm=SPEED)


@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("columns", ["No", "One", "Multi"])
def test_a_labview_file_is_read_with_and_without_abscissas(tmp_path: Path, columns: str, decimal: str) -> None:
    gap = "\t\t" if columns == "Multi" else "\t"
    fields = {
        "Channels": "2", "Samples": "64\t64", "Y_Unit_Label": gap.join(["mm", "1/min"]),
        "X_Dimension": gap.join(["Time", "Time"]), "X0": gap.join(["0.0E+0", "0.0E+0"]),
        "Delta_X": gap.join(["0.002000", "0.002000"]),
    }  # fmt: skip
    general = {"Writer_Version": "2", "Separator": "Tab", "Decimal_Separator": decimal, "X_Columns": columns}
    lines = ["LabVIEW Measurement\t", *map("\t".join, general.items()), "***End_of_Header***\t", "\t"]
    lines += [*map("\t".join, fields.items()), "***End_of_Header***\t\t"]
    between = "\tX_Value\t" if columns == "Multi" else "\t"
    lines.append(f"X_Value\tprobe (Trigger){between}Drehzahl\tComment")
    for time, *values in zip(TIME, PROBE, SPEED):
        x = "" if columns == "No" else f"{time:.6f}"
        lines.append(f"{x}\t" + (f"\t{x}\t" if columns == "Multi" else "\t").join(f"{y:.6f}" for y in values))
    lines[-len(TIME)] += "\tbegin of the run-up"
    path = tmp_path / "record.lvm"
    numbers = "\r\n".join(lines).replace(".", decimal)
    path.write_bytes(numbers.encode())
    assert_is_probe(sf.read_record(path), rpm=SPEED)
    segments = numbers + "\r\n" + numbers[numbers.index("Channels") :]
    path.write_bytes(segments.encode())
    with pytest.raises(sf.InputError, match="segment 2 of 2; keep one"):
        sf.read_record(path)


def response() -> tuple[Array, Array]:
    """Frequencies and a response with resonances at 100, 125, 150 and 260 Hz."""
    hz = np.arange(0.0, 300.0, 0.5)
    modes = ((100.0, 3.0), (125.0, 1.0), (150.0, 2.0), (260.0, 5.0))
    return hz, np.asarray(sum(a / (f**2 - hz**2 + 0.008j * f * hz) for f, a in modes))


HZ, H = response()
LEVEL, DEGREES = 20.0 * np.log10(np.abs(H)), np.degrees(np.angle(H))


@pytest.mark.parametrize(
    ("titles", "columns", "unit"),
    [
        ("Frequency [Hz];Magnitude [mm/N];Phase [deg]", [HZ, np.abs(H), DEGREES], "mm/N"),
        ("f_hz;phase_rad;mag", [HZ, np.angle(H), np.abs(H)], ""),
        ("Frequenz [kHz];Betrag [mm/N];Phase [°]", [HZ / 1e3, np.abs(H), DEGREES], "mm/N"),
        ("Frequency;Magnitude;Phase\nHz;dB;deg", [HZ, LEVEL, DEGREES], ""),
        ("Frequency (Hz);FRF (dB re 1 mm/N);Phase (deg)", [HZ, LEVEL, DEGREES], "mm/N"),
        ("f;Magnitude dB re 1e-3 mm/N;Phase_deg", [HZ, LEVEL + 60.0, DEGREES], "mm/N"),
        ("omega [rad/s];Real;Imag", [2.0 * np.pi * HZ, H.real, H.imag], ""),
        ("f (Hz);H(f) (imag);H(f) (real);Coherence", [HZ, H.imag, H.real, np.ones(len(HZ))], ""),
        ("Fréquence [Hz];Partie réelle;Partie imaginaire", [HZ, H.real, H.imag], ""),
        ("X_Value [Hz];Re(H) [mm/N];Im(H) [mm/N]", [HZ, H.real, H.imag], "mm/N"),
        ("Hz;mm/N;deg", [HZ, np.abs(H), DEGREES], "mm/N"),
    ],
)
def test_a_frequency_response_is_read_by_its_titles(
    tmp_path: Path, titles: str, columns: list[Array], unit: str
) -> None:
    path = tmp_path / "frf.csv"
    path.write_text(table(titles, columns, decimal=","), encoding="latin-1")
    spectrum = sf.read_frf(path, rpm=0)
    assert spectrum.unit == unit
    assert np.abs(spectrum.frequency_hz - HZ).max() < 1e-6
    assert np.abs(spectrum.response - H).max() < 1e-6 * np.abs(H).max()
    assert np.abs(spectrum.peaks().frequency_hz - [100.0, 125.0, 150.0, 260.0]).max() < 0.5


def test_frequencies_of_few_digits_are_even(tmp_path: Path) -> None:
    path = tmp_path / "frf.csv"
    np.savetxt(path, np.column_stack([0.625 * np.arange(400), np.ones(400)]), "%.2f", header="f_hz mag", comments="")
    assert abs(sf.read_frf(path).resolution_hz - 1.25) < 1e-3


@pytest.mark.parametrize(
    ("titles", "said"),
    [
        ("Frequency [foo];Magnitude;Phase [deg]", "frequencies .* are in 'foo', but must be in one of Hz, kHz"),
        ("Frequency [Hz];Magnitude;Phase [gon]", "phases .* are in 'gon'"),
        ("Frequency [Hz];Magnitude;Phase", "phases .* no unit; name the column phase_deg"),
        ("Frequency [Hz];Magnitude [dBV];Phase [deg]", "'dBV', which has no known reference"),
        ("Frequency [Hz];Real;Phase [deg]", "has the columns Frequency .*name them so"),
        ("Frequency [Hz];Magnitude;Temperature", "Temperature, but a frequency response"),
        ("Frequency [Hz];Real [mm/N];Imag [m/N]", "units 'mm/N' and 'm/N'"),
        ("Frequency [Hz];Real;Real", "two columns of one kind, real"),
        ("Frequency [Hz];Phase [deg];Magnitude", "must be 0 or more .* unit dB"),
        ("", "column 1, column 2, column 3, but a frequency response"),
    ],
)
def test_a_response_that_may_mean_two_things_is_refused(tmp_path: Path, titles: str, said: str) -> None:
    path = tmp_path / "frf.csv"
    path.write_text(table(titles, [HZ, np.abs(H), np.angle(H)]))
    with pytest.raises(sf.InputError, match=said):
        sf.read_frf(path)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (table("Zeit in Stunden;probe_mm", [TIME, PROBE]), "no column of time"),
        (table("time [ticks];probe_mm", [TIME, PROBE]), "times of .* are in 'ticks', but must be in one of s, ms"),
        (table("time;probe_mm", [1e3 * TIME, PROBE]), "rise by 2, and the column time has no unit; .* time_ms"),
        (table("time_s;Drehzahl [foo];probe_mm", [TIME, SPEED, PROBE]), "no channel of a speed in rpm .*'foo'"),
        (table("time_s;probe;time_ms", [TIME, PROBE, 1e3 * TIME]), "2 columns of time"),
        (table("Gerät;NI9234\nZeit [s];Weg [mm]", [TIME, PROBE]), "line 1 of .* it is text, and so is line 2"),
        (table("Elapsed Time (s) Probe (mm)", [TIME, PROBE], " "), "5 names, the numbers below 2 columns"),
        (table("time_s;probe;state", [TIME, PROBE, TIME]).replace("0.004\n", "OK\n"), "or the column"),
        ("Zeit;Weg\n12:00:01,5;3\n", "give times as seconds"),
    ],
)
def test_a_table_that_may_mean_two_things_is_refused(tmp_path: Path, text: str, said: str) -> None:
    path = tmp_path / "record.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(sf.InputError, match=said):
        sf.read_record(path)


@pytest.mark.parametrize("noise", [0.0, 0.5])
@pytest.mark.parametrize("high", [4.8, -4.8])
@pytest.mark.parametrize("share", [0.02, 0.5])
def test_pulses_are_no_speed_and_no_signal(tmp_path: Path, noise: float, high: float, share: float) -> None:
    time = np.arange(0.0, 4.0, 5e-4)
    rpm = 600.0 + 50.0 * time
    turns = np.cumsum(rpm) / 60.0 * 5e-4
    pulses = np.where(turns % 1.0 < share, high, 0.0) + noise * np.random.default_rng(5).standard_normal(len(time))
    path = tmp_path / "record.csv"
    path.write_text(table("time_s;speed;probe [mm]", [time, pulses, np.sin(300.0 * time)]))
    with pytest.raises(sf.InputError, match="speed must be a rotation speed .*tacho='speed'"):
        sf.read_record(path)
    record = sf.read_record(path, tacho="speed")
    assert record.unit == "mm" and np.abs(record.rpm / rpm - 1.0)[400:-400].max() < 0.02
    path.write_text(table("time_s;key [V];probe [mm]", [time, pulses, np.sin(300.0 * time)]))
    with pytest.raises(sf.InputError, match="tacho='key'"):
        sf.read_record(path)
    assert sf.read_record(path, rpm=(600, 800)).unit == "mm"
    begins = np.flatnonzero((turns[1:] % 1.0 < share) & (turns[:-1] % 1.0 >= share)) + 1
    wrong = {"missing": (begins[10], begins[11] - 2, 0.0), "added": (begins[10] + 160, begins[10] + 163, high)}
    for begin, end, level in wrong.values() if share == 0.02 and high > 0.0 else ():
        changed = pulses.copy()
        changed[begin:end] = level
        path.write_text(table("time_s;key [V];probe [mm]", [time, changed, time]))
        with pytest.raises(sf.InputError, match="none is missing and none is added"):
            sf.read_record(path, tacho="key", signal=0)


def test_uneven_times_are_refused_with_their_own_steps(tmp_path: Path) -> None:
    time = np.cumsum(np.where(np.arange(50) < 25, 0.003, 0.002))
    path = tmp_path / "phone.csv"
    path.write_text(table("time_s;probe [mm]", [time, np.sin(300.0 * time)]))
    with pytest.raises(sf.InputError, match=r"steps from 0\.002 to 0\.003 s.*give rate_hz=402, at which"):
        sf.read_record(path, rpm=0.0)


def test_uneven_times_of_a_phone_are_interpolated_at_a_given_rate(tmp_path: Path) -> None:
    """The decay has 60 Hz, sampled at steps of 2 ms that differ by a tenth."""
    steps = 2e-3 * (1.0 + 0.1 * np.random.default_rng(4).uniform(-1.0, 1.0, 2000))
    time = np.cumsum(steps)
    path = tmp_path / "phone.csv"
    path.write_text(table("Time (s);probe [mm]", [time, np.exp(-time) * np.cos(2.0 * np.pi * 60.0 * time)]))
    with pytest.raises(sf.InputError, match="not evenly spaced .*give rate_hz=") as refused:
        sf.read_record(path, rpm=0.0)
    cure = re.search(r"rate_hz=(\d+)", str(refused.value))
    assert cure is not None
    record = sf.read_record(path, rpm=0.0, rate_hz=float(cure[1]))
    at = time[0] + record.time_s
    inner = slice(5, -5)
    assert np.abs(record.samples - np.exp(-at) * np.cos(2.0 * np.pi * 60.0 * at))[inner].max() < 0.02
    assert np.abs(record.spectrum(to_hz=150).peaks().frequency_hz - 60.0).max() < 0.05
    with pytest.raises(sf.InputError, match="not evenly spaced"):
        sf.read_record(path, rpm=0.0, rate_hz=5000)


def test_a_speed_of_few_digits_or_with_rests_is_a_speed(tmp_path: Path) -> None:
    time = np.arange(0.0, 4.0, 2e-3)
    path = tmp_path / "record.csv"
    for rpm in (3000.0 + (np.arange(len(time)) % 3 == 0), np.interp(time % 2.0, [0.5, 1.0, 1.5], [0.0, 3000.0, 0.0])):
        path.write_text(table("time_s;rpm;probe [mm]", [time, rpm, np.sin(300.0 * time)]))
        assert np.abs(sf.read_record(path).rpm - rpm).max() < 1e-3


def universal(samples: Array, *, step: float, unit: str, kind: int = 1, stated: int | None = None) -> str:
    """A data set 58 in text, in single precision, with a last line of fillers."""
    is_complex = np.iscomplexobj(samples)
    count = len(samples) if stated is None else stated
    axis = 17 if kind == 1 else 18
    lines = ["    -1", "    58", "probe", "NONE", "16-May-2019 14:00:01", "NONE", "NONE"]
    lines.append(f"{kind:5d}{0:10d}{0:5d}{0:10d} NONE      {1:10d}{3:4d} NONE      {1:10d}{3:4d}")
    lines.append(f"{5 if is_complex else 2:10d}{count:10d}{1:10d}{0:13.5E}{step:13.5E}{0:13.5E}")
    for of, label in ((axis, unit), (8, "mm"), (0, "NONE"), (0, "NONE")):
        lines.append(f"{of:10d}{0:5d}{0:5d}{0:5d} {'NONE':20s} {label:20s}")
    flat = np.column_stack([samples.real, samples.imag]).ravel() if is_complex else samples
    cells = [f"{x:13.5E}" for x in [*flat, *np.zeros(-len(flat) % 6)]]
    lines += ["".join(cells[at : at + 6]) for at in range(0, len(cells), 6)]
    return "\n".join([*lines, "    -1", ""])


@pytest.mark.parametrize(("unit", "step"), [("s", 2e-3), ("NONE", 2e-3), ("ms", 2.0), ("µs", 2e3)])
@pytest.mark.parametrize("exponent", ["E", "D"])
def test_a_time_history_has_its_unit_and_fillers(tmp_path: Path, unit: str, step: float, exponent: str) -> None:
    path = tmp_path / "record.uff"
    path.write_text(re.sub(r"(?<=\d)E(?=[-+]\d)", exponent, universal(PROBE, step=step, unit=unit)), encoding="utf-8")
    assert_is_probe(sf.read_record(path, rpm=0))


@pytest.mark.parametrize(("unit", "step"), [("Hz", 0.5), ("NONE", 0.5), ("kHz", 5e-4), ("rad/s", np.pi)])
def test_a_universal_frequency_response_has_its_unit(tmp_path: Path, unit: str, step: float) -> None:
    path = tmp_path / "frf.uff"
    path.write_text(universal(H, step=step, unit=unit, kind=4))
    assert np.abs(sf.read_frf(path).peaks().frequency_hz - [100.0, 125.0, 150.0, 260.0]).max() < 0.5


def test_a_universal_file_with_fewer_samples_than_stated_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "record.uff"
    text = universal(PROBE[:60], step=2e-3, unit="s", stated=64)
    path.write_text(text)
    with pytest.raises(sf.InputError, match="60 of 64 samples are there; .*columns 11 to 20 of line 7 below the 58"):
        sf.read_record(path, rpm=0)
    # The advice of the message.
    lines = text.splitlines()
    at = lines.index("    58") + 7
    lines[at] = f"{lines[at][:10]}{60:10d}{lines[at][20:]}"
    path.write_text("\n".join(lines))
    assert len(sf.read_record(path, rpm=0).samples) == 60
    for changed, said in (
        (universal(PROBE, step=2e-3, unit="s", stated=40), "states 40 samples, but has 66"),
        (universal(PROBE, step=2e-3, unit="foo"), "times of .* are in 'foo'"),
        (text.replace(f"{PROBE[9]:13.5E}", f"{'*' * 13}"), r"has '\*+' instead of a number"),
        (universal(PROBE, step=2e-3, unit="Hz", kind=0), "no time history .*0 over 18"),
    ):
        path.write_text(changed)
        with pytest.raises(sf.InputError, match=said):
            sf.read_record(path, rpm=0)
