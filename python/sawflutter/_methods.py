"""Methods of the parts of a report."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._entry import ComplexArray, Entry, FloatArray
from ._values import Number, numbers
from .errors import refused

if TYPE_CHECKING:
    from ._report_types import Branch, Instability, Shape, Wave

# Smaller growth rates are rounding of the eigenvalues, as in the program's figures.
NEGLIGIBLE_PER_S = 1e-3


class RestModeMethods(Entry):
    """Methods of a mode at rest."""

    if TYPE_CHECKING:
        profiles: tuple[Shape, ...]

    def shape(self, radius_m: npt.ArrayLike, angle_deg: npt.ArrayLike) -> FloatArray:
        """Deflection at ``radius_m`` and ``angle_deg`` as in :meth:`Mode.shape`, with a maximum of one, of
        the shape of both."""
        radius, theta = points(radius_m, angle_deg)
        total = np.zeros(radius.shape)
        for part in self.profiles:
            n = part.nodal_diameters
            total += _profile(radius, part.radius_m, part.cosine) * np.cos(n * theta)
            total += _profile(radius, part.radius_m, part.sine) * np.sin(n * theta)
        return total


class ModeMethods(Entry):
    """Methods of a mode at a speed."""

    if TYPE_CHECKING:
        frequency_hz: float
        growth_per_s: float
        radius_m: FloatArray
        harmonics: tuple[Wave, ...]

    def shape(self, radius_m: npt.ArrayLike, angle_deg: npt.ArrayLike) -> ComplexArray:
        """Complex deflection in the fixed frame, of any scale; the real part of its product with e^(iωt) is
        the motion.

        Parameters
        ----------
        radius_m, angle_deg : array_like
            Distances from the axis and angles from the cut, positive with the rotation; they are
            broadcast against each other.

        Returns
        -------
        ndarray of complex
            The deflection in the shape of both.

        Raises
        ------
        ArgumentError
            A radius is beside the blade.
        """
        radius, theta = points(radius_m, angle_deg)
        total = np.zeros(radius.shape, complex)
        for wave in self.harmonics:
            n = wave.nodal_diameters
            for part, turn in ((wave.cosine, np.cos(n * theta)), (wave.sine, np.sin(n * theta))):
                real = _profile(radius, self.radius_m, part.re)
                imaginary = _profile(radius, self.radius_m, part.im)
                total += (real + 1j * imaginary) * turn
        return total

    def deflection(
        self, radius_m: npt.ArrayLike, angle_deg: npt.ArrayLike, time_s: Number
    ) -> FloatArray:
        """Real deflection at ``radius_m`` and ``angle_deg`` as in :meth:`shape`, at ``time_s`` and
        without growth: Re(shape · e^(iωt)), of the shape of all three."""
        turned = self.shape(radius_m, angle_deg) * np.exp(2j * np.pi * self.frequency_hz * numbers("time_s", time_s))
        return np.asarray(turned.real)


class BranchMethods(Entry):
    """Methods of a branch of the Campbell diagram."""

    if TYPE_CHECKING:
        rpm: FloatArray
        frequency_hz: FloatArray
        growth_per_s: FloatArray

    # Speeds at which a band of this branch begins or ends, and the side of them on which it lies.
    _edges: tuple[tuple[float, int], ...] = ()

    def at(self, rpm: Any) -> tuple[Any, Any]:
        """Frequency in Hz and growth rate in 1/s at speeds, by monotone cubics between those of the
        report, and NaN outside them. At the edges of the bands in which the branch grows the growth
        rate is zero, and its square is smooth. Of the built-in saw, damped or in its cut, 99 of 100
        values are within 0.06 Hz and 0.1 1/s of the modes, of lines within 0.14 Hz and 0.6 1/s; where
        modes of a saw with material damping merge, the errors are larger. :meth:`Scene.modes` gives
        modes without interpolation.

        Returns
        -------
        (ndarray, ndarray)
            Both in the shape of ``rpm``.

        Examples
        --------
        >>> import sawflutter as sf
        >>> r = sf.Scene.paper().run_campbell(accuracy="draft")
        >>> band = r.bands[0]
        >>> growing = r.branches[band.branches[0] - 1]
        >>> [bool(growing.at(rpm)[1] > 0) for rpm in (band.from_rpm - 1, band.peak_rpm)]
        [False, True]
        """
        speeds = numbers("rpm", rpm)
        places, growth = self._growth()
        square = _between(speeds, places, growth * np.abs(growth), _monotone)
        hz = _between(speeds, self.rpm, self.frequency_hz, _monotone)
        return hz, np.asarray(np.sign(square) * np.sqrt(np.abs(square)))

    def _growth(self) -> tuple[FloatArray, FloatArray]:
        """Growth rates over speed, with the edges of the bands."""
        rows = dict(zip(self.rpm.tolist(), self.growth_per_s.tolist()))
        for edge, side in self._edges:
            right = int(np.searchsorted(self.rpm, edge))
            if not 0 < right < len(self.rpm) or edge in rows:
                continue
            before, past = self.growth_per_s[right - 1 : right + 1]
            inside, outside = (past, before) if side > 0 else (before, past)
            # A damped branch that does not grow in the band also decays at its edge.
            if inside > 0.0 or abs(outside) < NEGLIGIBLE_PER_S:
                rows[edge] = 0.0
        speeds = np.array(sorted(rows))
        return speeds, np.array([rows[speed] for speed in speeds.tolist()])


def know_bands(branches: Sequence[Branch], bands: Iterable[Instability]) -> None:
    """Gives branches the edges of the bands in which they become unstable."""
    for band in bands:
        for number in band.branches:
            branch = branches[number - 1]
            edges = ((band.from_rpm, 1), (band.to_rpm, -1))
            object.__setattr__(branch, "_edges", (*branch._edges, *edges))


def points(radius_m: npt.ArrayLike, angle_deg: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Points of the blade, broadcast against each other; the angles in radians."""
    radius, angle = np.broadcast_arrays(numbers("radius_m", radius_m), numbers("angle_deg", angle_deg))
    return radius, np.radians(angle)


def _profile(radius: FloatArray, places: FloatArray, values: FloatArray) -> FloatArray:
    """Values along the radius of the blade."""
    found = _between(radius, places, values)
    if np.isnan(found).any():
        allowed = f"from {places[0]:.9g} to {places[-1]:.9g}, the radii of the blade"
        raise refused("radius_m", float(radius[np.isnan(found)].flat[0]), allowed, "name a point of the blade")
    return found


def _between(at: Any, places: FloatArray, values: FloatArray, curve: Any = np.interp) -> FloatArray:
    """Interpolation, linear by default, with NaN outside the range, apart from rounding at its ends."""
    width = 1e-9 * (abs(places[-1]) + abs(places[0])) if len(places) else 0.0
    inside = (at >= places[0] - width) & (at <= places[-1] + width)
    return np.where(inside, curve(at, places, values), np.nan)


def _monotone(at: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Cubics of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5 (1984), 300), which have no
    extremum between the points."""
    if len(x) < 3:
        return np.asarray(np.interp(at, x, y))
    h = np.diff(x)
    steep = np.diff(y) / h
    before, after = 2.0 * h[1:] + h[:-1], h[1:] + 2.0 * h[:-1]
    slopes = np.zeros(len(x))
    same = steep[:-1] * steep[1:] > 0.0
    mean = before[same] / steep[:-1][same] + after[same] / steep[1:][same]
    slopes[1:-1][same] = (before + after)[same] / mean
    for end, first, second in ((0, 0, 1), (-1, -1, -2)):
        slope = steep[first] + (steep[first] - steep[second]) * h[first] / (h[first] + h[second])
        # Toward the next point, and at most three times as steep.
        slopes[end] = np.clip(slope, *sorted((0.0, 3.0 * steep[first])))
    k = np.clip(np.searchsorted(x, at) - 1, 0, len(x) - 2)
    t, width = np.clip((at - x[k]) / h[k], 0.0, 1.0), h[k]
    left = (1.0 - t) ** 2 * ((1.0 + 2.0 * t) * y[k] + t * width * slopes[k])
    right = t**2 * ((3.0 - 2.0 * t) * y[k + 1] + (t - 1.0) * width * slopes[k + 1])
    return np.asarray(left + right)
