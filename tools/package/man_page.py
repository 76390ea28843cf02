#!/usr/bin/python3
"""Man page of a Python script, of its docstring: indented lines are commands and stay as they are.

    man_page.py SCRIPT NAME VERSION OUTPUT
"""
import ast
import sys
from pathlib import Path


def escaped(line):
    line = line.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + line if line.startswith((".", "'")) else line


def page_of(text, name, version):
    first, *paragraphs = text.strip().split("\n\n")
    lines = [f'.TH {name.upper()} 1 "" "hdem {version}"', ".SH NAME", f"{escaped(name)} \\- {escaped(first.split(':')[0][0].lower() + first.split(':')[0][1:])}",
             ".SH DESCRIPTION", escaped(first)]
    for paragraph in paragraphs:
        rows = paragraph.replace("tools/sweep ", f"{name} ").splitlines()
        if all(row.startswith("    ") for row in rows):
            lines += [".PP", ".nf", *(escaped(part) for row in rows for part in split(row)), ".fi"]
        else:
            lines += [".PP", *map(escaped, rows)]
    return "\n".join([*lines, ".SH SEE ALSO", ".BR hdem (1),", f".B {escaped(name)} plan \\-\\-help", "and the like for each command; the guide in /usr/share/doc/hdem/guide"]) + "\n"


def split(row):
    """A command, and what it does, below it."""
    command, _, does = row.strip().partition("   ")
    return [f"    {command}", *([f"        {does.strip()}"] if does else [])]


if __name__ == "__main__":
    script, name, version, output = sys.argv[1:]
    Path(output).write_text(page_of(ast.get_docstring(ast.parse(Path(script).read_text(encoding="utf-8"))), name, version), encoding="utf-8")
