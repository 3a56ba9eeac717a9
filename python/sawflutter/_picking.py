"""Peaks of a spectrum."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ._entry import FloatArray
from ._extras import extra
from ._values import Number, number

# Peaks that are weaker than the largest one by more decibels may be leakage, and are not reported.
_RANGE_DB = 60.0
# Peaks within this distance of a multiple of the speed, in widths of a peak, are shifted by its line.
_NEAR = 2.0
# The floor is the median over this number of widths of a peak, or over this share of the spectrum.
_FLOOR_WIDTHS, _FLOOR_SHARE = 20.0, 0.1


def lowest_hz(resolution_hz: float) -> float:
    """The frequency below which the static deflection covers the spectrum."""
    return 2.0 * resolution_hz


def peak_rows(
    frequency_hz: FloatArray,
    spectra: Iterable[tuple[float, FloatArray]],
    resolution_hz: float,
    orders: Iterable[Number],
    above_db: Number,
) -> list[tuple[float, float, float, float, int]]:
    """Speed, frequency, amplitude, order and number of the spectrum of each peak. The order is the
    multiple of the speed that is so near that it is, or shifts, the peak; NaN if none is."""
    multiples = np.array([number("orders", order) for order in orders])
    found = list[tuple[float, float, float, float, int]]()
    for place, (rpm, amplitude) in enumerate(spectra):
        for hz, size in zip(*_picked(frequency_hz, amplitude, resolution_hz, number("above_db", above_db))):
            near = np.abs(multiples * rpm / 60.0 - hz) <= _NEAR * resolution_hz
            order = float(multiples[near][0]) if rpm > 0.0 and near.any() else np.nan
            found.append((float(rpm), float(hz), float(size), order, place))
    return found


def _picked(
    frequency_hz: FloatArray, amplitude: FloatArray, resolution_hz: float, above_db: float
) -> tuple[FloatArray, FloatArray]:
    """Frequencies and amplitudes of the peaks that exceed the median of their surroundings by so
    many decibels. A parabola through three levels gives the frequency between the lines."""
    with extra("records"):
        from scipy.ndimage import median_filter
        from scipy.signal import find_peaks

    clear = frequency_hz >= lowest_hz(resolution_hz)
    largest = float(amplitude[clear].max(initial=0.0))
    if largest == 0.0:
        return np.empty(0), np.empty(0)
    levels = 20.0 * np.log10(np.maximum(amplitude / largest, 1e-15))
    step = float(frequency_hz[1] - frequency_hz[0])
    width = max(_FLOOR_WIDTHS * resolution_hz, _FLOOR_SHARE * float(np.ptp(frequency_hz)))
    floor = median_filter(levels, size=max(3, round(width / step)), mode="nearest")
    least = np.maximum(floor + above_db, -_RANGE_DB)
    places, _ = find_peaks(levels, height=least, prominence=0.5 * above_db)
    left, middle, right = (levels[places + off] for off in (-1, 0, 1))
    bend = left - 2.0 * middle + right
    shift = np.where(bend < 0.0, 0.5 * (left - right) / np.where(bend < 0.0, bend, -1.0), 0.0)
    top = middle - 0.25 * (left - right) * shift
    found = frequency_hz[places] + shift * step
    clear = found >= lowest_hz(resolution_hz)
    return found[clear], (largest * 10.0 ** (top / 20.0))[clear]
