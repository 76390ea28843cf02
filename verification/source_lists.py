#!/usr/bin/python3
"""Fails when a .cpp file is not named in the next CMakeLists.txt above it: it would be neither built nor tested.

    source_lists.py [ROOT]
"""
import re
import sys
from pathlib import Path

FOLDERS = ("core", "parallel", "io", "limit", "verification", "perf", "tools")


def find_problems(root):
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
