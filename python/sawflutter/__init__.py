"""Stability of thin, fast, guided circular saws in the frequency domain.

>>> import sawflutter as sf
>>> saw = sf.Scene.paper().replace({"accuracy": "draft"})
>>> r = saw.run_campbell()
>>> round(r.first_critical_rpm), round(r.flutter_rpm), len(r.bands)
(1531, 2256, 11)
>>> saw.check(operating_rpm=1250).passed
True

The name of a number contains its unit. Reports equal those of the program to the last bit. ``saw`` is a
Scene, ``r`` a result; help(sf.Scene.run_campbell) has the arguments of a call. Every computation of a saw
takes ``accuracy`` or ``tolerance``, and every number may have a unit: "2.6 mm", "30 rev/s", or a quantity
of pint.

I want: the call

    a saw from a file, from a dict, or the built-in one
        sf.Scene.load(path), sf.Scene(data), sf.Scene.paper()
    a number of it, and the same saw with others
        saw["blade.thickness_m"], saw.replace({"blade.thickness_m": "2.6 mm"})
    the keys of a scene, with units and usual ranges
        print(sf.keys("guides")), sf.schema()
    a Campbell diagram, critical speeds, bands of instability
        r = saw.run_campbell(); r.branches, r.critical_rpm, r.flutter_rpm, r.bands
    speeds alone, for many similar saws and searches
        saw.speeds(beside=nominal)
    modes at a speed, their shapes
        saw.modes(1800), mode.shape(radius_m, angle_deg), saw.animate(mode)
    growth rates of many similar saws at a speed
        saw.modes(1800, beside=nominal).growth_per_s
    one page for a decision or a customer
        saw.run_report(customer="…").save("report.html")
    how thick, how stiff, how fast
        saw.size("blade.thickness_m").windows
    a verdict for a test suite
        assert saw.check(operating_rpm=1250)
    the saw in the wood, at a power
        saw.run_cut(2400, power_w="12 kW")
    a run-up, without a block in the scene
        saw.run_up(to_rpm=3000, duration_s=60)
    deflections over the speed, with jumps
        saw.run_deflect(force_n=5)
    steady states of run-out, imbalance, a side force
        saw.run_response(force_n="5 N")
    the response between points of one's own
        saw.matrices().response(rpm, hz, inputs=[(0.3, 0)], outputs=[(0.3, 90)])
    a history under forces of one's own
        saw.matrices().run_time_response(rpm, forces_n, times_s, inputs=…, outputs=…)
    a state space for control
        saw.matrices().state_space(rpm, inputs=…, outputs=…)
    eigenvalues of one's own
        numpy.linalg.eig(saw.matrices().companion(rpm))
    guides with a gap
        saw.run_gap(max_deviation_m=3e-4)
    waves on the board
        saw.run_washboard()
    a saw fitted to measured frequencies
        saw.fit("measured.csv").saw
    whether two blades differ in tension
        first_fit.differs_from(second_fit, "membrane.roll_tension[0].eigenstrain")
    how fast a measured saw may turn
        saw.measured_margin(peaks.rpm, peaks.frequency_hz, free)
    the best place of the guides, within tolerances
        saw.place().saw
    tolerances, many saws, a cluster
        sf.Study(saw, study).run(folder, executor=…)
    a map over one or two numbers
        saw.run_map(("blade.thickness_m", "2 mm", "3 mm"))
    critical speeds over the stiffness of the guides
        saw.run_stiffness_map([1e6, 1e7, 1e8])
    saws beside each other
        sf.compare(saw, other), sf.compare({"now": saw, "thin": other})
    what accuracy takes in time
        saw.tradeoff()
    a figure to change, or the program's own
        r.plot(), r.plot_matplotlib(ax), r.chart(name), r.figure("campbell.svg")
    a table, a file, a page to print
        r.to_dataframe(), r.save("r.json"), r.save("r.csv"), r.save("r.html"), r.save("r.svg")
    a report read again
        sf.load("r.json")
    records of a probe, peaks for a fit
        sf.read_record(path).waterfall().peaks().rows(saw)
    a record, to look at
        sf.read_record(path).plot()
    a frequency response of a tap test
        sf.read_frf(path).peaks()
"""

from __future__ import annotations

from importlib.metadata import version as _version
from types import ModuleType as _Module

from ._report_types import (
    Branch as Branch,
    CriticalSpeed as CriticalSpeed,
    Instability as Instability,
    Mode as Mode,
    RestMode as RestMode,
)
from ._result import Result as Result
from ._scene_types import SceneDict as SceneDict, StudyDict as StudyDict
from .checks import CheckResults as CheckResults
from .compared import CompareResults as CompareResults, compare as compare
from .designs import (
    DesignResults as DesignResults,
    FitResults as FitResults,
    FittedDifference as FittedDifference,
    PlaceResults as PlaceResults,
    SizeResults as SizeResults,
    Speeds as Speeds,
    StiffnessMap as StiffnessMap,
    TradeoffResults as TradeoffResults,
)
from .errors import (
    AnalysisError as AnalysisError,
    ArgumentError as ArgumentError,
    InputError as InputError,
    ModelWarning as ModelWarning,
    PathError as PathError,
    SceneError as SceneError,
    StudyError as StudyError,
)
from .maps import MapResults as MapResults
from .margins import MeasuredMargin as MeasuredMargin
from .matrices import Matrices as Matrices
from .modes import Modes as Modes
from .motions import (
    CutResults as CutResults,
    DeflectResults as DeflectResults,
    GapResults as GapResults,
    ResponseResults as ResponseResults,
    RunUpResults as RunUpResults,
    WashboardResults as WashboardResults,
)
from .peaks import Peaks as Peaks
from .record_files import read_record as read_record
from .records import Record as Record
from .results import CampbellResults as CampbellResults, load as load
from .scene import Scene as Scene, keys as keys, schema as schema
from .spectra import Spectrum as Spectrum, read_frf as read_frf
from .state_space import StateSpace as StateSpace
from .studies import StudyResults as StudyResults
from .study import Study as Study
from .waterfalls import Waterfall as Waterfall

__version__ = _version("sawflutter")


def __dir__() -> list[str]:
    """The public names. There is no ``__all__``, with which help() would list all classes in full below the
    table of calls."""
    own = (name for name, value in globals().items() if not (name.startswith("_") or isinstance(value, _Module)))
    return sorted({*own, "__doc__", "__version__", "errors"} - {"annotations"})
