"""Checks of a saw against limits."""

from __future__ import annotations

from ._report_types import CheckReport
from ._result import Result


class CheckResults(Result, CheckReport):
    """Check of a saw against limits. It is true if :attr:`passed`, so ``assert saw.check(...)``
    fails if a limit is violated, and pytest shows which.
    """

    _command, _rows_of = "check", "verdict.limits"

    def __bool__(self) -> bool:
        return self.passed

    @property
    def failures(self) -> tuple[str, ...]:
        """Implausible numbers, unless they were accepted, and names of the violated limits."""
        unusual = () if self.accept_unusual else self.unusual_numbers
        return unusual + tuple(c.name for c in self.verdict.limits if c.answer != "yes")

    def _answer(self) -> str:
        # Of a failed assertion pytest shows the first letters: the limits that are not kept.
        broken = [c for c in self.verdict.limits if c.answer != "yes"]
        told = "; ".join(f"{c.name}: {c.finding}" for c in broken)
        return f"failed at {self.operating_rpm:.0f} rpm: {told}" if told else super()._answer()
