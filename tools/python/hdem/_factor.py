"""The factor of safety by strength reduction."""
from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from . import _core
from ._case import Case, require_case, whole


@dataclass(frozen=True)
class Trial:
    """The rock with its strength divided by `factor`."""

    search: str                  # "as_given", "peak" or "stiffer"
    factor: float
    verdict: str                 # "stable", "failed" or "undecided", which counts as failed
    reason: str
    displacement: float          # of the block that moved farthest [m]
    cycles: int
    time: float                  # simulated [s]
    failing_blocks: list[str]    # names, the first to fail comes first


@dataclass(frozen=True)
class FactorOfSafety:
    """The answer; `data` is all that `hdem fos` writes into summary.json."""

    factor: float | None         # middle of the last bracket; None where all trials stand, or all fail
    stable_at: float | None
    failed_at: float | None
    bound: float | None          # by limit analysis: the factor is at most that
    failing_blocks: list[str]
    warnings: list[str]
    trials: list[Trial]
    data: dict[str, Any] = field(repr=False)


def fos(case: Case, *, threads: int | None = None, callback: Callable[[Trial], object] | None = None) -> FactorOfSafety:
    """Run all stages of a case, then divide the strength of its joints by F until blocks fail; as `hdem fos`, but nothing is written.

    callback(trial) is called after each trial that counts; an exception of it ends the search. Ctrl-C ends the search. `[factor_of_safety]` of the case
    says which joints and how narrow the bracket is. Raises CaseError where the rock is never at rest, RunError where a run fails.
    """
    require_case(case, "fos")
    if callback is not None and not callable(callback):
        raise TypeError(f"fos(): callback must be a function of one trial, not {callback!r:.80}")
    show = None if callback is None else lambda text: callback(Trial(**json.loads(text)))
    data = json.loads(_core.find_factor(case, whole("threads", threads), show))
    return FactorOfSafety(trials=[Trial(**trial) for trial in data["trials"]], data=data,
                          **{key: data[key] for key in ("factor", "stable_at", "failed_at", "bound", "failing_blocks", "warnings")})
