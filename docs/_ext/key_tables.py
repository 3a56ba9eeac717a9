"""Tables of the keys of a scene or a study: units, defaults, ranges, meanings.

Keys, defaults and meanings come from the JSON schema, ranges from the error messages of the program
for refused values, and usual ranges from the library's table of quantities.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
UNITS = {
    "_n_s_3_2_per_m_3_2": "N·s^(3/2)/m^(3/2)", "_n_per_m_3_2": "N/m^(3/2)", "_n_s_per_m3": "N·s/m³",
    "_n_s_per_m": "N·s/m", "_n_per_m": "N/m", "_n_per_tooth": "N", "_kg_per_m3": "kg/m³",
    "_m_per_s": "m/s", "_per_s": "1/s", "_per_k": "1/K", "_deg": "°", "_rpm": "rpm", "rpm": "rpm",
    "_pa": "Pa", "_hz": "Hz", "_m": "m", "_n": "N", "_s": "s", "_w": "W", "_k": "K",
}  # fmt: skip


def unit(key: str) -> str:
    return next((unit for end, unit in UNITS.items() if key.endswith(end)), "")


def usual() -> dict[str, tuple[str, float, float]]:
    """Unit and usual range of each number, from the table of the library."""
    line = re.compile(r'q\("([^"]+)", "[^"]+", "([^"]*)", ([^,]+), ([^)]+)\)')
    sources = (path.read_text(encoding="utf-8") for path in (ROOT / "src").rglob("*.rs"))
    rows = [row for source in sources for row in line.findall(source)]
    assert len(rows) > 60, "the table of quantities has moved"
    return {path: (unit, float(low), float(high)) for path, unit, low, high in rows}


def typical() -> str:
    """The library's table of typical values, with their ranges and sources."""
    line = re.compile(r't\("([^"]+)", ([^,]+), "([^"]*)", ([^,]+), ([^,]+), "([^"]+)"\)')
    source = (ROOT / "src/scene/typical.rs").read_text(encoding="utf-8")
    rows = line.findall(source)
    assert len(rows) == source.count(": Typical = t("), "the table of typical values has moved"
    units = usual()
    lines = []
    for path, value, of, low, high, basis in rows:
        measure = of or units[path][0]
        number, least, largest = (f"{float(text):g}" for text in (value, low, high))
        lines.append(f"| `{path}` | {number} {measure} | {least} to {largest} | {basis} |".replace("  ", " "))
    head = "| key | typical value | common range | source |\n|---|---|---|---|\n"
    return head + "\n".join(lines) + "\n"


Schema = dict[str, Any]


def properties(
    schema: Schema, defs: Schema, prefix: str = ""
) -> Iterator[tuple[str, Schema, bool]]:
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
    """The schema of the value of a key, and whether the value is a list of such values."""
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


def scene_of(name: str) -> dict[str, Any]:
    scene: dict[str, Any] = json.loads((ROOT / f"scenes/{name}.json").read_text(encoding="utf-8"))
    return scene


def refusal(scene: dict[str, Any]) -> tuple[str, str] | None:
    """The key that the program refuses, and its allowed values. A cut at rest is always refused, so
    that nothing is computed."""
    done = subprocess.run(
        [os.environ["SAWFLUTTER_PROGRAM"], "cut", "-", "--rpm", "0"],
        input=json.dumps(scene), capture_output=True, text=True, check=False,
    )  # fmt: skip
    found = re.search(r"was refused: (\S+) is .+?, but must be (.+); [^;]+$", done.stderr.strip())
    return (found[1], found[2]) if found else None


def full_scene() -> dict[str, Any]:
    """A scene with every block, in which one value at a time is made invalid."""
    data: dict[str, Any] = scene_of("paper")
    data["spline"] = scene_of("paper-spline")["spline"]
    data["membrane"] = {
        "temperature": {"expansion_per_k": 1.2e-5, "rim_rise_k": 5.0},
        "roll_tension": [{"radius_m": 0.2, "width_m": 0.02, "eigenstrain": 1e-4}],
    }
    data["damping"] = {"air_n_s_per_m3": 1.0}
    data["blade"]["profile"] = [{"radius_m": 0.3, "thickness_m": 2e-3}]
    data["blade"]["rim"] = {"mass_per_tooth_kg": 1e-3}
    data["cut"]["washboarding"] = {"stiffness_n_per_m": 1e4, "pitches_deg": [360 / 42]}
    return data


def allowed(path: str, kind: str | None) -> str:
    """The allowed values of a key, from the error message for an impossible value."""
    data = full_scene()
    if kind == "collar":
        data["mount"] = {"kind": "collar", "diameter_m": 0.25, "in_plane": "free"}
        data.pop("spline")
    if "residual_stress" in path:
        data["membrane"] = {"residual_stress": [{"radius_m": 0.2, "hoop_pa": 0.0}]}
    if "groove_depth_m" in path:
        del data["membrane"]["roll_tension"][0]["eigenstrain"]
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
    except (KeyError, IndexError, TypeError):
        return ""
    refused = refusal(data)
    return tidy(refused[1]) if refused and refused[0] == path.replace("[]", "[0]") else ""


def tidy(text: str) -> str:
    """The allowed values with short numbers, without the usual range, which has its own column."""
    text = text.partition("; saws have")[0]
    text = re.sub(r"-?\d[\d.]*(e-?\d+)?", lambda found: f"{float(found[0]):g}", text)
    return text.replace("greater than", "above").replace("less than", "below")


def choices(value: Schema, defs: Schema) -> str:
    inner, _ = resolved(value, defs)
    names = [option.get("const") or option.get("properties", {}).get("kind", {}).get("const")
             for option in inner.get("oneOf", [])]  # fmt: skip
    return ", ".join(f'`"{name}"`' for name in names if name)


def tables(schema: Schema, ranges: bool) -> str:
    """One table for the keys of the file, and one for each of its blocks."""
    own = schema["properties"]
    parts = [table(schema, ranges, own, deep=False)]
    for key in (key for key, value in own.items() if holds_keys(value, schema["$defs"])):
        text = " ".join(
            resolved(own[key], schema["$defs"])[0].get("description", "").split("\n\n")[0].split()
        )
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
        lines.append(
            f"| `{path}` | {measure or '–'} | {default(value, required)} | {span or '–'} | {text} |"
        )
    head = "| key | unit | default | allowed | what it is |\n|---|---|---|---|---|\n"
    return head + "\n".join(line.replace("\n", " ") for line in lines) + "\n"
