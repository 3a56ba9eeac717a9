"""What can be asked of the parts of a report beside their numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
import numpy.typing as npt

from ._entry import ComplexArray, Entry, FloatArray


class _Profile(Protocol):
    """Deflection of n nodal diameters at a few radii."""

    @property
    def nodal_diameters(self) -> int: ...
    @property
    def radius_m(self) -> FloatArray: ...
    @property
    def cosine(self) -> FloatArray: ...
    @property
    def sine(self) -> FloatArray: ...


class _Complex(Protocol):
    @property
    def re(self) -> FloatArray: ...
    @property
    def im(self) -> FloatArray: ...


class _Harmonic(Protocol):
    """The same of a mode at a speed."""

    @property
    def nodal_diameters(self) -> int: ...
    @property
    def cosine(self) -> _Complex: ...
    @property
    def sine(self) -> _Complex: ...


class RestModeMethods(Entry):
    """Of a mode at rest."""

    if TYPE_CHECKING:
        profiles: tuple[_Profile, ...]

    def shape(self, radius_m: npt.ArrayLike, theta_rad: npt.ArrayLike) -> FloatArray:
        """Deflection at points of the blade, scaled to a largest value of one.

        Parameters
        ----------
        radius_m, theta_rad : array_like
            Distances from the axis and angles from the cut, positive with the rotation; they are
            broadcast against each other.

        Returns
        -------
        ndarray of float, of the broadcast shape
            NaN off the blade.
        """
        radius, theta = np.broadcast_arrays(
            np.asarray(radius_m, float), np.asarray(theta_rad, float)
        )
        total = np.zeros(radius.shape)
        for part in self.profiles:
            n = part.nodal_diameters
            total += _between(radius, part.radius_m, part.cosine) * np.cos(n * theta)
            total += _between(radius, part.radius_m, part.sine) * np.sin(n * theta)
        return total


class ModeMethods(Entry):
    """Of a mode at a speed."""

    if TYPE_CHECKING:
        frequency_hz: float
        growth_per_s: float
        radius_m: FloatArray
        harmonics: tuple[_Harmonic, ...]

    def shape(self, radius_m: npt.ArrayLike, theta_rad: npt.ArrayLike) -> ComplexArray:
        """Complex deflection in space; its real part times e^(iωt) is what moves.

        Parameters
        ----------
        radius_m, theta_rad : array_like
            Distances from the axis and angles from the cut, positive with the rotation; they are
            broadcast against each other.

        Returns
        -------
        ndarray of complex, of the broadcast shape
            NaN off the blade. Its size means nothing, only its proportions do.

        Examples
        --------
        A reflected wave turns with the rotation: a quarter of a period later, the deflection is
        the same further on.

        >>> import numpy as np
        >>> import sawflutter as sf
        >>> mode = sf.Scene.paper().replace({"accuracy": "draft"}).modes(rpm=1800)[0]
        >>> mode.name, mode.direction
        ('2 diameters', 'reflected')
        >>> mode.shape(0.3, np.linspace(0, np.pi, 4)).shape
        (4,)
        """
        radius, theta = np.broadcast_arrays(
            np.asarray(radius_m, float), np.asarray(theta_rad, float)
        )
        total = np.zeros(radius.shape, complex)
        for wave in self.harmonics:
            n = wave.nodal_diameters
            for part, turn in ((wave.cosine, np.cos(n * theta)), (wave.sine, np.sin(n * theta))):
                real = _between(radius, self.radius_m, part.re)
                imaginary = _between(radius, self.radius_m, part.im)
                total += (real + 1j * imaginary) * turn
        return total

    def deflection(
        self, radius_m: npt.ArrayLike, theta_rad: npt.ArrayLike, time_s: float
    ) -> FloatArray:
        """Real deflection at a time, without growth: Re(shape · e^(iωt))."""
        turned = self.shape(radius_m, theta_rad) * np.exp(2j * np.pi * self.frequency_hz * time_s)
        return np.asarray(turned.real)


class BranchMethods(Entry):
    """Of a branch of the Campbell diagram."""

    if TYPE_CHECKING:
        rpm: FloatArray
        frequency_hz: FloatArray
        growth_per_s: FloatArray

    def at(self, rpm: npt.ArrayLike) -> tuple[Any, Any]:
        """Frequency in Hz and growth rate in 1/s at speeds, linear between those of the report.

        NaN before the first and past the last speed of the branch.
        """
        speeds = np.asarray(rpm, float)
        return (
            _between(speeds, self.rpm, self.frequency_hz),
            _between(speeds, self.rpm, self.growth_per_s),
        )


def _between(at: Any, places: FloatArray, values: FloatArray) -> FloatArray:
    """Linear interpolation, NaN outside but for what rounding puts there."""
    width = 1e-9 * (abs(places[-1]) + abs(places[0])) if len(places) else 0.0
    inside = (at >= places[0] - width) & (at <= places[-1] + width)
    return np.where(inside, np.interp(at, places, values), np.nan)
