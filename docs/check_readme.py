"""Holds README.md against the program: its length, its example, its links.

Files that it, CONTRIBUTING.md and SECURITY.md name have to be there.

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


def read(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def block(text: str, language: str) -> str:
    found = re.search(rf"```{language}\n(.*?)```", text, re.DOTALL)
    assert found, f"README.md has no block of {language}"
    return found[1]


def missing_files(text: str) -> list[str]:
    """Files that are linked to, or named with their folder, and do not exist."""
    links = re.findall(r"\]\((?!https?://)([^)#]+)", text)
    named = re.findall(
        r"`((?:src|tests|docs|scenes|figures|python|benches|\.ci|\.github)/[\w./-]*)`", text
    )
    return [f"no file {path}" for path in [*links, *named] if not (ROOT / path).exists()]


def faults(text: str) -> list[str]:
    lines = text.splitlines()
    found = [] if len(lines) <= MOST_LINES else [f"{len(lines)} lines, at most {MOST_LINES}"]
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
    found = [f"README.md: {fault}" for fault in faults(read("README.md"))]
    for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md"):
        found += [f"{name}: {fault}" for fault in missing_files(read(name))]
    print(*found, sep="\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
