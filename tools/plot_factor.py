"""Displacement of the trials of `hdem fos` against the factor by which strength was divided."""
import math

import matplotlib.pyplot as plt

from hdem_io import ResultError
from plain_text import add_legend, literal
from plot_history import scaled_unit

SEARCHES = {"as_given": ("strength as given", "#0072b2", "o"), "peak": ("peak strength throughout", "#d55e00", "s"), "stiffer": ("stiffer joints", "#009e73", "^")}
VERDICTS = {"stable": "stands", "failed": "fails", "undecided": "undecided"}
TRIAL = {"search": str, "factor": float, "verdict": str, "reason": str, "displacement": float, "cycles": float, "failing_blocks": list}


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def factor_of(summary):
    """Key factor_of_safety of summary.json, checked; None where the run has none."""
    factor = summary.get("factor_of_safety")
    if factor is None:
        return None
    trials = factor.get("trials") if isinstance(factor, dict) else None
    if not isinstance(trials, list) or not trials:
        raise ResultError("summary.json: factor_of_safety is not what `hdem fos` writes. Remove the file, or run the case again.")
    for trial in trials:
        for key, kind in TRIAL.items():
            value = trial.get(key) if isinstance(trial, dict) else None
            if not (is_number(value) if kind is float else isinstance(value, kind)) or (key == "search" and value not in SEARCHES) or (key == "verdict" and value not in VERDICTS):
                raise ResultError(f"summary.json: factor_of_safety: {key} = {str(value)[:50]} is not what `hdem fos` writes. Remove the file, or run the case again.")
    for key in ("factor", "stable_at", "failed_at", "bound"):
        if factor.get(key) is not None and not is_number(factor[key]):
            raise ResultError(f"summary.json: factor_of_safety: {key} = {str(factor[key])[:50]} is not a number. Remove the file, or run the case again.")
    return factor


def draw_factor(run, options):
    factor = factor_of(run.summary())
    if factor is None:
        raise ResultError(f"{run.folder}: holds no factor of safety. Run the case with hdem fos.")
    trials = factor["trials"]
    figure, axes = plt.subplots(figsize=(options.width / 25.4, 0.55 * options.width / 25.4), dpi=options.dpi, layout="constrained")
    least = min((t["displacement"] for t in trials if t["displacement"] > 1e-9), default=1e-6)
    scale, unit = scaled_unit("m", max(t["displacement"] for t in trials))
    handles = []
    for search, (name, colour, marker) in SEARCHES.items():
        same = sorted((t for t in trials if t["search"] == search), key=lambda t: t["factor"])
        if not same:
            continue
        x, y = [t["factor"] for t in same], [max(t["displacement"], least) / scale for t in same]
        axes.plot(x, y, color=colour, linewidth=0.6, alpha=0.5)
        for verdict, word in VERDICTS.items():
            points = [(a, b) for a, b, t in zip(x, y, same) if t["verdict"] == verdict]
            if points:
                handles.append(axes.plot(*zip(*points), marker, color=colour, markerfacecolor="white" if verdict == "failed" else colour, markersize=5,
                                         fillstyle="left" if verdict == "undecided" else "full", markerfacecoloralt="white", label=f"{name}: {word}")[0])
    if factor.get("factor") is not None:
        handles.append(axes.axvline(factor["factor"], color="#222222", linewidth=0.8, label=f"F = {factor['factor']:.4f}"))
    if factor.get("bound") is not None:
        handles.append(axes.axvline(factor["bound"], color="#222222", linewidth=0.8, linestyle=":", label=f"bound {factor['bound']:.4f}"))
    axes.set_yscale("log")
    axes.set_xlabel("factor F by which strength is divided")
    axes.set_ylabel(f"displacement [{unit}]")
    axes.grid(True, linewidth=0.3, alpha=0.5)
    title = options.title if options.title is not None else run.blocks("last")["info"]["title"]
    if title:
        literal(axes.set_title(title, loc="left"))
    add_legend(axes, handles, loc="best", frameon=True, framealpha=0.85)
    return figure
