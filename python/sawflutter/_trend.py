"""The course of a measured speed, which has noise."""

from __future__ import annotations

import numpy as np

from ._entry import FloatArray

# Parts of a record whose mean speeds are its trend.
_PARTS = 20


def trend(rpm: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Places in a record as shares of it, and the speeds there: means of a twentieth of the record each, at
    their middles, and the ends that follow from these."""
    parts = min(_PARTS, max(1, len(rpm) // 2))
    edges = np.linspace(0, len(rpm), parts + 1).round().astype(int)
    sums = np.add.reduceat(rpm, edges[:-1])
    means = np.asarray(sums / np.diff(edges))
    middles = 0.5 * (edges[1:] + edges[:-1] - 1) / max(1, len(rpm) - 1)
    if parts == 1:
        return np.array([0.0, 1.0]), np.asarray(rpm[[0, -1]])
    slopes = np.diff(means)[[0, -1]] / np.diff(middles)[[0, -1]]
    first, last = means[[0, -1]] + slopes * [-middles[0], 1.0 - middles[-1]]
    ends = np.clip([first, last], rpm.min(), rpm.max())
    return np.concatenate([[0.0], middles, [1.0]]), np.concatenate([ends[:1], means, ends[1:]])


def is_steady(rpm: FloatArray) -> bool:
    """Whether a speed is constant."""
    _, course = trend(rpm)
    return bool(np.ptp(course) <= max(5.0, 0.01 * rpm.mean()))


def longest_part(rpm: FloatArray, duration_s: float) -> tuple[float, float]:
    """Times between which the trend goes from its smallest to its largest value, or back."""
    shares, course = trend(rpm)
    begin, end = sorted(shares[[course.argmin(), course.argmax()]] * duration_s)
    return float(begin), float(end)
