"""Comparison of saws."""

from __future__ import annotations

from collections.abc import Iterable

from . import _native
from ._progress import Progress, reporting
from ._report_types import CompareReport
from ._result import Result
from .errors import warned
from .results import CampbellResults
from .scene import Scene, _scene


class CompareResults(Result, CompareReport):
    """Comparison of several saws: critical speeds, flutter, bands, stiffness at the rim, and the
    differences between their scenes. Its chart overlays their Campbell diagrams."""

    _command, _rows_of = "compare", "saws"

    def _answer(self) -> str:
        speeds = ((saw.name, saw.flutter_rpm) for saw in self.saws)
        found = ((name, "no flutter" if rpm is None else f"flutter from {rpm:.0f} rpm") for name, rpm in speeds)
        return "; ".join(f"{name}: {said}" for name, said in found)

    def _warnings(self) -> tuple[str, ...]:
        return tuple(f"{saw.name}: {text}" for saw in self.saws for text in saw.warnings)


def compare(
    *saws: Scene | CampbellResults,
    names: Iterable[str] | None = None,
    progress: Progress = None,
) -> CompareResults:
    """Compares saws with the first of them, as the program's ``compare`` does.

    Parameters
    ----------
    *saws : Scene or CampbellResults
        Two or more scenes or charts. Scenes are charted first, those without a sweep over the same
        speeds.
    names : iterable of str, optional
        Labels of the saws; by default their names, numbered.
    progress : bool or callable, optional
        As of :meth:`Scene.run_campbell`.

    Examples
    --------
    >>> import sawflutter as sf
    >>> saw = sf.Scene.paper().with_accuracy("draft")
    >>> thin = saw.replace({"blade.thickness_m": "2.6 mm"})
    >>> found = sf.compare(saw, thin, names=["saw", "thin"])
    >>> [saw.name for saw in found.saws]
    ['saw', 'thin']
    >>> found.differences[0].path, found.differences[0].values
    ('blade.thickness_m', ('0.0028', '0.0026'))
    """
    if len(saws) < 2:
        raise ValueError(f"a comparison needs two saws, not {len(saws)}")
    for place, saw in enumerate(saws):
        if not isinstance(saw, CampbellResults):
            _scene(f"saws[{place}]", saw)
    if names is None:
        named = [f"{number} {_name(saw)}" for number, saw in enumerate(saws, 1)]
    else:
        named = [str(name) for name in names]
    if len(named) != len(saws):
        raise ValueError(f"there are {len(saws)} saws, but {len(named)} names")
    texts = [(name, saw.to_json(), isinstance(saw, Result)) for name, saw in zip(named, saws)]
    with reporting(progress, "saws") as native:
        result = CompareResults._from_json(_native.compare(texts, progress=native))
    warned(result._warnings())
    return result


def _name(saw: Scene | CampbellResults) -> str:
    return str(saw._scene["name"]) if isinstance(saw, Result) else saw.name
