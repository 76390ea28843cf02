"""What the tests of interrupted runs share: a small case, runs of it, and whether a run's folder is whole.

h5py reads the files: not the library that hdem reads them with.
"""
import json
import subprocess
from pathlib import Path

import h5py
import numpy as np

# Blocks that slide, fall and are excavated, in two stages; histories of a block and of a pair that parts, frames and checkpoints.
CASE = """
title = "A run that is cut short"
[domain]
width = 12.0
height = 12.0
fixed = ["left", "right", "bottom"]
[[joint_set]]
dip_deg = 20.0
spacing = 1.1
deviation_deg = 3.0
[[joint_set]]
dip_deg = -65.0
spacing = 1.2
deviation_deg = 3.0
[[excavation]]
name = "tunnel"
shape = "horseshoe"
position = [6.0, 4.0]
width = 4.0
height = 4.0
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 15.0
[[stage]]
cycles = 800
[[stage]]
excavate = ["tunnel"]
cycles = 2200
[[history]]
name = "roof"
block = "b60"
quantities = ["displacement", "velocity"]
every = 50
[[history]]
name = "joint"
between = ["b60", "b61"]
quantities = ["normal_force", "shear_displacement"]
every = 70
[output]
row_every = 500
frame_every = 1000
checkpoint_every = 200
checkpoint_wall_minutes = 0
"""
INTERVAL = 200    # checkpoint_every
ROW_EVERY = 50    # where rows of run.log must tell how far a killed run had come


def write_case(folder):
    file = Path(folder) / "case.toml"
    file.write_text(CASE, encoding="utf-8")
    return file


def run(hdem, *arguments, **options):
    """`hdem run` to its end, with its exit code and both outputs."""
    return subprocess.run([hdem, "run", *map(str, arguments)], capture_output=True, text=True, check=False, **options)


def summary(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def read_all(group, into):
    for name, item in group.items():
        if isinstance(item, h5py.Group):
            read_all(item, into)
        else:
            into[item.name] = item[...]
    return into


def broken_files(folder):
    """What cannot be opened and read to its last byte, and frames that are named but not there."""
    broken = []
    for file in sorted(folder.rglob("*")):
        try:
            if file.suffix in (".h5", ".hdf"):
                with h5py.File(file, "r") as opened:
                    for name in opened:
                        if name != "frames":
                            read_all(opened[name], {})
            elif file.suffix in (".json", ".series"):
                content = json.loads(file.read_text(encoding="utf-8"))
                broken += [f"{file.name} names {frame['name']}" for frame in content.get("files", [])
                           if not (folder / frame["name"]).exists()]
        except (OSError, KeyError, RuntimeError, ValueError) as error:
            broken.append(f"{file.name}: {error}")
    if (folder / "results.h5").exists():
        with h5py.File(folder / "results.h5", "r") as results:
            broken += [f"results.h5 names frame {number}" for number in results["frames/number"][...]
                       if not (folder / f"frames/blocks_{number:06d}.hdf").exists()]
    return broken


def checkpoint_cycle(folder):
    """Of the last checkpoint; -1 without one."""
    for name in ("checkpoint.h5", "checkpoint.previous.h5"):
        if (folder / name).exists():
            with h5py.File(folder / name, "r") as checkpoint:
                return int(checkpoint["state"].attrs["cycle"])
    return -1


def differing_results(one, other):
    """Names of histories, energies and frame numbers that are not the same to the last bit."""
    def tables(folder):
        with h5py.File(folder / "results.h5", "r") as results:
            values = {name: results["frames"][name][...] for name in ("number", "cycle", "time", "stage")}
            return read_all(results["history"], read_all(results["energy"], values))
    a, b = tables(one), tables(other)
    frames = [sorted(file.name for file in (folder / "frames").iterdir()) for folder in (one, other)]
    return sorted(a.keys() ^ b.keys()) + [name for name in a.keys() & b.keys() if not np.array_equal(a[name], b[name])] + \
        (["frames"] if frames[0] != frames[1] else [])
