"""Results as labelled arrays of xarray."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ._extras import extra

if TYPE_CHECKING:
    import xarray as xr

    from .maps import MapResults
    from .results import CampbellResults


def of_chart(report: CampbellResults) -> xr.Dataset:
    """Branches over the speed; NaN where a branch has no point."""
    with extra("xarray"):
        import xarray as xr

    branches = report.branches
    rpm = np.unique(np.concatenate([branch.rpm for branch in branches] or [np.empty(0)]))
    units = {"frequency_hz": "Hz", "body_frequency_hz": "Hz", "growth_per_s": "1/s", "krein_sign": ""}
    variables = {}
    for name, unit in units.items():
        table = np.full((len(branches), len(rpm)), np.nan)
        for row, branch in zip(table, branches):
            row[np.searchsorted(rpm, branch.rpm)] = getattr(branch, name)
        variables[name] = (("branch", "rpm"), table, {"units": unit})
    coordinates = {
        "branch": [branch.branch for branch in branches],
        "rpm": ("rpm", rpm, {"units": "rpm"}),
        "name": ("branch", [branch.name for branch in branches]),
    }
    return xr.Dataset(variables, coordinates, {"scene": report.scene["name"]})


def of_map(report: MapResults) -> xr.Dataset:
    """Speeds and states over the numbers of the axes."""
    with extra("xarray"):
        import xarray as xr

    axes = [report.x] if report.y is None else [report.y, report.x]
    names = [axis.path for axis in axes]
    states = [saw.state or "" for saw in report.saws]
    variables = {
        "lowest_critical_rpm": (names, report.lowest_critical_rpm, {"units": "rpm"}),
        "flutter_rpm": (names, report.flutter_rpm, {"units": "rpm"}),
        "state": (names, np.reshape(np.array(states), report.shape)),
    }
    coordinates = {
        axis.path: (axis.path, axis.values, {"units": axis.unit, "long_name": axis.name})
        for axis in axes
    }
    attributes = {"scene": report.scene["name"], "to_rpm": report.to_rpm}
    if report.rpm is not None:
        attributes["rpm"] = report.rpm
    return xr.Dataset(variables, coordinates, attributes)
