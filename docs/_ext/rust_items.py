"""The role `rust`: the name of an item of the library, and the file that defines it.

A build fails if the item does not exist, so that pages name no item that was removed.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.util.docutils import SphinxRole

SOURCES = Path(__file__).parents[2] / "src"
ITEM = re.compile(
    r"^\s*(?:pub(?:\([a-z: ]+\))? )?(?:const )?(?:async )?"
    r"(?:struct|enum|trait|fn|type|const|mod) (\w+)",
    re.MULTILINE,
)


@cache
def definitions() -> dict[str, tuple[str, ...]]:
    """Files that define each name."""
    found: dict[str, list[str]] = {}
    for path in sorted(SOURCES.rglob("*.rs")):
        inside = path.relative_to(SOURCES.parent).as_posix()
        for name in ITEM.findall(path.read_text(encoding="utf-8")):
            found.setdefault(name, []).append(inside)
    return {name: tuple(dict.fromkeys(files)) for name, files in found.items()}


IMPLEMENTATION = re.compile(r"^impl\b[^{]*?(\w+)(?:<[^{]*>)? \{", re.MULTILINE)


@cache
def implementations() -> dict[str, tuple[str, ...]]:
    """Files with functions of each type."""
    found: dict[str, list[str]] = {}
    for path in sorted(SOURCES.rglob("*.rs")):
        inside = path.relative_to(SOURCES.parent).as_posix()
        for name in set(IMPLEMENTATION.findall(path.read_text(encoding="utf-8"))):
            found.setdefault(name, []).append(inside)
    return {name: tuple(files) for name, files in found.items()}


def file_of(item: str) -> str | None:
    """The file of `Type::function`, `function` or `Type`."""
    owner, _, name = item.rpartition("::")
    files = definitions().get(name, ())
    if owner:
        kind = owner.rpartition("::")[2]
        owners = definitions().get(kind, ()) + implementations().get(kind, ())
        folders = tuple(file.removesuffix(".rs").removesuffix("/mod") for file in owners)
        same = [file for file in files if file in owners]
        files = tuple(same or [file for file in files if file.startswith(folders)])
    return files[0] if files else None


class RustItem(SphinxRole):
    """``{rust}`Type::function` ``."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        file = file_of(self.text)
        if file is None:
            message = f"no item {self.text!r} in src/"
            error = self.inliner.reporter.error(message, line=self.lineno)
            return [self.inliner.problematic(self.rawtext, self.rawtext, error)], [error]
        name = nodes.literal(self.text, self.text)
        return [name, nodes.Text(" ("), nodes.literal(file, file), nodes.Text(")")], []


def setup(app: Any) -> dict[str, Any]:
    app.add_role("rust", RustItem())
    return {"parallel_read_safe": True, "parallel_write_safe": True}
