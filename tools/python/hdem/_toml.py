"""A case in Python's own types, written as TOML."""
from __future__ import annotations

import json
import os
import re
import tomllib
from collections.abc import Mapping, Sequence
from typing import Any

_PLAIN_KEY = re.compile(r"[A-Za-z0-9_-]+")


def from_toml(text: str) -> dict[str, Any]:
    """The case in a text, which may begin with the mark that Windows puts there."""
    return tomllib.loads(text.removeprefix("\ufeff"))


def to_toml(case: Mapping[str, Any]) -> str:
    """Text of a case file with the keys and values of `case`.

    Sections are dicts, sections that occur several times lists of dicts. Values may be numpy's: arrays become lists. Other types than
    texts, numbers, truth values, lists and dicts raise TypeError that names the key.
    """
    plain = {key: _python_value(value) for key, value in case.items()}
    lines = [f"{_key(key)} = {_value(value, key)}" for key, value in plain.items() if not _is_section(value)]
    for key, value in plain.items():
        if _is_section(value):
            lines += _section(key, value)
    return "\n".join(lines) + "\n"


def toml_value(value: Any, key: str = "value") -> str:
    """One value, as on the right of a `=`."""
    return _value(_python_value(value), key)


def _python_value(value: Any) -> Any:
    """Numpy's numbers and arrays as those of Python."""
    return value.tolist() if hasattr(value, "tolist") else value


def _is_tables(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str) and len(value) > 0 and all(isinstance(v, Mapping) for v in value)


def _is_section(value: Any) -> bool:
    return isinstance(value, Mapping) or _is_tables(value)


def _section(name: str, value: Any) -> list[str]:
    if _is_tables(value):
        return [line for table in value for line in ["", f"[[{_key(name)}]]", *_rows(table, name)]]
    if value and all(isinstance(v, Mapping) for v in value.values()):    # [joint.NAME]
        return [line for key, table in value.items() for line in ["", f"[{_key(name)}.{_key(key)}]", *_rows(table, f"{name}.{key}")]]
    return ["", f"[{_key(name)}]", *_rows(value, name)]


def _rows(table: Mapping[str, Any], path: str) -> list[str]:
    return [f"{_key(key)} = {_value(_python_value(value), f'{path}.{key}')}" for key, value in table.items()]


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise TypeError(f"key {key!r} of a case is not a text")
    return key if _PLAIN_KEY.fullmatch(key) else _text(key)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007F")


def _value(value: Any, path: str) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(int(value) if isinstance(value, int) else float(value))    # kinds of their own, as IntEnum, have a repr of their own
    if isinstance(value, (str, os.PathLike)):
        return _text(os.fspath(value))
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(k)} = {_value(_python_value(v), f'{path}.{k}')}" for k, v in value.items()) + "}"
    if isinstance(value, Sequence):
        return "[" + ", ".join(_value(_python_value(v), path) for v in value) + "]"
    raise TypeError(f"{path} = {value!r} ({type(value).__name__}): a case holds texts, numbers, truth values, lists and dicts")
