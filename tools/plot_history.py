"""A history of a run over time; and what pictures of frames and of histories share."""
import itertools
import textwrap

import matplotlib.pyplot as plt
import numpy as np

from hdem_io import ResultError
from plain_text import add_legend, literal

PREFIXES = {"m": [(1, "m"), (1e-3, "mm"), (1e-6, "µm")], "m/s": [(1, "m/s"), (1e-3, "mm/s"), (1e-6, "µm/s")],
            "Pa": [(1e6, "MPa"), (1e3, "kPa"), (1, "Pa")], "N": [(1e6, "MN"), (1e3, "kN"), (1, "N")]}
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]
STYLES = list(itertools.product(["-", "--", ":", "-."], COLOURS))
LINEAR = 1e-6    # of the greatest value: smaller ones are drawn linearly where some are negative
LARGEST = 1e100    # what a run that blew up reached beyond is not drawn: ends of axes overflow


def drawable(values):
    return np.where(np.abs(values) < LARGEST, values, np.nan)


def scaled_unit(unit, greatest):
    """Factor and name of the unit in which the greatest value reads best."""
    for factor, name in PREFIXES.get(unit, []):
        if greatest >= factor:
            return factor, name
    return PREFIXES.get(unit, [(1, unit)])[-1]


def panel_of(name, unit):
    """What is drawn in one panel: quantities of one unit; without a unit, counts of points."""
    return unit if unit != "1" else "points" if name.endswith("_points") else name.replace("_", " ")


def moment_of(run, frame):
    """Stage, cycle and time of a frame (hdem_io.Frame); of the last one also whether the run was broken off there, or goes on."""
    words = [f'stage "{frame.stage}"'] if frame.stage else []
    words += [f"cycle {frame.cycle}", f"{frame.time:.6g} s"]
    if run and frame.number == run.frames[-1].number:
        words += state_of(run)
    return ", ".join(words)


def state_of(run):
    """Nothing for a run that is done."""
    return {"done": [], "running": ["the run goes on"]}.get(run.state(), [run.state()])


def start_of(name, values):
    """A position that changes little is drawn from its first value on; 0 for anything else."""
    drawn = values[np.isfinite(values)]
    return drawn[0] if name.startswith("position") and len(drawn) and np.ptp(drawn) < 0.05 * abs(drawn[0]) else 0.0


def name_of(options):
    return "energies" if options.energy else options.history


def table_of(run, options):
    """What is drawn over time, and whether it is the energies. A history named energy is itself: --energy draws the others."""
    is_energy = options.energy or (options.history == "energy" and "energy" not in run.histories)
    return run.energy() if is_energy else run.history(options.history), is_energy


def set_scale(axes, curves):
    """Logarithmic where values span more than a factor of 1000; where some are negative too, linear about zero."""
    values = np.concatenate(curves)
    sizes = np.abs(values[np.isfinite(values) & (values != 0.0)])
    least, greatest = sizes.min(initial=np.inf), sizes.max(initial=0.0)
    if not greatest > 1e3 * least:
        return
    if np.any(values < 0.0):
        axes.set_yscale("symlog", linthresh=max(least, LINEAR * greatest))
    else:
        axes.set_yscale("log", nonpositive="mask")    # it knows no zero


def draw_history(run, options):
    table, is_energy = table_of(run, options)
    names = [name for name in table if name not in ("cycle", "time")]
    if not len(table["time"]) or not names:
        raise ResultError(f"history {name_of(options)} holds no rows yet")
    for name in names:
        table[name] = drawable(table[name])
    zero = [name for name in names if is_energy and table.unit[name] == "J" and not np.any(table[name])]
    names = [name for name in names if name not in zero] or names
    panels = {}
    for name in names:
        panels.setdefault(panel_of(name, table.unit[name]), []).append(name)
    panels = sorted(panels.items(), key=lambda panel: (panel[0] != "J", panel[0]))
    heights = [max(1.5, 0.17 * len(same)) for _, same in panels]    # inches; a row of the legend is as high
    figure, grid = plt.subplots(len(panels), 1, sharex=True, squeeze=False, figsize=(options.width / 25.4, 0.9 + sum(heights)), dpi=options.dpi, layout="constrained",
                                height_ratios=heights)
    for axes, (panel, same) in zip(grid[:, 0], panels):
        unit = table.unit[same[0]]
        starts = {name: start_of(name, table[name]) for name in same}
        factor, shown = scaled_unit(unit, max(np.nan_to_num(np.abs(table[name] - starts[name])).max() for name in same))
        curves = [(table[name] - starts[name]) / factor for name in same]
        for name, curve, (stroke, colour) in zip(same, curves, itertools.cycle(STYLES)):
            label = name.replace("_", " ") + (f" from {starts[name]:.6g} {unit}" if starts[name] else "")
            axes.plot(table["time"], curve, color=colour, linestyle=stroke, linewidth=0.9, label=label)
        if is_energy and panel != "points":
            set_scale(axes, curves)
        literal(axes.set_ylabel(f"[{shown}]" if shown != "1" else "[-]"))
        axes.grid(linewidth=0.3, color="#cccccc")
        beside = {"loc": "upper left", "bbox_to_anchor": (1.0, 1.03), "handlelength": 2.8} if len(same) > len(COLOURS) else {"loc": "best", "ncol": min(len(same), 3)}    # more are wider than the picture
        add_legend(axes, axes.lines, frameon=False, **beside)
    grid[-1, 0].set_xlabel("time [s]")
    title = [options.title if options.title is not None else name_of(options),
             ", ".join([f"to cycle {table['cycle'][-1]}", *state_of(run)]) if state_of(run) else "",
             textwrap.fill(f"always 0: {', '.join(name.replace('_', ' ') for name in zero)}", max(20, int(options.width / 1.7))) if zero else ""]
    literal(grid[0, 0].set_title("\n".join(filter(None, title)), loc="left"))
    return figure
