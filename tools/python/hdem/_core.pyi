"""Types of the compiled part. Use the package hdem; texts stand in the docstrings there and in help(hdem.Simulation)."""
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Doubles = NDArray[np.float64]
_Numbers = NDArray[np.int32]
_Flags = NDArray[np.bool_]

def version_line() -> str: ...
def default_threads() -> int: ...
def find_factor(case: Case, threads: int | None, callback: Callable[[str], object] | None) -> str: ...

class _Blocks:
    @property
    def names(self) -> list[str]: ...
    @property
    def areas(self) -> _Doubles: ...              # (n,) [m2]
    @property
    def masses(self) -> _Doubles: ...             # (n,) [kg]
    @property
    def inertias(self) -> _Doubles: ...           # (n,) [kg m2]
    @property
    def materials(self) -> _Numbers: ...          # (n,)
    @property
    def fixed(self) -> _Flags: ...                # (n,)
    @property
    def walls(self) -> _Flags: ...                # (n,)
    @property
    def polygons(self) -> list[_Doubles]: ...     # n of (k, 2) [m]
    @property
    def parts(self) -> list[list[_Doubles]]: ...  # n lists of (k, 2) [m]
    @property
    def material_names(self) -> list[str]: ...
    @property
    def joint_names(self) -> list[str]: ...

class Case(_Blocks):
    def __init__(self, text: str | None, file: str, overrides: list[str], files: dict[str, bytes] | None = ...) -> None: ...
    @property
    def _files(self) -> dict[str, bytes]: ...
    @property
    def text(self) -> str: ...
    @property
    def file(self) -> str: ...
    @property
    def overrides(self) -> list[str]: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def title(self) -> str: ...
    @property
    def time_step(self) -> float: ...             # [s]
    @property
    def stage_names(self) -> list[str]: ...
    @property
    def excavations(self) -> _Numbers: ...        # (n,)
    @property
    def excavation_names(self) -> list[str]: ...
    @property
    def positions(self) -> _Doubles: ...          # (n, 2) [m]

class Run(_Blocks):
    def __init__(self, case: Case | str, folder: str | bool | None, threads: int | None, overwrite: bool = ...) -> None: ...
    def _run(self, cycles: int | None, stages: int | None, callback: Callable[[Any], object] | None, every: int) -> list[dict[str, Any]]: ...
    def _cycles_since(self, stage: int) -> int: ...
    def _take_case(self, text: str, overrides: list[str]) -> None: ...
    def contacts(self, also_open: bool = ...) -> NDArray[np.void]: ...
    def write_checkpoint(self, folder: str) -> None: ...
    def write_frame(self, file: str, kind: str = ...) -> None: ...

    # motion: copies, which may be assigned
    @property
    def positions(self) -> _Doubles: ...          # (n, 2) [m]
    @positions.setter
    def positions(self, values: ArrayLike) -> None: ...
    @property
    def velocities(self) -> _Doubles: ...         # (n, 2) [m/s]
    @velocities.setter
    def velocities(self, values: ArrayLike) -> None: ...
    @property
    def rotations(self) -> _Doubles: ...          # (n,) [rad]
    @rotations.setter
    def rotations(self, values: ArrayLike) -> None: ...
    @property
    def angular_velocities(self) -> _Doubles: ... # (n,) [rad/s]
    @angular_velocities.setter
    def angular_velocities(self, values: ArrayLike) -> None: ...

    # results: copies
    @property
    def displacements(self) -> _Doubles: ...      # (n, 2) [m]
    @property
    def turns(self) -> _Doubles: ...              # (n,) [rad]
    @property
    def forces(self) -> _Doubles: ...             # (n, 2) [N]
    @property
    def moments(self) -> _Doubles: ...            # (n,) [N m]
    @property
    def stresses(self) -> _Doubles: ...           # (n, 3) [Pa]
    @property
    def present(self) -> _Flags: ...              # (n,)
    @property
    def slots(self) -> _Numbers: ...              # (n,)

    # views
    @property
    def motion_view(self) -> NDArray[np.void]: ...
    @property
    def force_view(self) -> NDArray[np.void]: ...
    @property
    def origin(self) -> tuple[float, float]: ...  # [m]

    # progress
    @property
    def cycle(self) -> int: ...
    @property
    def time(self) -> float: ...                  # [s]
    @property
    def time_step(self) -> float: ...             # [s]
    @property
    def stage(self) -> int: ...
    @property
    def stage_begun(self) -> bool: ...
    @property
    def stage_cycles(self) -> int: ...
    @property
    def is_over(self) -> bool: ...
    @property
    def is_done(self) -> bool: ...
    @property
    def threads(self) -> int: ...
    @property
    def state_hash(self) -> str: ...
    @property
    def kinetic_energy(self) -> float: ...        # [J]
    @property
    def unbalanced_force_ratio(self) -> float: ...
    @property
    def energies(self) -> dict[str, float]: ...   # [J]
    @property
    def results(self) -> list[dict[str, Any]]: ...
    @property
    def case_text(self) -> str: ...
    @property
    def case_overrides(self) -> list[str]: ...
    @property
    def case_file(self) -> str: ...
    @property
    def folder(self) -> str: ...
    @property
    def _summary(self) -> str: ...
