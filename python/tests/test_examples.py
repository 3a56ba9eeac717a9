"""The examples run and print their answers."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
SAID = {
    "thinner_blade.py": "2.8 mm: first critical speed 1531 rpm, may be run at 1301 rpm",
    "own_eigenvalues.py": "0 rpm: NumPy 7.680, 13.143, 25.569, 42.847 Hz; sawflutter 7.680, 13.143",
    "figures.py": "2 diameters, reflected, at 1.61 Hz",
    "tolerances.py": "of 16 saws keep the 85 % rule",
}


@pytest.mark.parametrize("name", [path.name for path in sorted(EXAMPLES.glob("*.py"))])
def test_an_example_runs(name: str, tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, str(EXAMPLES / name), str(tmp_path)],
        check=False,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    assert SAID[name] in done.stdout, done.stdout
