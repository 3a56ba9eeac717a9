"""A saw at a speed as a state space, for control."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ._entry import ComplexArray, Entry, FloatArray

# Modes whose eigenvectors agree to half the digits are about to coalesce.
_LARGEST_CONDITION = 1e8


@dataclass(frozen=True, eq=False, repr=False)
class StateSpace(Entry):
    """x' = A x + B u, y = C x + D u of a saw at a speed: u are forces in N at points fixed in
    space, y deflections in m at others. :meth:`sawflutter.Matrices.state_space` makes it.

    It unpacks into its four matrices, so that ``control.ss(*space)`` of python-control and
    ``scipy.signal.StateSpace(*space)`` take it.
    """

    rpm: float
    """Rotation speed."""

    A: FloatArray
    """States by states, in 1/s."""

    B: FloatArray
    """States by inputs."""

    C: FloatArray
    """Outputs by states."""

    D: FloatArray
    """Outputs by inputs, in m/N: the deflection at rest of modes that are left out; zero for a full model."""

    def __iter__(self) -> Iterator[FloatArray]:
        return iter((self.A, self.B, self.C, self.D))

    @classmethod
    def of(
        cls, rpm: float, companion: FloatArray, forces: FloatArray, probes: FloatArray
    ) -> StateSpace:
        """The state space of all unknowns.

        Parameters
        ----------
        rpm : float
            Rotation speed.
        companion : ndarray
            Matrix of x' = A x with x = (q, q').
        forces, probes : ndarray
            Basis functions at the points, a row each.

        Returns
        -------
        StateSpace

        Examples
        --------
        >>> import numpy as np
        >>> import sawflutter as sf
        >>> one = np.ones((1, 1))
        >>> sf.StateSpace.of(0.0, np.array([[0.0, 1.0], [-4.0, 0.0]]), one, one).D
        array([[0.]])
        """
        size = len(companion) // 2
        inputs = np.vstack([np.zeros((size, len(forces))), forces.T])
        outputs = np.hstack([probes, np.zeros((len(probes), size))])
        return cls(rpm, companion, inputs, outputs, np.zeros((len(probes), len(forces))))

    def reduced(self, to_hz: float) -> StateSpace:
        """The state space of the modes up to a frequency. The others deflect at once, as at
        rest, so that static deflections remain those of the full model.

        Parameters
        ----------
        to_hz : float
            Largest frequency in space of a mode that is kept.

        Returns
        -------
        StateSpace

        Raises
        ------
        ValueError
            Where no mode is as low, or where the modes cannot be separated: two of them coalesce
            at this speed, or nothing holds the blade against a rigid motion.

        Examples
        --------
        >>> import numpy as np
        >>> import sawflutter as sf
        >>> m = sf.Scene.paper().matrices(basis=(8, 5))
        >>> whole = m.state_space(1000, inputs=[(0.355, 0)], outputs=[(0.355, 90)])
        >>> low = whole.reduced(to_hz=100)
        >>> len(low.A) < len(whole.A)
        True
        >>> bool(np.allclose(low.response(0.0), whole.response(0.0)))
        True
        """
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
        return StateSpace(
            self.rpm, matrix, inverse @ self.B, self.C @ basis, self.D + yielding.real
        )

    def response(self, frequency_hz: npt.ArrayLike) -> ComplexArray:
        """Deflections for forces of one newton at frequencies, in m/N: their size and phase.

        Parameters
        ----------
        frequency_hz : array_like
            Frequencies in space.

        Returns
        -------
        ndarray of complex
            Of the shape of the frequencies, with outputs and inputs as its last axes.

        Examples
        --------
        >>> import sawflutter as sf
        >>> m = sf.Scene.paper().matrices(basis=(8, 5))
        >>> rim = [(0.355, 90)]
        >>> m.state_space(1000, inputs=rim, outputs=rim).response([1.0, 2.0]).shape
        (2, 1, 1)
        """
        s = 2j * np.pi * np.asarray(frequency_hz, float)[..., None, None]
        states = np.linalg.solve(s * np.eye(len(self.A)) - self.A, self.B)
        return np.asarray(self.C @ states + self.D)

    def to_dict(self) -> dict[str, FloatArray | float]:
        """The matrices by their names, for ``scipy.io.savemat`` and with it for MATLAB.

        Returns
        -------
        dict

        Examples
        --------
        >>> import sawflutter as sf
        >>> m = sf.Scene.paper().matrices(basis=(6, 4))
        >>> sorted(m.state_space(0, inputs=[(0.3, 0)], outputs=[(0.3, 0)]).to_dict())
        ['A', 'B', 'C', 'D', 'rpm']
        """
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
