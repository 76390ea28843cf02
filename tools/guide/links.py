#!/usr/bin/python3
"""Finds links that lead nowhere, inside this repository.

    tools/guide/links.py [FILE.md...]     of Markdown files; without names of README.md, CONTRIBUTING.md, all README.md of folders and the guide
    tools/guide/links.py --site FOLDER    of all pages of the built guide

Looked at are files and headings (#...); addresses of the network are not asked. Exit code 1: a link is dead.
"""
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parents[2]
FENCE = re.compile(r"^(```|~~~).*?^\1", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ +(.+?) *$", re.MULTILINE)
INCLUDED = re.compile(r'^--8<-- "([^"]+)"$', re.MULTILINE)
ELSEWHERE = ("http:", "https:", "mailto:", "data:", "javascript:")


def slug(heading):
    """Name of a heading in a link, as GitHub and mkdocs make it for what stands in these pages."""
    words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[ -]+", "-", re.sub(r"[^\w\- ]", "", words.lower()).strip())


def text_of(file):
    """With what it includes."""
    text = file.read_text(encoding="utf-8")
    return INCLUDED.sub(lambda match: (ROOT / match.group(1)).read_text(encoding="utf-8") if match.group(1).endswith(".md") else "", FENCE.sub("", text))


def dead_in_markdown(file):
    for link in LINK.findall(text_of(file)):
        if link.startswith(ELSEWHERE):
            continue
        path, _, name = unquote(link).partition("#")
        target = (file.parent / path).resolve() if path else file
        if not target.exists():
            yield link, "no such file"
        elif name and target.suffix == ".md" and name not in {slug(heading) for heading in HEADING.findall(FENCE.sub("", text_of(target)))}:
            yield link, "no such heading"


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.names = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("id", "name") and value:
                self.names.add(value)
            elif key in ("href", "src") and value and not value.startswith(ELSEWHERE):
                self.links.append(value)


def dead_in_site(folder):
    pages = {file.resolve(): Page(file.read_text(encoding="utf-8")) for file in sorted(folder.rglob("*.html")) if file.name != "404.html"}
    for file, page in pages.items():
        for link in page.links:
            path, _, name = unquote(link).partition("#")
            target = (file.parent / path.partition("?")[0]).resolve() if path else file
            target = target / "index.html" if target.is_dir() else target
            if not target.exists():
                yield file, link, "no such file"
            elif name and target in pages and name not in pages[target].names:
                yield file, link, "no such heading"
    if not pages:
        yield folder, "index.html", "no pages"


def markdown_files():
    found = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "tools/guide/docs").glob("*.md"))]
    return found + [file for top in ("core", "io", "parallel", "perf", "tools", "verification") for file in sorted((ROOT / top).rglob("*.md"))
                    if file not in found and "node_modules" not in file.parts and file.name != "case_format.md"] + [ROOT / "io/case_format.md"]


def main(arguments):
    if arguments[:1] == ["--site"]:
        dead = list(dead_in_site(Path(arguments[1])))
    else:
        dead = [(file, *found) for file in (map(Path, arguments) if arguments else markdown_files()) for found in dead_in_markdown(file.resolve())]
    for file, link, why in dead:
        print(f"{file}: {link}: {why}")
    return 1 if dead else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
