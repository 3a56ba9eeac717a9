"""Holds README.md against the program: its length, its example, its links.

The first JSON block is charted by SAWFLUTTER_PROGRAM, and every line of the text block after it has
to be in the summary.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
MOST_LINES = 120


def block(text: str, language: str) -> str:
    found = re.search(rf"```{language}\n(.*?)```", text, re.DOTALL)
    assert found, f"README.md has no block of {language}"
    return found[1]


def faults(text: str) -> list[str]:
    lines = text.splitlines()
    found = [] if len(lines) <= MOST_LINES else [f"{len(lines)} lines, at most {MOST_LINES}"]
    links = re.findall(r"\]\((?!https?://)([^)#]+)", text)
    found += [f"no file {link}" for link in links if not (ROOT / link).exists()]
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "my-saw.json"
        scene.write_text(block(text, "json"), encoding="utf-8")
        done = subprocess.run(
            [os.environ["SAWFLUTTER_PROGRAM"], scene.name], cwd=folder, check=True,
            capture_output=True, text=True, env={**os.environ, "NO_COLOR": "1"},
        )  # fmt: skip
    said = done.stdout.splitlines()
    shown = [line for line in block(text, "text").splitlines() if line.strip()]
    return found + [f"the program does not say {line!r}" for line in shown if line not in said]


def main() -> int:
    found = faults((ROOT / "README.md").read_text(encoding="utf-8"))
    print(*(f"README.md: {fault}" for fault in found), sep="\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
