"""Curves of hdem_verify as SVG that takes its colours from the page, in light and in dark.

matplotlib writes fixed colours, so it is given placeholders that are replaced by the page's variables afterwards.
"""
import io
import re
from html import escape

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

from plain_text import literal

# placeholder -> variable of style.css
INK, FAINT, PAPER, GROUND = "#010203", "#010204", "#010205", "#010206"
SERIES = [f"#0103{i:02x}" for i in range(10)]
VARIABLES = {INK: "--ink", FAINT: "--grid", PAPER: "--paper", GROUND: "--card", **{colour: f"--c{i}" for i, colour in enumerate(SERIES)}}
EXACT_DASH, PAPER_DASH = (3, 3), (2, 2)
MARK_DASHES = [(6, 2), (1.5, 1.5), (6, 2, 1.5, 2), (3, 3)]

STYLE = {
    "font.size": 8.5, "axes.titlesize": 9, "axes.labelsize": 8.5, "axes.linewidth": 0.6, "axes.edgecolor": FAINT, "axes.facecolor": "none",
    "axes.labelcolor": INK, "axes.titlecolor": INK, "text.color": INK, "xtick.color": INK, "ytick.color": INK, "xtick.major.width": 0.6,
    "ytick.major.width": 0.6, "xtick.major.size": 2.5, "ytick.major.size": 2.5, "grid.color": FAINT, "grid.linewidth": 0.5,
    "figure.facecolor": "none", "savefig.facecolor": "none", "svg.fonttype": "none", "path.simplify_threshold": 0.2,
}


class Looks:
    """How the lines of a figure look: the same name the same in all panels that share names of ours, and in their legend."""

    def __init__(self, figure):
        self.groups, self.marks = [], {}
        for panel in figure["panels"]:
            group = self.group_of(panel)
            for series in panel["series"]:
                add_line(group["lines"], series)
            for mark in panel["marks"]:
                self.marks.setdefault(mark["name"], {"color": PAPER if mark["origin"] == "paper" else INK, "linewidth": 1.0,
                                                     "dashes": MARK_DASHES[len(self.marks) % len(MARK_DASHES)]})

    def group_of(self, panel):
        """Panels that share a name of ours; what they show is the group's title."""
        names = {series["name"] for series in panel["series"] if series["origin"] == "ours"}
        group = next((g for g in self.groups if names & g["names"]), None)
        if group is None:
            group = {"names": set(), "lines": {}, "shows": []}
            self.groups.append(group)
        group["names"] |= names
        what = panel["y_label"].split(" [")[0]
        if what not in group["shows"]:
            group["shows"].append(what)
        return group

    def legend(self):
        """HTML, a row a group, one entry a name."""
        rows = []
        for group in self.groups:
            title = f'<li class="note">{escape(", ".join(group["shows"]))}</li>' if len(self.groups) > 1 else ""
            entries = "".join(f"<li>{swatch(look)}{escape(name)}</li>" for name, look in group["lines"].items() if name)
            rows += [title + entries] if entries else []
        if self.marks:
            rows.append("".join(f"<li>{swatch(look, upright=True)}{escape(name)}</li>" for name, look in self.marks.items()))
        return "".join(f'<ul class="legend">{row}</ul>' for row in rows)


def add_line(lines, series):
    if series["name"] in lines:
        return
    single = len(series["x"]) == 1
    used = sum(look["color"] in SERIES for look in lines.values())
    if series["origin"] == "exact":
        look = {"color": INK, "linewidth": 0.8, "dashes": EXACT_DASH, "zorder": 4}
    elif series["origin"] == "paper":
        look = {"color": PAPER, "linewidth": 1.1, "dashes": PAPER_DASH, "zorder": 5}
    else:
        look = {"color": SERIES[used % len(SERIES)], "linewidth": max(2.2 - 0.5 * used, 1.2), "zorder": 3}
    if series["dots"]:    # smaller from one to the next, so that equal ones are seen to be equal
        look |= {"marker": "D" if series["origin"] == "paper" else "o", "markersize": 5.5 if single else max(5.5 - 2.0 * used, 3.5),
                 "markerfacecolor": GROUND, "markeredgewidth": 1.2, "zorder": 6}
    if single:
        del look["linewidth"]
        look.pop("dashes", None)
        look["linestyle"] = "none"
    lines[series["name"]] = look


def variable(placeholder):
    return f"var({VARIABLES[placeholder]})"


def swatch(look, upright=False):
    dashes = " ".join(f"{d:g}" for d in look.get("dashes", ()))
    line = '<path d="M13 0v14"' if upright else '<path d="M1 7h24"'
    picture = f'{line} style="stroke:{variable(look["color"])};stroke-width:{look.get("linewidth", 0) * 1.3:g};stroke-dasharray:{dashes or "none"}"/>'
    if "marker" in look:
        shape = '<circle cx="13" cy="7" r="3.2"' if look["marker"] == "o" else '<path d="M13 2.8 17.2 7 13 11.2 8.8 7z"'
        picture += f'{shape} style="fill:var(--card);stroke:{variable(look["color"])};stroke-width:1.6"/>'
    return f'<svg class="swatch" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 26 14" aria-hidden="true">{picture}</svg>'


def plain(value, _position=None):
    """1234567 -> 1 234 567; powers of ten where digits would be many."""
    if value == 0:
        return "0"
    if abs(value) >= 1e7 or abs(value) < 1e-3:
        digits, power = f"{value:.2e}".split("e")
        return f"{float(digits):g}e{int(power)}".replace("-", "−")
    text = f"{value:.6g}" if abs(value) < 1e4 else f"{value:,.0f}".replace(",", "\u202f")
    return text.replace("-", "−")


def draw_panel(axes, panel, looks):
    lines = looks.group_of(panel)["lines"]
    for series in panel["series"]:
        axes.plot(series["x"], [float("nan") if y is None else y for y in series["y"]], **lines[series["name"]])
    for mark in panel["marks"]:
        axes.axvline(mark["x"], zorder=2, **looks.marks[mark["name"]])
    literal(axes.set_title(panel["title"], loc="left"))
    literal(axes.set_xlabel(panel["x_label"]))
    literal(axes.set_ylabel(panel["y_label"]))
    axes.grid(True)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    for axis, log in ((axes.xaxis, panel["log_x"]), (axes.yaxis, panel["log_y"])):
        if log:
            axis.axes.set(**{f"{axis.axis_name}scale": "log"})
            low, high = axis.get_view_interval()
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < 30.0 * low else (1.0,), numticks=7))
            axis.set_minor_formatter(NullFormatter())
        else:
            axis.set_major_locator(MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]))
        axis.set_major_formatter(FuncFormatter(plain))


def set_range(axes, panel):
    """From zero where the values are not far from it; a logarithm shows at most twelve decades, the rest is round-off."""
    for axis, log in (("x", panel["log_x"]), ("y", panel["log_y"])):
        values = [value for series in panel["series"] for value in series[axis] if value is not None]
        if log and axis == "y":
            positive = [value for value in values if value > 0.0]
            axes.set_ylim(max(0.5 * min(positive), 1e-12 * max(positive)), 2.0 * max(positive))
        elif not log and 0.0 <= min(values) < 0.5 * max(values):
            axes.set(**{f"{axis}lim": (-0.02 * max(values), None)})


def short(number):
    return f"{float(number[0]):.2f}".rstrip("0").rstrip(".")


def tidy(svg, prefix):
    """matplotlib's file as a part of a page: no header, ids of its own, the page's colours and letters, two decimals."""
    svg = svg[svg.index("<svg"):]
    svg = re.sub(r"<metadata>.*?</metadata>|<defs>\s*<style.*?</style>\s*</defs>|<!--.*?-->", "", svg, flags=re.DOTALL)
    svg = re.sub(r' id="([^"]+)"', rf' id="{prefix}-\1"', svg)
    svg = re.sub(r'(xlink:)?href="#([^"]+)"', rf'href="#{prefix}-\2"', svg)
    svg = re.sub(r"url\(#([^)]+)\)", rf"url(#{prefix}-\1)", svg)
    svg = re.sub(r"font: ([\d.]+)px [^;\"]*", r"font-size: \1px", svg)
    svg = re.sub(r"<[^>]*>", lambda tag: re.sub(r"-?\d+\.\d{3,}", short, tag[0]), svg)
    svg = svg.replace(' xmlns:xlink="http://www.w3.org/1999/xlink"', "")
    for placeholder, name in VARIABLES.items():
        svg = svg.replace(placeholder, f"var({name})")
    return re.sub(r"\s*\n\s*", "\n", svg)


def draw(figure):
    """SVG of the panels, legend as HTML."""
    looks = Looks(figure)
    panels, columns = figure["panels"], figure["columns"]
    rows = -(-len(panels) // columns)
    height = {1: 3.6, 2: 2.5}.get(columns, 2.15)
    with matplotlib.rc_context(STYLE | {"svg.hashsalt": figure["id"]}):
        picture, grid = plt.subplots(rows, columns, squeeze=False, figsize=(10.0, height * rows), layout="constrained")
        for axes, panel in zip(grid.flat, panels):
            draw_panel(axes, panel, looks)
            set_range(axes, panel)
        for axes in grid.flat[len(panels):]:
            axes.set_visible(False)
        file = io.StringIO()
        picture.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
        plt.close(picture)
    svg = tidy(file.getvalue(), figure["id"])
    label = escape(figure["title"], quote=True)
    return re.sub(r"^<svg[^>]*viewBox=\"([^\"]+)\"[^>]*>",    # the title is no template of the expression
                  lambda head: f'<svg class="curves" xmlns="http://www.w3.org/2000/svg" viewBox="{head[1]}" role="img" aria-label="{label}">',
                  svg), looks.legend()
