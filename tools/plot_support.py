"""Bolts and linings over the blocks, with what they carry. For plot.py."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D

from plot_history import scaled_unit

ORANGE = "#d55e00"
DIAGRAM = 0.08    # of the picture's shorter side: where the greatest value of linings stands


def draw_bolts(axes, bolts):
    """Those that are installed by then; one that has ruptured, or lost its rock, has no force."""
    lines, force = bolts["points"], np.nan_to_num(bolts["axial_force"].astype(float), nan=0.0, posinf=0.0, neginf=0.0)
    if not len(lines):
        return []
    greatest = float(np.max(force, initial=0.0)) or 1.0
    colours = plt.get_cmap("plasma")
    axes.add_collection(LineCollection(lines, colors="black", linewidths=2.6, capstyle="round", zorder=4))
    axes.add_collection(LineCollection(lines, colors=colours(np.clip(force / greatest, 0.0, 1.0)), linewidths=1.8, capstyle="round", zorder=4.1))
    factor, unit = scaled_unit("N", greatest)
    return [Line2D([], [], color=colours(share), linewidth=1.8, label=f"bolt, {share * greatest / factor:.3g} {unit}") for share in (0.0, 0.5, 1.0)]


def draw_liners(axes, liners, kind, view):
    """Linings as lines; thrust or moment stands off them, on the inside where it compresses or stretches the inside."""
    lines = liners["points"]
    if not len(lines):
        return [Line2D([], [], color="none", label="no lining is installed yet")]
    moments = kind == "moment"
    values = np.stack([liners["moment_from"], liners["moment_to"]] if moments else [liners["thrust"]] * 2, axis=1)
    values = np.nan_to_num(values.astype(float), nan=0.0, posinf=0.0, neginf=0.0)
    greatest = float(np.max(np.abs(values), initial=0.0)) or 1.0
    along = lines[:, 1] - lines[:, 0]
    inside = np.stack([-along[:, 1], along[:, 0]], axis=1) / np.maximum(np.linalg.norm(along, axis=1), 1e-30)[:, None]
    off = lines + inside[:, None, :] * (values / greatest)[:, :, None] * DIAGRAM * min(view[2] - view[0], view[3] - view[1])
    axes.add_collection(PolyCollection(np.concatenate([lines, off[:, ::-1]], axis=1), facecolors=ORANGE, alpha=0.35, linewidths=0.0, zorder=3.5))
    axes.add_collection(LineCollection(off, colors=ORANGE, linewidths=0.7, zorder=3.6))
    axes.add_collection(LineCollection(lines, colors="black", linewidths=1.8, capstyle="round", zorder=3.8))
    factor, unit = scaled_unit("N m" if moments else "N", greatest)
    name = "moment of the lining, inside where the inside is stretched" if moments else "thrust of the lining, inside where it is compressed"
    return [Line2D([], [], color=ORANGE, linewidth=4.0, alpha=0.5, label=f"{name}: at most {greatest / factor:.3g} {unit}")]
