#!/usr/bin/python3
"""Fails when a .cpp file is not named in the next CMakeLists.txt above it: it would be neither built nor tested. Also fails when git
keeps something in the root folder that does not belong there, such as the results of a run.

    source_lists.py [ROOT]
"""
import re
import subprocess
import sys
from pathlib import Path

FOLDERS = ("core", "parallel", "io", "verification", "perf", "tools")
ROOT_FILES = ("CHANGELOG.md", "CITATION.cff", "CMakeLists.txt", "CMakePresets.json", "CONTRIBUTING.md", "LICENSE", "README.md")


def find_strangers(root):
    """Names in the root folder that git keeps for no reason. None without git."""
    try:
        listed = subprocess.run(["git", "-C", root, "ls-files", "-z"], capture_output=True, text=True, check=False).stdout
    except FileNotFoundError:
        return
    for name in sorted({path.split("/")[0] for path in listed.split("\0") if path}):
        if not (name.startswith(".") or name in FOLDERS + ROOT_FILES):
            yield f"{name} does not belong into the root folder"


def find_problems(root):
    yield from find_strangers(root)
    for folder in FOLDERS:
        for file in sorted((root / folder).rglob("*.cpp")):
            lists = next(above / "CMakeLists.txt" for above in file.parents if (above / "CMakeLists.txt").exists())
            name = file.relative_to(lists.parent).as_posix()
            if not re.search(rf"(^|[\s(]){re.escape(name)}($|[\s)])", lists.read_text(encoding="utf-8"), re.MULTILINE):
                yield f"{file.relative_to(root)} is not named in {lists.relative_to(root)}"


if __name__ == "__main__":
    found = list(find_problems(Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()))
    print("\n".join(found + [f"{len(found)} problems"]))
    sys.exit(1 if found else 0)
