"""The matrices of the equation of motion."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, SupportsFloat, SupportsIndex

import numpy as np
import numpy.typing as npt

from . import _native
from ._entry import Entry, FloatArray
from ._methods import points
from .state_space import StateSpace


@dataclass(frozen=True, eq=False, repr=False)
class Matrices(Entry):
    """Matrices of the equation of motion, each of the shape (functions, functions) and read-only.
    :meth:`sawflutter.Scene.matrices` returns them.

    q'' + (2 Ω G + C) q' + (K + Ω² S + Ω N) q = f, Ω in rad/s; the mass matrix is the identity. The
    basis functions for n = 0 nodal diameters are the radial functions; for each n ≥ 1 they are the
    radial functions times cos nθ, followed by those times sin nθ.
    """

    stiffness: FloatArray
    """K in 1/s²: bending, guides, membrane stress that does not depend on speed."""

    spin: FloatArray
    """S: centrifugal stress less the convective part."""

    gyroscopic: FloatArray
    """G, skew."""

    damping: FloatArray | None
    """C in 1/s; None without damping."""

    circulatory: FloatArray | None
    """N in 1/s; None without material damping."""

    max_diameters: int
    """Largest number of nodal diameters."""

    radial_functions: int
    """Radial functions of each."""

    scene: str = field(default="", repr=False)
    """The scene as JSON."""

    @classmethod
    def of(cls, scene: str, basis: tuple[SupportsIndex, SupportsIndex] | None) -> Matrices:
        """The matrices of a scene as JSON, in a basis or in that of its accuracy.

        Parameters
        ----------
        scene : str
            The scene as JSON.
        basis : (int, int) or None
            Largest number of nodal diameters, and radial functions of each.

        Returns
        -------
        Matrices

        Raises
        ------
        ArgumentError
            If the basis is out of range.

        Examples
        --------
        >>> import sawflutter as sf
        >>> scene = sf.Scene.paper().to_json()
        >>> sf.Matrices.of(scene, (6, 4)).radial_functions
        4
        """
        found, diameters, functions = _native.matrices(scene, basis=basis)
        arrays: dict[str, Any] = {"damping": None, "circulatory": None}
        for name, values in found.items():
            arrays[name] = np.frombuffer(values, "<f8").reshape((2 * diameters + 1) * functions, -1)
        return cls(**arrays, max_diameters=diameters, radial_functions=functions, scene=scene)

    @property
    def mass(self) -> FloatArray:
        """The mass matrix M, which is the identity.

        Examples
        --------
        >>> import sawflutter as sf
        >>> bool(sf.Scene.paper().matrices(basis=(6, 4)).mass[0, 0] == 1.0)
        True
        """
        one = np.eye(len(self.stiffness))
        one.setflags(write=False)
        return one

    def at(self, radius_m: npt.ArrayLike, angle_deg: npt.ArrayLike) -> FloatArray:
        """Basis functions φ at points of the blade fixed in space. The deflection there is w = φᵀ
        q, and a force F there is f = F φ. The receptance between two points at Ω and ω is φ₁ᵀ (K +
        Ω² S + Ω N − ω² + iω (2 Ω G + C))⁻¹ φ₂.

        Parameters
        ----------
        radius_m, angle_deg : array_like
            Distances from the axis and angles from the cut, positive with the rotation; they are
            broadcast against each other.

        Returns
        -------
        ndarray of float
            In 1/√kg, of the broadcast shape with the functions as its last axis.

        Raises
        ------
        ArgumentError
            If a point is off the blade.

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
        radius, angle = points(radius_m, np.radians(angle_deg))
        basis = (self.max_diameters, self.radial_functions)
        found = _native.functions_at(
            self.scene, basis, *(at.ravel().tolist() for at in (radius, angle))
        )
        return np.frombuffer(found, "<f8").reshape(*radius.shape, len(self.stiffness))

    def companion(self, rpm: SupportsFloat) -> FloatArray:
        """Matrix A of x' = A x with x = (q, q') at a speed; its eigenvalues are those of the saw,
        in 1/s.

        Parameters
        ----------
        rpm : float
            Rotation speed, of any size.

        Returns
        -------
        ndarray of float, of the shape (2 functions, 2 functions)

        Examples
        --------
        >>> import numpy as np
        >>> import sawflutter as sf
        >>> eigenvalues = np.linalg.eigvals(sf.Scene.paper().matrices(basis=(8, 5)).companion(0.0))
        >>> lowest_hz = np.sort(abs(eigenvalues.imag))[0] / (2 * np.pi)
        >>> round(float(lowest_hz), 1)
        7.8
        """
        speed = float(rpm) * np.pi / 30.0
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
        rpm: SupportsFloat,
        *,
        inputs: npt.ArrayLike,
        outputs: npt.ArrayLike,
        to_hz: SupportsFloat | None = None,
    ) -> StateSpace:
        """The saw at a speed as x' = A x + B u, y = C x + D u, for python-control, SciPy or MATLAB.

        Parameters
        ----------
        rpm : float
            Rotation speed, of any size.
        inputs : array_like
            Points at which forces act, fixed in space: distance from the axis in m, angle from the
            cut in degrees.
        outputs : array_like
            Points at which deflections are read.
        to_hz : float, optional
            Keeps the modes up to this frequency, see :meth:`StateSpace.reduced`; all by default.

        Returns
        -------
        StateSpace

        Raises
        ------
        ArgumentError
            Where a point is off the blade.
        ValueError
            Where the modes cannot be separated.

        Examples
        --------
        >>> import sawflutter as sf
        >>> m = sf.Scene.paper().matrices(basis=(8, 5))
        >>> m.state_space(1000, inputs=[(0.355, 0)], outputs=[(0.355, 0), (0.3, 90)])
        <StateSpace at 1000 rpm: 170 states, 1 inputs, 2 outputs>
        """
        forces, probes = (
            self.at(*np.asarray(of, float).reshape(-1, 2).T) for of in (inputs, outputs)
        )
        whole = StateSpace.of(float(rpm), self.companion(rpm), forces, probes)
        return whole if to_hz is None else whole.reduced(float(to_hz))
