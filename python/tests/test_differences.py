"""Whether two fitted saws differ in a number."""

from __future__ import annotations

import json

import numpy as np
import pytest

import sawflutter as sf

STRAIN = "membrane.roll_tension[0].eigenstrain"


@pytest.fixture(scope="module")
def blade(draft: sf.Scene) -> sf.Scene:
    band = {"radius_m": 0.22, "width_m": 0.02, "eigenstrain": 2e-4}
    return draft.replace({"guides": [], "cut": None, "membrane": {"roll_tension": [band]}})


def fitted(blade: sf.Scene, strain: float, noise: np.random.Generator) -> sf.FitResults:
    hz = blade.replace({STRAIN: strain}).modes([0.0]).frequency_hz[0, :10]
    read = np.sort(hz * (1.0 + 3e-3 * noise.standard_normal(len(hz))))
    return blade.fit(read, free={STRAIN: (0.0, 8e-4)}, starts=1)


def test_the_interval_of_a_difference_covers_the_truth_as_often_as_it_says(blade: sf.Scene) -> None:
    noise = np.random.default_rng(20241122)
    count = 12
    pairs = [(fitted(blade, 2e-4, noise), fitted(blade, 2.6e-4, noise)) for _ in range(count)]
    found = [first.differs_from(second, STRAIN) for first, second in pairs]
    covered = sum(of.interval_from <= -6e-5 <= of.interval_to for of in found)
    # Three standard deviations of such a count, around 11 of 12.
    assert covered >= count * 0.95 - 3.0 * np.sqrt(count * 0.95 * 0.05)
    # Equal blades are found to differ less than once in 12.
    equal = [first.differs_from(other, STRAIN) for (first, _), (other, _) in zip(pairs, pairs[1:])]
    assert sum(of.differs for of in equal) <= 3


def test_a_difference_is_shown_by_intervals_that_overlap(blade: sf.Scene) -> None:
    """Intervals of 3 and 4 about values 6 apart overlap; that of the difference is 5 wide."""
    report = fitted(blade, 2e-4, np.random.default_rng(1))

    def moved(value: float, half: float) -> sf.FitResults:
        data = json.loads(report.to_json())
        number = data["parameters"][0]
        number["value"], number["interval_from"], number["interval_to"] = value, value - half, value + half
        return sf.FitResults._from_json(json.dumps(data))

    first, second = moved(6e-5, 3e-5), moved(0.0, 4e-5)
    found = first.differs_from(second, STRAIN)
    assert (found.difference, found.interval_from, found.interval_to) == pytest.approx((6e-5, 1e-5, 1.1e-4))
    assert found.differs and str(found).startswith(f"{STRAIN} differs: +6e-05 (95 % interval 1e-05")
    assert not moved(4e-5, 3e-5).differs_from(second, STRAIN).differs


def test_numbers_without_an_interval_are_not_compared(blade: sf.Scene) -> None:
    first = fitted(blade, 2e-4, np.random.default_rng(1))
    with pytest.raises(sf.ArgumentError, match="a number of both fits .*free it in both"):
        first.differs_from(first, "blade.thickness_m")
    hz = blade.modes([0.0]).frequency_hz[0, :10]
    at_bound = blade.fit(hz.tolist(), free={STRAIN: (0.0, 1e-4)}, starts=1)
    with pytest.raises(sf.ArgumentError, match="at its bound in a fit"):
        first.differs_from(at_bound, STRAIN)
    other = blade.fit(hz.round(1).tolist(), free={STRAIN: (0.0, 8e-4)}, starts=1, confidence=0.9)
    with pytest.raises(sf.ArgumentError, match="same confidence"):
        first.differs_from(other, STRAIN)
