"""Tables of the keys of a scene or a study: units, defaults, ranges, meanings, all from the JSON schema."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

UNITS = {
    "_n_s_3_2_per_m_3_2": "N·s^(3/2)/m^(3/2)", "_n_per_m_3_2": "N/m^(3/2)", "_n_s_per_m3": "N·s/m³",
    "_n_s_per_m": "N·s/m", "_n_per_m": "N/m", "_n_per_tooth": "N", "_kg_per_m3": "kg/m³",
    "_m_per_s": "m/s", "_per_s": "1/s", "_per_k": "1/K", "_deg": "°", "_rpm": "rpm", "rpm": "rpm",
    "_pa": "Pa", "_hz": "Hz", "_m": "m", "_n": "N", "_s": "s", "_w": "W", "_k": "K",
}  # fmt: skip


def unit(key: str) -> str:
    return next((unit for end, unit in UNITS.items() if key.endswith(end)), "")


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


def typical(schema: Schema) -> str:
    """The numbers that have a typical value, with common range and source."""
    lines = []
    for path, value, _ in properties(schema, schema["$defs"]):
        if (known := value.get("x-typical")) is None:
            continue
        measure = known["of"] or value.get("x-unit", "")
        least, largest = known["common"]
        number = f"{known['value']:g} {measure}".rstrip()
        lines.append(f"| `{path}` | {number} | {least:g} to {largest:g} | {known['basis']} |")
    head = "| key | typical value | common range | source |\n|---|---|---|---|\n"
    return head + "\n".join(lines) + "\n"


FAR = 1e9  # ends farther apart only prevent overflow


def allowed(number: Schema) -> str:
    """The range of a number. Of a range without practical ends only the lower end is told, if it is zero."""
    low, high = (number.get(key, number.get(open_key)) for key, open_key in
                 [("minimum", "exclusiveMinimum"), ("maximum", "exclusiveMaximum")])  # fmt: skip
    if low is None or high is None:
        return ""
    if high / low >= FAR if low > 0 else high - low >= FAR:
        return "above 0" if low > 0 or "exclusiveMinimum" in number else "0 or more" if low == 0 else ""
    below, above = "exclusiveMinimum" in number, "exclusiveMaximum" in number
    if not (below or above):
        return f"{low:g} to {high:g}"
    return f"{'above' if below else 'from'} {low:g}, {'below' if above else 'at most'} {high:g}"


def choices(value: Schema, defs: Schema) -> str:
    inner, _ = resolved(value, defs)
    names = [option.get("const") or option.get("properties", {}).get("kind", {}).get("const")
             for option in inner.get("oneOf", [])]  # fmt: skip
    return ", ".join(f'`"{name}"`' for name in names if name)


def tables(schema: Schema) -> str:
    """One table for the keys of the file, and one for each of its blocks."""
    own = schema["properties"]
    parts = [table(schema, own, deep=False)]
    for key in (key for key, value in own.items() if holds_keys(value, schema["$defs"])):
        text = " ".join(
            resolved(own[key], schema["$defs"])[0].get("description", "").split("\n\n")[0].split()
        )
        parts.append(f"## `{key}`\n\n{text}\n\n{table(schema, {key: own[key]}, deep=True)}")
    return "\n".join(parts)


def holds_keys(value: Schema, defs: Schema) -> bool:
    inner, _ = resolved(value, defs)
    return any("properties" in kind for kind in inner.get("oneOf", [inner]))


def table(schema: Schema, keys: Schema, deep: bool) -> str:
    defs = schema["$defs"]
    lines = []
    for path, value, required in properties({**schema, "properties": keys}, defs):
        if deep == (path in keys):
            continue
        inner, list_of = resolved(value, defs)
        is_block = "properties" in inner or "oneOf" in inner
        number = value.get("items", value)
        measure = number.get("x-unit", "") if "x-name" in number else unit(path)
        span = choices(value, defs)
        if "x-name" in number:
            least, largest = number.get("x-usual", [None, None])
            usual = "" if least is None else f"usual range {least:g} to {largest:g}"
            span = ", ".join(filter(None, [allowed(number), usual]))
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
