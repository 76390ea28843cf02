"""A case: read, checked, its blocks made."""
from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from . import _core
from ._toml import from_toml, to_toml, toml_value


def override_texts(changes: Mapping[str, Any] | Iterable[str]) -> list[str]:
    """{"generator.seed": 3}, {"generator": {"seed": 3}} or ["generator.seed=3"] -> ["generator.seed=3"]"""
    if isinstance(changes, str):
        raise TypeError('set: a list of texts "key=value", or a dict, is needed')
    if isinstance(changes, Mapping):
        return [f"{key}={toml_value(value, key)}" for key, value in _members(changes)]
    return [str(change) for change in changes]


def _members(changes: Mapping[str, Any], section: str = "") -> Iterator[tuple[str, Any]]:
    """Members of a section by themselves: what a dict does not name stays."""
    for key, value in changes.items():
        is_section = not section and "." not in key and "[" not in key or section in ("joint", "material")
        if is_section and isinstance(value, Mapping):
            yield from ((f"{key}.{member}", one) for member, one in _members(value, key if not section else " "))
        else:
            yield key, value


def whole(name: str, value: Any) -> int | None:
    """A whole number of any kind, numpy's too, or None."""
    if value is None:
        return None
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} = {value!r:.80}: a whole number is needed, or None") from None
    if abs(number) >= 2**31 and name != "cycles" or abs(number) >= 2**62:
        raise ValueError(f"{name} = {max(min(number, 10**300), -10**300):.4g}: too great")
    return number


def require_case(case: Any, what: str) -> None:
    if not isinstance(case, _core.Case):
        raise TypeError(f"{what}: an hdem.Case is needed, not {case!r:.80}. hdem.Case(file or dict) makes one.")


class Case(_core.Case):
    """A case that has been read, and the blocks that it makes.

    source  name of a case file, or a dict with the keys of one (io/case_format.md)
    set     values laid over it, as --set of the program: {"joint.default.cohesion": 0, "stage[1].max_cycles": 2000}, or texts "key=value".
            A dict for a section, {"generator": {"seed": 3}}, leaves the keys that it does not name
    name    of a dict in messages; files that it names (blocks_file, ...) are looked up beside it

    Raises CaseError with all problems at once. Lines and columns in messages about a dict are those of `text`.
    All arrays are copies, one row a block, in the order of the case.
    """

    def __init__(self, source: str | os.PathLike[str] | Mapping[str, Any], *, set: Mapping[str, Any] | Iterable[str] = (),
                 name: str | os.PathLike[str] = "case.toml") -> None:
        if isinstance(source, Mapping):
            try:
                text = to_toml(source)
            except RecursionError:
                raise ValueError("a case holds itself, or is nested without end") from None
            super().__init__(text, os.fspath(name), override_texts(set))
        else:
            if not isinstance(source, (str, os.PathLike)):
                raise TypeError(f"Case: a file name or a dict is needed, not {source!r:.80}")
            super().__init__(None, os.fspath(source), override_texts(set))
        self._is_read = True

    @property
    def data(self) -> dict[str, Any]:
        """The text as a dict of its own, without what `set` says."""
        return from_toml(self.text)

    @property
    def blocks(self) -> int:
        """How many there are."""
        return len(self.names)

    def __reduce__(self) -> tuple[Any, ...]:    # for other processes: it is made again there, of the same texts
        return _make_again, (self.text, self.file, self.overrides, self._files)

    def __repr__(self) -> str:
        if not getattr(self, "_is_read", False):
            return "<hdem.Case that could not be read>"
        return f"<hdem.Case {self.file!r}: {self.blocks} blocks, stages {', '.join(self.stage_names)}>"


def _make_again(text: str, file: str, overrides: list[str], files: dict[str, bytes]) -> Case:
    case = Case.__new__(Case)
    _core.Case.__init__(case, text, file, overrides, files)
    case._is_read = True
    return case
