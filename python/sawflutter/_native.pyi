"""The compiled part: scenes, options and reports as JSON."""

import os
from collections.abc import Callable, Sequence
from typing import SupportsFloat, SupportsIndex, TypeAlias, final

__all__ = [
    "Map",
    "Study",
    "StudyLog",
    "analyze",
    "campbell_csv",
    "chart",
    "check",
    "compare",
    "cut",
    "deflect",
    "fit",
    "functions_at",
    "gap",
    "matrices",
    "modes",
    "number",
    "outlines",
    "page",
    "palette",
    "panic",
    "paper",
    "picture",
    "place",
    "processor",
    "program",
    "read_scene",
    "read_text",
    "response",
    "runup",
    "scene",
    "schema",
    "summary",
    "tradeoff",
    "vtk_files",
    "washboard",
]

# The arguments are the finished steps, their total, and their name.
_Progress: TypeAlias = Callable[[int, int, str], object] | None
# A path of the scene, and its bounds unless they are the default ones.
_Bounds: TypeAlias = tuple[str, tuple[float, float] | None]

def scene(text: str) -> str: ...
def outlines(text: str) -> list[list[list[float]]]: ...
def number(path: str, text: str) -> float | None: ...
def paper() -> str: ...
def read_scene(path: str | os.PathLike[str]) -> str: ...
def read_text(path: str | os.PathLike[str], table: bool) -> str: ...
def schema() -> str: ...
def program(arguments: Sequence[str]) -> int: ...
def panic() -> None: ...
def processor() -> str: ...
def analyze(
    scene: str,
    *,
    sensitivity: bool = False,
    amplitude: bool = False,
    shapes_at_rpm: Sequence[float] | None = None,
    progress: _Progress = None,
) -> str: ...
def compare(
    saws: Sequence[tuple[str, str, bool]], *, progress: _Progress = None
) -> str: ...
def modes(scene: str, at_rpm: Sequence[float], *, progress: _Progress = None) -> str: ...
def check(
    scene: str,
    *,
    operating_rpm: SupportsFloat | None = None,
    margin: SupportsFloat = 0.85,
    min_flutter_rpm: SupportsFloat | None = None,
    min_critical_rpm: SupportsFloat | None = None,
    max_rim_m_per_s: SupportsFloat = 100.0,
    max_amplitude_mm: SupportsFloat | None = None,
    accept_unusual: bool = False,
    progress: _Progress = None,
) -> str: ...
def deflect(
    scene: str,
    *,
    force_n: SupportsFloat | None = None,
    angle_deg: SupportsFloat | None = None,
    to_rpm: SupportsFloat | None = None,
    progress: _Progress = None,
) -> str: ...
def response(
    scene: str,
    *,
    rpm: SupportsFloat | None = None,
    to_hz: SupportsFloat | None = None,
    progress: _Progress = None,
) -> str: ...
def gap(
    scene: str,
    *,
    force_n: SupportsFloat | None = None,
    rpm: SupportsFloat | None = None,
    max_deviation_mm: SupportsFloat | None = None,
    oscillating_force_n: SupportsFloat | None = None,
    oscillating_order: int = 1,
    friction: SupportsFloat | None = None,
    heat_share: SupportsFloat = 1.0,
    convection_w_per_m2_k: SupportsFloat = 60.0,
    conductivity_w_per_m_k: SupportsFloat = 45.0,
    progress: _Progress = None,
) -> str: ...
def cut(scene: str, rpm: Sequence[float], *, progress: _Progress = None) -> str: ...
def runup(scene: str, *, progress: _Progress = None) -> str: ...
def washboard(
    scene: str, rpm: SupportsFloat | None = None, *, progress: _Progress = None
) -> str: ...
def fit(
    scene: str,
    measured: tuple[str, str] | None,
    free: Sequence[_Bounds],
    *,
    to_rpm: SupportsFloat | None = None,
    confidence: SupportsFloat = 0.95,
    starts: SupportsIndex = 12,
    seed: SupportsIndex = 0,
    progress: _Progress = None,
) -> str: ...
def place(
    scene: str,
    free: Sequence[_Bounds],
    *,
    goal: str = "flutter",
    min_critical_rpm: SupportsFloat | None = None,
    amplitude_mm: SupportsFloat | None = None,
    max_deviation_mm: SupportsFloat | None = None,
    force_n: SupportsFloat | None = None,
    samples: SupportsIndex = 64,
    refine: SupportsIndex = 60,
    map: SupportsIndex = 17,
    radius_tolerance_m: SupportsFloat = 0.002,
    angle_tolerance_deg: SupportsFloat = 1.0,
    guide_tolerance_share: SupportsFloat = 0.1,
    other_tolerance_share: SupportsFloat = 0.01,
    progress: _Progress = None,
) -> str: ...
def tradeoff(scene: str, *, progress: _Progress = None) -> str: ...
def matrices(
    scene: str, *, basis: tuple[SupportsIndex, SupportsIndex] | None = None
) -> tuple[dict[str, bytes], int, int]: ...
def functions_at(
    scene: str,
    basis: tuple[SupportsIndex, SupportsIndex],
    radius_m: Sequence[float],
    angle_rad: Sequence[float],
) -> bytes: ...
def picture(command: str, name: str, report: str) -> bytes | None: ...
def summary(command: str, report: str) -> str: ...
def chart(command: str, name: str, report: str) -> str | None: ...
def campbell_csv(report: str) -> str: ...
def palette() -> str: ...
def page(command: str, report: str) -> str | None: ...
def vtk_files(report: str) -> list[tuple[str, str]]: ...

@final
class Map:
    def __new__(
        cls,
        scene: str,
        x: tuple[str, float, float],
        y: tuple[str, float, float] | None = None,
        *,
        points: SupportsIndex | None = None,
        rpm: SupportsFloat | None = None,
        to_rpm: SupportsFloat | None = None,
    ) -> Map: ...
    @property
    def study(self) -> str: ...
    def report(self, folder: str | os.PathLike[str]) -> str: ...

@final
class Study:
    def __new__(cls, scene: str, study: str) -> Study: ...
    @property
    def count(self) -> int: ...
    def values(self, index: int) -> list[float]: ...
    def rows(self, ranges: Sequence[tuple[int, int]], *, progress: _Progress = None) -> bytes: ...
    def failed(self, index: int, reason: str) -> bytes: ...
    def run(self, folder: str | os.PathLike[str], *, progress: _Progress = None) -> None: ...
    def log(self, folder: str | os.PathLike[str]) -> StudyLog: ...
    def sum_up(
        self,
        folder: str | os.PathLike[str],
        csv: str | os.PathLike[str],
        parquet: str | os.PathLike[str],
    ) -> list[tuple[str, bytes]]: ...

@final
class StudyLog:
    @property
    def done(self) -> int: ...
    def missing(self, first: int, most: int) -> tuple[int, int] | None: ...
    def append(self, rows: bytes) -> int: ...
    def append_processor(self, name: str) -> None: ...
    def close(self) -> None: ...
