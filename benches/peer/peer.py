"""The same matrices by SciPy and LAPACK, and the ratios: called by run.sh.

usage: peer.py RUST.json MATRICES_DIR...   (OPENBLAS_NUM_THREADS=1)
"""

import json
import math
import pathlib
import sys
import time

import numpy as np
import scipy
import scipy.linalg

SWEEP = 201
SAMPLED = 11  # speeds timed of the sweep; each costs the same
REPEATS = 5


def companion(folder, speed):
    """(q, q'/s) of q'' + 2 speed G q' + (K + speed^2 S) q = 0, in units of s."""
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
    chart, sweep = rust["chart_s"], rust["sweep_201_at_264_s"]
    print(f"\nerror of the six lowest modes of the sweep at 264 functions: {error:.1e}")
    print("\nratio                                              reached   target")
    ratio = lambda what, value, target: print(f"{what:50} {value:8.2f}   {target}")
    ratio("chart at 1e-3, one thread / one eigvals of 528", chart["one_thread"] / once[264], "<= 1")
    ratio("chart at 1e-3, two threads / one eigvals of 528", chart["two_threads"] / once[264], "<= 1")
    ratio("SciPy sweep / ours, 264 functions, one thread", SWEEP * once[264] / sweep["one_thread"], ">= 100")
    ratio("SciPy sweep / ours, 264 functions, two threads", SWEEP * once[264] / sweep["two_threads"], ">= 100")
    sizes = [(row["functions"], row["seconds"]) for row in rust["chart_by_functions"]]
    (n0, t0), (n1, t1) = sizes[0], sizes[-1]
    ratio(f"exponent of time from {n0} to {n1} functions", math.log(t1 / t0) / math.log(n1 / n0), "< 1.5")
    ratio("chart, one thread / two threads", chart["one_thread"] / chart["two_threads"], ">= 1.7")
    print("\nours: " + ", ".join(f"{n} functions {1e3 * t:.0f} ms" for n, t in sizes) + " (chart, one thread)")
    print(f"ours: chart at 1e-3 {1e3 * chart['one_thread']:.0f} ms, sweep {1e3 * sweep['one_thread']:.0f} ms (one thread)")


def worst_error(folder, rust, speeds, sampled):
    """Largest relative difference of the low frequencies, in units of the sixth at rest."""
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
