"""A saw held against limits."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._report_types import CheckReport, Criterion
from ._result import Result
from ._table import frame

if TYPE_CHECKING:
    import pandas as pd

    from .plot.chart import Chart


class CheckResults(Result, CheckReport):
    """A saw held against limits. Its truth is :attr:`passed`, so that ``assert saw.check(...)`` fails
    where a limit is not kept, and pytest shows which.
    """

    command = "check"
    figure_names = ("check.svg", "check.png")

    def __bool__(self) -> bool:
        return self.passed

    @property
    def failures(self) -> tuple[str, ...]:
        """Numbers that no saw has, unless they were accepted, and names of the limits that are not
        kept.

        Examples
        --------
        >>> import sawflutter as sf
        >>> check = sf.Scene.paper().check(operating_rpm=1400, accuracy="draft")
        >>> check.failures
        ('85 % rule',)
        """
        unusual = () if self.accept_unusual else self.unusual_numbers
        return unusual + tuple(c.name for c in self.criteria if not c.passed)

    def to_dataframe(self) -> pd.DataFrame:
        """One row a limit; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            Where pandas is missing: it says how it is installed.

        Examples
        --------
        >>> import sawflutter as sf
        >>> check = sf.Scene.paper().check(operating_rpm=1400, accuracy="draft")
        >>> bool(check.to_dataframe()["passed"].all())
        False
        """
        return frame(self.criteria)

    def chart(self) -> Chart:
        """Speeds that were asked for and found.

        Returns
        -------
        sawflutter.plot.Chart

        Examples
        --------
        >>> import sawflutter as sf
        >>> check = sf.Scene.paper().check(operating_rpm=1400, accuracy="draft")
        >>> check.chart().panels[0].y_names[-1]
        '85 % rule'
        """
        from .plot.design import check

        return check(self, self._facts())

    def _facts(self) -> str:
        broken = (_missed(criterion) for criterion in self.criteria if not criterion.passed)
        found = "passed" if self.passed else f"failed: {'; '.join(broken)}"
        return f"{found}, at {self.operating_rpm:.0f} rpm"


def _missed(criterion: Criterion) -> str:
    """A limit that is not kept, in the words of the program."""
    return f"{criterion.name}: {criterion.finding}"
