"""A history of a run over time; and what pictures of frames and of histories share."""
import matplotlib.pyplot as plt
import numpy as np

from hdem_io import ResultError
from plain_text import add_legend, literal

PREFIXES = {"m": [(1, "m"), (1e-3, "mm"), (1e-6, "µm")], "m/s": [(1, "m/s"), (1e-3, "mm/s"), (1e-6, "µm/s")],
            "Pa": [(1e6, "MPa"), (1e3, "kPa"), (1, "Pa")], "N": [(1e6, "MN"), (1e3, "kN"), (1, "N")]}
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


def draw_history(run, options):
    table = run.energy() if options.history == "energy" else run.history(options.history)
    names = [name for name in table if name not in ("cycle", "time")]
    for name in names:
        table[name] = drawable(table[name])
    panels = sorted({panel_of(name, table.unit[name]) for name in names}, key=lambda panel: (panel != "J", panel))
    if not len(table["time"]) or not names:
        raise ResultError(f"history {options.history} holds no rows yet")
    width = options.width / 25.4
    figure, grid = plt.subplots(len(panels), 1, sharex=True, squeeze=False, figsize=(width, 0.9 + 1.5 * len(panels)), dpi=options.dpi, layout="constrained")
    for axes, panel in zip(grid[:, 0], panels):
        same = [name for name in names if panel_of(name, table.unit[name]) == panel]
        unit = table.unit[same[0]]
        starts = {name: start_of(name, table[name]) for name in same}
        factor, shown = scaled_unit(unit, max(np.nan_to_num(np.abs(table[name] - starts[name])).max() for name in same))
        positive = np.concatenate([table[name][table[name] > 0.0] for name in same])
        log = options.history == "energy" and panel != "points" and len(positive) and positive.max() > 1e3 * positive.min()
        for name, colour in zip(same, ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"] * len(same)):
            values = np.where(table[name] > 0.0, table[name], np.nan) if log else table[name]    # a logarithm knows no zero
            label = name.replace("_", " ") + (f" from {starts[name]:.6g} {unit}" if starts[name] else "")
            axes.plot(table["time"], (values - starts[name]) / factor, color=colour, linewidth=0.9, label=label)
        axes.set_yscale("log" if log else "linear")
        literal(axes.set_ylabel(f"[{shown}]" if shown != "1" else "[-]"))
        axes.grid(linewidth=0.3, color="#cccccc")
        add_legend(axes, axes.lines, frameon=False, loc="best", ncol=min(len(same), 3))    # more are wider than the picture
    grid[-1, 0].set_xlabel("time [s]")
    title = [options.title if options.title is not None else options.history,
             ", ".join([f"to cycle {table['cycle'][-1]}", *state_of(run)]) if state_of(run) else ""]
    literal(grid[0, 0].set_title("\n".join(filter(None, title)), loc="left"))
    return figure
