"""A run."""
from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from . import _core
from ._applied import applied_forces, apply_forces, begin_with_stage, stage_name
from ._case import Case, require_case, whole
from ._overrides import take_in
from ._toml import from_toml, to_toml, toml_value

ASSIGNED = ("positions", "velocities", "rotations", "angular_velocities", "applied_forces")
RESULTS = ("forces", "moments", "stresses", "displacements", "turns")
CHANGED = frozenset({"stage", "load"})    # sections of the case that change as it runs
REGIMES = ("open", "stick", "slip", "impulse")    # by the number in contacts()["regime"]


def numbers(name: str, value: Any) -> Any:
    """As an array of float64. What a mask hides is no number to take."""
    if np.ma.is_masked(value):
        raise ValueError(f"{name}: {np.ma.count_masked(value)} elements are masked; filled(...) gives them values")
    try:
        array = np.asarray(value)
        if array.dtype.kind == "c":
            raise TypeError("complex")
        return array.astype(np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: an array of numbers is needed, not {value!r:.80}") from None


class Simulation(_core.Run):
    """A case and its present state.

    case       what to run; it is copied, and may be used again
    folder     write there what `hdem run -o` writes: frames, results.h5, checkpoints, run.log, summary.json. None: nothing is written
    threads    fixed number, or None: as many as are fastest at the moment. Results do not depend on it
    overwrite  begin anew where a run in the folder was cut short

    Arrays are copies with one row a block, row i is block i of the case: a block keeps its number for ever, also once it is removed (`present`
    says so) and however the program sorts blocks in memory. motion_view and force_view are no copies; see there how long they hold.
    One simulation is used by one thread at a time; several may run in several threads, as cycles run without Python's lock.
    """

    def __init__(self, case: Case, *, folder: str | os.PathLike[str] | None = None, threads: int | None = None,
                 overwrite: bool = False) -> None:
        require_case(case, "Simulation")
        super().__init__(case, None if folder is None else os.fspath(folder), whole("threads", threads), bool(overwrite))
        self._is_there = True

    @classmethod
    def from_checkpoint(cls, file: str | os.PathLike[str], *, threads: int | None = None) -> Simulation:
        """The state in a checkpoint file, or in that of a folder, with the case that it holds. Nothing is written."""
        place = os.fspath(file)
        return cls._loaded(os.path.join(place, "checkpoint.h5") if os.path.isdir(place) else place, False, threads)

    @classmethod
    def restart(cls, folder: str | os.PathLike[str], *, threads: int | None = None) -> Simulation:
        """Go on with the run in a folder, and write there, as `hdem run --restart`."""
        return cls._loaded(os.fspath(folder), True, threads)

    @classmethod
    def _loaded(cls, checkpoint: str, writes: bool, threads: int | None) -> Simulation:
        simulation = cls.__new__(cls)
        _core.Run.__init__(simulation, checkpoint, writes, whole("threads", threads))
        simulation._is_there = True
        return simulation

    def run(self, *, cycles: int | None = None, stages: int | None = None, callback: Callable[[Simulation], object] | None = None,
            every: int = 1000) -> list[dict[str, Any]]:
        """Run what is left of the case, or so many stages of it (the running one counts), or at most so many cycles.

        callback(simulation) is called after each cycle that is a multiple of `every`; False ends the run there. In it the state may be read and
        motions assigned. An exception of it, and Ctrl-C (KeyboardInterrupt), end the run between two cycles; the state is whole, and run() goes
        on from there. Where there is a folder a checkpoint is then written.
        Returns all stages that have begun, each a dict: name, first_cycle, cycles, time [s] of the run at its end or now, is_over, converged,
        met_end (an end that the case asks for), not_at_rest (names of blocks), to_come (texts). Raises RunError where the run cannot go on, and warns
        (RuntimeWarning) of a stage that ended without the end that the case asks for: where the program ends with exit code 4.
        """
        if callback is not None and not callable(callback):
            raise TypeError(f"run(): callback must be a function of one simulation, not {callback!r:.80}")
        if every is None:
            raise TypeError("every = None: a whole number is needed")
        over = sum(stage["is_over"] for stage in self.results)
        stages_now = self._run(whole("cycles", cycles), whole("stages", stages), callback, whole("every", every))
        for stage in stages_now[over:]:
            if stage["is_over"] and not stage["met_end"]:
                moving = f", not at rest: {', '.join(stage['not_at_rest'][:5])}" if stage["not_at_rest"] else ""
                warnings.warn(f"stage {stage['name']!r} ended after {stage['cycles']} cycles without the end that it asks for{moving}",
                              RuntimeWarning, stacklevel=2)
        return stages_now

    def contacts(self, also_open: bool = False) -> Any:
        """Points of contacts as a structured array, a copy; closed ones, or all of faces near each other.

        blocks        (2,) int32, numbers of the first and the second block
        joint         int32, position in joint_names; -1: a wall of [[boundary]]
        end           uint8, 0 or 1: a contact has two points
        regime        uint8, position in hdem.REGIMES
        point         (2,) where it is [m]
        normal        (2,) from the first to the second block [-]; the shear axis is it turned left
        length        of the contact that this point bears [m]; force / length is its stress
        normal_force  compression positive [N]
        shear_force   on the second block along the shear axis [N]
        tilt_force    acts like it and adds to it in the balance of a block, but has nothing to do with friction: great where a corner presses on a side at an angle [N]
        gap           between the faces where the blocks are now, below 0: they overlap [m]
        closure       of the normal spring in the last cycle, with what in-situ stress presses it [m]
        slip          of the second block against the shear axis since the stage began, in the middle of the contact [m]
        plastic_slip  that the law remembers, signed as shear_force [m]; 0 of laws without memory
        broken        0 intact, 1 broken, or met after the start: cohesion and tension are gone

        Forces and closures are those of the last cycle, places and gaps those after it.
        """
        return super().contacts(also_open)

    def write_checkpoint(self, folder: str | os.PathLike[str]) -> None:
        """Write FOLDER/checkpoint.h5; the one that was there becomes checkpoint.previous.h5. `hdem run --restart` goes on from it."""
        super().write_checkpoint(os.fspath(folder))

    def write_frame(self, file: str | os.PathLike[str], kind: str = "blocks") -> None:
        """One picture of the present state for `hdem plot` and ParaView, as hdf5_format.md has it. kind: blocks, contacts, bolts or liners."""
        super().write_frame(os.fspath(file), kind)

    @property
    def summary(self) -> dict[str, Any]:
        """summary.json, once all stages have run into a folder; else an empty dict."""
        return json.loads(self._summary or "{}")

    @property
    def case(self) -> dict[str, Any]:
        """The case as a dict of its own, with stages that were added, without its overrides."""
        return from_toml(self.case_text)

    def _present_case(self) -> tuple[dict[str, Any], list[str]]:
        """The case as it is, and what is still laid over it: sections that change are as they run."""
        case = self.case
        return case, take_in(case, self.case_overrides, CHANGED)

    def add_stage(self, stage: Mapping[str, Any] | None = None, **keys: Any) -> None:
        """One more stage behind the last: the keys of [[stage]], as a dict or by name, e.g. add_stage(cycles=2000, set={"joint.default.cohesion": 0}).

        `set` changes numbers of joints and materials from that stage on: a dict, or texts as in the case. The changed case stands in case_text
        and goes into checkpoints: what was done can be run again by `hdem run`, with the same bits. Lines in
        messages about the changed case are those of case_text.
        """
        table = {**(stage or {}), **keys}
        if isinstance(table.get("set"), Mapping):
            table["set"] = [f"{key} = {toml_value(value, key)}" for key, value in table["set"].items()]
        case, overrides = self._present_case()
        case.setdefault("stage", []).append(table)
        if self.is_done:
            begin_with_stage(case, self.cycle, stage_name(case, len(case["stage"]) - 1))
        self._take_case(to_toml(case), overrides)

    def set(self, key: str, value: Any) -> None:
        """A number of a joint or material from the next stage on, e.g. set("joint.default.friction_angle_deg", 25), as `set` of that stage."""
        case, overrides = self._present_case()
        number = self.stage + (1 if self.stage_begun else 0)
        if number >= len(case.get("stage", [])):
            raise ValueError(f"set {key}: no stage is left to begin. Add one: add_stage(..., set={{{key!r}: {value!r}}}).")
        case["stage"][number].setdefault("set", []).append(f"{key} = {toml_value(value, key)}")
        self._take_case(to_toml(case), overrides)

    @property
    def applied_forces(self) -> Any:
        """What the user puts on each block's centroid, (n, 2) [N] per metre of thickness, beside weights, contacts and loads of the case. Zero at first.

        Reading gives a copy. What is assigned, between two calls of run(), acts from the next cycle on until other forces are assigned. It is written
        into the case, as a [[load]] for each row that changes: checkpoints keep it, and `hdem run` of case_text has it at the same cycles of its stage. A
        stage that looks for rest waits for loads that are to come: assign before it begins, and the case gives the same bits. For forces that change
        with time give the case a [[load]] with a table, or assign every hundred cycles or so, not in each one.
        """
        return applied_forces(self._present_case()[0], self.names)

    @applied_forces.setter
    def applied_forces(self, values: Any) -> None:
        names, (case, overrides) = self.names, self._present_case()
        if values.shape != (len(names), 2):
            raise ValueError(f"applied_forces: an array of shape ({len(names)}, 2) is needed, one row a block")
        for number in np.flatnonzero(~np.all(np.isfinite(values), axis=1)):
            raise ValueError(f"applied_forces: the number of block \"{names[number]}\" is not finite")
        for number in np.flatnonzero(np.any(values != 0.0, axis=1) & ~self.present):
            raise ValueError(f"applied_forces: block \"{names[number]}\" is removed: nothing can act on it. Give it 0.")
        stages = [stage_name(case, number) for number in range(len(case.get("stage", [])))]
        since = stage_name(case, self.stage + (1 if self.is_over else 0))
        if apply_forces(case, names, values, since, lambda stage: self._cycles_since(-1 if stage is None else stages.index(stage))):
            self._take_case(to_toml(case), overrides)

    def end_stage(self) -> None:
        """The running stage ends with the present cycle; run() goes on with the next one."""
        case, overrides = self._present_case()
        done = self.stage_cycles
        if not self.stage_begun or self.is_over or done < 1:
            raise ValueError("end_stage(): no stage is running. Run some cycles first.")
        table = case["stage"][self.stage]
        key = "max_cycles" if "until" in table else "cycles"
        for limit in ("cycles", "duration", "max_cycles"):
            table.pop(limit, None)
        table[key] = done
        self._take_case(to_toml(case), overrides)

    def __setattr__(self, name: str, value: Any) -> None:
        """A misspelt name would be a new attribute that does nothing. Classes of your own may have more."""
        if name in RESULTS:
            raise AttributeError(f"{name}: what cycles have made of the run, to be read only. To push a block assign applied_forces, or give the case a [[load]].")
        if type(self) is Simulation and not name.startswith("_") and not hasattr(Simulation, name):
            raise AttributeError(f"a Simulation has no {name!r}. What can be assigned: {', '.join(ASSIGNED)}.")
        super().__setattr__(name, numbers(name, value) if name in ASSIGNED else value)

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a Simulation cannot be copied or sent to another process: write_checkpoint() there, from_checkpoint() here")

    def __repr__(self) -> str:
        if not getattr(self, "_is_there", False):
            return "<hdem.Simulation that could not begin>"
        try:
            return f"<hdem.Simulation {self.case_file!r}: cycle {self.cycle}, stage {self.stage}>"
        except RuntimeError:    # cycles run in another thread
            return f"<hdem.Simulation {self.case_file!r} that runs>"
