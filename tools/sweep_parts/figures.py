"""Figures of a sweep: a histogram, and the share of failed runs over a key."""
from needed_modules import need
need("matplotlib", "numpy")
import matplotlib    # noqa: E402
matplotlib.use("Agg")
import matplotlib.pyplot as plt    # noqa: E402

from output_file import write_picture    # noqa: E402

from .common import BESIDE    # noqa: E402

STYLE = {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "text.parse_math": False}
STANDS, FAILS = "#0072b2", "#d55e00"


def draw_histogram(rows, name, criterion, file):
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(6.3, 3.3), layout="constrained")
        left, widths = [row["from"] for row in rows], [row["to"] - row["from"] for row in rows]
        failed = [row.get("failed", 0) for row in rows]
        others = [row["runs"] - count for row, count in zip(rows, failed)]
        axes.bar(left, others, widths, align="edge", color=STANDS, edgecolor="white", linewidth=0.5, label="others" if criterion else None)
        if criterion:
            axes.bar(left, failed, widths, align="edge", bottom=others, color=FAILS, edgecolor="white", linewidth=0.5, label=criterion)
            axes.legend(frameon=False)
        axes.set_xlabel(name)
        axes.set_ylabel("runs")
        write_picture(figure, file, remedy=BESIDE, dpi=150)
        plt.close(figure)


def draw_shares(rows, key, file):
    """Points with their intervals; values that are texts stand side by side."""
    with plt.rc_context(STYLE):
        figure, axes = plt.subplots(figsize=(6.3, 3.3), layout="constrained")
        values = [row[key] for row in rows]
        at = range(len(values)) if any(isinstance(value, str) for value in values) else values
        if at is not values:
            axes.set_xticks(list(at), [str(value) for value in values])
        share = [row["share"] for row in rows]
        errors = [[row["share"] - row["low"] for row in rows], [row["high"] - row["share"] for row in rows]]
        axes.errorbar(list(at), share, [[max(e, 0.0) for e in side] for side in errors], fmt="o", color=STANDS, markersize=4, linewidth=1.0, capsize=3)
        axes.set_ylim(-0.02, 1.02)
        axes.set_xlabel(key)
        axes.set_ylabel(f"share with {rows[0]['criterion']}")
        write_picture(figure, file, remedy=BESIDE, dpi=150)
        plt.close(figure)
