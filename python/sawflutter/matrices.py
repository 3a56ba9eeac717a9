"""The matrices of the equation of motion."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from . import _native
from ._entry import ComplexArray, Entry, FloatArray
from ._methods import points
from ._values import Number, number, numbers
from .errors import refused
from .state_space import StateSpace


@dataclass(frozen=True, eq=False, repr=False)
class Matrices(Entry):
    """Matrices of the equation of motion, each of the shape (functions, functions) and read-only.
    :meth:`sawflutter.Scene.matrices` returns them.

    q'' + (2 Ω G + C) q' + (K + Ω² S + Ω N) q = f, Ω in rad/s; the mass matrix is the identity. The
    basis functions for n = 0 nodal diameters are the radial functions; for each n ≥ 1 they are the
    radial functions times cos nθ, followed by those times sin nθ. An unknown √m h for each head of a
    guide arm, with mass m and deflection h, follows those of n = 0, and then one for each internal
    state of films and controllers.

    Attributes
    ----------
    stiffness : K in 1/s²: bending, guides, membrane stress that does not depend on speed; symmetric
        without films and controllers.
    spin : S: centrifugal stress less the convective part.
    gyroscopic : G, skew.
    damping : C in 1/s; None without damping.
    circulatory : N in 1/s; None without material damping.
    max_diameters : largest number of nodal diameters.
    radial_functions : radial functions of each.
    """

    stiffness: FloatArray
    spin: FloatArray
    gyroscopic: FloatArray
    damping: FloatArray | None
    circulatory: FloatArray | None
    max_diameters: int
    radial_functions: int
    _scene: str = field(default="", repr=False)

    @property
    def mass(self) -> FloatArray:
        """The mass matrix M, which is the identity."""
        one = np.eye(len(self.stiffness))
        one.setflags(write=False)
        return one

    def at(self, radius_m: npt.ArrayLike, angle_deg: npt.ArrayLike) -> FloatArray:
        """Basis functions φ in 1/√kg at points of the blade fixed in space, along the last axis. The
        deflection there is w = φᵀ q, and a force F there is f = F φ. The receptance between two points at Ω and ω is φ₁ᵀ (K +
        Ω² S + Ω N − ω² + iω (2 Ω G + C))⁻¹ φ₂.

        Parameters
        ----------
        radius_m, angle_deg : array_like
            Distances from the axis and angles from the cut, positive with the rotation; they are
            broadcast against each other; also texts with a unit.

        Returns
        -------
        ndarray
            Functions in the shape of both with (functions) as the last axis.

        Raises
        ------
        ArgumentError
            A radius is beside the blade.

        Examples
        --------
        The deflection under a newton at rest, where it acts:

        >>> import numpy as np
        >>> import sawflutter as sf
        >>> m = sf.Scene.paper().matrices(basis=(12, 6))
        >>> rim = m.at(radius_m=0.355, angle_deg=90.0)
        >>> print(f"{1e6 * rim @ np.linalg.solve(m.stiffness, rim):.0f} µm")
        290 µm
        """
        radius, angle = points(radius_m, angle_deg)
        basis = (self.max_diameters, self.radial_functions)
        found = _native.functions_at(
            self._scene, basis, *(at.ravel().tolist() for at in (radius, angle))
        )
        return np.frombuffer(found, "<f8").reshape(*radius.shape, len(self.stiffness))

    def companion(self, rpm: Number) -> FloatArray:
        """Matrix A of x' = A x with x = (q, q') at any speed; its eigenvalues are those of the saw,
        in 1/s. It has twice as many rows as there are functions."""
        speed = float(numbers("rpm", number("rpm", rpm))) * np.pi / 30.0
        size = len(self.stiffness)
        velocity = 2.0 * speed * self.gyroscopic
        position = self.stiffness + speed**2 * self.spin
        if self.damping is not None:
            velocity = velocity + self.damping
        if self.circulatory is not None:
            position = position + speed * self.circulatory
        return np.block([[np.zeros((size, size)), np.eye(size)], [-position, -velocity]])

    def state_space(
        self,
        rpm: Number,
        *,
        inputs: npt.ArrayLike,
        outputs: npt.ArrayLike,
        to_hz: Number | None = None,
    ) -> StateSpace:
        """The saw at a speed as x' = A x + B u, y = C x + D u, for python-control, SciPy or MATLAB.

        Parameters
        ----------
        rpm : float
            Rotation speed, of any size.
        inputs : array_like
            Points at which forces act, fixed in space: distance from the axis in m, angle from the
            cut in degrees, or texts with a unit; of the shape (inputs, 2), or (2) for one.
        outputs : array_like
            Points at which deflections are read, likewise.
        to_hz : float, optional
            Keeps the modes up to this frequency, see :meth:`StateSpace.reduced`; all by default.

        Returns
        -------
        StateSpace

        Raises
        ------
        ArgumentError
            A point is beside the blade, or no point is given.
        """
        forces, probes = (self._at_points(*pair) for pair in (("inputs", inputs), ("outputs", outputs)))
        size = len(self.stiffness)
        b = np.vstack([np.zeros((size, len(forces))), forces.T])
        c = np.hstack([probes, np.zeros((len(probes), size))])
        space = StateSpace(number("rpm", rpm), self.companion(rpm), b, c, np.zeros((len(probes), len(forces))))
        return space if to_hz is None else space.reduced(to_hz)

    def response(
        self, rpm: Number, frequency_hz: npt.ArrayLike, *, inputs: npt.ArrayLike, outputs: npt.ArrayLike
    ) -> ComplexArray:
        """Deflections at points for forces of one newton at others, at a speed and at frequencies: the
        :meth:`StateSpace.response` to ``frequency_hz``, with ``rpm``, ``inputs`` and ``outputs`` of
        :meth:`state_space`.

        Returns
        -------
        ndarray of complex
            Deflections in m/N, in the shape of ``frequency_hz`` with outputs and inputs as the last axes.

        Raises
        ------
        ArgumentError
            As of :meth:`state_space`.
        """
        return self.state_space(rpm, inputs=inputs, outputs=outputs).response(frequency_hz)

    def run_time_response(
        self,
        rpm: Number,
        forces_n: npt.ArrayLike,
        times_s: npt.ArrayLike,
        *,
        inputs: npt.ArrayLike,
        outputs: npt.ArrayLike,
        to_hz: Number | None = None,
    ) -> FloatArray:
        """Deflections in m at points over time, from rest, under forces at others that are linear
        between the times; needs SciPy.

        Parameters
        ----------
        rpm, inputs, outputs, to_hz
            As in :meth:`state_space`.
        forces_n, times_s
            As in :meth:`StateSpace.time_response`.

        Returns
        -------
        ndarray
            Deflections of the shape (times, outputs).

        Raises
        ------
        ArgumentError
            As of :meth:`state_space`, or the times are not even.
        """
        space = self.state_space(rpm, inputs=inputs, outputs=outputs, to_hz=to_hz)
        return space.time_response(forces_n, times_s)

    def _at_points(self, name: str, of: npt.ArrayLike) -> FloatArray:
        pairs = np.array(of, object)
        if pairs.size == 0 or pairs.size % 2 or (pairs.ndim != 1 and pairs.shape[-1] != 2):
            said = "points of the blade, each a radius in m and an angle in degrees"
            raise refused(name, of, said, 'write it like [(0.3, 90)] or [("300 mm", "90 deg")]')
        radii, angles = pairs.reshape(-1, 2).T.tolist()
        return self.at(radii, angles)
