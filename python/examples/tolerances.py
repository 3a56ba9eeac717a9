"""How many of the saws that are made within tolerances pass? The study uses all cores."""

from __future__ import annotations

import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import sawflutter as sf

STUDY: sf.StudyDict = {
    "name": "Thickness within ±0.05 mm",
    "saws": 16,
    "parameters": [
        {
            "path": "blade.thickness_m",
            "distribution": {"kind": "tolerance", "plus_minus": 5e-5},
        }
    ],
    "limits": {"operating_rpm": 1290},
}


def main(folder: Path) -> None:
    study = sf.Study(sf.Scene.paper().with_accuracy("draft"), STUDY)
    with ProcessPoolExecutor() as executor:
        result = study.run(folder, executor=executor)
    passing = result.all.passing
    assert passing is not None
    print(f"{passing.passed} of {result.all.saws} saws keep the 85 % rule at 1290 rpm")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "sawflutter-out"))
