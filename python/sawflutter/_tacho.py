"""Rotation speed from the pulses of a tachometer."""

from __future__ import annotations

import numpy as np

from ._channels import refused
from ._entry import FloatArray

# A pulse begins above the upper share of the range of the signal, after it was below the lower one.
_LOWER, _MIDDLE, _UPPER = 0.4, 0.5, 0.6


def speed_of_pulses(samples: FloatArray, rate_hz: float, pulses_per_turn: int) -> FloatArray:
    """The speed in rpm at each sample. Each turn gives its mean speed, at its middle; between these
    the speed is interpolated, and before the first and after the last one it is constant."""
    if pulses_per_turn < 1:
        remedy = "give the number of marks or slots of the tachometer"
        raise refused("pulses_per_turn", pulses_per_turn, "at least 1", remedy)
    low, high = float(samples.min()), float(samples.max())
    lower, middle, upper = (low + share * (high - low) for share in (_LOWER, _MIDDLE, _UPPER))
    # Levels that are neither high nor low keep the last state.
    state = np.where(samples >= upper, 1, np.where(samples <= lower, 0, -1))
    known = np.maximum.accumulate(np.where(state >= 0, np.arange(len(state)), 0))
    is_high = state[known] == 1
    begun = np.flatnonzero(is_high[1:] & ~is_high[:-1]) + 1
    if len(begun) <= pulses_per_turn:
        allowed = f"a channel with more pulses than those of one turn, {pulses_per_turn}"
        remedy = "give the channel of the pulses, or the speed as rpm"
        raise refused("tacho", f"{len(begun)} pulses", allowed, remedy)
    before, after = samples[begun - 1], samples[begun]
    share = np.clip((middle - before) / np.where(after > before, after - before, 1.0), 0.0, 1.0)
    times = (begun - 1 + share) / rate_hz
    turns = times[pulses_per_turn:] - times[:-pulses_per_turn]
    middles = 0.5 * (times[pulses_per_turn:] + times[:-pulses_per_turn])
    return np.asarray(np.interp(np.arange(len(samples)) / rate_hz, middles, 60.0 / turns))
