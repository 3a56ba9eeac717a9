"""Frequency responses of a state space: many at once by its modes, or each by a solution of its equations."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ._entry import ComplexArray, FloatArray, IntArray

if TYPE_CHECKING:
    from .state_space import StateSpace

# Number of frequencies from which on modes are used: the eigenproblem of 740 states takes as long as 50 solutions,
# 0.26 s with one thread.
_MANY = 50
# Largest correction of a deflection by a second step, as a share of the largest deflection at its frequency, for
# which modes are used. The error that remains has the order of its square.
_CORRECTION = 1e-6
# Largest size in bytes of the matrices that are used at once.
_BLOCK_BYTES = 2**25


def receptance(space: StateSpace, s: ComplexArray) -> ComplexArray:
    """C (s − A)⁻¹ B + D, of the shape (s, outputs, inputs)."""
    equations = _Equations.of(space)
    found = np.empty((len(s), *space.D.shape), complex)
    left = np.arange(len(s))
    if len(s) >= _MANY:
        modes = _Modes.of(space, equations)
        wrong = [block[modes.fill(s, block, found)] for block in _blocks(left, 16 * len(space.A) * space.B.shape[1])]
        left = np.concatenate(wrong)
    for block in _blocks(left, 16 * len(equations.position) ** 2):
        found[block] = equations.solved(s[block])
    return np.asarray(found + space.D)


def _blocks(places: IntArray, size: int) -> Iterator[IntArray]:
    """Parts of places, each of which takes so many bytes."""
    step = max(1, _BLOCK_BYTES // size)
    return (places[begin : begin + step] for begin in range(0, len(places), step))


@dataclass(frozen=True)
class _Equations:
    """(mass s² + velocity s + position) q = force, of which the probe reads deflections. Their order is half
    of the number of states where these are deflections and velocities."""

    mass: float
    velocity: FloatArray
    position: FloatArray
    force: FloatArray
    probe: FloatArray

    @classmethod
    def of(cls, space: StateSpace) -> _Equations:
        states = len(space.A)
        size = states // 2
        upper = np.hstack([np.zeros((size, size)), np.eye(size)])
        is_second_order = (
            states == 2 * size
            and np.array_equal(space.A[:size], upper)
            and not space.B[:size].any()
            and not space.C[:, size:].any()
        )
        if is_second_order:
            position, velocity = -space.A[size:, :size], -space.A[size:, size:]
            return cls(1.0, velocity, position, space.B[size:], space.C[:, :size])
        return cls(0.0, np.eye(states), -space.A, space.B, space.C)

    def solved(self, s: ComplexArray) -> ComplexArray:
        """Deflections at the probe for each force."""
        each = s[:, None, None]
        matrices = self.mass * each**2 * np.eye(len(self.position)) + each * self.velocity + self.position
        return np.asarray(self.probe @ np.linalg.solve(matrices, self.force))

    def residual(self, s: ComplexArray, q: ComplexArray) -> ComplexArray:
        """Forces that q, of the shape (unknowns, s, forces), does not balance."""
        each = s[:, None]
        moved = self.mass * each**2 * q + each * _times(self.velocity, q) + _times(self.position, q)
        return np.asarray(self.force[:, None] - moved)


@dataclass(frozen=True)
class _Modes:
    """Eigenvalues of a state space, the unknowns of its eigenvectors, and the coordinates of forces in these."""

    equations: _Equations
    values: ComplexArray
    vectors: ComplexArray
    coordinates: ComplexArray

    @classmethod
    def of(cls, space: StateSpace, equations: _Equations) -> _Modes:
        values, vectors = np.linalg.eig(space.A)
        size = len(equations.position)
        try:
            inverse = np.linalg.inv(vectors)
        except np.linalg.LinAlgError:
            # Modes coalesce exactly; no frequency is accepted.
            inverse = np.full(vectors.shape, np.nan)
        return cls(equations, values, vectors[:size], inverse[:, -size:])

    def fill(self, s: ComplexArray, block: IntArray, found: ComplexArray) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """Writes the deflections at places of s and gives where they are not accurate."""
        at = s[block]
        force = np.broadcast_to(self.equations.force[:, None], (len(self.vectors), len(at), found.shape[2]))
        with np.errstate(all="ignore"):
            first = self._solved(at, force)
            correction = self._solved(at, self.equations.residual(at, first))
            deflection, change = (_times(self.equations.probe, of) for of in (first + correction, correction))
            largest, changed = (np.abs(of).max(axis=(0, 2)) for of in (deflection, change))
            found[block] = np.moveaxis(deflection, 0, 1)
            return np.asarray(~(changed <= _CORRECTION * largest))

    def _solved(self, s: ComplexArray, force: ComplexArray | FloatArray) -> ComplexArray:
        along = _times(self.coordinates, force) / (s[:, None] - self.values[:, None, None])
        return _times(self.vectors, along)


def _times(matrix: FloatArray | ComplexArray, of: FloatArray | ComplexArray) -> ComplexArray:
    """A product along the first axis, by one call of BLAS."""
    return np.asarray((matrix @ of.reshape(len(of), -1)).reshape(len(matrix), *of.shape[1:]))
