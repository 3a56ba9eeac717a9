"""Stability of thin, fast, guided circular saws in the frequency domain.

>>> import sawflutter as sf
>>> saw = sf.Scene.paper().replace({"accuracy": "draft"})
>>> r = saw.run_campbell()
>>> r
<CampbellResults 'Guided spline arbor saw': lowest critical speed 1531 rpm, flutter from 2256 rpm, \
11 bands of instability from 0 to 3000 rpm>
>>> saw.check(operating_rpm=1250).passed
True

Numbers carry their units in their names. Reports are what the program writes, to the last bit.
"""

from __future__ import annotations

from importlib.metadata import version as _version

from . import _report_types, checks, designs, matrices, modes, motions, results, stiffness, studies
from ._entry import describe as _describe
from ._report_types import Branch, CriticalSpeed, Instability, Mode, RestMode
from ._scene_types import SceneDict, StudyDict
from .errors import (
    AnalysisError,
    ArgumentError,
    InputError,
    ModelWarning,
    PathError,
    SceneError,
    StudyError,
)
from .matrices import Matrices
from .modes import Modes
from .results import (
    CampbellResults,
    CheckResults,
    CutResults,
    DeflectResults,
    FitResults,
    PlaceResults,
    Result,
    RunUpResults,
    StudyResults,
    TradeoffResults,
    WashboardResults,
    load,
)
from .scene import Scene
from .stiffness import StiffnessMap
from .study import Study

for _module in (
    _report_types, checks, designs, matrices, modes, motions, results, stiffness, studies
):  # fmt: skip
    _describe(_module.__name__)

__version__ = _version("sawflutter")

__all__ = [
    "AnalysisError",
    "ArgumentError",
    "Branch",
    "CampbellResults",
    "CheckResults",
    "CriticalSpeed",
    "CutResults",
    "DeflectResults",
    "FitResults",
    "InputError",
    "Instability",
    "Matrices",
    "Mode",
    "ModelWarning",
    "Modes",
    "PathError",
    "PlaceResults",
    "RestMode",
    "Result",
    "RunUpResults",
    "Scene",
    "SceneDict",
    "SceneError",
    "StiffnessMap",
    "Study",
    "StudyDict",
    "StudyError",
    "StudyResults",
    "TradeoffResults",
    "WashboardResults",
    "load",
]
