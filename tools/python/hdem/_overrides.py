"""Values that are laid over a case: those of sections that change later become part of it."""
from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable
from typing import Any

_STEP = re.compile(r"([^.\[\]]+)(?:\[(\d+)\])?")


def _value(text: str) -> Any:
    """As --set reads it: TOML, or a bare word."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text


def _entry(entries: list[dict[str, Any]], section: str, name: str) -> dict[str, Any]:
    return next(entry for number, entry in enumerate(entries, 1) if entry.get("name", f"{section}{number}") == name)


def _lay(case: dict[str, Any], path: str, value: Any) -> None:
    """A path that the program has accepted: "stage[1].max_cycles", or with the entry's name "stage.collapse.max_cycles"."""
    steps = [(match[1], match[2]) for match in map(_STEP.fullmatch, path.split(".")) if match]
    at: Any = case
    for place, (name, index) in enumerate(steps):
        last = place + 1 == len(steps)
        if isinstance(at, list):
            entry = _entry(at, steps[place - 1][0], name)
            if last:
                entry.clear()
                entry.update(value)
            at = entry
        elif index is None and last:
            at[name] = value
        elif index is None:
            at = at.setdefault(name, {})
        elif last:
            at[name][int(index)] = value
        else:
            at = at[name][int(index)]


def take_in(case: dict[str, Any], overrides: Iterable[str], sections: frozenset[str]) -> list[str]:
    """Writes what is laid over these sections into the case. The others are left."""
    left = []
    for text in overrides:
        path, _, value = text.partition("=")
        if re.split(r"[.\[]", path.strip())[0] in sections:
            _lay(case, path.strip(), _value(value.strip()))
        else:
            left.append(text)
    return left
