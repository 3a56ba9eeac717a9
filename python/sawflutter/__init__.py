"""Stability of thin, fast, guided circular saws in the frequency domain.

>>> import sawflutter as sf
>>> saw = sf.Scene.paper().replace({"accuracy": "draft"})
>>> r = saw.run_campbell()
>>> round(r.first_critical_rpm), round(r.flutter_rpm), len(r.bands)
(1531, 2256, 11)
>>> saw.check(operating_rpm=1250).passed
True

The name of a number contains its unit. Reports equal those of the program to the last bit.
"""

from __future__ import annotations

from importlib.metadata import version as _version

from ._report_types import Branch, CriticalSpeed, Instability, Mode, RestMode
from ._result import Result
from ._scene_types import SceneDict, StudyDict
from .checks import CheckResults
from .compared import CompareResults, compare
from .designs import DesignResults, FitResults, FittedDifference, PlaceResults, SizeResults, Speeds, StiffnessMap, TradeoffResults
from .errors import (
    AnalysisError,
    ArgumentError,
    InputError,
    ModelWarning,
    PathError,
    SceneError,
    StudyError,
)
from .maps import MapResults
from .margins import MeasuredMargin, measured_margin
from .matrices import Matrices
from .modes import Modes
from .motions import CutResults, DeflectResults, GapResults, ResponseResults, RunUpResults, WashboardResults
from .peaks import Peaks
from .record_files import read_record
from .records import Record
from .results import CampbellResults, load
from .scene import Scene, keys, schema
from .spectra import Spectrum, read_frf
from .state_space import StateSpace
from .studies import StudyResults
from .study import Study
from .waterfalls import Waterfall

__version__ = _version("sawflutter")

__all__ = [
    "AnalysisError",
    "ArgumentError",
    "Branch",
    "CampbellResults",
    "CheckResults",
    "CompareResults",
    "CriticalSpeed",
    "CutResults",
    "DeflectResults",
    "DesignResults",
    "FitResults",
    "FittedDifference",
    "GapResults",
    "InputError",
    "Instability",
    "MapResults",
    "Matrices",
    "MeasuredMargin",
    "Mode",
    "ModelWarning",
    "Modes",
    "PathError",
    "Peaks",
    "PlaceResults",
    "Record",
    "RestMode",
    "Result",
    "ResponseResults",
    "RunUpResults",
    "Scene",
    "SceneDict",
    "SceneError",
    "Spectrum",
    "SizeResults",
    "Speeds",
    "StateSpace",
    "StiffnessMap",
    "Study",
    "StudyDict",
    "StudyError",
    "StudyResults",
    "TradeoffResults",
    "WashboardResults",
    "Waterfall",
    "compare",
    "keys",
    "load",
    "measured_margin",
    "read_frf",
    "read_record",
    "schema",
]


def __dir__() -> list[str]:
    return sorted([*__all__, "__doc__", "__version__", "errors"])
