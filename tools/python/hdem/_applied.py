"""Forces that a user puts on blocks between runs: they stand in the case, as loads of one block each."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

KEYS = {"blocks", "force", "moment", "from_cycle"}    # moment = 0 marks them: who writes a case by hand leaves it out


def _is_applied(load: dict[str, Any]) -> bool:
    return load.keys() - {"since"} == KEYS and len(load["blocks"]) == 1 and load["moment"] == 0.0


def stage_name(case: dict[str, Any], number: int) -> str | None:
    """None where the case has no such stage."""
    stages = case.get("stage", [])
    return stages[number].get("name", f"stage{number + 1}") if number < len(stages) else None


def applied_forces(case: dict[str, Any], names: Sequence[str]) -> NDArray[np.float64]:
    """Those that act now, (n, 2) [N]."""
    row = {name: number for number, name in enumerate(names)}
    forces = np.zeros((len(names), 2))
    for load in filter(_is_applied, case.get("load", [])):
        forces[row[load["blocks"][0]]] += load["force"]
    return forces


def apply_forces(case: dict[str, Any], names: Sequence[str], forces: NDArray[np.float64], since: str | None, age: Callable[[str | None], int]) -> bool:
    """The case with these from now on. Whether anything changes.

    since  the stage that runs, or the next one: stages before it do not wait for the load when the case is run again. None: there is none yet
    age    cycles since a stage began, or the run; below 0: it has not
    """
    changed = np.flatnonzero(np.any(forces != applied_forces(case, names), axis=1))
    row_of = {names[row]: row for row in changed}
    kept = np.zeros_like(forces)
    loads = []
    for load in case.get("load", []):
        if _is_applied(load) and load["blocks"][0] in row_of:
            now = age(load.get("since"))
            if now <= load["from_cycle"]:
                continue    # it has not acted yet
            if load.get("since") == since:
                load["until_cycle"] = now
            else:    # its stage is over. An end by its cycles would let that stage wait for it when the case is run again: what changes is a load of its own
                kept[row_of[load["blocks"][0]]] += load["force"]
        loads.append(load)
    forces = forces - kept
    begin = {"from_cycle": max(age(since), 0)} | ({} if since is None else {"since": since})
    loads += [{"blocks": [names[row]], "force": forces[row].tolist(), "moment": 0.0, **begin} for row in changed if np.any(forces[row])]
    case["load"] = loads
    return len(changed) > 0


def begin_with_stage(case: dict[str, Any], cycle: int, since: str) -> None:
    """Those that wait for a stage begin with this one."""
    for load in filter(_is_applied, case.get("load", [])):
        if "since" not in load and load["from_cycle"] == cycle:
            load |= {"from_cycle": 0, "since": since}
