"""A hundred thousand saws in little memory, a million if SAWFLUTTER_TRIALS is set: synthetic rows,
summarized by the program."""

from __future__ import annotations

import json
import os
import random
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import sawflutter as sf

SAWS, MOST_KB = (1_000_000, 500_000) if "SAWFLUTTER_TRIALS" in os.environ else (100_000, 150_000)
# Rows of a task, and number of simultaneous tasks.
ROWS, WINDOW = 5000, 64
MERGE = """
import resource, subprocess, sys
code = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL).returncode
# In kB on Linux.
print(code, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
"""


def critical_rpm(thickness: float) -> float:
    return 5.3e5 * thickness


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="memory is counted otherwise")
def test_many_saws_are_summed_up_in_little_memory(
    draft: sf.Scene, programs: list[str], tmp_path: Path
) -> None:
    even = {"kind": "tolerance", "plus_minus": 5e-5}
    limits = {"operating_rpm": 1250.0}
    thickness = {"path": "blade.thickness_m", "distribution": even}
    file = {"name": "Thickness", "saws": SAWS, "parameters": [thickness], "limits": limits}
    study = sf.Study(draft.replace({"guides": []}), file)
    runs = tmp_path / "runs"
    runs.mkdir()
    log = study._native.log(runs)
    exact = []
    draw = random.Random(1)
    for window in range(0, SAWS, ROWS * WINDOW):
        # Tasks end in any order.
        tasks = list(range(window, min(SAWS, window + ROWS * WINDOW), ROWS))
        for first in draw.sample(tasks, len(tasks)):
            lines = []
            for saw in range(first, first + ROWS):
                value = study._native.values(saw)[0]
                rpm = critical_rpm(value)
                kept = str(rpm >= 1250.0 / 0.85).lower()
                exact.append(rpm)
                # Stability, distance from critical speeds, margin, rim speed, static stiffness.
                keeps = f"true,true,{kept},true,true"
                numbers = f"{rpm!r},,,{kept},{keeps},85,0.001,0"
                lines.append(f"{saw},{value!r},analysed,{numbers},\n")
            assert log.append("".join(lines).encode()) == ROWS
    log.close()
    merge = [programs[0], "study", "merge", str(runs), "--out", str(tmp_path / "sum")]
    said = subprocess.run(
        [sys.executable, "-c", MERGE, *merge], check=True, capture_output=True, text=True
    )
    code, kilobytes = map(int, said.stdout.split())
    assert code == 0 and kilobytes < MOST_KB, kilobytes
    report = json.loads((tmp_path / "sum" / "study.json").read_text())
    speeds = np.array(exact)
    # Counts and quantiles are exact, although the rows do not all fit into memory.
    quantiles = report["all"]["first_critical"]["quantiles"]
    found = np.array([q["rpm"] for q in quantiles])
    shares = [q["share"] for q in quantiles]
    assert np.allclose(found, np.quantile(speeds, shares), rtol=1e-14, atol=0)
    assert report["all"]["passing"]["passed"] == np.count_nonzero(speeds >= 1250.0 / 0.85)
    assert sum(report["all"]["first_critical"]["histogram"]["counts"]) == SAWS
    import pandas as pd

    table = pd.read_parquet(tmp_path / "sum" / "study.parquet")
    assert np.array_equal(table["saw"], np.arange(SAWS))
    assert np.array_equal(np.sort(table["first_critical_rpm"]), np.sort(speeds))
    # The first rows, as two other libraries read them from both tables.
    polars, duckdb = pytest.importorskip("polars"), pytest.importorskip("duckdb")
    for name in ("study.parquet", "study.csv"):
        path = tmp_path / "sum" / name
        read = polars.read_parquet(path) if name.endswith("parquet") else polars.read_csv(path)
        assert read["first_critical_rpm"].to_list()[:9] == list(table["first_critical_rpm"][:9])
        (row,) = duckdb.sql(f"select count(*), max(first_critical_rpm) from '{path}'").fetchall()
        assert row == (SAWS, speeds.max())
