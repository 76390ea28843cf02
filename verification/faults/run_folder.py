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


def same_bits(a, b):
    """Texts of variable length have no bytes of their own; numbers must be the same to the sign of zero."""
    a, b = np.asarray(a), np.asarray(b)
    return a.dtype == b.dtype and a.shape == b.shape and (a.tolist() == b.tolist() if a.dtype.kind == "O" else a.tobytes() == b.tobytes())


def read_frame(file):
    """Every dataset and every attribute of a frame."""
    with h5py.File(file, "r") as opened:
        objects = {f"/@{key}": value for key, value in opened.attrs.items()}

        def take(name, item):
            objects.update({f"{name}@{key}": value for key, value in item.attrs.items()})
            if isinstance(item, h5py.Dataset):
                objects[name] = item[...]
        opened.visititems(take)
        return objects


def differing_keys(a, b):
    return sorted(a.keys() ^ b.keys()) + sorted(name for name in a.keys() & b.keys() if not same_bits(a[name], b[name]))


def differing_frames(one, other):
    """Frames that only one run has, and what in the others is not the same to the last bit."""
    names = [{file.name for file in (folder / "frames").iterdir() if file.suffix == ".hdf"} for folder in (one, other)]
    differing = [f"frames/{name}" for name in sorted(names[0] ^ names[1])]
    for name in sorted(names[0] & names[1]):
        files = [folder / "frames" / name for folder in (one, other)]
        if files[0].read_bytes() != files[1].read_bytes():
            differing += [f"frames/{name}: {key}" for key in differing_keys(*map(read_frame, files))]
    return differing


def differing_results(one, other):
    """Names of histories, energies, frame numbers and parts of frames that are not the same to the last bit."""
    def tables(folder):
        with h5py.File(folder / "results.h5", "r") as results:
            values = {f"/frames/{name}": results["frames"][name][...] for name in ("number", "cycle", "time", "stage")}
            return read_all(results["history"], read_all(results["energy"], values))
    series = [name for name in ("blocks.hdf.series", "contacts.hdf.series")
              if [(folder / name).read_bytes() if (folder / name).exists() else None for folder in (one, other)].count(None) == 1
              or ((one / name).exists() and (one / name).read_bytes() != (other / name).read_bytes())]
    return differing_keys(tables(one), tables(other)) + differing_frames(one, other) + series


# Of the time on the wall and the machine, not of the run.
OF_THE_MACHINE = {"threads", "thread_use", "wall_seconds", "stage_wall_seconds", "contact_point_updates_per_second", "timing"}


def differing_summary(one, other):
    """Keys of summary.json whose values are not the same, the numbers to their last digit."""
    a, b = summary(one), summary(other)
    return sorted(key for key in (a.keys() | b.keys()) - OF_THE_MACHINE if a.get(key) != b.get(key))
