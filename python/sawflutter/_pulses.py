"""Pulses of a tachometer."""

from __future__ import annotations

import numpy as np

from ._entry import FloatArray, IntArray
from .errors import refused

# A pulse begins above the upper share of the range of the signal, after it was below the lower one.
_LOWER, _MIDDLE, _UPPER = 0.4, 0.5, 0.6
# Pulses are between these for at most a share of the time, a sine for 0.13 of it, and their range is at
# least a share of their largest value.
_BETWEEN, _RANGE = 0.04, 0.5
# A distance of pulses that is shorter or longer than these multiples of the median, and differs from it
# by more than some samples, has a pulse too many or too few.
_SHORTEST, _LONGEST, _ROUNDED = 0.6, 1.6, 1.6
# The distances around one with which it is compared; a long one is that of a missing tooth if most of the
# long ones are equally many pulses apart.
_AROUND, _MOST = 9, 0.6
# Fewest samples from pulse to pulse: with fewer than two, pulses are lost, and those that are left look like slower ones.
_FEWEST = 2.2


def jumps(samples: FloatArray) -> bool:
    """Whether a signal jumps between two levels several times, as no speed and no vibration does."""
    low, high = float(samples.min()), float(samples.max())
    is_wide = high - low >= _RANGE * max(abs(low), abs(high)) > 0.0
    between = (samples > _level(samples, _LOWER)) & (samples < _level(samples, _UPPER))
    return is_wide and bool(between.mean() <= _BETWEEN) and len(_begins(samples)) > 1


def speed_of(samples: FloatArray, rate_hz: float, pulses_per_turn: int) -> FloatArray:
    """The speed in rpm at each sample. Each turn gives its mean speed, at its middle; between these
    the speed is interpolated, and before the first and after the last one it is constant."""
    if pulses_per_turn < 1:
        remedy = "give the number of marks or slots of the tachometer"
        raise refused("pulses_per_turn", pulses_per_turn, "at least 1", remedy)
    begun = _begins(samples)
    if len(begun) <= pulses_per_turn:
        allowed = f"a channel with more pulses than those of one turn, {pulses_per_turn}"
        remedy = "give the channel of the pulses, or the speed as rpm"
        raise refused("tacho", f"{len(begun)} pulses", allowed, remedy)
    middle = _level(samples, _MIDDLE)
    before, after = samples[begun - 1], samples[begun]
    share = np.clip((middle - before) / np.where(after > before, after - before, 1.0), 0.0, 1.0)
    times = (begun - 1 + share) / rate_hz
    in_turn = _in_a_turn(np.diff(times), pulses_per_turn)
    _check_regular(times, in_turn, 1.0 / rate_hz)
    turns = times[in_turn:] - times[:-in_turn]
    closest = turns.min() * rate_hz / in_turn
    if closest < _FEWEST:
        given = f"pulses {closest:.2g} samples apart, at {rate_hz:g} samples per second"
        remedy = "record it at a higher rate, or with fewer marks, or give the speed as rpm"
        raise refused("tacho", given, f"a channel with at least {_FEWEST:g} samples from pulse to pulse", remedy)
    middles = 0.5 * (times[in_turn:] + times[:-in_turn])
    return np.asarray(np.interp(np.arange(len(samples)) / rate_hz, middles, 60.0 / turns))


def _in_a_turn(between: FloatArray, pulses_per_turn: int) -> int:
    """Number of pulses that come in a turn. A wheel with missing teeth has a long distance in every turn,
    and is described by its pulses, or by its teeth and the missing ones."""
    around = np.pad(between, _AROUND // 2, mode="reflect") if len(between) > _AROUND else between
    if around is between:
        return pulses_per_turn
    usual = np.median(np.lib.stride_tricks.sliding_window_view(around, _AROUND), axis=1)
    longer = between / usual
    gaps = np.flatnonzero(longer > _LONGEST)
    if len(gaps) == 1 and len(between) < 2 * pulses_per_turn:
        allowed = "a channel with two turns or more, because one distance of pulses is long, as that of a missing tooth"
        raise refused("tacho", f"{len(between) + 1} pulses", allowed, "record more turns, or give the speed as rpm")
    if len(gaps) < 2:
        return pulses_per_turn
    apart = np.diff(gaps)
    counts = np.bincount(apart)
    pulses = int(counts.argmax())
    if counts[pulses] < _MOST * len(apart):
        return pulses_per_turn
    teeth = pulses + round(float(np.median(longer[gaps]))) - 1
    for size in (pulses, teeth):
        # A wheel may have a gap several times in a turn.
        if pulses_per_turn % size == 0:
            return pulses_per_turn // size * pulses
    given = f"one distance of {pulses} is {longer[gaps].mean():.2g} times as long as the others"
    allowed = f"{pulses}, or {teeth} with the missing teeth, because {given} in every turn"
    raise refused("pulses_per_turn", pulses_per_turn, allowed, f"give {teeth}, or the speed as rpm")


def _check_regular(times: FloatArray, pulses_per_turn: int, step_s: float) -> None:
    """Refuses pulses whose distances do not repeat every turn: one is missing or added, once or in
    every turn. Marks may be unevenly spaced, so a distance is compared with the median of the distances
    of the same mark in the turns beside it."""
    between = np.diff(times)
    turns = len(between) // pulses_per_turn
    width = 5 if turns >= 5 else 3
    reach = (width - 1) * pulses_per_turn
    if len(between) <= reach:
        return
    windows = np.lib.stride_tricks.sliding_window_view(between, reach + 1)[:, ::pulses_per_turn]
    median, own = np.median(windows, axis=1), windows[:, width // 2]
    wrong = (own < _SHORTEST * median) | (own > _LONGEST * median)
    # Distances of few samples are rounded to whole numbers of them.
    wrong &= np.abs(own - median) > _ROUNDED * step_s
    if not wrong.any():
        return
    first = int(np.flatnonzero(wrong)[0])
    at = first + reach // 2
    other = f"that are {median[first]:.3g} s apart in other turns, at {times[at]:.3g} s"
    given = f"{own[first]:.3g} s between pulses {other}"
    allowed = "pulses of which none is missing and none is added"
    remedy = "filter the pulses, or give the speed as rpm: pairs (time in s, rpm)"
    raise refused("tacho", given, allowed, remedy)


def _level(samples: FloatArray, share: float) -> float:
    """The level at a share of the range of samples."""
    return float((1.0 - share) * samples.min() + share * samples.max())


def _begins(samples: FloatArray) -> IntArray:
    """Places of the first samples of pulses."""
    is_upper, is_lower = samples >= _level(samples, _UPPER), samples <= _level(samples, _LOWER)
    # Levels that are neither high nor low keep the last state.
    state = np.where(is_upper, 1, np.where(is_lower, 0, -1))
    known = np.maximum.accumulate(np.where(state >= 0, np.arange(len(state)), 0))
    is_high = state[known] == 1
    return np.asarray(np.flatnonzero(is_high[1:] & ~is_high[:-1]) + 1)
