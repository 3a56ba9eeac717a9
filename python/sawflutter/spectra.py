"""Spectra at one speed: of a tap test, or a frequency response."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from . import _files, _native
from ._channels import even_step
from ._drawn import Drawn
from ._entry import ComplexArray, Entry, FloatArray, array
from ._extras import extra
from ._values import Number, optional
from .errors import ArgumentError, InputError, refused
from .peaks import Peaks
from .plot.chart import Chart
from .plot.described import read

if TYPE_CHECKING:
    from .records import Record
    from .scene import Scene

# The exponential window falls to this value at its end.
_END = 0.01
# Fewest samples of a decay, and fewest lines of a frequency response.
_FEWEST = 16
# One spectrum is independent of all others.
_APART = 4.0


@dataclass(frozen=True, eq=False, repr=False)
class Spectrum(Drawn, Entry):
    """Amplitude over frequency at one speed. :meth:`Record.spectrum` makes one of a tap test,
    :func:`read_frf` reads a frequency response.

    Attributes
    ----------
    frequency_hz : frequencies in space, ascending, of the shape (frequencies).
    response : complex amplitudes, of the same shape.
    rpm : rotation speed.
    resolution_hz : distance below which two peaks are one.
    unit : unit of the response.
    name : name of the record or of the frequency response.
    """

    frequency_hz: FloatArray
    response: ComplexArray
    rpm: float
    resolution_hz: float
    unit: str
    name: str

    def peaks(
        self, *, orders: Iterable[Number] = (1, 2, 3, 4), above_db: Number = 12.0
    ) -> Peaks:
        """Peaks of the magnitude, as frequencies of modes. Two modes with a distance below their
        half-power width, or below the resolution, give one peak, and a mode that the probe or the
        tap does not excite gives none. Damping shifts the peak of a deflection by the square of the
        damping ratio, which is neglected.

        Parameters
        ----------
        orders, above_db
            As in :meth:`Waterfall.peaks`. A saw at rest has no orders.
        """
        spectra = [(self.rpm, np.abs(self.response))]
        return Peaks._picked(self, _APART, spectra, orders, above_db)

    def chart(self, saw: Scene | None = None, peaks: Peaks | None = None) -> Chart:
        """Level over frequency, with the computed frequencies of a ``saw`` at this speed as vertical
        lines, and picked ``peaks`` as rings."""
        computed = None if saw is None else (saw.name, saw.modes(self.rpm).frequency_hz)
        return read(_native.spectrum_chart(self, np.abs(self.response), computed, peaks))

    def __repr__(self) -> str:
        lines = f"{len(self.frequency_hz)} lines up to {self.frequency_hz[-1]:.0f} Hz"
        return f"<Spectrum {self.name!r}: {lines}, at {self.rpm:.0f} rpm>"


def read_frf(
    path: str | os.PathLike[str], *, rpm: Number | None = None, number: int = 0
) -> Spectrum:
    """Reads a frequency response from a table or from a universal file with a data set 58 of type 4.

    A table has named columns: frequency, real and imaginary part; or frequency, magnitude, also as a
    level in dB, and phase, which may be missing. Units are read from the names, such as ``f_hz``,
    ``FRF [dB re 1 mm/N]``, ``phase [deg]``.

    Parameters
    ----------
    path : str or path
        The file: .csv (.txt, .tsv, .dat, .lvm), .uff (.unv, .uf).
    rpm : float, optional
        Rotation speed; by default that on the z axis of the data set, or 0, at rest.
    number : int
        Number of the frequency response in the file, from 0.
    """
    found = _files.read_responses(path)
    if not 0 <= number < len(found):
        names = ", ".join(f"{place} ({of.name})" for place, of in enumerate(found))
        raise refused("number", number, f"a frequency response of {path}", f"it has {names}")
    of = found[number]
    given = optional("rpm", rpm)
    speed = given if given is not None else of.rpm or 0.0
    if not speed >= 0.0:
        raise refused("rpm", speed, "0 or more", "give the rotation speed in rpm")
    if not (np.isfinite(of.frequency_hz).all() and np.isfinite(of.response).all()):
        raise InputError(f"{path} has numbers that are not finite; remove these frequencies")
    steps = np.diff(of.frequency_hz)
    step = even_step(of.frequency_hz)
    if len(steps) < _FEWEST or step is None:
        with_steps = f" with steps from {steps.min():g} to {steps.max():g} Hz" if len(steps) else ""
        raise InputError(
            f"{path} has {len(of.frequency_hz)} frequencies{with_steps}, but must have more than {_FEWEST} at "
            "even steps; resample it"
        )
    response = array(of.response, np.complex128)
    return Spectrum(array(of.frequency_hz), response, speed, 2.0 * step, of.unit, of.name)


def after_tap(record: Record, to_hz: float) -> Spectrum:
    """The spectrum of a record from its largest deflection on."""
    with extra("records"):
        from scipy.fft import next_fast_len, rfft

    rate_hz = record.rate_hz
    from_mean = record.samples - np.median(record.samples)
    begin = int(np.abs(from_mean).argmax())
    decay = from_mean[begin:]
    if len(decay) < _FEWEST:
        given = f"largest at {begin / rate_hz:g} s of {record.time_s[-1]:g} s"
        allowed = f"followed by at least {_FEWEST} samples"
        remedy = "give the time after the tap as well, or a part by between()"
        message = f"the samples of {record.name} are {given}, but this must be {allowed}; {remedy}"
        raise ArgumentError(message, "samples", given, allowed, remedy)
    window = _END ** np.linspace(0.0, 1.0, len(decay))
    size = next_fast_len(2 * len(decay), real=True)
    frequency_hz = np.fft.rfftfreq(size, 1.0 / rate_hz)
    kept = int(np.searchsorted(frequency_hz, to_hz, side="right"))
    response = 2.0 / window.sum() * rfft(window * decay, size)[:kept]
    # A decay by σ has a peak of the width √3 σ/π at half its height.
    width = np.sqrt(3.0) / np.pi * -np.log(_END) * rate_hz / len(decay)
    return Spectrum(
        array(frequency_hz[:kept]),
        array(response, np.complex128),
        float(record.rpm.mean()),
        float(width),
        record.unit,
        record.name,
    )
