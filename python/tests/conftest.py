"""Fixtures of several tests."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import sawflutter as sf

CHECKOUT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def scenes() -> Path:
    """The scenes of the checkout."""
    return CHECKOUT / "scenes"


@pytest.fixture(scope="session")
def draft() -> sf.Scene:
    """The built-in saw at draft accuracy."""
    return sf.Scene.paper().with_accuracy("draft")


@pytest.fixture(scope="session")
def report(draft: sf.Scene) -> sf.CampbellResults:
    """Its chart."""
    return draft.run_campbell()


@pytest.fixture(scope="session")
def resaw(scenes: Path) -> sf.Scene:
    """A saw that washboards."""
    return sf.Scene.load(scenes / "gallery/washboarding.json").with_accuracy("draft")


@pytest.fixture(scope="session")
def programs() -> Iterator[list[str]]:
    """The program that pip installed, and the one that cargo built where SAWFLUTTER_PROGRAM names
    it."""
    installed = shutil.which("sawflutter", path=str(Path(sys.executable).parent))
    assert installed is not None, "pip installs the program"
    built = os.environ.get("SAWFLUTTER_PROGRAM")
    yield [installed] + ([str((CHECKOUT / built).resolve())] if built else [])
