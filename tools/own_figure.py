#!/usr/bin/python3
"""Example of a figure of one's own: which way contact forces point in a run, as a rose, before and after.

    tools/own_figure.py FOLDER [-o FILE.png]

Shows how hdem_io.py gives frames and histories as numpy arrays; copy it and change what is drawn.
"""
import argparse
import sys
from pathlib import Path

from needed_modules import end_in_one_line, need
if __name__ == "__main__":
    end_in_one_line("own_figure")
need("h5py", "matplotlib", "numpy")    # says in one line which are missing; leave it out in a figure of your own
import matplotlib    # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt    # noqa: E402
import numpy as np    # noqa: E402

from hdem_io import ResultError, open_run, tell    # noqa: E402
from output_file import write_picture    # noqa: E402

SECTORS = 36


def force_rose(contacts):
    """Sum of normal forces in each sector of directions [N]; a force points both ways."""
    angle = np.arctan2(contacts["normal"][:, 1], contacts["normal"][:, 0])
    both = np.concatenate([angle, angle + np.pi]) % (2.0 * np.pi)
    force = np.tile(contacts["normal_force"], 2)
    return np.histogram(both, bins=SECTORS, range=(0.0, 2.0 * np.pi), weights=force)[0]


def draw(options):
    """The file it is in."""
    run = open_run(options.folder)
    loaded = [frame for frame in run.frames if run.has_contacts(frame.number) and len(run.contacts(frame.number)["length"])]
    if not loaded:
        raise ResultError(f"{options.folder}: has no frame with contacts")
    figure, (rose, energy) = plt.subplots(1, 2, figsize=(8.0, 3.6), layout="constrained")
    rose.remove()
    rose = figure.add_subplot(1, 2, 1, projection="polar")
    middle = (np.arange(SECTORS) + 0.5) * 2.0 * np.pi / SECTORS
    for frame, colour in zip((loaded[0], loaded[-1]), ("#0072b2", "#d55e00")):
        rose.bar(middle, force_rose(run.contacts(frame.number)) / 1e6, width=2.0 * np.pi / SECTORS, color=colour, alpha=0.5,
                 label=f"cycle {frame.cycle}")
    rose.set_title("contact normal forces [MN]")
    rose.legend(loc="lower left", bbox_to_anchor=(-0.25, -0.15), frameon=False)

    table = run.energy()
    moving = table["kinetic_energy"] > 0.0
    energy.semilogy(table["time"][moving], table["kinetic_energy"][moving], color="#222222", linewidth=1.0)
    energy.set_xlabel("time [s]")
    energy.set_ylabel(f"kinetic energy [{table.unit['kinetic_energy']}]")
    write_picture(figure, options.output, [run.file], dpi=150)
    return options.output


def main(arguments):
    parser = argparse.ArgumentParser(description="Directions of contact forces in the first frame with contacts and in the last.")
    parser.add_argument("folder", type=Path, help="of a run")
    parser.add_argument("-o", "--output", type=Path, default=Path("own_figure.png"))
    options = parser.parse_args(arguments)
    return tell("own_figure", options.folder, lambda: draw(options))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
