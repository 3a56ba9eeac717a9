"""Modes at several speeds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ._entry import Entry, FloatArray, IntArray, array
from ._extras import entries
from ._report_types import Mode

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False, repr=False)
class Modes(Entry):
    """Modes at several speeds, from one basis, with one row for each speed, ascending by
    frequency. Rows with fewer modes are filled with NaN, and with 0 for Krein signs."""

    rpm: FloatArray
    """Speeds."""

    frequency_hz: FloatArray
    """Frequencies, of the shape (speeds, modes)."""

    growth_per_s: FloatArray
    """Growth rates, of the same shape."""

    krein_sign: IntArray
    """Krein signs, of the same shape; 0 where a mode has none."""

    modes: tuple[tuple[Mode, ...], ...]
    """The modes themselves, with their shapes, of each speed."""

    @classmethod
    def of(cls, rpm: npt.ArrayLike, modes: list[list[dict[str, object]]]) -> Modes:
        """The table of the library's report for each speed.

        Parameters
        ----------
        rpm : array_like
            The speeds.
        modes : list
            The modes at each of them, as in the JSON.

        Returns
        -------
        Modes

        Examples
        --------
        >>> import sawflutter as sf
        >>> sf.Modes.of([], []).rpm.shape
        (0,)
        """
        found = tuple(tuple(map(Mode.from_dict, at)) for at in modes)

        def table(of: str) -> FloatArray:
            return array([[getattr(mode, of) for mode in at] for at in found])

        signs = array(np.nan_to_num(table("krein_sign")), np.int64)
        speeds, hz, growth = array(np.ravel(rpm)), table("frequency_hz"), table("growth_per_s")
        return cls(speeds, hz, growth, signs, found)

    def to_dataframe(self) -> pd.DataFrame:
        """One row for each speed and mode with speed, frequency, growth rate, Krein sign,
        direction and the dominant number of nodal diameters; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            If pandas is missing; the message says how to install it.

        Examples
        --------
        >>> import sawflutter as sf
        >>> found = sf.Scene.paper().with_accuracy("draft").modes([0, 500])
        >>> sorted(set(found.to_dataframe()["rpm"].round(6)))
        [0.0, 500.0]
        """
        modes = [mode for at in self.modes for mode in at]
        table = entries(modes)
        table["nodal_diameters"] = [mode.harmonics[0].nodal_diameters for mode in modes]
        return table
