"""How often the intervals of a margin from measured peaks contain the truth, for simulated saws.

    python python/tools/margin_coverage.py FROM TO

simulates a saw for each number of the range, takes peaks of it, and prints how many of its true
numbers and speeds are within the intervals of 95 %. A saw takes a minute, with a smaller sampling than
usual.
"""

from __future__ import annotations

import sys
import warnings
from collections import Counter

import numpy as np

import sawflutter as sf
from sawflutter import margins

RADIUS, STIFFNESS = "guides[0].radius_m", "guides[0].stiffness_n_per_m"
TENSION = "membrane.roll_tension[0].eigenstrain"
FREE = {RADIUS: (0.15, 0.28), STIFFNESS: (3e6, 6e7), TENSION: (0.0, 2e-4)}
SPEEDS = np.linspace(100.0, 1200.0, 8)
# Frequencies that a probe may see, and the share that it sees.
LOWEST, SEEN = 6, 0.6
MODE_HZ, ORDER_HZ = 0.15, 0.1
STEPS = 80


def nominal() -> sf.Scene:
    band = {"radius_m": 0.22, "width_m": 0.02, "eigenstrain": 1e-4}
    changes = {"accuracy": "draft", "cut": None, "measured": None, "membrane": {"roll_tension": [band]}}
    return sf.Scene.paper().replace(changes)


def simulated(saw: sf.Scene, seed: int) -> tuple[sf.Scene, list[float], list[float], list[float]]:
    """A saw, its free numbers, and speeds and frequencies of peaks."""
    noise = np.random.default_rng(seed)
    share = noise.random(3) * 0.8 + 0.1
    numbers = [0.15 + 0.13 * share[0], 3e6 * 20.0 ** share[1], 2e-4 * share[2]]
    real = saw.replace(dict(zip(FREE, numbers)))
    rpm, hz = list[float](), list[float]()
    for speed, modes in zip(SPEEDS, real.modes(SPEEDS.tolist()).frequency_hz[:, :LOWEST]):
        seen = modes[noise.random(LOWEST) < SEEN]
        peaks = list(seen + MODE_HZ * noise.standard_normal(len(seen)))
        for order in (1, 2):
            if noise.random() < 0.7:
                peaks.append(order * speed / 60.0 + ORDER_HZ * noise.standard_normal())
        if noise.random() < 0.5:
            peaks.append(noise.uniform(3.0, 100.0))
        peaks = [float(one) for one in peaks if one > 0.5]
        rpm += [float(speed)] * len(peaks)
        hz += peaks
    return real, numbers, rpm, hz


def main(begin: int, end: int) -> None:
    margins._FIRST, margins._ANALYSED = 384, 48
    warnings.simplefilter("ignore", sf.ModelWarning)
    saw, counts = nominal(), Counter[str]()
    for seed in range(begin, end):
        real, numbers, rpm, hz = simulated(saw, seed)
        true, found = real.speeds(beside=saw), saw.measured_margin(rpm, hz, FREE, steps=STEPS, seed=seed)
        critical, flutter = (np.nan if of is None else of for of in (true.first_critical_rpm, true.flutter_rpm))
        truths = [*zip(FREE, numbers, found.numbers.T), ("critical speed", critical, found.critical_rpm)]
        for name, truth, values in [*truths, ("flutter speed", flutter, found.flutter_rpm)]:
            low, high = np.nanquantile(values, (0.025, 0.975))
            counts[name] += bool(low <= truth <= high)
        deciding = float(np.fmin(np.fmin(critical, flutter), found.to_rpm))
        counts["stated speed kept"] += found.at_most_rpm / found.margin <= deciding
        print(f"{seed + 1 - begin} saws: {', '.join(f'{name} {count}' for name, count in counts.items())}", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
