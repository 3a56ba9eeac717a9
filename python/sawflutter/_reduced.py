"""Frequencies of many similar saws from small matrices, in milliseconds each."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

import numpy as np

from ._entry import ComplexArray, FloatArray
from ._extras import extra
from ._progress import Callback
from .errors import ArgumentError
from .scene import Scene

# Functions of the small matrices, and modes of each sampled saw from which they follow.
_SIZE, _MODES = 36, 14
# Saws within the bounds whose modes are taken, and those with which the frequencies are compared.
_SAMPLED, _COMPARED = 32, 6
# Highest degree over one number. The interpolated matrices may miss the sampled ones by this share of their variation.
_HIGHEST, _MISSED = 36, 1e-4
# Largest number of saws at whose matrices the others are interpolated.
_MOST = 3000
# Eigenproblems by which their time is measured.
_TIMED = 48
# Number of lowest frequencies that are computed.
BRANCHES = 8


class Reduced:
    """Small matrices K, S, G and C, N of a saw over some of its numbers, each within bounds.

    The modes of saws within the bounds give a basis of few functions by a singular value
    decomposition. The matrices in this basis are polynomials of the numbers, interpolated at the points
    of Chebyshev; a stiffness or a tension enters linearly. :attr:`error_hz` is the largest difference
    of the lowest frequencies at rest and at ``top_rpm`` from those of the full matrices. Before the matrices
    of all points are computed, ``announce`` is called with the time in seconds that they will take.
    """

    error_hz: float

    def __init__(
        self,
        saw: Scene,
        bounds: Sequence[tuple[str, float, float]],
        top_rpm: float,
        announce: Callable[[float], None],
        told: Callback,
    ) -> None:
        with extra("margin"):
            from scipy.stats import qmc
        self._saw, self._paths = saw, [path for path, _, _ in bounds]
        self._low = np.array([low for _, low, _ in bounds])
        self._high = np.array([high for _, _, high in bounds])
        nominal = saw.matrices()
        self._basis = (nominal.max_diameters, nominal.radial_functions)
        speed = top_rpm * np.pi / 30.0
        begin = time.perf_counter()
        drawn = qmc.Halton(len(bounds), seed=0).random(_SAMPLED + _COMPARED)
        sampled = [self._full(2.0 * share - 1.0) for share in drawn]
        modes = [_lowest(of, at) for of in sampled[:_SAMPLED] for at in (0.0, 0.7 * speed, speed)]
        left, _, _ = np.linalg.svd(np.hstack(modes), full_matrices=False)
        self._functions = left[:, :_SIZE]
        nodes = [_nodes(self._degree(place)) for place in range(len(bounds))]
        points = np.stack(np.meshgrid(*nodes, indexing="ij"), axis=-1).reshape(-1, len(bounds))
        if len(points) > _MOST:
            needs = ", ".join(f"{path} {len(of)}" for path, of in zip(self._paths, nodes))
            message = (
                f"the bounds of free are too wide together: they need {len(points)} saws between them, the product of "
                f"{needs}, but at most {_MOST} are computed; narrow the bounds that need the most, to half of their width "
                "first, or free fewer numbers"
            )
            raise ArgumentError(message, "free")
        saws = len(drawn) + len(bounds) * (_HIGHEST + 1)
        announce(len(points) * (time.perf_counter() - begin) / saws)
        found = np.empty((len(points), 5, _SIZE, _SIZE))
        for number, point in enumerate(points):
            found[number] = self._small(self._full(point))
            told(number + 1, len(points), "saws between the bounds")
        self._degrees = [len(of) - 1 for of in nodes]
        coefficients = found.reshape(*(len(of) for of in nodes), -1)
        for axis, of in enumerate(nodes):
            solved = np.linalg.solve(np.polynomial.chebyshev.chebvander(of, len(of) - 1), np.eye(len(of)))
            coefficients = np.moveaxis(np.tensordot(solved, coefficients, (1, axis)), 0, axis)
        self._coefficients = coefficients.reshape(len(points), -1)
        differences = [
            self._off(2.0 * share - 1.0, of, top_rpm) for share, of in zip(drawn[_SAMPLED:], sampled[_SAMPLED:])
        ]
        self.error_hz = float(np.max(differences))

    def frequencies_hz(self, numbers: FloatArray, rpm: FloatArray) -> FloatArray:
        """The lowest frequencies in space, of the shape (saws, speeds, BRANCHES); inf where there are
        fewer. Numbers have a row for each saw."""
        places = 2.0 * (numbers - self._low) / (self._high - self._low) - 1.0
        return _frequencies_hz(self._at(places), rpm)

    def _at(self, places: FloatArray) -> FloatArray:
        """The small matrices at places from -1 to 1 between the bounds."""
        terms = np.ones((len(places), 1))
        for degree, column in zip(self._degrees, places.T):
            own = np.polynomial.chebyshev.chebvander(column, degree)
            terms = (terms[:, :, None] * own[:, None, :]).reshape(len(places), -1)
        return (terms @ self._coefficients).reshape(-1, 5, _SIZE, _SIZE)

    def _full(self, place: FloatArray) -> list[FloatArray | None]:
        numbers = self._low + 0.5 * (place + 1.0) * (self._high - self._low)
        of = self._saw.replace(dict(zip(self._paths, numbers.tolist()))).matrices(basis=self._basis)
        return [of.stiffness, of.spin, of.gyroscopic, of.damping, of.circulatory]

    def _small(self, matrices: list[FloatArray | None]) -> FloatArray:
        none = np.zeros((_SIZE, _SIZE))
        return np.array([none if of is None else self._functions.T @ of @ self._functions for of in matrices])

    def _degree(self, place: int) -> int:
        """The degree that a number needs along the middle of the others."""
        points = np.zeros((_HIGHEST + 1, len(self._paths)))
        points[:, place] = _nodes(_HIGHEST)
        found = np.array([self._small(self._full(point)).ravel() for point in points])
        coefficients = np.linalg.solve(np.polynomial.chebyshev.chebvander(points[:, place], _HIGHEST), found)
        sizes = np.linalg.norm(coefficients, axis=1)[1:]
        behind = np.cumsum(sizes[::-1])[::-1]
        needed = np.flatnonzero(behind > _MISSED * behind[0])
        return int(needed[-1]) + 1 if behind[0] > 0.0 else 0

    def _off(self, place: FloatArray, full: list[FloatArray | None], top_rpm: float) -> float:
        none = np.zeros_like(np.asarray(full[0]))
        rpm = np.array([0.0, top_rpm])
        exact, small = (
            _frequencies_hz(of, rpm)
            for of in (np.array([[none if of is None else of for of in full]]), self._at(place[None]))
        )
        known = np.isfinite(exact) & np.isfinite(small)
        return float(np.abs(exact - small)[known].max(initial=0.0))


def solve_s() -> float:
    """Time in seconds of an eigenproblem of small matrices, by a few of them."""
    matrices = np.random.default_rng(0).standard_normal((_TIMED, 5, _SIZE, _SIZE))
    begin = time.perf_counter()
    _frequencies_hz(matrices, np.zeros(1))
    return (time.perf_counter() - begin) / _TIMED


def _nodes(degree: int) -> FloatArray:
    return np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))


def _lowest(matrices: list[FloatArray | None], speed: float) -> FloatArray:
    """Static modes at a speed in rad/s."""
    stiffness, spin = np.asarray(matrices[0]), np.asarray(matrices[1])
    _, modes = np.linalg.eigh(stiffness + speed**2 * spin)
    return np.asarray(modes[:, :_MODES])


def _frequencies_hz(matrices: FloatArray, rpm: FloatArray) -> FloatArray:
    """Frequencies of matrices of the shape (saws, 5, n, n)."""
    speed = (rpm * np.pi / 30.0)[None, :, None, None]
    stiffness, spin, gyroscopic, damping, circulatory = np.moveaxis(matrices, 1, 0)[:, :, None]
    size = matrices.shape[-1]
    state = np.zeros((len(matrices), len(rpm), 2 * size, 2 * size))
    state[..., :size, size:] = np.eye(size)
    state[..., size:, :size] = -(stiffness + speed**2 * spin + speed * circulatory)
    state[..., size:, size:] = -(2.0 * speed * gyroscopic + damping)
    roots: ComplexArray = np.linalg.eigvals(state).astype(complex)
    hz = np.where(roots.imag > 1e-6, roots.imag / (2.0 * np.pi), np.inf)
    return np.asarray(np.sort(hz, axis=-1)[..., :BRANCHES])
