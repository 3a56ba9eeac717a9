"""Saws a second on many workers, by a model from what one machine measures, as a figure.

    python docs/cluster/scaling.py docs/cluster/throughput.json docs/cluster/scaling.svg

`throughput.json` is written by tests/cluster/throughput.py. A saw takes t seconds on a worker; a
task is n saws worth half a minute, t n = 30 s. Three rates bound a study on W workers:

    workers     W / (t + a / n)       a: cost of a task beside its saws (there, back, taken up)
    scheduler   n / a                 where tasks are handed out one at a time, as dear as all of a
    client      1 / (1/r + a / n)     r: rows a second that the client checks and writes

a is the time of one task after the other, of which a scheduler with many workers does most things
at the same time: the two last rates are lower bounds. Not in the model: a network slower than the
rows (100 bytes a saw), workers of different speed, and the end of a study, where the last tasks
are short and some workers wait for others, at most half a minute.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("svg")
import matplotlib.pyplot as plt

TASK = 30.0
# Seconds a saw: the measured one; the guided saw of the sample study, 3 minutes of processor time for
# a thousand; and one of a second.
SAWS = (("free blade, draft", None), ("guided saw", 0.18), ("any saw", 1.0))
SHOWN = (64, 1024)


def rates(workers: np.ndarray, saw: float, found: dict[str, float]) -> dict[str, np.ndarray]:
    """The three bounds, in saws a second."""
    task, rows = found["seconds_a_task"], found["rows_per_second"]
    size = max(1.0, TASK / saw)
    return {
        "workers": workers / (saw + task / size),
        "scheduler": np.full(workers.shape, size / task),
        "client": np.full(workers.shape, 1.0 / (1.0 / rows + task / size)),
    }


def main(measured: str, out: str) -> None:
    found = json.loads(Path(measured).read_text())
    workers = np.geomspace(1, 1e5, 300)
    figure, axes = plt.subplots(figsize=(7.5, 4.6), layout="constrained")
    for name, saw in SAWS:
        saw = saw or found["runs"][0]["seconds_a_saw"]
        bounds = rates(workers, saw, found)
        (line,) = axes.loglog(
            workers, np.min(list(bounds.values()), axis=0), label=f"{name}, {saw:.3g} s"
        )
        axes.loglog(workers, bounds["workers"], ":", lw=0.8, color=line.get_color())
        for count in SHOWN:
            at = {key: rate[0] for key, rate in rates(np.array([count]), saw, found).items()}
            first = min(at, key=lambda key: at[key])
            second = min((key for key in at if key != first), key=lambda key: at[key])
            print(
                f"{name}, {saw:.3g} s a saw, {count} workers: {at[first]:.0f} saws/s, bounded by the "
                f"{first}; the {second} would bound at {at[second]:.0f}; 1e6 saws in "
                f"{1e6 / at[first] / 3600:.2f} h"
            )
    for run in found["runs"]:
        axes.plot(run["workers"], run["saws_per_second"], "ko", ms=4)
    for count in SHOWN:
        axes.axvline(count, color="0.8", lw=0.8, zorder=0)
    axes.set(
        xlabel="workers", ylabel="saws a second", title="Saws a second, by model; dots: measured"
    )
    axes.legend(frameon=False)
    figure.savefig(out, metadata={"Date": None})


if __name__ == "__main__":
    main(*sys.argv[1:])
