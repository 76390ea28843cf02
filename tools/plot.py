#!/usr/bin/python3
"""Draws one frame of a run, one of its histories, or its factor of safety. Called by `hdem plot`; see its --help.

The blocks that stay in place decide the range of the colours: one fallen block must not wash out the rest. Detached blocks are
drawn hatched where they are.
"""
from needed_modules import end_in_one_line, need
if __name__ == "__main__":
    end_in_one_line("hdem plot")
need("h5py", "matplotlib", "numpy")
import math    # noqa: E402
import sys    # noqa: E402

import matplotlib    # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt    # noqa: E402
import numpy as np    # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection    # noqa: E402
from matplotlib.colors import ListedColormap    # noqa: E402
from matplotlib.lines import Line2D    # noqa: E402
from matplotlib.patches import Patch    # noqa: E402

from hdem_io import Frame, ResultError, open_run, read_blocks, tell    # noqa: E402
from output_file import check_output, is_stream, make_folder_of, write_picture    # noqa: E402
from plain_text import add_legend, as_file_name, literal, one_line    # noqa: E402
from plot_factor import draw_factor    # noqa: E402
from plot_history import draw_history, moment_of, name_of, scaled_unit, state_of    # noqa: E402
from plot_options import CLASSES, FIELDS, MOTION, parse    # noqa: E402, F401
from plot_rock import draw_crosses, draw_joints, draw_water_table    # noqa: E402
from plot_support import DIAGRAM, draw_bolts, draw_liners    # noqa: E402

# Safe for the common kinds of colour blindness (Okabe and Ito; ColorBrewer).
GREY, BLUE, ORANGE, DARK, FALLEN = "#dddddd", "#56b4e9", "#d55e00", "#222222", "#f7cfae"
MATERIALS = ["#e8d9b5", "#56b4e9", "#009e73", "#e69f00", "#cc79a7", "#0072b2", "#f0e442", "#d55e00"]
SEQUENTIAL, DIVERGING = "YlGnBu", "RdBu_r"
ANOTHER = "give the name of a picture with -o"
REGIMES = ["no contact", "force", "impulse"]
STYLE = {"font.size": 8, "axes.titlesize": 8.5, "axes.linewidth": 0.6, "xtick.major.width": 0.6, "ytick.major.width": 0.6,
         "hatch.linewidth": 0.5, "legend.fontsize": 7.5, "svg.hashsalt": "hdem", "svg.fonttype": "none"}


def colour_range(values, signed):
    """Low, high, and whether a few values lie beyond; from the blocks that stay in place."""
    values = values[np.isfinite(values)]
    if not len(values) or not np.any(values):
        return (-1.0, 1.0, "neither") if signed else (0.0, 1.0, "neither")
    magnitude = np.abs(values)
    greatest, usual = magnitude.max(), np.percentile(magnitude, 98)
    outliers = greatest > 5.0 * usual > 0.0
    high = usual if outliers else greatest
    if not signed:
        return 0.0, high, "max" if outliers else "neither"
    return -high, high, "both" if outliers else "neither"


def number_of(chosen):
    count = np.count_nonzero(chosen)
    return f"{count} block" if count == 1 else f"{count} blocks"


def pick(parts_of, chosen, blocks):
    return [part for part, block in zip(parts_of, blocks["part_block"]) if chosen[block]]


def draw_field(axes, blocks, options):
    label, unit, value, signed = FIELDS[options.colour]
    values = value(blocks).astype(float)
    detached = blocks["detached"].astype(bool)
    hatched = detached if options.colour in MOTION else np.zeros_like(detached)
    low, high, extend = colour_range(values[~hatched], signed)
    if options.range:
        (low, high), extend = options.range, "both"
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            raise ResultError(f"--range {low:g} {high:g}: no range. Give two finite numbers, the lower one first.")
    factor, unit = (math.radians(1.0), "deg") if unit == "rad" else scaled_unit(unit, max(abs(low), abs(high)))
    shown = pick(blocks["part_polygon"], ~hatched, blocks)
    faces = PolyCollection(shown, cmap=DIVERGING if signed else SEQUENTIAL, edgecolors="face", linewidths=0.1)
    faces.set_array(values[blocks["part_block"]][~hatched[blocks["part_block"]]] / factor)
    faces.set_clim(low / factor, high / factor)
    axes.add_collection(faces)
    bar = axes.figure.colorbar(faces, ax=axes, extend=extend, shrink=0.85, aspect=28, pad=0.025)
    bar.set_label(f"{label} [{unit}]")
    bar.outline.set_linewidth(0.6)
    if not np.any(hatched):
        return []
    axes.add_collection(PolyCollection(pick(blocks["part_polygon"], hatched, blocks), facecolors=FALLEN, edgecolors=ORANGE, linewidths=0.0, hatch="//////"))
    distance = 1e3 * blocks["info"]["detached_distance"]
    return [Patch(facecolor=FALLEN, edgecolor=ORANGE, linewidth=0.0, hatch="//////", label=f"detached: moved more than {distance:.4g} mm ({number_of(hatched)})")]


def draw_classes(axes, blocks, options):
    if options.colour == "none":
        numbers, names, colours = np.zeros(len(blocks["id"]), int), ["blocks"], ["#efe6d2"]
    elif options.colour == "regime":
        numbers, names, colours = blocks["regime"].astype(int), REGIMES, [GREY, BLUE, ORANGE]
    else:
        names = blocks["material_names"]
        numbers, colours = blocks["material"], [MATERIALS[i % len(MATERIALS)] for i in range(len(names))]
    faces = PolyCollection(blocks["part_polygon"], cmap=ListedColormap(colours), edgecolors="face", linewidths=0.1)
    faces.set_array(numbers[blocks["part_block"]])
    faces.set_clim(-0.5, len(colours) - 0.5)
    axes.add_collection(faces)
    if options.colour == "none":
        return []
    return [Patch(facecolor=colours[i], edgecolor=DARK, linewidth=0.4, label=f"{names[i]} ({number_of(numbers == i)})") for i in np.unique(numbers)]


def draw_contacts(axes, blocks, contacts, width_mm):
    """From centroid to contact to centroid, as wide as the normal force is great."""
    force = np.nan_to_num(contacts["normal_force"].astype(float), nan=0.0, posinf=0.0, neginf=0.0)    # of a run that blew up
    if not len(force) or not force.max() > 0.0:
        return []
    if not np.all(np.isin(contacts["blocks"], blocks["id"])):
        raise ResultError("contacts name blocks that this frame does not have: its two files are of different runs, or damaged. Run the case again.")
    position = blocks["position"][np.searchsorted(blocks["id"], contacts["blocks"])]
    lines = np.stack([position[:, 0], contacts["points"].mean(axis=1), position[:, 1]], axis=1)
    widest = max(0.5, width_mm / 65.0)    # points
    reference = np.percentile(force, 99.5)
    widths = widest * np.clip(force / reference, 0.0, 1.0)
    kept = widths > 0.02 * widest
    colours = np.where(contacts["regime"] == 3, ORANGE, DARK)
    axes.add_collection(LineCollection(lines[kept], linewidths=widths[kept], colors=colours[kept], capstyle="round", zorder=3))
    factor, unit = scaled_unit("N", reference)
    handles = [Line2D([], [], color=DARK, linewidth=widest, label=f"normal force {reference / factor:.3g} {unit}")]
    if np.any(contacts["regime"] == 3):
        handles.append(Line2D([], [], color=ORANGE, linewidth=widest, label="the same, by impulse"))
    return handles


def view_of(blocks, liners, others, options):
    """x0, y0, x1, y1 [m]: of blocks, outlines, linings with their diagrams, and the places of what else is drawn."""
    if options.window:
        x0, y0, x1, y1 = options.window
        if not (math.isfinite(x1 - x0) and math.isfinite(y1 - y0)) or x0 == x1 or y0 == y1:
            raise ResultError("--window: has no area. Give two opposite corners.")
    points = [*blocks["part_polygon"], blocks["outline"], blocks["water_table"], *others]
    if options.window:
        window = np.sort([[x0, y0], [x1, y1]], axis=0)
        low, high = corners(points + ([liners["points"]] if liners else []))
        if np.any(window[0] >= high) or np.any(window[1] <= low):
            raise ResultError(f"--window: nothing is drawn there. What there is spans ({low[0]:.6g}, {low[1]:.6g}) to ({high[0]:.6g}, {high[1]:.6g}).")
        return tuple(window.ravel())
    margin = 0.02
    if options.excavation:
        if not len(blocks["outline"]):
            raise ResultError("this case has no excavation to look at; leave out --excavation")
        points, margin, liners = [blocks["outline"]], 0.6, None
    low, high = corners(points + ([liners["points"]] if liners else []))
    if liners:    # before the margin the picture is a little smaller, hence the 1.3
        lined, off = liners["points"].reshape(-1, 2), 1.3 * DIAGRAM * min(high - low)
        low, high = corners([(low, high), lined - off, lined + off])
    if not np.all(high - low > 1e-12 * np.maximum(np.abs(low), np.abs(high))):
        raise ResultError("what is to be drawn has no extent: the frame is damaged. Run the case again.")
    margin *= max(high - low)
    return (*(low - margin), *(high + margin))


def corners(places):
    """Lowest and highest x and y of all these points."""
    points = np.concatenate([np.empty((0, 2)), *(np.reshape(some, (-1, 2)) for some in places)])
    if not len(points):
        raise ResultError("this frame holds no blocks, and nothing else that can be drawn")
    return points.min(axis=0), points.max(axis=0)


def figure_for(view, options, has_bar, legend_rows):
    """Figure and axes in which a metre is as long in x as in y and nothing is left empty."""
    width = options.width / 25.4
    left, right, bottom, top = 0.62, 0.95 if has_bar else 0.15, 0.52 + 0.2 * legend_rows, 0.5    # inches around the axes
    height = (width - left - right) * (view[3] - view[1]) / (view[2] - view[0])
    height = min(max(height, 0.8), 2.5 * width)
    figure = plt.figure(figsize=(width, height + bottom + top), dpi=options.dpi)
    total = height + bottom + top
    return figure, figure.add_axes([left / width, bottom / total, (width - left - right * 0.2) / width, height / total])


def draw_frame(run, options):
    single = options.result.suffix == ".hdf"
    blocks = read_blocks(options.result) if single else run.blocks(options.frame)
    contacts = run.contacts(options.frame) if options.contacts or options.joints else None
    if options.bolts and not run.has_bolts(options.frame):
        raise ResultError("--bolts: this case has no bolts, or the run is of a program that wrote no frames of them")
    bolts = run.bolts(options.frame) if options.bolts else None
    if options.liners and not run.has_liners(options.frame):
        raise ResultError("--liners: this case has no linings, or the run is of a program that wrote no frames of them")
    liners = run.liners(options.frame) if options.liners else None
    where = blocks if len(blocks["id"]) or not run else run.blocks(run.frames[0].number)    # all are gone: where they were
    view = view_of(blocks | {"part_polygon": where["part_polygon"]}, liners, [bolts["points"]] if bolts else [], options)
    field = options.colour in FIELDS
    rows = int(options.colour in ("regime", "material") or (options.colour in MOTION and blocks["detached"].any())) + int(bool(options.contacts)) + int(bool(options.joints or options.crosses)) + 2 * int(options.bolts) + int(bool(options.liners)) + int(len(blocks["water_table"]) > 0)
    figure, axes = figure_for(view, options, field, rows)
    handles = draw_field(axes, blocks, options) if field else draw_classes(axes, blocks, options)
    line = float(np.clip(14.0 / math.sqrt(max(visible(blocks, view), 1)), 0.04, 0.6))
    axes.add_collection(LineCollection(blocks["edges"], colors="#999999" if contacts or options.crosses else DARK, linewidths=line, capstyle="round", zorder=2))
    if len(blocks["outline"]):
        axes.add_collection(LineCollection(blocks["outline"], colors="black", linewidths=1.6, capstyle="round", zorder=2.5))
    if options.contacts:
        handles += draw_contacts(axes, blocks, contacts, options.width)
    if options.joints:
        handles += draw_joints(axes, contacts, options.joints, options.width, view, options.numbers)
    if options.bolts:
        handles += draw_bolts(axes, bolts)
    if options.liners:
        handles += draw_liners(axes, liners, options.liners, view)
    if options.crosses:
        handles += draw_crosses(axes, blocks, view)
    handles += draw_water_table(axes, blocks)
    axes.set_xlim(view[0], view[2])
    axes.set_ylim(view[1], view[3])
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.ticklabel_format(useOffset=False, style="plain")
    info = blocks["info"]
    title = options.title if options.title is not None else info["title"]
    frame = run.frame(options.frame) if run else Frame(None, info["cycle"], info["time"], info["stage"])
    literal(axes.set_title("\n".join(filter(None, [title, moment_of(run, frame) + ("" if len(blocks["id"]) else ": no blocks are left")])), loc="left"))
    if handles:
        add_legend(axes, handles, loc="upper left", bbox_to_anchor=(0.0, -0.42 / axes_height(figure, axes)), ncol=2 if len(handles) > 1 else 1,
                   frameon=False, borderaxespad=0.0, handlelength=1.8, columnspacing=1.5)
    return figure


def axes_height(figure, axes):
    """In inches, as drawn."""
    axes.apply_aspect()
    return axes.get_position().height * figure.get_size_inches()[1]


def visible(blocks, view):
    x, y = blocks["position"].T
    return np.count_nonzero((x >= view[0]) & (x <= view[2]) & (y >= view[1]) & (y <= view[3]))


def make_picture(options):
    """The file it is in."""
    single = options.result.suffix == ".hdf"
    run = None if single else open_run(options.result)
    read = [options.result if single else run.file]
    if options.output:
        check_output(options.output, read, ANOTHER)    # before it is drawn
    over_time = options.history or options.energy
    figure = draw_factor(run, options) if options.factor else draw_history(run, options) if over_time else draw_frame(run, options)
    output = options.output
    if output is None:
        folder = options.result if options.result.is_dir() else options.result.parent
        name = "factor_of_safety" if options.factor else name_of(options) if over_time else f"{options.colour}_" + (options.result.stem[-6:] if single else f"{run.frame(options.frame).number:06d}")
        output = folder / f"{as_file_name(name)}.png"
    if not output.suffix and not output.is_dir() and not is_stream(output):
        output = output.with_name(f"{output.name}.png")
    make_folder_of(output, ANOTHER)
    write_picture(figure, output, read, ANOTHER, bbox_inches="tight", pad_inches=0.05,
                  metadata={"Date": None} if output.suffix == ".svg" else None)
    if run and not over_time and not options.factor and state_of(run):
        print(f"the picture shows {one_line(moment_of(run, run.frame(options.frame)))}", file=sys.stderr)
    return output


def main(arguments):
    options = parse(arguments)
    plt.rcParams.update(STYLE)
    return tell("hdem plot", options.result, lambda: make_picture(options))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
