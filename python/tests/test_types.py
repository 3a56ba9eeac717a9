"""Generated types agree with those of the library."""

from __future__ import annotations

import json
import runpy
import sys
from pathlib import Path

import pytest

import sawflutter as sf
from sawflutter import _native, _report_types

GENERATOR = Path(__file__).resolve().parents[1] / "tools" / "generate_types.py"


def test_the_generated_types_are_up_to_date(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", [str(GENERATOR), "--check"])
    monkeypatch.syspath_prepend(str(GENERATOR.parent))
    with pytest.raises(SystemExit) as ended:
        runpy.run_path(str(GENERATOR), run_name="__main__")
    assert ended.value.code == 0, "run python/tools/generate_types.py"


def test_every_object_of_the_reports_has_a_class_with_a_docstring() -> None:
    reports = json.loads(_native.schema())["reports"]
    assert set(reports) == {
        "analyze", "check", "compare", "cut", "deflect", "fit", "gap", "map", "modes", "place", "report", "response", "runup", "size", "study",
        "tradeoff", "washboard",
    }  # fmt: skip
    for name in vars(_report_types):
        of = getattr(_report_types, name)
        if isinstance(of, type) and of.__module__ == _report_types.__name__:
            assert of.__doc__, name


def test_a_key_with_a_default_may_be_absent(report: sf.CampbellResults, tmp_path: Path) -> None:
    path = tmp_path / "report.json"
    report.save(path)
    data = json.loads(path.read_text(encoding="utf-8"))
    del data["condition"], data["unusual_numbers"]
    path.write_text(json.dumps(data), encoding="utf-8")
    found = sf.load(path)
    assert isinstance(found, sf.CampbellResults)
    assert found.unusual_numbers == ()
