#!/usr/bin/python3
"""The words of case files, for libFuzzer: all sections, keys and values with a name that `hdem schema` knows, and numbers that hurt.

    case_dict.py HDEM > case.dict          writes the dictionary
    case_dict.py HDEM --check case.dict    exit code 1 where it is not that of this hdem
"""
import json
import subprocess
import sys
from pathlib import Path

HURT = ["nan", "inf", "1e308", "1e-308", "-1", "0", "1e-9", "1e18", "[[0, 0], [1, 0], [1, 1]]", "[[0, 0], [5, 1]]", '[\\"*\\"]', "{mean = 1, sd = 1}"]


def properties_of(node):
    return node.get("properties") or (node["items"].get("properties") if isinstance(node.get("items"), dict) else None)


def words_of(node, words):
    """Keys and named values below a node of the schema."""
    if isinstance(node, dict):
        words |= {f'\\"{value}\\"' for value in node.get("enum", []) if isinstance(value, str)}
        words |= {f"{key} = " for key in node.get("properties", {})}
        for value in node.values():
            words_of(value, words)
    elif isinstance(node, list):
        for value in node:
            words_of(value, words)
    return words


def headers_of(schema):
    for name, node in schema["properties"].items():
        if node.get("type") == "array" and properties_of(node):
            yield f"[[{name}]]\\x0a"
        elif "additionalProperties" in node and isinstance(node["additionalProperties"], dict):
            yield f"[{name}.default]\\x0a"
        elif properties_of(node):
            yield f"[{name}]\\x0a"


def dictionary(program):
    schema = json.loads(subprocess.run([program, "schema"], capture_output=True, text=True, check=True).stdout)
    words = sorted(set(headers_of(schema)) | words_of(schema, set()) | set(HURT))
    return "# Written by case_dict.py from `hdem schema`.\n" + "".join(f'"{word}"\n' for word in words)


def main(arguments):
    text = dictionary(arguments[0])
    if arguments[1:2] == ["--check"]:
        if Path(arguments[2]).read_text(encoding="utf-8") != text:
            print(f"{arguments[2]} is out of date: verification/fuzz/case_dict.py HDEM > verification/fuzz/case.dict")
            return 1
        return 0
    print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
