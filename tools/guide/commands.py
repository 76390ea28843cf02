#!/usr/bin/python3
"""Runs the commands of the guide's pages as a reader would, one page after another.

    tools/guide/commands.py [PAGE...]            short forms, as the tests do; without names all pages
    tools/guide/commands.py --long [PAGE...]     as they stand: ten minutes and more for all pages
    tools/guide/commands.py --list               what is run, and what is not and why
    tools/guide/commands.py --long --pictures gallery    and keeps the pictures that the page shows, in docs/pictures

    --program HDEM    default: the variable HDEM, or that of the preset release
    --keep FOLDER     the pages' runs go there and stay

Commands are the blocks ```sh and ```python of a page. They run in an empty folder for each page, beside links to tools and verification. A comment before a block says more:

    <!-- short: WORDS -->      the test adds these words to each hdem run, fos and critical, and to tools/sweep work
    <!-- long -->              runs with --long only
    <!-- not run: REASON -->

A block ```text behind one is what it prints: each line must be among what it has printed, but where the block before was shortened.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

GUIDE = Path(__file__).resolve().parent
ROOT = GUIDE.parent.parent
BLOCK = re.compile(r"^(?:<!-- (?P<note>[^\n]*?) -->\n+)?```(?P<kind>sh|python|text)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
TAKES_WORDS = re.compile(r"(hdem (run|fos|critical)|tools/sweep work) ")


@dataclass
class Block:
    kind: str    # sh, python or text
    text: str
    short: str = ""    # words that make it quick
    is_long: bool = False
    reason: str = ""    # why it is not run


def blocks_of(text, page):
    found = []
    for match in BLOCK.finditer(text):
        block, note = Block(match["kind"], match["text"]), match["note"]
        if note == "long":
            block.is_long = True
        elif note and note.startswith("short: "):
            block.short = note[7:]
        elif note and note.startswith("not run: "):
            block.reason = note[9:]
        elif note and block.kind != "text":
            raise ValueError(f"{page}: <!-- {note} --> is neither short, long nor not run")
        found.append(block)
    return found


def shortened(block):
    """Its lines with the words of the short form, before a comment."""
    lines = []
    for line in block.text.splitlines():
        if block.short and TAKES_WORDS.match(line):
            command, gap, comment = line.partition("   # ")
            line = f"{command.rstrip()} {block.short}{gap}{comment}"
        lines.append(line)
    return "\n".join(lines) + "\n"


def words_of(block, is_long):
    text = block.text if is_long else shortened(block)
    return ["bash", "-euo", "pipefail", "-c", text] if block.kind == "sh" else ["/usr/bin/python3", "-c", text]


def squeezed(text):
    return {" ".join(line.split()) for line in text.splitlines()}


def environment(program):
    prefix = program.parent.parent
    modules = f"{ROOT / 'tools'}:{prefix / 'share/hdem'}:{prefix / 'python'}"    # hdem_io and, where it was built, hdem
    return os.environ | {"HDEM": str(program), "PATH": f"{program.parent}:{os.environ['PATH']}", "PYTHONPATH": modules, "MPLBACKEND": "Agg"}


def run_page(page, folder, program, is_long, say=print):
    """Runs all blocks of a page; how many failed."""
    for name in ("tools", "verification", "io"):
        if not (folder / name).exists():
            (folder / name).symlink_to(ROOT / name)
    failed, printed, whole = 0, "", False
    for block in blocks_of(page.read_text(encoding="utf-8"), page.name):
        if block.kind == "text":
            missing = [line for line in block.text.splitlines() if " ".join(line.split()) not in squeezed(printed) and line.strip() not in ("", "...")]
            if whole and missing:
                failed += 1
                say(f"{page.name}: not printed: {missing}\n{printed}")
            continue
        if block.reason or (block.is_long and not is_long):
            whole = False
            continue
        done = subprocess.run(words_of(block, is_long), cwd=folder, env=environment(program), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        printed, whole = done.stdout, is_long or not block.short
        if done.returncode:
            failed += 1
            say(f"{page.name}: exit code {done.returncode} of\n{block.text}{done.stdout[-3000:]}")
    return failed


def keep_pictures(page, folder, say=print):
    """Those that the page shows and its commands have made."""
    for name in re.findall(r"\]\(pictures/([^)]+)\)", page.read_text(encoding="utf-8")):
        if (folder / name).exists():
            shutil.copyfile(folder / name, GUIDE / "docs/pictures" / name)
            say(f"{name}: {(folder / name).stat().st_size // 1024} kB")


def tell(page):
    for block in blocks_of(page.read_text(encoding="utf-8"), page.name):
        if block.kind != "text":
            how = f"not run: {block.reason}" if block.reason else "long" if block.is_long else f"short: {block.short}" if block.short else "as it stands"
            print(f"{page.name} [{how}]\n" + "".join(f"    {line}\n" for line in block.text.splitlines()))


def main(arguments):
    parser = argparse.ArgumentParser(prog="commands.py", description="Runs the commands of the guide's pages.")
    parser.add_argument("pages", nargs="*", help="names of pages, e.g. slope (default: all)")
    parser.add_argument("--long", action="store_true", help="as they stand, not shortened")
    parser.add_argument("--list", action="store_true", help="only say what is run")
    parser.add_argument("--pictures", action="store_true", help="keep the pictures that the pages show")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="the runs go there and stay")
    parser.add_argument("--program", type=Path, default=Path(os.environ.get("HDEM", ROOT / "build/release/bin/hdem")))
    options = parser.parse_args(arguments)
    pages = [GUIDE / "docs" / f"{name.removesuffix('.md')}.md" for name in options.pages] or sorted((GUIDE / "docs").glob("*.md"))
    missing = [page.stem for page in pages if not page.exists()]
    if missing:
        parser.error(f"{missing[0]}: no such page. There are {', '.join(sorted(page.stem for page in (GUIDE / 'docs').glob('*.md')))}.")
    failed = 0
    for page in pages:
        if options.list:
            tell(page)
            continue
        with tempfile.TemporaryDirectory(prefix="hdem_guide_") as scratch:
            folder = (options.keep.resolve() if options.keep else Path(scratch)) / page.stem
            folder.mkdir(parents=True, exist_ok=True)
            problems = run_page(page, folder, options.program.resolve(), options.long)
            if options.pictures and not problems:
                keep_pictures(page, folder)
            print(f"{page.stem}: {'failed' if problems else 'done'}", flush=True)
            failed += problems
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
