"""What `hdem plot` can be asked for: its options, and what colours can show."""
from pathlib import Path

import numpy as np

from plain_text import OneLineParser
from plot_rock import JOINTS

# name -> label, unit, value per block, whether both signs occur
FIELDS = {
    "displacement": ("displacement", "m", lambda b: np.linalg.norm(b["displacement"], axis=1), False),
    "displacement_x": ("displacement in x", "m", lambda b: b["displacement"][:, 0], True),
    "displacement_y": ("displacement in y", "m", lambda b: b["displacement"][:, 1], True),
    "rotation": ("rotation", "rad", lambda b: b["rotation"], True),
    "velocity": ("speed", "m/s", lambda b: b["speed"], False),
    "stress": ("mean stress, magnitude", "Pa", lambda b: b["stress_magnitude"], False),
    "stress_xx": ("mean stress $\\sigma_{xx}$, compression positive", "Pa", lambda b: b["stress_xx"], True),
    "stress_yy": ("mean stress $\\sigma_{yy}$, compression positive", "Pa", lambda b: b["stress_yy"], True),
    "stress_xy": ("mean stress $\\sigma_{xy}$", "Pa", lambda b: b["stress_xy"], True),
}
CLASSES = ("regime", "material", "none")
MOTION = ("displacement", "displacement_x", "displacement_y", "rotation", "velocity")    # a falling block has far more of it than the others
OF_FRAMES = ("colour", "frame", "excavation", "window", "range", "contacts", "joints", "numbers", "bolts", "liners", "crosses")
OF_RUNS = ("history", "energy", "factor", "frame", "contacts", "joints", "bolts", "liners")    # more than one blocks_NNNNNN.hdf has


def parser():
    made = OneLineParser(prog="hdem plot", description="Draw a frame of a run, or a history of it, as PNG, SVG or PDF.")
    made.add_argument("result", type=Path, help="results.h5, the run's folder, or one blocks_NNNNNN.hdf")
    made.add_argument("-o", "--output", type=Path, help="picture; its ending decides the format (default: COLOUR_NNNNNN.png beside the result)")
    made.add_argument("--colour", "--color", choices=[*FIELDS, *CLASSES], help="what the colours show (default: displacement)")
    made.add_argument("--frame", help="number of the frame, or last (default)")
    made.add_argument("--excavation", action="store_true", help="only the surroundings of the excavation")
    made.add_argument("--window", nargs=4, type=float, metavar=("X0", "Y0", "X1", "Y1"), help="only this part [m]")
    made.add_argument("--range", nargs=2, type=float, metavar=("LOW", "HIGH"), help="of the colours, in SI units: rotation in rad")
    made.add_argument("--contacts", action="store_true", help="draw contact forces as lines between blocks")
    made.add_argument("--joints", choices=JOINTS, help="draw joints as lines, as wide as this is great")
    made.add_argument("--bolts", action="store_true", help="draw the bolts, coloured by their axial force")
    made.add_argument("--liners", choices=("thrust", "moment"), help="draw the linings with this along them")
    made.add_argument("--numbers", action="store_true", help="with --joints: write values beside them, the greatest of each part of the picture")
    made.add_argument("--crosses", action="store_true", help="draw the principal stresses of blocks as crosses")
    made.add_argument("--history", metavar="NAME", help="draw this history over time instead; energy: as --energy, unless the case has a history of that name")
    made.add_argument("--energy", action="store_true", help="draw the energies of the run over time instead, with unbalanced force and contact points")
    made.add_argument("--factor", action="store_true", help="draw displacement against the factor of the trials of hdem fos instead")
    made.add_argument("--title", help="instead of the case's title")
    made.add_argument("--width", type=float, default=160.0, help="of the picture [mm] (default: 160)")
    made.add_argument("--dpi", type=float, default=200.0, help="of a PNG (default: 200)")
    return made


def parse(arguments):
    """What would have no effect is refused."""
    made = parser()
    options = made.parse_args(arguments)
    given = [name for name, value in vars(options).items() if value is not None and value is not False]
    instead = [name for name in ("history", "energy", "factor") if name in given]
    if len(instead) > 1:
        made.error(f"argument --{instead[1]}: another picture than --{instead[0]}. Leave one of them out.")
    for name in OF_FRAMES if instead else ():
        if name in given:
            made.error(f"argument --{name}: of pictures of a frame. Leave it out, or leave out --{instead[0]}.")
    for name in OF_RUNS if options.result.suffix == ".hdf" else ():
        if name in given:
            made.error(f"argument --{name}: {options.result.name} is a single frame. Give the run's folder or its results.h5, or leave out --{name}.")
    if options.excavation and options.window:
        made.error("argument --window: another part than --excavation. Leave one of them out.")
    if options.range and options.colour in CLASSES:
        made.error(f"argument --range: --colour {options.colour} has none. Leave it out.")
    if options.numbers and not options.joints:
        made.error("argument --numbers: needs --joints")
    options.colour, options.frame = options.colour or "displacement", "last" if options.frame is None else options.frame
    if options.frame != "last" and not options.frame.isdigit():
        made.error("argument --frame: a number, or last")
    for name, low in (("width", 20.0), ("dpi", 10.0)):
        if not low <= getattr(options, name) <= 5000.0:
            made.error(f"argument --{name}: {low:g} to 5000")
    return options
