"""Comparison of saws."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, overload

from . import _native
from ._extras import entries
from ._progress import Progress, reporting
from ._report_types import CompareReport
from ._result import Result
from .errors import refused, warned
from .results import CampbellResults
from .scene import Scene, _scene

if TYPE_CHECKING:
    import pandas as pd

Compared: TypeAlias = "Scene | CampbellResults"


class CompareResults(Result, CompareReport):
    """Comparison of several saws: critical speeds, flutter, bands, stiffness at the rim, and the
    differences between their scenes. Its chart overlays their Campbell diagrams."""

    _command = "compare"

    def to_dataframe(self) -> pd.DataFrame:
        """A row for each saw with its name, first critical speed, flutter speed, number of bands, verdict
        (yes, at_risk, no) with its cause, and stiffness at the rim; needs pandas.

        Returns
        -------
        pandas.DataFrame
        """
        table = entries(self.saws)
        table.insert(4, "bands", [len(saw.bands) for saw in self.saws])
        table.insert(5, "verdict", [saw.verdict.answer for saw in self.saws])
        table.insert(6, "cause", [saw.verdict.cause for saw in self.saws])
        return table

    def _answer(self) -> str:
        speeds = ((saw.name, saw.flutter_rpm) for saw in self.saws)
        found = ((name, "no flutter" if rpm is None else f"flutter from {rpm:.0f} rpm") for name, rpm in speeds)
        return "; ".join(f"{name}: {said}" for name, said in found)

    def _warnings(self) -> tuple[str, ...]:
        return tuple(f"{saw.name}: {text}" for saw in self.saws for text in saw.warnings)


@overload
def compare(
    *saws: Compared, names: Iterable[str] | None = None, progress: Progress = None
) -> CompareResults: ...
@overload
def compare(
    saws: Iterable[Compared] | Mapping[str, Compared], /, *, names: Iterable[str] | None = None,
    progress: Progress = None,
) -> CompareResults: ...  # fmt: skip
def compare(*saws: Any, names: Iterable[str] | None = None, progress: Progress = None) -> CompareResults:
    """Compares saws with the first of them, as the program's ``compare`` does.

    Parameters
    ----------
    *saws : Scene or CampbellResults
        Two or more scenes or charts, also as one list of them, or as one dict of them by their labels.
        Scenes are charted first, those without a sweep over the same speeds.
    names : iterable of str, optional
        Labels of the saws; by default their names, with a number where two of them are the same.
    progress : bool or callable, optional
        As of :meth:`Scene.run_campbell`.

    Returns
    -------
    CompareResults

    Raises
    ------
    ArgumentError
        There are fewer than two saws, or not as many names as saws.
    AnalysisError
        A saw cannot be analysed; the message names it.

    Examples
    --------
    >>> import sawflutter as sf
    >>> saw = sf.Scene.paper().with_accuracy("draft")
    >>> thin = saw.replace({"blade.thickness_m": "2.6 mm"})
    >>> found = sf.compare({"saw": saw, "thin": thin})
    >>> [saw.name for saw in found.saws]
    ['saw', 'thin']
    >>> found.differences[0].path, found.differences[0].values
    ('blade.thickness_m', ('0.0028', '0.0026'))
    """
    given: Sequence[Any] = saws
    if len(saws) == 1 and not isinstance(saws[0], (Scene, CampbellResults)):
        (group,) = saws
        if isinstance(group, Mapping):
            names = list(group) if names is None else names
            given = list(group.values())
        elif isinstance(group, Iterable):
            given = list(group)
    for place, saw in enumerate(given):
        if not isinstance(saw, CampbellResults):
            _scene(f"saws[{place}]", saw)
    if len(given) < 2:
        raise refused("saws", len(given), "two saws or more", "write it like compare(saw, other) or compare([saw, other])")
    named = _distinct([_name(saw) for saw in given]) if names is None else [str(name) for name in names]
    if len(named) != len(given):
        raise refused("names", len(named), f"{len(given)}, one for each saw", "give each saw a name")
    texts = [(name, saw.to_json(), isinstance(saw, Result)) for name, saw in zip(named, given)]
    with reporting(progress, "saws") as native:
        result = CompareResults._from_json(_native.compare(texts, progress=native))
    warned(result._warnings())
    return result


def _name(saw: Scene | CampbellResults) -> str:
    return str(saw._scene["name"]) if isinstance(saw, Result) else saw.name


def _distinct(names: Sequence[str]) -> list[str]:
    """The names, each with the number of its place where an earlier one is the same."""
    return [f"{name} {place}" if name in names[: place - 1] else name for place, name in enumerate(names, 1)]
