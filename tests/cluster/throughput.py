"""Measures a study on one and on two workers of this machine, the cost of a task, and the rate at
which a client writes rows.

    python tests/cluster/throughput.py OUT.json

The numbers are those of `docs/cluster/scaling.py`. Times are wall times: what else runs on the
machine makes them longer.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
import time
from pathlib import Path

import sawflutter as sf
from distributed import Client, LocalCluster
from sawflutter import _native, _tasks

SAWS = 3000
# Rows of one call, as many as in a task of half a minute.
ROWS, TASKS = 5000, 20


def study(saws: int) -> sf.Study:
    free = sf.Scene.paper().replace({"accuracy": "draft", "guides": []})
    even = {"kind": "tolerance", "plus_minus": 5e-5}
    thickness = {"path": "blade.thickness_m", "distribution": even}
    return sf.Study(free, {"name": "Thickness", "saws": saws, "parameters": [thickness]})


def on_workers(workers: int) -> dict[str, float]:
    """Time of a study from its first task to its last row."""
    one = study(SAWS)
    with (
        LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        text = _tasks.Text(one.scene.to_json(), one._text)
        log = one._native.log(tempfile.mkdtemp())
        run = _tasks.Run(one._native, log, _tasks.place(client, text))
        begun = time.perf_counter()
        run()
        seconds = time.perf_counter() - begun
        log.close()
    return {
        "workers": workers,
        "seconds": seconds,
        "saws_per_second": SAWS / seconds,
        "seconds_a_saw": run.seconds / SAWS,
        "tasks": run.tasks,
    }


def cost_of_a_task() -> float:
    """Time of tasks of one saw, run one after the other without a pause, less that of the saw
    itself."""
    one = study(SAWS)
    text = _tasks.Text(one.scene.to_json(), one._text)
    with (
        LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        place = _tasks.place(client, text)
        place.submit((0, 1)).result()
        begun, inside, tasks = time.perf_counter(), 0.0, 200
        for saw in range(tasks):
            inside += _tasks.Rows(*place.submit((saw, saw + 1)).result()).seconds
        return (time.perf_counter() - begun - inside) / tasks


def row(index: int, value: float) -> str:
    """A synthetic saw."""
    critical = 5.3e5 * value
    return f"{index},{value!r},analysed,{critical!r},,{1.5 * critical!r},,85,0.001,0,\n"


def rows_per_second() -> float:
    """The rate at which a client checks and writes rows."""
    one = study(ROWS * TASKS)
    log = one._native.log(tempfile.mkdtemp())
    seconds = 0.0
    for task in range(TASKS):
        saws = range(task * ROWS, (task + 1) * ROWS)
        rows = "".join(row(saw, one._native.values(saw)[0]) for saw in saws).encode()
        begun = time.perf_counter()
        assert log.append(rows) == ROWS
        seconds += time.perf_counter() - begun
    return ROWS * TASKS / seconds


def main(out: str) -> None:
    found = {
        "processor": _native.processor(),
        "cores": os.cpu_count(),
        "load": os.getloadavg()[0],
        "runs": [on_workers(workers) for workers in (1, 2)],
        "seconds_a_task": cost_of_a_task(),
        "rows_per_second": rows_per_second(),
    }
    Path(out).write_text(json.dumps(found, indent=2) + "\n")
    print(Path(out).read_text())


if __name__ == "__main__":
    main(*sys.argv[1:])
