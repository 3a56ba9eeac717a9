"""Prints the tables of docs/explanation/after-flutter.md: which state a run-up with stretching ends in.

    SAWFLUTTER_PROGRAM=target/release/sawflutter python3 python/tools/after_flutter_study.py [ACCURACY [SECONDS]]

Each row changes one thing about the built-in saw: damping, the duration of the ramp, the side force, the pad. Ramps go
from 1400 to 2100 rpm in 10.5 s, the rate of 4000 rpm in 60 s, where a row does not say otherwise. Runs longer than SECONDS of computing are
stopped and said to be. A run takes half a minute to some minutes.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path
from statistics import mean, pstdev

SCENE = Path(__file__).parents[2] / "scenes/paper.json"
SPEEDS = (1400, 1500, 1600, 1800, 2000, 2400, 2700)
RAMP = {"runup.from_rpm": 1400.0, "runup.to_rpm": 2100.0, "runup.duration_s": 10.5}
LONG = {"runup.to_rpm": 2800.0, "runup.duration_s": 21.0}
MATERIAL, AIR = "damping.material_retardation_time_s", "damping.air_n_s_per_m3"
ROWS: list[tuple[str, dict[str, float]]] = [
    ("5 N at 0°, without damping", {}),
    ("0.001 N", {"side_force.force_n": 1e-3}),
    ("0.1 N", {"side_force.force_n": 0.1}),
    ("0.1 N, to 2800 rpm in 21 s", {"side_force.force_n": 0.1, **LONG}),
    ("20 N", {"side_force.force_n": 20.0}),
    ("air at rest 10 N s/m³", {AIR: 10.0}),
    ("air at rest 30 N s/m³", {AIR: 30.0}),
    ("air at rest 100 N s/m³", {AIR: 100.0}),
    ("material 1e-6 s", {MATERIAL: 1e-6}),
    ("material 1e-5 s", {MATERIAL: 1e-5}),
    ("material 1e-4 s", {MATERIAL: 1e-4}),
    ("material 1e-4 s, to 2800 rpm in 21 s", {MATERIAL: 1e-4, **LONG}),
    ("ramp in 2.6 s", {"runup.duration_s": 2.6}),
    ("ramp in 42 s", {"runup.duration_s": 42.0}),
    ("pad at 0.25 m", {"guides[0].radius_m": 0.25}),
    ("pad at −90°", {"guides[0].angle_deg": -90.0}),
]


def row(changes: dict[str, float], accuracy: str, seconds: float) -> str:
    """Mean deflection at the probe over 100 rpm from each speed on and the deviation about it, in
    mm."""
    program = os.environ.get("SAWFLUTTER_PROGRAM", "sawflutter")
    command = [program, "runup", str(SCENE), "--stretching", "--accuracy", accuracy, "--json"]
    for path, value in {**RAMP, **changes}.items():
        command += ["--set", f"{path}={value}"]
    begun = time.monotonic()
    try:
        ran = subprocess.run(command, capture_output=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return f"stopped after {seconds:.0f} s of computing |"
    if ran.returncode:
        return f"{ran.stderr.decode().strip()} |"
    report = json.loads(ran.stdout)
    record = list(zip(report["rpm"], report["deflection_m"]))
    cells = []
    for speed in SPEEDS:
        part = [1e3 * w for rpm, w in record if speed <= rpm < speed + 100]
        cells.append(f"{mean(part):.2f} ({pstdev(part):.2f})" if part else "–")
    end = report["stretching"]["valid_until_rpm"]
    cells.append("–" if end is None else f"{end:.0f}")
    cells.append(f"{time.monotonic() - begun:.0f}")
    return " | ".join(cells) + " |"


def main() -> None:
    """Prints the rows."""
    accuracy = sys.argv[1] if len(sys.argv) > 1 else "draft"
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 3600.0
    speeds = " | ".join(f"{speed} rpm" for speed in SPEEDS)
    print(f"| run-up | {speeds} | slopes past 0.1 from [rpm] | computing [s] |")
    print("|" + "---|" * (len(SPEEDS) + 3))
    for name, changes in ROWS:
        print(f"| {name} | {row(changes, accuracy, seconds)}", flush=True)


if __name__ == "__main__":
    main()
