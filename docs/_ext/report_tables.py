"""Tables of the keys of every report, from the classes that are made of the library's schema."""

from __future__ import annotations

import ast
import re
from pathlib import Path

TYPES = Path(__file__).parents[2] / "python/sawflutter/_report_types.py"


def report_tables() -> str:
    """Keys of every report and of its parts, from the classes made of the library's schema."""
    tree = ast.parse(TYPES.read_text(encoding="utf-8")).body
    classes = [node for node in tree if isinstance(node, ast.ClassDef)]
    words = {node.name: f"[{node.name}](#{anchor(node.name)})" for node in classes}
    for node in tree:
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value:
            options = re.findall(r"'([^']+)'", ast.unparse(node.value))
            words[node.target.id] = ", ".join(f'`"{option}"`' for option in options)
    return "\n".join(report_table(node, words) for node in classes)


def report_table(node: ast.ClassDef, words: dict[str, str]) -> str:
    about, _, attributes = (ast.get_docstring(node) or "").partition("Attributes\n----------\n")
    meanings = dict(re.findall(r"^(\w+) : (.*(?:\n +.*)*)", attributes, re.MULTILINE))
    rows = []
    for field in node.body:
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name):
            kind = json_kind(ast.unparse(field.annotation), words)
            meaning = " ".join(meanings[field.target.id].split()).replace("|", "\\|")
            renamed = re.search(r"'key': '(\w+)'", ast.unparse(field.value) if field.value else "")
            rows.append(f"| `{renamed[1] if renamed else field.target.id}` | {kind} | {meaning} |")
    meaning = " ".join(about.split())
    head = f"({anchor(node.name)})=\n## {node.name}\n\n{meaning}\n\n| key | type | what it is |\n|---|---|---|\n"
    return head + "\n".join(rows) + "\n"


def anchor(name: str) -> str:
    return f"report-{name.lower()}"


def json_kind(annotation: str, words: dict[str, str]) -> str:
    """A type of Python in words of JSON; `words` has links to parts of reports, and names."""
    optional = annotation.endswith(" | None")
    kind = annotation.removesuffix(" | None")
    inner = kind.removeprefix("tuple[").removesuffix(", ...]")
    plain = {"float": "number", "int": "whole number", "str": "text", "bool": "true or false",
             "FloatArray": "numbers", "IntArray": "whole numbers", "SceneDict": "[scene](scene.md)",
             "StudyDict": "[study](study.md)"}  # fmt: skip
    word = {**plain, **words}.get(inner, inner)
    listed = f"list of {word}" if inner != kind else word
    return f"{listed} or null" if optional else listed
