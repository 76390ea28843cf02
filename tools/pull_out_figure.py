#!/usr/bin/python3
"""The pull-out test of verification/cases/support/pull.toml beside its closed form: force against displacement of the head.

    tools/pull_out_figure.py FOLDER [-o FILE.png]

A bar with the stiffness E A in a bond of stiffness k and strength s per metre; l of the bonded length L has slipped (shear lag):

    P = s (l + tanh(lambda (L - l)) / lambda),  w = s (1/k + l tanh(lambda (L - l)) / (lambda E A) + l^2 / (2 E A)),  lambda = (k / E A)^1/2

Before that P = E A lambda tanh(lambda L) w. The numbers of the cable are those of the case that was run.
"""
import argparse
import sys
import tomllib
from pathlib import Path

from needed_modules import end_in_one_line, need
if __name__ == "__main__":
    end_in_one_line("pull_out_figure")
need("h5py", "matplotlib", "numpy")
import matplotlib    # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt    # noqa: E402
import numpy as np    # noqa: E402

from hdem_io import ResultError, open_run, tell    # noqa: E402
from output_file import write_picture    # noqa: E402

STEEL = 2e11    # modulus where the case gives none [Pa]


def cable_of(run):
    """E A, k, s, bonded length and free length of the only bolt, as the case file has them."""
    provenance = run.provenance()
    if any(override.startswith("bolt") for override in provenance["overrides"]):
        raise ResultError("the cable was changed by --set; write its numbers into a case file")
    bolts = tomllib.loads(provenance["case_text"]).get("bolt", [])
    if len(bolts) != 1 or bolts[0].get("kind") != "grouted":
        raise ResultError("this is no run of a pull-out test: its case must have one grouted [[bolt]]")
    bolt = bolts[0]
    free = bolt.get("free_length", 0.0)
    return bolt["area"] * bolt.get("modulus", STEEL), bolt["bond_stiffness"], bolt["bond_strength"], np.hypot(*np.subtract(bolt["to"], bolt["from"])) - free, free


def closed_form(section, bond, strength, length):
    """Displacement [m] and force [N] of the head, from nothing to the whole length slipped."""
    rate = np.sqrt(bond / section)
    slipped = np.linspace(0.0, length, 400)
    grip = np.tanh(rate * (length - slipped)) / rate
    head = strength * (1.0 / bond + grip * slipped / section + slipped**2 / (2.0 * section))
    return np.concatenate([[0.0], head]), np.concatenate([[0.0], strength * (slipped + grip)])


def draw(options):
    """The file it is in."""
    run = open_run(options.folder)
    section, bond, strength, length, free = cable_of(run)
    table = run.history("cable")
    force = table["axial_force"]
    head = table["elongation"] - free * force / section    # where the bond begins
    displacement, bearing = closed_form(section, bond, strength, length)
    figure, axes = plt.subplots(figsize=(6.3, 3.3), layout="constrained")
    axes.plot(1e3 * np.append(displacement, max(head[-1], displacement[-1])), 1e-3 * np.append(bearing, bearing[-1]), color="#222222", linewidth=1.2, label="closed form")
    shown = np.unique(np.searchsorted(head, np.linspace(head[0], head[-1], 31)))
    axes.plot(1e3 * head[shown], 1e-3 * force[shown], "o", color="#0072b2", markersize=4.0, label="hdem")
    axes.axvline(1e3 * strength / bond, color="#999999", linewidth=0.8, linestyle=":")
    axes.annotate("bond slips at the head", (1e3 * strength / bond, 4.0), xytext=(4, 0), textcoords="offset points", fontsize=8, color="#666666")
    axes.set_xlabel("displacement of the head [mm]")
    axes.set_ylabel("force [kN]")
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="lower right", frameon=False)
    write_picture(figure, options.output, [run.file], dpi=150)
    return options.output


def main(arguments):
    parser = argparse.ArgumentParser(description="Force and displacement of a pull-out test beside the closed form.")
    parser.add_argument("folder", type=Path, help="of a run of verification/cases/support/pull.toml")
    parser.add_argument("-o", "--output", type=Path, default=Path("pull_out.png"))
    options = parser.parse_args(arguments)
    return tell("pull_out_figure", options.folder, lambda: draw(options))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
