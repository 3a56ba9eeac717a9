"""Writes `_generated/`: the reference pages that are made of what the program says.

Commands and options come from `--help`, keys from the JSON schemas, ranges from what the library
answers to a value that it refuses. `SAWFLUTTER_PROGRAM` names the program.
"""

from __future__ import annotations

import ast
import json
import os
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import sawflutter as sf

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
OUT = HERE.parent / "_generated"
COMMANDS = [
    [], ["analyze"], ["check"], ["cut"], ["runup"], ["fit"], ["place"], ["study"],
    ["study", "merge"], ["tradeoff"], ["export"], ["explore"], ["schema"],
]  # fmt: skip
UNITS = {
    "_n_s_3_2_per_m_3_2": "N·s^(3/2)/m^(3/2)", "_n_per_m_3_2": "N/m^(3/2)", "_n_s_per_m3": "N·s/m³",
    "_n_s_per_m": "N·s/m", "_n_per_m": "N/m", "_n_per_tooth": "N", "_kg_per_m3": "kg/m³",
    "_m_per_s": "m/s", "_per_s": "1/s", "_per_k": "1/K", "_deg": "°", "_rpm": "rpm", "rpm": "rpm",
    "_pa": "Pa", "_hz": "Hz", "_m": "m", "_n": "N", "_s": "s", "_w": "W", "_k": "K",
}  # fmt: skip


def said(*arguments: str) -> str:
    done = subprocess.run(
        [os.environ["SAWFLUTTER_PROGRAM"], *arguments], capture_output=True, text=True, check=True,
        env={**os.environ, "COLUMNS": "96", "NO_COLOR": "1"},
    )  # fmt: skip
    return done.stdout


def command_line() -> str:
    parts = []
    for command in COMMANDS:
        title = " ".join(["sawflutter", *command])
        parts.append(f"## {title}\n\n```text\n{said(*command, '--help').rstrip()}\n```\n")
    return "\n".join(parts)


def unit(key: str) -> str:
    return next((unit for end, unit in UNITS.items() if key.endswith(end)), "")


def usual() -> dict[str, tuple[str, float, float]]:
    """Unit of each number and the values that saws have: the library's own table."""
    line = re.compile(r'q\("([^"]+)", "[^"]+", "([^"]*)", ([^,]+), ([^)]+)\)')
    sources = (path.read_text(encoding="utf-8") for path in (ROOT / "src").rglob("*.rs"))
    rows = [row for source in sources for row in line.findall(source)]
    assert len(rows) > 60, "the table of quantities has moved"
    return {path: (unit, float(low), float(high)) for path, unit, low, high in rows}


Schema = dict[str, Any]


def properties(schema: Schema, defs: Schema, prefix: str = "") -> Iterator[tuple[str, Schema, bool]]:
    """Path, description and whether it is required, of every key within."""
    for key, value in schema.get("properties", {}).items():
        path = f"{prefix}{key}"
        yield path, value, key in schema.get("required", [])
        inner, list_of = resolved(value, defs)
        for kind in inner.get("oneOf", [inner]):
            name = kind.get("properties", {}).get("kind", {}).get("const")
            begin = f"{path}[]" if list_of else path
            for row in properties(kind, defs, f"{begin}."):
                if row[0] != f"{begin}.kind":
                    yield (row[0], {**row[1], "of_kind": name} if name else row[1], row[2])


def resolved(value: Schema, defs: Schema) -> tuple[Schema, bool]:
    """What a key holds, and whether it holds a list of it."""
    if "items" in value:
        return resolved(value["items"], defs)[0], True
    for option in [value, *value.get("anyOf", [])]:
        if "$ref" in option:
            return defs[option["$ref"].rpartition("/")[2]], False
    return value, False


def default(value: Schema, required: bool) -> str:
    if required:
        return "required"
    given = value.get("default")
    return "none" if given is None else f"`{json.dumps(given)}`"


# A scene in which every block is there, so that one value at a time can be put wrong.
def full_scene() -> dict[str, Any]:
    data: dict[str, Any] = dict(sf.Scene.paper().to_dict())
    data["spline"] = sf.Scene.load(ROOT / "scenes/paper-spline.json")["spline"]
    data["membrane"] = {
        "temperature": {"expansion_per_k": 1.2e-5, "rim_rise_k": 5.0},
        "roll_tension": [{"radius_m": 0.2, "width_m": 0.02, "eigenstrain": 1e-4}],
    }
    data["damping"] = {"air_n_s_per_m3": 1.0}
    return data


def allowed(path: str, kind: str | None) -> str:
    """What the library answers to a value that no saw has."""
    data = full_scene()
    if kind == "collar":
        data["mount"] = {"kind": "collar", "diameter_m": 0.25, "in_plane": "free"}
        data.pop("spline")
    if "residual_stress" in path:
        data["membrane"] = {"residual_stress": [{"radius_m": 0.2, "hoop_pa": 0.0}]}
    if "temperature.table" in path:
        data["membrane"]["temperature"] = {
            "expansion_per_k": 1e-5, "table": [{"radius_m": 0.2, "rise_k": 1.0}],
        }  # fmt: skip
    target: Any = data
    steps = re.findall(r"\w+|\[\]", path)
    try:
        for step in steps[:-1]:
            target = target[0] if step == "[]" else target.setdefault(step, {})
        target[0 if steps[-1] == "[]" else steps[-1]] = -1e30
        sf.Scene(data)
    except sf.SceneError as error:
        return "" if error.allowed is None or error.key != path.replace("[]", "[0]") else tidy(error.allowed)
    except (KeyError, IndexError, TypeError):
        return ""
    return ""


def tidy(text: str) -> str:
    """Numbers as people write them."""
    text = re.sub(r"-?\d[\d.]*(e-?\d+)?", lambda found: f"{float(found[0]):g}", text)
    return text.replace("greater than", "above").replace("less than", "below")


def choices(value: Schema, defs: Schema) -> str:
    inner, _ = resolved(value, defs)
    names = [option.get("const") or option.get("properties", {}).get("kind", {}).get("const")
             for option in inner.get("oneOf", [])]  # fmt: skip
    return ", ".join(f"`\"{name}\"`" for name in names if name)


def tables(schema: Schema, ranges: bool) -> str:
    """One table for the keys of the file, and one for each of its blocks."""
    own = {key: value for key, value in schema["properties"].items()}
    blocks = {key for key, value in own.items() if holds_keys(value, schema["$defs"])}
    parts = [table(schema, ranges, {key: own[key] for key in own}, deep=False)]
    for key in (key for key in own if key in blocks):
        text = " ".join(resolved(own[key], schema["$defs"])[0].get("description", "").split("\n\n")[0].split())
        parts.append(f"## `{key}`\n\n{text}\n\n{table(schema, ranges, {key: own[key]}, deep=True)}")
    return "\n".join(parts)


def holds_keys(value: Schema, defs: Schema) -> bool:
    inner, _ = resolved(value, defs)
    return any("properties" in kind for kind in inner.get("oneOf", [inner]))


def table(schema: Schema, ranges: bool, keys: Schema, deep: bool) -> str:
    defs, known = schema["$defs"], usual()
    lines = []
    for path, value, required in properties({**schema, "properties": keys}, defs):
        if deep == (path in keys):
            continue
        inner, list_of = resolved(value, defs)
        is_block = "properties" in inner or "oneOf" in inner
        low_high = known.get(path)
        measure = low_high[0] if ranges and low_high else unit(path.removesuffix("[]"))
        span = choices(value, defs)
        if ranges and not is_block:
            span = allowed(path, value.get("of_kind"))
        if ranges and low_high and not is_block:
            span += f"{'; ' if span else ''}saws have {low_high[1]:g} to {low_high[2]:g}"
        if is_block and not span:
            span = "list of blocks" if list_of else "block"
        text = " ".join(value.get("description", "").split())
        if value.get("of_kind"):
            text += f" (kind `{value['of_kind']}`)"
        lines.append(f"| `{path}` | {measure or '–'} | {default(value, required)} | {span or '–'} | {text} |")
    head = "| key | unit | default | allowed | what it is |\n|---|---|---|---|---|\n"
    return head + "\n".join(line.replace("\n", " ") for line in lines) + "\n"


def rust_example() -> str:
    """The example of the crate's first page, as it stands there; hidden lines are left out."""
    text = (ROOT / "src/lib.rs").read_text(encoding="utf-8")
    begin = text.index("//! ```\n") + len("//! ```\n")
    lines = text[begin : text.index("//! ```", begin)].splitlines()
    bare = [line.removeprefix("//!").removeprefix(" ") for line in lines]
    return "```rust\n" + "\n".join(line for line in bare if not line.startswith("#")) + "\n```\n"


def report_tables() -> str:
    """Keys of every report and of its parts, from the classes made of the library's schema."""
    source = Path(sf.__file__).with_name("_report_types.py").read_text(encoding="utf-8")
    tree = ast.parse(source).body
    classes = [node for node in tree if isinstance(node, ast.ClassDef)]
    words = {node.name: f"[{node.name}](#{anchor(node.name)})" for node in classes}
    for node in tree:
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value:
            options = re.findall(r"'([^']+)'", ast.unparse(node.value))
            words[node.target.id] = ", ".join(f"`\"{option}\"`" for option in options)
    return "\n".join(report_table(node, words) for node in classes)


def report_table(node: ast.ClassDef, words: dict[str, str]) -> str:
    rows = []
    for field, text in zip(node.body, node.body[1:], strict=False):
        said = isinstance(text, ast.Expr) and isinstance(text.value, ast.Constant)
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name) and said:
            kind = json_kind(ast.unparse(field.annotation), words)
            meaning = " ".join(str(text.value.value).split()).replace("|", "\\|")
            renamed = re.search(r"'key': '(\w+)'", ast.unparse(field.value) if field.value else "")
            rows.append(f"| `{renamed[1] if renamed else field.target.id}` | {kind} | {meaning} |")
    meaning = " ".join((ast.get_docstring(node) or "").split())
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


def generate(app: Any) -> None:
    pages = {
        "reports.md": report_tables(),
        "rust-example.md": rust_example(),
        "command-line.md": command_line(),
        "scene.md": tables(json.loads(said("schema")), ranges=True),
        "study.md": tables(json.loads(said("schema", "--study")), ranges=False),
    }
    OUT.mkdir(exist_ok=True)
    for name, text in pages.items():
        path = OUT / name
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def escape(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Docstrings write |λ| for a modulus, which is no substitution of reStructuredText."""
    lines[:] = [line.replace("|", r"\|") if "``" not in line else line for line in lines]


def setup(app: Any) -> dict[str, Any]:
    app.connect("builder-inited", generate)
    app.connect("autodoc-process-docstring", escape)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
