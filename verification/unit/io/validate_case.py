#!/usr/bin/python3
"""Validates a case file against the JSON Schema that `hdem schema` prints: validate_case.py SCHEMA.json CASE.toml"""

import json
import sys
import tomllib

import jsonschema


def main() -> int:
    with open(sys.argv[1], encoding="utf-8") as file:
        schema = json.load(file)
    with open(sys.argv[2], "rb") as file:
        case = tomllib.load(file)
    jsonschema.Draft7Validator.check_schema(schema)
    errors = list(jsonschema.Draft7Validator(schema).iter_errors(case))
    for error in errors:
        print("/".join(map(str, error.absolute_path)) + ":", error.message)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
