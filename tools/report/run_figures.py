"""Pictures and curves of one run, as parts of its page."""
import base64
import io
from html import escape

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

import curves
import plot
from plot_history import drawable, panel_of
from shell import anchor

MANY_BLOCKS = 4000      # from here on a picture is made of dots, which is smaller then
MOST_POINTS = 1200      # of a curve: more than a screen shows
COUNTS = "contact points"
STORED = ("kinetic_energy", "elastic_normal", "elastic_shear", "driven_kinetic")
NOT_ENERGIES = ("unbalanced_force_ratio", "greatest_speed", "stick_points", "slip_points", "impulse_points")


def figure(name, body, caption):
    return f'<figure id="{anchor(name)}">{body}<figcaption>{caption}</figcaption></figure>'


def picture(run, colour, caption, arguments):
    """One frame as `hdem plot` draws it."""
    options = plot.parse(["--colour", colour, "--title", "", *arguments, "--", str(run.folder)])
    with matplotlib.rc_context(plot.STYLE | {"svg.fonttype": "path"}):
        drawn = plot.draw_frame(run, options)
        file = io.BytesIO()
        dots = len(run.blocks(options.frame)["id"]) > MANY_BLOCKS
        drawn.savefig(file, format="png" if dots else "svg", bbox_inches="tight", pad_inches=0.05, metadata=None if dots else {"Date": None})
        plt.close(drawn)
    data = base64.b64encode(file.getvalue()).decode()
    image = f'<img class="picture" alt="{escape(caption, quote=True)}" src="data:image/{"png" if dots else "svg+xml"};base64,{data}">'
    return figure(" ".join(["picture", colour, *arguments]), image, f"<b>{escape(caption)}</b>")


def factor_picture(run, caption):
    """Trials of `hdem fos` as `hdem plot --factor` draws them."""
    options = plot.parse(["--factor", "--title", "", "--", str(run.folder)])
    with matplotlib.rc_context(plot.STYLE | {"svg.fonttype": "path"}):
        drawn = plot.draw_factor(run, options)
        file = io.BytesIO()
        drawn.savefig(file, format="svg", bbox_inches="tight", pad_inches=0.05, metadata={"Date": None})
        plt.close(drawn)
    data = base64.b64encode(file.getvalue()).decode()
    return figure("factor of safety", f'<img class="picture" alt="{escape(caption, quote=True)}" src="data:image/svg+xml;base64,{data}">', f"<b>{escape(caption)}</b>")


def thinned(x, y):
    """A curve of many points as the least and greatest value of each of its stretches, where they are."""
    if len(x) <= MOST_POINTS:
        return x, y
    kept = [np.array([0, len(x) - 1])]
    for stretch in np.array_split(np.arange(len(x)), MOST_POINTS // 2):
        finite = stretch[np.isfinite(y[stretch])]
        if len(finite):
            kept.append(finite[[np.argmin(y[finite]), np.argmax(y[finite])]])
    kept = np.unique(np.concatenate(kept))
    return x[kept], y[kept]


def curve(table, name, label, positive=False):
    y = drawable(table[name].astype(float))
    x, y = thinned(table["time"], np.where(y > 0.0, y, np.nan) if positive else y)
    return {"name": label, "origin": "ours", "dots": len(x) == 1, "x": x.tolist(), "y": [float(v) if np.isfinite(v) else None for v in y]}


def begins_of_stages(run):
    """Times at which the second stage and later ones began, with their names."""
    ends = {}
    for frame in run.frames:
        ends[frame.stage] = frame.time
    names = [name for name in ends if name]
    return [{"name": f'stage "{after}" begins', "x": ends[before], "origin": "ours"} for before, after in zip(names, names[1:])]


def panel(run, table, names, title, unit, log=False):
    series = [curve(table, name, name.replace("_", " ") if len(names) > 1 else "", log) for name in names]
    series = [s for s in series if any(value is not None for value in s["y"])]
    if not series:
        return None
    return {"title": "", "x_label": "time [s]", "y_label": title + (f" [{unit}]" if unit != "1" else ""), "log_x": False, "log_y": log,
            "series": series, "marks": begins_of_stages(run)}


def drawn(name, panels, caption, title=None):
    """`name` is that of the place in the page, unlike all others; `title` what it is called."""
    panels = [p for p in panels if p]
    if not panels:
        return ""
    svg, legend = curves.draw({"id": anchor(name), "title": title or name, "columns": min(len(panels), 2), "panels": panels})
    return figure(f"curves {name}", f'{legend}<div class="wide">{svg}</div>', caption)


def convergence(run):
    table = run.energy()
    points = [name for name in ("stick_points", "slip_points", "impulse_points") if name in table]
    return drawn("convergence", [panel(run, table, ["kinetic_energy"], "kinetic energy", "J", log=True),
                                 panel(run, table, ["unbalanced_force_ratio"], "unbalanced force ratio", "1", log=True),
                                 panel(run, table, ["greatest_speed"], "greatest speed of a block", "m/s", log=True),
                                 panel(run, table, points, COUNTS, "1")], "<b>The run as a whole.</b>")


def ledger_curves(run):
    table = run.energy()
    terms = [name for name in table if name not in ("cycle", "time", "residual", *NOT_ENERGIES)]
    flows = [name for name in terms if name not in STORED and np.any(table[name])]
    stored = [name for name in STORED if name in table and np.any(table[name])]
    return drawn("energy", [panel(run, table, flows, "sums since the start", "J"), panel(run, table, stored, "stored now", "J")],
                 "<b>Energies over time.</b>")


def history(run, name):
    table = run.history(name)
    names = [column for column in table if column not in ("cycle", "time")]
    kinds = {}
    for column in names:
        kinds.setdefault(panel_of(column, table.unit[column]), []).append(column)
    panels = [panel(run, table, same, kind if kind == "points" else ", ".join(column.replace("_", " ") for column in same), table.unit[same[0]])
              for kind, same in kinds.items()]
    return drawn(f"history {run.histories.index(name) + 1}", panels, f"<b>History \"{escape(name)}\".</b> {len(table['time'])} samples.", f"history {name}")
