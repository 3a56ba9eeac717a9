"""Files as workshops and laboratories have them, made from a known rotation: each is read with the right speed and the tone of
the probe, or refused with the cure."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import sawflutter as sf

Array = npt.NDArray[Any]
TONE_HZ = 60.0


@dataclass(frozen=True)
class Rotation:
    """A speed that changes evenly, at a sample rate."""

    rate_hz: float
    begin_rpm: float
    end_rpm: float
    seconds: float = 8.0

    @property
    def time(self) -> Array:
        return np.arange(0.0, self.seconds, 1.0 / self.rate_hz)

    @property
    def rpm(self) -> Array:
        return self.begin_rpm + (self.end_rpm - self.begin_rpm) * self.time / self.seconds

    @property
    def turns(self) -> Array:
        """The integral of the speed."""
        return (self.begin_rpm * self.time + 0.5 * (self.end_rpm - self.begin_rpm) * self.time**2 / self.seconds) / 60.0

    @property
    def probe(self) -> Array:
        return np.cos(2.0 * np.pi * TONE_HZ * self.time) + 0.3 * np.cos(2.0 * np.pi * self.turns)

    def noisy(self, rpm: float) -> Array:
        return self.rpm + rpm * np.random.default_rng(3).standard_normal(len(self.time))

    def wheel(self, teeth: int, missing: int = 0, level: float = 5.0) -> Array:
        """Pulses of a wheel whose last teeth are missing."""
        place = teeth * self.turns
        return np.where((place % 1.0 < 0.5) & (np.floor(place) % teeth < teeth - missing), level, 0.0)


Write = Callable[[Path, list[Array]], None]


def csv(titles: str, mark: str = ",", decimal: str = ".", encoding: str = "utf-8") -> Write:
    def write(path: Path, columns: list[Array]) -> None:
        rows = [mark.join(f"{x:.6f}".replace(".", decimal) for x in row) for row in zip(*columns)]
        path.write_bytes("\r\n".join([titles, *rows, ""]).encode(encoding))

    return write


def xlsx(path: Path, columns: list[Array]) -> None:
    pd = pytest.importorskip("pandas")
    pytest.importorskip("openpyxl")
    above = [["Run-up of saw 4; 12 March", None, None], ["Zeit", "Weg", "Drehzahl"], ["s", "mm", "1/min"]]
    pd.DataFrame(above + [list(row) for row in zip(*columns)]).to_excel(path, header=False, index=False)


def tdms(path: Path, columns: list[Array]) -> None:
    nptdms = pytest.importorskip("nptdms")
    step = {"wf_increment": float(columns[0][1] - columns[0][0])}
    probe = nptdms.ChannelObject("saw", "probe", columns[1], properties={**step, "unit_string": "mm"})
    speed = nptdms.ChannelObject("saw", "speed", columns[2], properties={**step, "unit_string": "rpm"})
    with nptdms.TdmsWriter(path) as writer:
        writer.write_segment([probe, speed])


def mat(path: Path, columns: list[Array]) -> None:
    io = pytest.importorskip("scipy.io")
    rate = 1.0 / float(columns[0][1] - columns[0][0])
    io.savemat(path, {"daq": {"probe_mm": columns[1][:, None], "rpm": columns[2], "Fs": rate}, "note": "saw 4"})


def mat_73(path: Path, columns: list[Array]) -> None:
    path.write_bytes(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM" + bytes(400))


UP, DOWN, STEADY = Rotation(1000, 300, 900), Rotation(1000, 1200, 400), Rotation(1000, 600, 600)
FAST, SLOW, WIDE = Rotation(2000, 300, 900), Rotation(2000, 300, 600), Rotation(10000, 300, 900, 4.0)
TACHO = "Time (s),probe (mm),trigger (V)"
SPEED = "Time (s),probe (mm),n (1/min)"


@dataclass(frozen=True)
class File:
    """A file, how it is read, and of what a refusal speaks."""

    name: str
    rotation: Rotation
    write: Write
    third: Callable[[Rotation], Array]
    arguments: dict[str, Any] = field(default_factory=dict)
    refused: str = ""


def wheel(teeth: int, missing: int = 0) -> Callable[[Rotation], Array]:
    return lambda of: of.wheel(teeth, missing)


def noise(rpm: float) -> Callable[[Rotation], Array]:
    return lambda of: of.noisy(rpm)


def pulses(count: int, **others: Any) -> dict[str, Any]:
    return {"tacho": "trigger (V)", "pulses_per_turn": count, **others}


def once_missing(of: Rotation) -> Array:
    found = of.wheel(60)
    found[(of.turns > 20.0) & (of.turns < 20.0 + 1.0 / 60.0)] = 0.0
    return found


def up_and_down(of: Rotation) -> Array:
    return np.asarray(of.noisy(1.0) - of.rpm) + np.interp(of.time, [0.0, 0.5 * of.seconds, of.seconds], [300.0, 900.0, 300.0])


FILES = [
    File("noise of 0.1 rpm.csv", FAST, csv(SPEED), noise(0.1)),
    File("noise of 3 rpm.csv", UP, csv(SPEED), noise(3.0)),
    File("run-down.csv", DOWN, csv("Zeit [s];Weg [mm];Drehzahl [1/min]", ";", ","), noise(1.0), {"signal": "Weg"}),
    File("constant.csv", STEADY, csv(SPEED), noise(3.0)),
    File("from rest.csv", Rotation(1000, 0, 600), csv(SPEED), noise(1.0)),
    File("36 teeth.csv", Rotation(5000, 300, 600), csv(TACHO), wheel(36), pulses(36)),
    File("60 teeth.csv", SLOW, csv(TACHO), wheel(60), pulses(60, signal="probe")),
    File("120 teeth, run-down.csv", Rotation(10000, 900, 300, 4.0), csv(TACHO), wheel(120), pulses(120)),
    File("36-1 by its teeth.csv", WIDE, csv(TACHO), wheel(36, 1), pulses(36)),
    File("36-1 by its pulses.csv", WIDE, csv(TACHO), wheel(36, 1), pulses(35)),
    File("60-2 by its teeth.csv", WIDE, csv(TACHO), wheel(60, 2), pulses(60)),
    File("60-2 by its pulses.csv", WIDE, csv(TACHO), wheel(60, 2), pulses(58)),
    File("60-2 at few samples.csv", SLOW, csv(TACHO), wheel(60, 2), pulses(60)),
    File("20-1 at few samples.csv", FAST, csv(TACHO), wheel(20, 1), pulses(20)),
    File("stars.txt", UP, csv("* Logger 3, 2 channels; mean\n*\nt_s\tprobe [mm]\trpm", "\t"), noise(1.0)),
    File("semicolons.csv", UP, csv("; Logger, saw 4\n; 12 March\ntime_s,probe_mm,rpm"), noise(1.0)),
    File("percent.dat", UP, csv("% Logger; saw 4\n% time_s probe_mm rpm", " "), noise(1.0)),
    File("utf-16.txt", UP, csv("Zeit\tWeg\tDrehzahl\ns\tmm\t1/min", "\t", ",", "utf-16"), noise(1.0)),
    File("utf-16 without a mark.csv", UP, csv("t_s;probe_mm;rpm", ";", ",", "utf-16-be"), noise(1.0)),
    File("latin-1.csv", UP, csv("Zeit in s;Weg (µm);U/min", ";", ",", "latin-1"), noise(1.0)),
    File("sep and BOM.csv", UP, csv("sep=;\ntime_s;probe_mm;rpm", ";", ",", "utf-8-sig"), noise(1.0)),
    File("sheet.xlsx", Rotation(500, 300, 900), xlsx, noise(1.0)),
    File("labview.tdms", UP, tdms, noise(1.0)),
    File("matlab.mat", UP, mat, noise(1.0)),
    File("matlab 7.3.mat", UP, mat_73, noise(1.0), {}, "save it by save.'record.mat', ..., '-v7'."),
    File("120 teeth too fast.csv", FAST, csv(TACHO), wheel(120), pulses(120), "record it at a higher rate"),
    File("36-1 as another.csv", WIDE, csv(TACHO), wheel(36, 1), pulses(1), "must be 35, or 36 with .*give 36"),
    File("missing once.csv", SLOW, csv(TACHO), once_missing, pulses(60), "none is missing and none is added"),
    File("up and down.csv", UP, csv(SPEED), up_and_down, {}, r"rising or falling .* 90. rpm; .*between\(0, 4"),
    File("pulses.csv", SLOW, csv(TACHO), wheel(60), {}, "give rpm=0 .*tacho='trigger'"),
    File("two speeds.csv", UP, csv("t_s,motor [rpm],saw (rpm)"), noise(1.0), {}, r"motor \(rpm\), saw \(rpm\)"),
    File("other channel.csv", UP, csv(SPEED), noise(1.0), {"signal": "mic"}, r"it has 0 \(probe \(mm\)\), 1 \(n \(1/min\)\)"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "said"),
    [("a.xlsx", "no spreadsheet .*save it as"), ("a.tdms", "no channels of LabVIEW"), ("a.mat", "no MAT file .*as CSV")],
)
def test_a_text_with_the_ending_of_another_format_is_refused(tmp_path: Path, name: str, said: str) -> None:
    (tmp_path / name).write_text("time_s,probe\n0,1\n1,2\n")
    with pytest.raises(sf.InputError, match=said):
        sf.read_record(tmp_path / name, rpm=0)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_a_file_is_read_or_refused_with_the_cure(tmp_path: Path, file: File) -> None:
    path, rotation = tmp_path / file.name, file.rotation
    file.write(path, [rotation.time, rotation.probe, file.third(rotation)])
    if file.refused:
        with pytest.raises(sf.InputError, match=file.refused):
            sf.read_record(path, **file.arguments).waterfall()
        return
    record = sf.read_record(path, **file.arguments)
    assert abs(record.rate_hz / rotation.rate_hz - 1.0) < 1e-3
    if rotation.begin_rpm == rotation.end_rpm:
        spectrum = record.spectrum(to_hz=200)
        assert spectrum.rpm == pytest.approx(rotation.begin_rpm, abs=0.5)
        return
    spectra = record.waterfall(to_hz=200)
    assert len(spectra.rpm) > 5
    # Each window has the mean speed of its samples, that of its middle, at even times.
    ends = sorted([rotation.begin_rpm, rotation.end_rpm])
    assert ends[0] < spectra.rpm[0] < spectra.rpm[-1] < ends[1]
    # The last windows may end before the record does.
    assert spectra.rpm.mean() == pytest.approx(sum(ends) / 2, abs=0.6 * np.diff(spectra.rpm).mean())
    assert np.diff(spectra.rpm) == pytest.approx(np.diff(spectra.rpm).mean(), rel=0.1, abs=0.5)
    middle = len(record.rpm) // 2
    half = len(record.rpm) // 20
    assert record.rpm[middle - half : middle + half].mean() == pytest.approx(sum(ends) / 2, rel=3e-3)
    peaks = spectra.peaks()
    free = peaks.frequency_hz[np.isnan(peaks.order)]
    assert np.median(np.abs(free - TONE_HZ)) < 0.1
