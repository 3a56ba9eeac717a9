"""Checks of a saw against limits."""

from __future__ import annotations

from ._report_types import CheckReport
from ._result import Result


class CheckResults(Result, CheckReport):
    """Check of a saw against limits. It is true if :attr:`passed`, so ``assert saw.check(...)``
    fails if a limit is violated, and pytest shows which.
    """

    _command, _rows_of = "check", "criteria"

    def __bool__(self) -> bool:
        return self.passed

    @property
    def failures(self) -> tuple[str, ...]:
        """Implausible numbers, unless they were accepted, and names of the violated limits."""
        unusual = () if self.accept_unusual else self.unusual_numbers
        return unusual + tuple(c.name for c in self.criteria if not c.passed)

    def _answer(self) -> str:
        # Of a failed assertion pytest shows the first letters: the limits that are not kept.
        broken = "; ".join(f"{c.name}: {c.finding}" for c in self.criteria if not c.passed)
        return f"failed at {self.operating_rpm:.0f} rpm: {broken}" if broken else super()._answer()
