"""Measures SciPy and LAPACK on the exported matrices and prints the ratios of run times; called by run.sh.

usage: peer.py RUST.json MATRICES_DIR...   (OPENBLAS_NUM_THREADS=1)
"""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
import scipy
import scipy.linalg

SWEEP = 201
SAMPLED = 11  # Number of speeds of the sweep at which errors are computed.
REPEATS = 5


def companion(folder, speed):
    """Companion matrix, divided by s, of the state (q, q'/s) of q'' + 2 speed G q' + (K + speed^2 S) q = 0; and s."""
    stiffness, spin, gyroscopic = (
        np.load(folder / f"{name}.npy") for name in ("stiffness", "spin", "gyroscopic")
    )
    k = stiffness + speed**2 * spin
    scale = 2.0 ** round(math.log2(math.sqrt(np.linalg.norm(k) / math.sqrt(len(k)))))
    zero, one = np.zeros_like(k), np.eye(len(k))
    return np.block([[zero, one], [-k / scale**2, -2 * speed * gyroscopic / scale]]), scale


def fastest(work, repeats=REPEATS):
    def once():
        start = time.perf_counter()
        work()
        return time.perf_counter() - start

    return min(once() for _ in range(repeats))


def main():
    rust = json.loads(pathlib.Path(sys.argv[1]).read_text())
    speeds = np.linspace(0.0, 3000.0 * math.pi / 30.0, SWEEP)
    sampled = np.linspace(0, SWEEP - 1, SAMPLED).astype(int)
    print(f"numpy {np.__version__}, scipy {scipy.__version__}; minima over repeats\n")
    print("functions   one eigvals   201 speeds (from a sample)")
    once = {}
    for folder in map(pathlib.Path, sys.argv[2:]):
        size = len(np.load(folder / "stiffness.npy"))
        matrix, _ = companion(folder, speeds[100])
        once[size] = fastest(lambda: scipy.linalg.eigvals(matrix))
        print(f"{size:9}   {1e3 * once[size]:8.1f} ms   {SWEEP * once[size]:8.2f} s")
        if size == 264:
            error = worst_error(folder, rust, speeds, sampled)
    print(f"\nerror of the six lowest modes of the sweep at 264 functions: {error:.1e}")
    table(rust, once[264], whole_process(rust["repeats"]))
    scenes(rust["scenes_s"], once[264])


def whole_process(repeats, *arguments):
    """Seconds of `sawflutter analyze` with every picture, on one thread."""
    program = os.environ.get("SAWFLUTTER")
    if not program:
        return None
    environment = dict(os.environ, RAYON_NUM_THREADS="1")
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "analyze", *arguments, "--out", folder]
        run = lambda: subprocess.run(command, env=environment, check=True, stdout=subprocess.DEVNULL)
        return fastest(run, repeats)


# Budget of the whole process for each scene in eigvals of order 528, at design and at draft.
BUDGET = {
    "free-blade": (0.5, 0.33),
    "collar-400mm": (0.5, 0.33),
    "paper": (1.2, 0.8),
    "two-pads": (1.5, 1.0),
    "gallery/six-pads": (15, 4),
    "gallery/damped-pad": (2, 1.3),
    "gallery/damped-material": (2, 1.3),
    "gallery/in-cut-wood": (2.5, 1.7),
}


def scenes(stages_s, eigvals):
    """Prints the run time of eight scenes, and of their stages, as ratios to one eigvals of order 528."""
    stages = list(next(iter(stages_s.values())))
    print(f"\n{'whole process, one thread':26} design (budget)   draft (budget)   " + "   ".join(stages))
    for name, (design, draft) in BUDGET.items():
        path = f"scenes/{name}.json"
        wholes = [whole_process(2, path, "--accuracy", accuracy) for accuracy in ("design", "draft")]
        cells = [
            f"{'-' if whole is None else format(whole / eigvals, '.3g'):>6} ({budget:4})"
            for whole, budget in zip(wholes, (design, draft))
        ]
        parts = [f"{stages_s[name][stage] / eigvals:{len(stage)}.2f}" for stage in stages]
        print(f"{name:26} {cells[0]:>15}   {cells[1]:>14}   " + "   ".join(parts))


def table(rust, eigvals, whole):
    """Prints the measurements, as ratios to one eigvals of order 528 unless a unit is named."""
    chart, sweep = rust["chart_s"], rust["sweep_201_at_264_s"]
    sizes = [(row["functions"], row["seconds"]) for row in rust["chart_by_functions"]]
    (n0, t0), (n1, t1) = sizes[0], sizes[-1]
    rows = [
        ("chart at 1e-3, one thread", chart["one_thread"] / eigvals, "<= 0.5"),
        ("sketch of a draft for the live page", rust["sketch_s"] / eigvals, "<= 0.15"),
        ("chart at 1e-4", rust["reference_s"] / eigvals, "<= 0.8"),
        ("chart at 1e-6 or the finest basis there is", rust["finest_s"] / eigvals, "<= 3"),
        ("whole process with every picture", whole and whole / eigvals, "<= 1"),
        (f"exponent of time from {n0} to {n1} functions", math.log(t1 / t0) / math.log(n1 / n0), "< 1.1"),
        ("chart, one thread / two threads", chart["one_thread"] / chart["two_threads"], ">= 1.8"),
        ("SciPy sweep / sawflutter, 264 functions, one thread", SWEEP * eigvals / sweep["one_thread"], ">= 300"),
        ("SciPy sweep / sawflutter, 264 functions, two threads", SWEEP * eigvals / sweep["two_threads"], ">= 300"),
        ("sweep to 6000 rpm, s", rust["to_6000_rpm_s"], "<= 1"),
        ("saws of a study at 6e-3, 1/s", 1 / rust["study_saw_s"], ">= 60"),
        ("saws of a placement, first basis, 1/s", 1 / rust["place_saw_s"], ""),
        ("placement with defaults, s (PLACE=1)", rust["place_s"], "<= 8"),
        ("peak memory of all of this, MB", rust["peak_memory_mb"], ""),
    ]
    print(f"\n{'relative to one eigvals of order 528':54}  reached   target")
    for name, value, target in rows:
        print(f"{name:54} {'-' if value is None else format(value, '.3g'):>8}   {target}")
    profile(rust["stages_s"])
    print("\nchart, one thread: " + ", ".join(f"{n} functions {1e3 * t:.0f} ms" for n, t in sizes))
    print(f"chart at 1e-3 {1e3 * chart['one_thread']:.0f} ms, sweep {1e3 * sweep['one_thread']:.0f} ms (one thread)")


def profile(stages_s):
    """Prints the run time of each stage."""
    names = list(next(iter(stages_s.values())))
    print("\n" + " " * 30 + "".join(f"{what:>20}" for what in stages_s))
    for name in names:
        cells = [stages[name] for stages in stages_s.values()]
        wholes = [sum(stages.values()) for stages in stages_s.values()]
        shares = [f"{1e3 * t:.0f} ms, {100 * t / all:.0f} %" for t, all in zip(cells, wholes)]
        print(f"{name:30}" + "".join(f"{share:>20}" for share in shares))


def worst_error(folder, rust, speeds, sampled):
    """Largest relative difference of the low frequencies at the sampled speeds, except at rest."""
    worst = 0.0
    for index in sampled[1:]:
        matrix, scale = companion(folder, speeds[index])
        values = scipy.linalg.eigvals(matrix) * scale
        exact = np.sort(values[(values.imag > 1e-6 * scale)].imag)
        for frequency in rust["low_frequencies_rad_per_s"][index]:
            if frequency > 1e-3 * scale:
                worst = max(worst, np.min(np.abs(exact - frequency)) / frequency)
    return worst


main()
