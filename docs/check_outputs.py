"""Holds pages with outputs in their text to the program and the package: what they show has to be what is printed.

A page may have three kinds of blocks with code. A block of `json` after "Write `NAME`:" is that file. In a block of
`console` lines after `$ ` are commands, other lines their output. A block of `python` prints the block of `text` after
it, if there is one. `…` stands for any number of lines. A picture `figures/my-saw-NAME` has to be like the file NAME that
was written last; `--draw` replaces the pictures. Needs SAWFLUTTER_PROGRAM and, for the pictures, Pillow.
"""

from __future__ import annotations

import contextlib
import difflib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

DOCS = Path(__file__).parent
PAGES = ["tutorials/first-saw.md"]
PARTS = re.compile(
    r"(?:Write `(?P<file>[\w.-]+)`:\n\n)?^```(?P<kind>\w+)\n(?P<content>.*?)^```$|^!\[[^]]*\]\((?P<picture>[^)]+)\)",
    re.DOTALL | re.MULTILINE,
)
LEFT_OUT = "…"
# Where an event falls on a step of the search, another processor may take one step more.
COUNTS = re.compile(r"(?<=Checks: all )\d+|(?<=proven for )[\d.]+")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
POINTS = re.compile(r' points="([^"]+)"')
# Last digits differ between processors, and so do rounded places in a drawing, by one of the four units of a pixel.
SAME_UNITS = 1.5
# Mean difference of the colours of 255.
SAME_COLOUR = 0.5


def fault(shown: str, printed: str) -> str | None:
    """What differs, if lines are shown that were not printed, or left out without `…`."""
    lines, seen = ([COUNTS.sub("", line) for line in text.strip("\n").splitlines()] for text in (printed, shown))
    pattern = "".join("(?:.*\n)*?" if line == LEFT_OUT else re.escape(line) + "\n" for line in seen)
    if re.fullmatch(pattern, "".join(line + "\n" for line in lines)):
        return None
    return "\n".join(difflib.ndiff(seen, lines))


def commands(content: str) -> Iterator[tuple[str, str]]:
    """Commands of a console, each with its output."""
    for part in re.split(r"^\$ ", content, flags=re.MULTILINE)[1:]:
        command, _, shown = part.partition("\n")
        yield command, shown


def alike(shown: Path, drawn: Path) -> bool:
    """Whether two pictures differ by rounding only."""
    if shown.suffix == ".svg":
        texts = [path.read_text(encoding="utf-8") for path in (shown, drawn)]
        # A rounded point may leave a line, or enter it.
        boxes = [[box(points) for points in POINTS.findall(text)] for text in texts]
        others = [[float(number) for number in NUMBER.findall(POINTS.sub("", text))] for text in texts]
        words = [NUMBER.sub("", POINTS.sub("", text)) for text in texts]
        numbers = [[*other, *(side for sides in of_lines for side in sides)] for other, of_lines in zip(others, boxes)]
        near = len(numbers[0]) == len(numbers[1]) and all(abs(a - b) < SAME_UNITS for a, b in zip(*numbers))
        return words[0] == words[1] and near
    from PIL import Image, ImageChops, ImageStat

    first, second = (Image.open(path).convert("RGB") for path in (shown, drawn))
    difference = ImageStat.Stat(ImageChops.difference(first, second)).mean
    return first.size == second.size and max(difference) < SAME_COLOUR


def box(points: str) -> tuple[float, float, float, float]:
    """Smallest and largest coordinates of a line."""
    x, y = ([float(point.split(",")[k]) for point in points.split()] for k in (0, 1))
    return min(x), max(x), min(y), max(y)


def faults(page: Path, draw: bool) -> Iterator[str]:
    parts = list(PARTS.finditer(page.read_text(encoding="utf-8")))
    names: dict[str, Any] = {"__name__": "__main__"}
    folder = Path.cwd()
    for part, after in zip(parts, [*parts[1:], None]):
        content, kind = part["content"], part["kind"]
        if part["picture"]:
            shown = page.parent / part["picture"]
            written = folder.rglob(shown.name.removeprefix("my-saw-"))
            drawn = max(written, key=lambda path: path.stat().st_mtime_ns)
            if draw:
                shutil.copyfile(drawn, shown)
            elif not alike(shown, drawn):
                yield f"{shown.name} differs from what the program draws; see --draw"
        elif kind == "json":
            (folder / part["file"]).write_text(content, encoding="utf-8")
        elif kind == "console":
            for command, wanted in commands(content):
                done = subprocess.run(["bash", "-c", command], capture_output=True, text=True)
                if found := fault(wanted, done.stdout + done.stderr):
                    yield f"$ {command}\n{found}"
        elif kind == "python":
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                exec(content, names)
            if after and after["kind"] == "text" and (found := fault(after["content"], printed.getvalue())):
                yield f"{content}{found}"


def main(draw: bool) -> int:
    program = Path(os.environ["SAWFLUTTER_PROGRAM"]).resolve()
    found = []
    for name in PAGES:
        with tempfile.TemporaryDirectory() as folder:
            tools = Path(folder) / "tools"
            tools.mkdir()
            (tools / "sawflutter").symlink_to(program)
            os.environ.update(PATH=f"{tools}{os.pathsep}{os.environ['PATH']}", NO_COLOR="1", COLUMNS="80")
            os.chdir(folder)
            found += [f"docs/{name}: {fault}" for fault in faults(DOCS.resolve() / name, draw)]
            os.chdir(DOCS)
    print(*found, sep="\n\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main("--draw" in sys.argv))
