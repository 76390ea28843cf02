"""What rock carries, over its blocks: joints by what they have done, and principal stresses as crosses. For plot.py."""
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

from hdem_io import ResultError
from plot_history import scaled_unit

# name -> label, unit
JOINTS = {
    "slip": ("slip since the stage began", "m"),
    "plastic_slip": ("plastic slip", "m"),
    "opening": ("opening by dilation", "m"),
    "broken": ("broken", ""),
    "damage": ("damage", ""),
    "mobilised_friction": ("mobilised friction", "deg"),
    "pore_pressure": ("water pressure in joints", "Pa"),
    "normal_stress": ("normal stress of joints", "Pa"),
    "shear_stress": ("shear stress of joints", "Pa"),
}
NEEDS = {"pore_pressure": "Only cases with [water] do"}
WATER = "#0072b2"
OUTLINED = [withStroke(linewidth=3.0, foreground="white")]
RED, PRESSED, PULLED = "#d55e00", "#222222", "#0072b2"


def draw_water_table(axes, blocks):
    """Returns legend handles."""
    line = blocks["water_table"]
    if not len(line):
        return []
    axes.add_collection(LineCollection([line], colors=WATER, linewidths=1.6, linestyles="--", zorder=3.6, path_effects=OUTLINED))
    middle = 0.5 * (line[len(line) // 2 - 1] + line[len(line) // 2])
    axes.plot(*middle, marker="v", color=WATER, markeredgecolor="white", markeredgewidth=0.6, markersize=7, zorder=3.7, clip_on=True)
    return [Line2D([], [], color=WATER, linewidth=1.6, linestyle="--", label="water table")]


def write_numbers(axes, places, values, reference, view, columns=14):
    """The greatest value of each cell of a grid, beside its joint."""
    x0, y0, x1, y1 = view
    cell = (x1 - x0) / columns
    factor, unit = reference
    taken = set()
    for i in np.argsort(-values, kind="stable"):
        x, y = places[i]
        at = (int((x - x0) // cell), int((y - y0) // (0.6 * cell)))
        if values[i] <= 0.0 or at in taken or not (x0 <= x <= x1 and y0 <= y <= y1):
            continue
        taken.add(at)
        axes.text(x, y, f"{values[i] / factor:.3g}", fontsize=5, ha="center", va="center", color="#222222", zorder=4.0,
                  bbox={"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.75})
    return [Line2D([], [], color="none", label=f"numbers in {unit}")] if taken and unit else []


def draw_joints(axes, contacts, name, width_mm, view, numbers):
    """Joints as lines, as wide as their value is great. Returns legend handles."""
    if name not in contacts:
        raise ResultError(f"--joints {name}: this frame does not have it. {NEEDS.get(name, 'Only cases with a joint law that has a memory do')}; slip and mobilised_friction are in all.")
    red = WATER if name == "pore_pressure" else RED
    label, unit = JOINTS[name]
    values = np.abs(np.nan_to_num(contacts[name].astype(float), nan=0.0, posinf=0.0, neginf=0.0))
    if not len(values) or not values.max() > 0.0:
        return [Line2D([], [], color=red, label=f"{label}: none")]
    reference = np.percentile(values[values > 0.0], 98.0)
    widest = max(1.0, width_mm / 50.0)    # points
    widths = widest * np.clip(values / reference, 0.0, 1.0)
    kept = widths > 0.04 * widest
    axes.add_collection(LineCollection(contacts["points"][kept], linewidths=widths[kept], colors=red, capstyle="round", zorder=3.2))
    factor, unit = scaled_unit(unit, reference) if unit else (1.0, "")
    written = write_numbers(axes, contacts["points"].mean(axis=1), values, (factor, unit), view) if numbers else []
    return written + [Line2D([], [], color=red, linewidth=widest, label=f"{label} {reference / factor:.3g} {unit}".rstrip())]


def principal_stresses(blocks):
    """Greatest and least, compression positive, and the direction of the greatest as an angle to x."""
    xx, yy, xy = (np.nan_to_num(blocks[f"stress_{c}"].astype(float)) for c in ("xx", "yy", "xy"))
    mean, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    return mean + radius, mean - radius, 0.5 * np.arctan2(2.0 * xy, xx - yy)


def draw_crosses(axes, blocks, view, most=900):
    """A cross in each block, or in the greatest block of each cell of a grid where there are too many. Returns legend handles."""
    greatest, least, angle = principal_stresses(blocks)
    x0, y0, x1, y1 = view
    x, y = blocks["position"].T
    inside = (x >= x0) & (x <= x1) & (y >= y0) & (y <= y1)
    cell = np.sqrt((x1 - x0) * (y1 - y0) / most)
    column, row = np.floor((x - x0) / cell).astype(int), np.floor((y - y0) / cell).astype(int)
    order = np.argsort(-blocks["area"], kind="stable")
    order = order[inside[order]]
    if not len(order):
        return []
    _, first = np.unique(np.stack([column[order], row[order]], axis=1), axis=0, return_index=True)
    shown = order[first]
    size = np.maximum(np.abs(greatest[shown]), np.abs(least[shown]))
    if not len(shown) or not size.max() > 0.0:
        return []
    reference = np.percentile(size, 98.0)
    scale = 0.55 * max(cell, np.sqrt(np.median(blocks["area"][shown]))) / reference
    lines, colours = [], []
    for value, turn in ((greatest[shown], angle[shown]), (least[shown], angle[shown] + 0.5 * np.pi)):
        half = scale * np.clip(np.abs(value), 0.0, 1.5 * reference)[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
        centre = blocks["position"][shown]
        lines.append(np.stack([centre - half, centre + half], axis=1))
        colours += [PRESSED if v >= 0.0 else PULLED for v in value]
    axes.add_collection(LineCollection(np.concatenate(lines), linewidths=0.45, colors=colours, zorder=3.4))
    factor, unit = scaled_unit("Pa", reference)
    handles = [Line2D([], [], color=PRESSED, linewidth=0.8, label=f"principal stresses, the longest {reference / factor:.3g} {unit}")]
    if np.any((least[shown] < -0.01 * reference)):
        handles.append(Line2D([], [], color=PULLED, linewidth=0.8, label="the same, tension"))
    return handles
