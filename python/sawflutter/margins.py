"""How fast a measured saw may turn: from peaks over the speed, of which some are of no mode."""

from __future__ import annotations

import logging
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ._drawn import Drawn
from ._entry import Entry, FloatArray, array
from ._extras import extra
from ._posterior import MOST_SPEEDS, Measured, most_telling
from ._progress import Callback
from ._reduced import Reduced, solve_s
from ._values import Number, number
from .errors import refused
from .plot.chart import Area, Chart, Line, Panel, Points, Shape, Upright, colours
from .plot.look import with_harmonics
from .scene import Scene

# Walkers of the ensemble, saws from which the best are its first ones, and saws that are analysed fully.
_WALKERS, _FIRST, _ANALYSED = 48, 768, 100
# The first part of the steps is left out.
_LEFT_OUT = 0.4
# Speeds at which a next measurement is tried.
_TRIED = 7
# Independent saws that suffice for an interval of 95 %, and the share of the bounds that an interval of a determined
# number does not exceed. Equal probability has 0.95.
_ENOUGH, _WIDE = 400, 0.8
# Time in seconds from which on it is announced, as for a chart.
_LONG_S = 10.0
_LOGGER = logging.getLogger(__package__)
# Largest error of the interpolation, as a share of the deviation of the peaks: it would widen intervals by a tenth.
_COARSE = 0.5


@dataclass(frozen=True, eq=False, repr=False)
class MeasuredMargin(Drawn, Entry):
    """Saws that agree with measured peaks, and their speeds; :meth:`Scene.measured_margin` makes it.

    Attributes
    ----------
    name : title of the scene.
    paths : free numbers.
    numbers : their values, a row for each saw and a column for each number.
    within : lower and upper ends of the intervals of 95 % of the numbers, as shares of their bounds, of the
        shape (2, numbers).
    deviation_hz : standard deviation of the peaks, for each saw.
    critical_rpm, flutter_rpm : first critical speed and flutter speed of each saw; NaN if it has none up
        to ``to_rpm``.
    to_rpm : last speed of the analyses.
    margin : share of the deciding speed at which the saw may run.
    rpm, peak_hz : the peaks that are used, of the shape (peaks).
    mode : most likely place of the mode of each peak among the frequencies in ascending order, from 1; 0
        for a multiple of the speed, and -1 for nothing.
    probability : its probability.
    next_rpm, next_hz, next_mode : speed, frequency and place of the mode whose measurement would tell most
        of the deciding speed.
    next_share : share of the variance of the deciding speed that it would take away.
    independent : number of independent saws that the sampling is worth: all of its saws, divided by the
        steps after which a walker has forgotten where it was.
    error_hz : largest error of the computed frequencies of the sampling; it is said beside the deviation of
        the peaks, and warned of from half of it on.
    speeds_hz : quantiles 2.5, 50 and 97.5 % of the frequencies, of the shape (3, speeds, frequencies).
    at_rpm : their speeds.
    """

    name: str
    paths: tuple[str, ...]
    numbers: FloatArray
    within: FloatArray
    deviation_hz: FloatArray
    critical_rpm: FloatArray
    flutter_rpm: FloatArray
    to_rpm: float
    margin: float
    rpm: FloatArray
    peak_hz: FloatArray
    mode: FloatArray
    probability: FloatArray
    next_rpm: float
    next_hz: float
    next_mode: int
    next_share: float
    independent: float
    error_hz: float
    speeds_hz: FloatArray
    at_rpm: FloatArray

    @property
    def deciding_rpm(self) -> FloatArray:
        """The lower one of critical and flutter speed of each saw; ``to_rpm`` if it has neither."""
        return _deciding(self.critical_rpm, self.flutter_rpm, self.to_rpm)

    @property
    def at_most_rpm(self) -> float:
        """The margin times the deciding speed that 95 % of the saws exceed."""
        return self.margin * float(np.quantile(self.deciding_rpm, 0.05))

    def chart(self) -> Chart:
        """Peaks over the speed by their most likely modes, and the frequencies of the saws."""
        low, middle, high = np.where(np.isfinite(self.speeds_hz), self.speeds_hz, np.nan)
        top_hz = 1.15 * float(self.peak_hz.max())
        items: list[Area | Line | Points | Upright] = []
        key: list[Area | Line | Points | Upright] = []
        for place in range(low.shape[1]):
            known = middle[:, place] < top_hz
            x = self.at_rpm[known]
            band = Area(x, low[known, place], high[known, place], colours()["blank"], "95 % of the saws", stepped=False)
            items += [band, Line(x, middle[known, place], colours()["standing"])] if known.any() else []
            key += [band] if place == 0 else []
        kinds: list[tuple[npt.NDArray[np.bool_], str, Shape, str]] = [
            (self.mode > 0, "forward", "disc", "peak of a mode"),
            (self.mode == 0, "quiet", "ring", "at a multiple of the speed"),
            (self.mode < 0, "backward", "cross", "of nothing"),
        ]
        for which, colour, shape, name in kinds:
            if which.any():
                key.append(Points(self.rpm[which], self.peak_hz[which], colours()[colour], name, shape))
        key.append(Upright(self.at_most_rpm, colours()["alarm"], name=f"at most {self.at_most_rpm:.0f} rpm"))
        items += key[1:]
        span = (0.0, 1.08 * max(float(self.at_rpm.max()), self.at_most_rpm))
        panel = Panel("rotation speed Ω [rpm]", "frequency in space [Hz]", items, span, (0.0, top_hz), harmonics=True)
        facts = f"Run at most {self.at_most_rpm:.0f} rpm with 95 % probability; {_spread('deciding speed', self.deciding_rpm)} rpm"
        return Chart(self.name, facts, tuple(with_harmonics((panel,), [1.0, 2.0])), key)

    def __str__(self) -> str:
        least = self.at_most_rpm / self.margin
        beyond = self.to_rpm * 0.999 <= least
        keeps = f"{'at least ' if beyond else ''}{least:.0f} rpm, which the saw keeps with 95 % probability"
        rows = [("critical speed", self.critical_rpm, "rpm"), ("flutter speed", self.flutter_rpm, "rpm")]
        rows += [(path, column, "") for path, column in zip(self.paths, self.numbers.T)]
        rows += [("deviation of the peaks", self.deviation_hz, "Hz")]
        counts = [int(of.sum()) for of in (self.mode > 0, self.mode == 0, self.mode < 0)]
        lines = [f"Run at most {self.at_most_rpm:.0f} rpm: {100 * self.margin:g} % of {keeps}", ""]
        lines += [f"  {_spread(name, of)} {unit}".rstrip() for name, of, unit in rows]
        lines += ["", f"Of {len(self.mode)} peaks {counts[0]} are of modes, {counts[1]} at multiples of the speed, {counts[2]} of nothing."]
        lines += [
            f"Measure next: frequency {self.next_mode} at {self.next_rpm:.0f} rpm, near {self.next_hz:.2f} Hz; it would "
            f"take {100 * self.next_share:.0f} % of the variance of the deciding speed."
        ]
        lines += ["", *self._remarks()]
        return "\n".join(lines)

    def _remarks(self) -> list[str]:
        """Warnings, and the error of the computation."""
        said = []
        if self.independent < _ENOUGH:
            said.append(f"Warning: the sampling is worth {self.independent:.0f} independent saws alone; take more steps.")
        said.extend(
            f"Warning: {path} is hardly determined; its bounds decide with the peaks."
            for path, low, high in zip(self.paths, *self.within)
            if high - low > _WIDE
        )
        noise_hz = float(np.median(self.deviation_hz))
        share = self.error_hz / noise_hz
        if share > _COARSE:
            said.append("Warning: the interpolation is as inexact as the peaks; narrow the bounds of radii and angles.")
        said.append(
            f"Frequencies of the sampling are within {self.error_hz:.2g} Hz of those of the full matrices, "
            f"{100.0 * share:.2g} % of the deviation of the peaks."
        )
        return said

    def __repr__(self) -> str:
        return f"<MeasuredMargin {self.name!r}: at most {self.at_most_rpm:.0f} rpm from {len(self.mode)} peaks>"


def measured_margin(
    saw: Scene,
    rpm: npt.ArrayLike,
    peak_hz: npt.ArrayLike,
    free: Mapping[str, tuple[Number, Number]],
    orders: Sequence[Number],
    margin: Number,
    steps: int,
    seed: int,
    told: Callback,
) -> MeasuredMargin:
    """The result of :meth:`Scene.measured_margin` for an idling saw."""
    with extra("margin"):
        import emcee
        from scipy.stats import qmc

    share = number("margin", margin)
    if not 0.0 < share <= 1.0:
        raise refused("margin", share, "above 0 and at most 1", "0.85 is usual")
    if steps < 20:
        raise refused("steps", steps, "at least 20", "200 is usual")
    if not free:
        raise refused("free", None, "given", "name a number that is not known, with its bounds")
    bounds = [(path, number(path, low), number(path, high)) for path, (low, high) in free.items()]
    speeds, hz = _checked(rpm, peak_hz)
    top = float(speeds.max())
    solves = (_FIRST + _WALKERS * steps) * min(len(np.unique(speeds)), MOST_SPEEDS)
    reduced = Reduced(saw, bounds, max(top, 1.0), lambda seconds: _announce(saw, seconds, solves), told)
    measured = Measured(reduced, bounds, speeds, hz, [number("orders", of) for of in orders])
    names = len(bounds) + 1
    first = qmc.Halton(names, seed=seed).random(_FIRST)
    known = np.concatenate([measured.logarithm(part) for part in np.array_split(first, 16)])
    best = first[np.argsort(known)[::-1][:_WALKERS]]
    # Both moves cross from one group of likely saws to another.
    moves = [(emcee.moves.DEMove(), 0.8), (emcee.moves.DESnookerMove(), 0.2)]
    sampler = emcee.EnsembleSampler(_WALKERS, names, measured.logarithm, vectorize=True, moves=moves)
    sampler.random_state = np.random.RandomState(seed).get_state()
    for done, _ in enumerate(sampler.sample(best, iterations=steps, skip_initial_state_check=True)):
        told(done + 1, steps, "steps")
    chain = sampler.get_chain(discard=int(_LEFT_OUT * steps))
    flat = chain.reshape(-1, names)
    independent = len(flat) / float(np.max(emcee.autocorr.integrated_time(chain, tol=0)))
    drawn = flat[np.random.default_rng(seed).choice(len(flat), _ANALYSED, replace=False)]
    numbers = measured.numbers(drawn)
    found = []
    for done, row in enumerate(numbers):
        found.append(saw.replace(dict(zip(free, row.tolist()))).speeds(beside=saw))
        told(done + 1, _ANALYSED, "analyses")
    to_rpm = min(of.to_rpm for of in found)
    critical, flutter = (
        np.array([np.nan if one is None or one > to_rpm else one for one in of])
        for of in ([of.first_critical_rpm for of in found], [of.flutter_rpm for of in found])
    )
    mode, probability = measured.most_likely(drawn)
    at_rpm = np.linspace(0.0, max(top, 1.0), 4 * _TRIED - 3)
    computed = reduced.frequencies_hz(numbers, at_rpm)
    deviation = measured.deviation_hz(drawn)
    tried = (at_rpm[::4], computed[:, ::4], _deciding(critical, flutter, to_rpm), float(np.median(deviation)))
    next_rpm, next_hz, place, next_share = most_telling(*tried)
    within = np.quantile(drawn[:, :-1], (0.025, 0.975), axis=0)
    speeds_hz = np.quantile(computed, (0.025, 0.5, 0.975), axis=0)
    return MeasuredMargin(
        saw.name, tuple(free), array(numbers), array(within), array(deviation), array(critical), array(flutter),
        to_rpm, share, array(measured.rpm[measured.speed]), array(measured.hz), array(mode), array(probability),
        next_rpm, next_hz, place, next_share, independent, reduced.error_hz, array(speeds_hz), array(at_rpm),
    )  # fmt: skip


def _announce(saw: Scene, of_reduction_s: float, solves: int) -> None:
    """Says how long the computation will take, by the times of single steps."""
    saw.speeds(beside=saw)
    begin = time.perf_counter()
    saw.speeds(beside=saw)
    of_analyses_s = _ANALYSED * (time.perf_counter() - begin)
    of_steps_s = solves * solve_s()
    if (seconds := of_reduction_s + of_steps_s + of_analyses_s) > _LONG_S:
        _LOGGER.warning(
            "the margin takes about %.0f seconds, a rough estimate: %.0f for the saws between the bounds, %.0f for the "
            "steps, %.0f for the analyses; where that is too long, take fewer steps, narrower bounds or "
            'accuracy="draft"', seconds, of_reduction_s, of_steps_s, of_analyses_s,
        )  # fmt: skip


def _checked(rpm: npt.ArrayLike, peak_hz: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    speeds, hz = np.asarray(rpm, float).ravel(), np.asarray(peak_hz, float).ravel()
    if len(speeds) != len(hz) or not len(hz):
        raise refused("peak_hz", len(hz), f"one for each of {len(speeds)} speeds", "give pairs of speed and frequency")
    if not (np.isfinite(speeds).all() and np.isfinite(hz).all() and (speeds >= 0.0).all() and (hz > 0.0).all()):
        raise refused("peak_hz", float(hz.min()), "above 0, at speeds of 0 or more", "leave out what is no peak")
    return speeds, hz


def _deciding(critical: FloatArray, flutter: FloatArray, to_rpm: float) -> FloatArray:
    return np.asarray(np.fmin(np.fmin(critical, flutter), to_rpm))


def _spread(name: str, values: FloatArray) -> str:
    known = values[np.isfinite(values)]
    if not len(known):
        return f"{name}: none"
    low, middle, high = np.quantile(known, (0.025, 0.5, 0.975))
    share = "" if len(known) == len(values) else f", {100 * len(known) / len(values):.0f} % of the saws"
    return f"{name}: {middle:.4g} (95 % interval {low:.4g} … {high:.4g}{share})"
