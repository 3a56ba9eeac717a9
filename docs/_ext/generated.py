"""Writes `_generated/`: the tables of the reference, from the output of the program.

Commands and options come from `--help`, keys from the JSON schemas and the classes of reports.
They are kept in the repository, so that a checkout has a reference to read. A build of the pages
writes those that are out of date, and fails. By hand:

    SAWFLUTTER_PROGRAM=target/release/sawflutter python3 docs/_ext/generated.py
"""

from __future__ import annotations

import ast
import json
import os
import re
import subprocess
from pathlib import Path
from typing import Any

from key_tables import tables, typical
from report_tables import report_tables

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
OUT = HERE.parent / "_generated"


def said(*arguments: str) -> str:
    done = subprocess.run(
        [os.environ["SAWFLUTTER_PROGRAM"], *arguments], capture_output=True, text=True, check=True,
        env={**os.environ, "COLUMNS": "96", "NO_COLOR": "1"},
    )  # fmt: skip
    return done.stdout


def command_line() -> str:
    """Help texts of the program and of every command."""
    parts = []
    waiting: list[list[str]] = [[]]
    while waiting:
        command = waiting.pop(0)
        text = said(*command, "--help").rstrip()
        title = " ".join(["sawflutter", *command])
        parts.append(f"## {title}\n\n```text\n{text}\n```\n")
        listed = re.search(r"^Commands:\n((?:  .*\n)+)", text, re.MULTILINE)
        names = re.findall(r"^  (\w+)", listed[1] if listed else "", re.MULTILINE)
        waiting = [[*command, name] for name in names if name != "help"] + waiting
    return "\n".join(parts)


def rust_example() -> str:
    """The example on the first page of the crate, without its hidden lines."""
    text = (ROOT / "src/lib.rs").read_text(encoding="utf-8")
    begin = text.index("//! ```\n") + len("//! ```\n")
    lines = text[begin : text.index("//! ```", begin)].splitlines()
    bare = [line.removeprefix("//!").removeprefix(" ") for line in lines]
    return "```rust\n" + "\n".join(line for line in bare if not line.startswith("#")) + "\n```\n"


def calls() -> str:
    """The table of calls in the docstring of the Python package."""
    module = ast.parse((ROOT / "python/sawflutter/__init__.py").read_text(encoding="utf-8"))
    _, _, table = (ast.get_docstring(module) or "").partition("I want: the call\n\n")
    lines = [line.strip() for line in table.splitlines()]
    rows = (f"| {want} | `{call}` |" for want, call in zip(lines[::2], lines[1::2]))
    return "\n".join(["| I want | Call |", "|---|---|", *rows, ""])


def generate() -> list[str]:
    """Writes the tables that are out of date, and returns their names."""
    scene = json.loads(said("schema"))
    pages = {
        "calls.md": calls(),
        "reports.md": report_tables(),
        "rust-example.md": rust_example(),
        "command-line.md": command_line(),
        "scene.md": tables(scene),
        "study.md": tables(json.loads(said("schema", "--study"))),
        "typical-values.md": typical(scene),
    }
    OUT.mkdir(exist_ok=True)
    stale = []
    for name, text in pages.items():
        path = OUT / name
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
            stale.append(f"docs/_generated/{name}")
    return stale


def keep_up_to_date(app: Any) -> None:
    """Warns of tables that were out of date; the gate treats a warning as an error."""
    from sphinx.util import logging

    stale = generate()
    if stale:
        told = "%s: out of date, written anew; commit them"
        logging.getLogger(__name__).warning(told, ", ".join(stale))


def escape(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Docstrings write |λ| for a modulus, which is no substitution of reStructuredText."""
    lines[:] = [line.replace("|", r"\|") if "``" not in line else line for line in lines]


def setup(app: Any) -> dict[str, Any]:
    app.connect("builder-inited", keep_up_to_date)
    app.connect("autodoc-process-docstring", escape)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


if __name__ == "__main__":
    print("\n".join(generate()) or "up to date")
