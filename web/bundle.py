"""Joins the modules of the page in one: `python3 web/bundle.py FOLDER`.

Each module becomes a function that returns what it exports; `main.js`, which awaits, follows as it is.
"""

import re
import sys
from pathlib import Path

IMPORT = re.compile(r'^import \{ (.+) \} from "\./(\w+)\.js";\n', re.MULTILINE)
EXPORT = re.compile(r"^export (?=(?:async )?(?:function|class|const) (\w+))", re.MULTILINE)


def joined(folder: Path, name: str, made: dict[str, str]) -> None:
    """Adds a module to `made`, after those that it imports."""
    text = (folder / f"{name}.js").read_text(encoding="utf-8")
    for _, other in IMPORT.findall(text):
        if other not in made:
            joined(folder, other, made)
    exports = ", ".join(EXPORT.findall(text))
    body = EXPORT.sub("", IMPORT.sub(r"const { \1 } = $\2;\n", text))
    made[name] = body if name == "main" else f"const ${name} = (() => {{\n{body}\nreturn {{ {exports} }};\n}})();\n"


def main(folder: Path) -> None:
    made: dict[str, str] = {}
    joined(folder, "main", made)
    for name in made:
        (folder / f"{name}.js").unlink()
    (folder / "main.js").write_text("".join(made.values()), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
