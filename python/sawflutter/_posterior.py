"""Probability of saws that were measured as peaks over the speed, of which some are of no mode."""

from __future__ import annotations

import numpy as np

from ._entry import FloatArray
from ._reduced import BRANCHES, Reduced
from .errors import refused

# Largest number of speeds.
MOST_SPEEDS = 12
# Probabilities, before it is seen, that a peak is of a mode, at a multiple of the speed, or of nothing.
_OF_MODE, _OF_ORDER, _OF_NOTHING = 0.6, 0.2, 0.2
# Bounds of the standard deviation of the peaks in Hz; it is no smaller than the error of the small matrices.
_LEAST_HZ, _MOST_HZ = 0.02, 5.0
# From this ratio of the bounds on, the scale is logarithmic.
_DECADE = 10.0


class Measured:
    """Peaks at some speeds, and the logarithm of the probability of a saw."""

    def __init__(
        self, reduced: Reduced, bounds: list[tuple[str, float, float]], rpm: FloatArray, hz: FloatArray, orders: list[float]
    ) -> None:
        self._reduced, self._bounds, self._orders = reduced, bounds, np.array(orders)
        self.rpm = np.unique(rpm)
        if len(self.rpm) > MOST_SPEEDS:
            self.rpm = self.rpm[np.unique(np.linspace(0, len(self.rpm) - 1, MOST_SPEEDS).round().astype(int))]
        middle = self.numbers(np.full((1, len(bounds) + 1), 0.5))
        top_hz = float(reduced.frequencies_hz(middle, self.rpm)[0, :, -1].min())
        used = np.isin(rpm, self.rpm) & (hz < top_hz)
        if used.sum() <= len(bounds):
            allowed = f"more than {len(bounds)} below {top_hz:.0f} Hz, the highest frequency that is computed"
            raise refused("peak_hz", int(used.sum()), allowed, "measure more, or free fewer numbers")
        self.hz, self._top_hz = hz[used], top_hz
        self.speed = np.searchsorted(self.rpm, rpm[used])

    def numbers(self, places: FloatArray) -> FloatArray:
        """The free numbers at places from 0 to 1."""
        columns = []
        for (_, low, high), share in zip(self._bounds, places.T):
            is_logarithmic = low > 0.0 and high >= _DECADE * low
            columns.append(low * (high / low) ** share if is_logarithmic else low + share * (high - low))
        return np.stack(columns, axis=1)

    def deviation_hz(self, places: FloatArray) -> FloatArray:
        least = max(_LEAST_HZ, self._reduced.error_hz / 3.0)
        return np.asarray(least * (_MOST_HZ / least) ** places[:, -1])

    def logarithm(self, places: FloatArray) -> FloatArray:
        """The logarithm of the probability, a value for each row."""
        found = np.full(len(places), -np.inf)
        within = ((places >= 0.0) & (places <= 1.0)).all(axis=1)
        if within.any():
            parts = self._parts(places[within])
            found[within] = np.log(parts.sum(axis=2)).sum(axis=1)
        return found

    def most_likely(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The most likely mode of each peak, and its probability."""
        parts = self._parts(places)
        mean = (parts / parts.sum(axis=2, keepdims=True)).mean(axis=0)
        kinds = np.concatenate([[-1.0, 0.0], np.arange(1.0, BRANCHES + 1.0)])
        return kinds[mean.argmax(axis=1)], mean.max(axis=1)

    def _parts(self, places: FloatArray) -> FloatArray:
        """Densities of each peak: of nothing, at a multiple, of each frequency."""
        deviation = self.deviation_hz(places)[:, None, None]
        computed = self._reduced.frequencies_hz(self.numbers(places), self.rpm)[:, self.speed]
        lines = self._orders * self.rpm[self.speed, None] / 60.0

        def density(of: FloatArray) -> FloatArray:
            scaled = (self.hz[:, None] - of) / deviation
            return np.asarray(np.exp(-0.5 * scaled**2) / (np.sqrt(2.0 * np.pi) * deviation))

        nothing = np.full((len(places), len(self.hz), 1), _OF_NOTHING / self._top_hz)
        multiple = _OF_ORDER / max(1, len(self._orders)) * density(lines[None]).sum(axis=2, keepdims=True)
        return np.concatenate([nothing, multiple, _OF_MODE / BRANCHES * density(computed)], axis=2)


def most_telling(
    rpm: FloatArray, computed: FloatArray, deciding: FloatArray, deviation: float
) -> tuple[float, float, int, float]:
    """Speed, frequency and place of the mode whose measurement would take most of the variance of the
    deciding speed, if all were normal: the square of their correlation, times the share of the
    variance of the frequency that an error of the measurement leaves."""
    hz = np.where(np.isfinite(computed), computed, 0.0)
    off, of_deciding = hz - hz.mean(axis=0), deciding - deciding.mean()
    variance = (off**2).mean(axis=0)
    both = (off * of_deciding[:, None, None]).mean(axis=0)
    shares = both**2 / (variance + deviation**2) / max(float((of_deciding**2).mean()), 1e-12)
    speed, place = np.unravel_index(int(shares.argmax()), shares.shape)
    return float(rpm[speed]), float(np.median(hz[:, speed, place])), int(place) + 1, float(shares[speed, place])
