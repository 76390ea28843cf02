"""Forces that a user puts on blocks between runs: they stand in the case, as loads of one block each."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

KEYS = {"blocks", "force", "moment", "from_cycle"}    # moment = 0 marks them: who writes a case by hand leaves it out


def _is_applied(load: dict[str, Any]) -> bool:
    return load.keys() == KEYS and len(load["blocks"]) == 1 and load["moment"] == 0.0


def applied_forces(case: dict[str, Any], names: Sequence[str]) -> NDArray[np.float64]:
    """Those that act now, (n, 2) [N]."""
    row = {name: number for number, name in enumerate(names)}
    forces = np.zeros((len(names), 2))
    for load in filter(_is_applied, case.get("load", [])):
        forces[row[load["blocks"][0]]] += load["force"]
    return forces


def apply_forces(case: dict[str, Any], names: Sequence[str], forces: NDArray[np.float64], cycle: int) -> bool:
    """The case with these from this cycle on. Whether anything changes."""
    changed = np.flatnonzero(np.any(forces != applied_forces(case, names), axis=1))
    others = {names[row] for row in changed}
    loads = []
    for load in case.get("load", []):
        if _is_applied(load) and load["blocks"][0] in others:
            if load["from_cycle"] == cycle:
                continue    # it has not acted yet
            load["until_cycle"] = cycle
        loads.append(load)
    loads += [{"blocks": [names[row]], "force": forces[row].tolist(), "moment": 0.0, "from_cycle": cycle} for row in changed if np.any(forces[row])]
    case["load"] = loads
    return len(changed) > 0
