"""A saw at a speed as a state space, for control."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ._entry import ComplexArray, Entry, FloatArray
from ._extras import extra
from ._receptance import receptance
from ._values import Number, number, numbers
from .errors import refused

# Modes whose eigenvectors agree to half the digits are about to coalesce.
_LARGEST_CONDITION = 1e8


@dataclass(frozen=True, eq=False, repr=False)
class StateSpace(Entry):
    """x' = A x + B u, y = C x + D u of a saw at a speed: u are forces in N at points fixed in
    space, y deflections in m at others. :meth:`Matrices.state_space` makes it.

    It unpacks into its four matrices, so that ``control.ss(*space)`` of python-control and
    ``scipy.signal.StateSpace(*space)`` take it.

    Attributes
    ----------
    rpm : rotation speed.
    A : of the shape (states, states), in 1/s.
    B : (states, inputs).
    C : (outputs, states).
    D : (outputs, inputs), in m/N: the deflection at rest of modes that are left out; zero for a
        full model.
    """

    rpm: float
    A: FloatArray
    B: FloatArray
    C: FloatArray
    D: FloatArray

    def __iter__(self) -> Iterator[FloatArray]:
        return iter((self.A, self.B, self.C, self.D))

    def reduced(self, to_hz: Number) -> StateSpace:
        """The state space of the modes up to a frequency. The others deflect at once, as at
        rest, so that static deflections remain those of the full model.

        Parameters
        ----------
        to_hz : float
            Largest frequency in space of a mode that is kept.
        """
        to_hz = number("to_hz", to_hz)
        values, vectors = np.linalg.eig(self.A)
        # Velocities are deflections times frequencies; without this factor both are of one size.
        size = len(self.A) // 2
        scaled = np.vstack([vectors[:size], vectors[size:] / np.maximum(abs(values), 1.0)])
        if np.linalg.cond(scaled / np.linalg.norm(scaled, axis=0)) > _LARGEST_CONDITION:
            raise ValueError(
                f"the modes at {self.rpm:g} rpm cannot be separated: two of them coalesce, or "
                "nothing holds the blade against a rigid motion; take another speed, or all states"
            )
        left = np.linalg.inv(vectors)
        kept = abs(values.imag) <= 2.0 * np.pi * to_hz
        if not kept.any():
            raise ValueError(f"no mode has a frequency of {to_hz:g} Hz or less; raise to_hz")
        rest = ~kept
        yielding = (self.C @ vectors[:, rest]) @ ((left[rest] @ self.B) / -values[rest, None])
        matrix, basis, inverse = _real_form(values, vectors, left, kept)
        return StateSpace(self.rpm, matrix, inverse @ self.B, self.C @ basis, self.D + yielding.real)

    def response(self, frequency_hz: npt.ArrayLike) -> ComplexArray:
        """Deflections for forces of one newton at frequencies in space: their size and phase. Memory is
        bounded, for any number of frequencies; many of them take one eigenproblem of A.

        Parameters
        ----------
        frequency_hz : array_like
            Frequencies, of any shape.

        Returns
        -------
        ndarray of complex
            Deflections in m/N, in the shape of ``frequency_hz`` with outputs and inputs as the last axes.
        """
        hz = numbers("frequency_hz", frequency_hz)
        found = receptance(self, np.asarray(2j * np.pi * hz.ravel(), np.complex128))
        return found.reshape(*hz.shape, *self.D.shape)

    def time_response(self, forces_n: npt.ArrayLike, times_s: npt.ArrayLike) -> FloatArray:
        """Deflections over time from rest in m, of the shape (times, outputs), under ``forces_n`` of
        the shape (times, inputs), which are linear between ``times_s``, ascending at even steps; needs
        SciPy."""
        with extra("records"):
            from scipy.signal import lsim
        times = numbers("times_s", times_s)
        forces = numbers("forces_n", forces_n)
        inputs = self.B.shape[1]
        if times.ndim != 1 or len(times) < 2 or not np.allclose(np.diff(times), times[1] - times[0], rtol=1e-6):
            raise refused("times_s", f"of shape {times.shape}", "ascending times at even steps", "use numpy.linspace")
        if forces.shape != (len(times), inputs):
            allowed = f"of the shape (times, inputs), ({len(times)}, {inputs})"
            raise refused("forces_n", f"of shape {forces.shape}", allowed, "give each force at each time")
        _, found, _ = lsim(tuple(self), forces, times - times[0])
        return np.asarray(found).reshape(len(times), -1)

    def to_dict(self) -> dict[str, FloatArray | float]:
        """The matrices by their names, for ``scipy.io.savemat`` and with it for MATLAB."""
        return {"rpm": self.rpm, "A": self.A, "B": self.B, "C": self.C, "D": self.D}

    def __repr__(self) -> str:
        sizes = f"{len(self.A)} states, {self.B.shape[1]} inputs, {len(self.C)} outputs"
        return f"<StateSpace at {self.rpm:g} rpm: {sizes}>"


def _real_form(
    values: ComplexArray, vectors: ComplexArray, left: ComplexArray, kept: npt.NDArray[np.bool_]
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """A of the modes that are kept, in blocks of two for each pair λ and its conjugate; their
    vectors, and what gives their coordinates."""
    count = int(kept.sum())
    matrix = np.zeros((count, count))
    basis, inverse = list[FloatArray](), list[FloatArray]()
    for k in np.flatnonzero(kept & (values.imag >= 0.0)):
        at, value = len(basis), values[k]
        if value.imag == 0.0:
            matrix[at, at] = value.real
            basis.append(vectors[:, k].real)
            inverse.append(left[k].real)
            continue
        matrix[at : at + 2, at : at + 2] = [[value.real, value.imag], [-value.imag, value.real]]
        basis += [vectors[:, k].real, vectors[:, k].imag]
        # v z + its conjugate is 2 (Re v Re z - Im v Im z).
        inverse += [2.0 * left[k].real, -2.0 * left[k].imag]
    return matrix, np.stack(basis, axis=1), np.stack(inverse)
