"""Looks for words that `docs/development/language.md` forbids: in texts of the program, on pages, and in comments
outside `src`."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
# What to write in place of each is in `docs/development/language.md`.
FORBIDDEN = [
    r"\b(?:hold|holds|held|holding)(?! the blade)(?: \w+){0,6} against\b",
    r"\bwhole (?:basis|model)\b",
    r"\bfirst (?:flutter )?(?:band )?of all\b",
    r"\b(?:told|tells?) (?:apart|from|which|that|of|how|why)\b",
    r"\b(?:was|were|is|are|be) told\b",
    r"\bwhat digits cost\b",
    r"\bat (?:the|its|their) worst of\b",
    r"\b(?:hangs|hang) on\b",
    r"\bpursu(?:e|ed|it)\b",
    r"\boutgrows every number\b",
    r"\b(?:no|none) in particular\b",
    r"\bas it was\b",
    r"\bthe tooth before\b",
    r"\bthe one before\b",
    r"\bstands? in space\b",
    r"\bleast (?:flutter|critical|first critical|lowest critical) speed\b",
    r"\bthe way up\b",
    r"\bmade-up\b",
    r"\bbends the blade ten times\b",
]
PATTERN = re.compile("|".join(FORBIDDEN), re.IGNORECASE)
# Beginnings of comments that do not name their object.
OPENING = re.compile(r"\A(?:What|Those|Whoever|The same (?:of|in|as|for))\b")
STRING = re.compile(r'"(?:[^"\\]|\\.)*"', re.DOTALL)
# Lines of Rust that are no text of the program.
COMMENT = re.compile(r"^\s*//.*$", re.MULTILINE)


def comments(content: str, mark: str) -> Iterator[tuple[int, str]]:
    """Blocks of comments, and the docstrings of Python, each with its line."""
    block = re.compile(rf"(?:^[ \t]*{mark}[/!]?(?: .*)?\n)+", re.MULTILINE)
    found = [*block.finditer(content)]
    if mark == "#":
        found += re.finditer(r'(?<=""")[^"]+(?=""")', content)
    for comment in found:
        text = re.sub(rf"^[ \t]*(?:{mark}[/!]?)?", "", comment[0], flags=re.MULTILINE)
        yield 1 + content[: comment.start()].count("\n"), text.strip()


def texts(path: Path) -> Iterator[tuple[int, str]]:
    """Texts of a file, each with its line."""
    content = path.read_text(encoding="utf-8")
    if path.suffix == ".md":
        yield from ((1 + content[: m.start()].count("\n"), m[0]) for m in re.finditer(r"[^\n]+(?:\n[^\n]+)*", content))
        return
    if not path.is_relative_to(ROOT / "src"):
        yield from comments(content, "//" if path.suffix == ".rs" else "#")
        return
    content = COMMENT.sub("", content).split("#[cfg(test)]\nmod tests")[0]
    for found in STRING.finditer(content):
        yield 1 + content[: found.start()].count("\n"), re.sub(r"\\\n\s*", "", found[0])


def files() -> Iterator[Path]:
    yield from (ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md"))
    for path in sorted((ROOT / "docs").rglob("*.md")):
        if path.name != "language.md":
            yield path
    for tree in ("src", "tests", "benches", "examples", "fuzz", "python"):
        for path in sorted((ROOT / tree).rglob("*")):
            if path.suffix in (".rs", ".py") and "target" not in path.parts:
                yield path
    yield from (path for path in sorted((ROOT / ".ci").iterdir()) if path.is_file())


def main() -> int:
    found = [
        f"{path.relative_to(ROOT)}:{line}: {match[0]}"
        for path in files()
        for line, text in texts(path)
        for pattern in ((PATTERN,) if path.suffix == ".md" else (PATTERN, OPENING))
        for match in pattern.finditer(" ".join(text.split()))
    ]
    print(*found, sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
