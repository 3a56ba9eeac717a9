"""Holds built pages against the net: what they load has to be in their own folder."""

from __future__ import annotations

import re
import sys
from html.parser import HTMLParser
from pathlib import Path

LOADED = {"script": "src", "img": "src", "source": "src", "video": "src", "audio": "src", "iframe": "src",
          "embed": "src", "object": "data", "use": "href", "image": "href"}  # fmt: skip
# Of <link>: what a browser fetches. A canonical address or an author is only said.
FETCHED = {"stylesheet", "preload", "modulepreload", "icon", "shortcut", "manifest", "prefetch"}
OUTSIDE = re.compile(r"^(?:[a-z]+:)?//", re.IGNORECASE)
FROM_STYLE = re.compile(r"url\(\s*['\"]?([^'\")]+)|@import\s+['\"]([^'\"]+)")


class Loads(HTMLParser):
    """What a page loads."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        if tag in LOADED:
            self.found += [given.get(LOADED[tag], ""), given.get("xlink:href", "")]
        if tag == "link" and FETCHED & set(given.get("rel", "").split()):
            self.found.append(given.get("href", ""))
        self.found += [a or b for a, b in FROM_STYLE.findall(given.get("style", ""))]


def of_page(path: Path) -> list[str]:
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".html":
        parser = Loads()
        parser.feed(text)
        text = "".join(re.findall(r"<style[^>]*>(.*?)</style>", text, re.DOTALL))
        return parser.found + [a or b for a, b in FROM_STYLE.findall(text)]
    return [a or b for a, b in FROM_STYLE.findall(text)]


def main(folder: Path) -> int:
    pages = sorted([*folder.rglob("*.html"), *folder.rglob("*.css")])
    found = [(page, load) for page in pages for load in of_page(page) if OUTSIDE.match(load)]
    for page, load in found:
        print(f"{page.relative_to(folder)} loads {load}")
    print(f"{len(pages)} pages and styles, {len(found)} load from the net")
    return 1 if found or not pages else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
