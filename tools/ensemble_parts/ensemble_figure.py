"""Reduction of cycles and difference of displacement, one point a realisation."""
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

from output_file import write_picture

STYLE = {"font.size": 9, "svg.fonttype": "none", "svg.hashsalt": "hdem", "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
         "grid.linewidth": 0.4, "legend.frameon": False}
SERIES = (("hybrid", "hybrid, R = 0.1", "o", "#0072b2"), ("hybrid_matched", "hybrid, R = 1/3", "^", "#d55e00"), ("hybrid_paper", "as published", "x", "#777777"))


def draw(found, file):
    rows = sorted(found["realisations"], key=lambda row: (row["dips_deg"], row["seed"]))
    with plt.rc_context(STYLE):
        figure, panels = plt.subplots(2, 1, figsize=(8.0, 6.0), sharex=True, layout="constrained")
        panels[1].set_yscale("symlog", linthresh=1e-2)    # from nothing to millimetres
        for name, label, marker, colour in SERIES:
            known = [(i, row["against_force"][name]) for i, row in enumerate(rows) if row["against_force"][name]]
            at = [i for i, _ in known]
            panels[0].plot(at, [100.0 * one["reduction"] for _, one in known], marker, color=colour, label=label)
            panels[1].plot(at, [one["displacement_difference_mm"] for _, one in known], marker, color=colour, label=label)
        median = found["median_reduction_paper_pairing"]
        if median is not None:
            panels[0].axhline(100.0 * median, color="#0072b2", linewidth=0.8, linestyle="--", label=f"median, R = 0.1: {100.0 * median:.1f} %")
        panels[0].set_ylabel("fewer cycles than force-based [%]")
        panels[0].legend(loc="best")
        panels[1].set_ylabel("mean displacement next to the\nopening differs by [mm]")
        panels[1].set_ylim(bottom=0.0)
        panels[1].set_xticks(range(len(rows)), ["/".join(f"{dip:g}" for dip in row["dips_deg"]) + f" seed {row['seed']}" for row in rows], rotation=90)
        write_picture(figure, file, remedy="give another file with --figure")
        plt.close(figure)
