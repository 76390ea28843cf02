"""The nights of a machine as one HTML page that asks the network for nothing: a plot a metric, what is worse first."""
import sys
from html import escape
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools/report"))
from shell import anchor, card, document, number    # noqa: E402

from judge import BEFORE, METRICS, RECENT    # noqa: E402

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 460, 130, 62, 10, 10, 20
NIGHTS_SHOWN = 365
STATUS = {"worse": "worse", "better": "better", "suspect": "perhaps worse", "same": "no change", "short": "too few nights to judge", "shown": "not judged"}
STYLE = """<style>
.plots { display: grid; grid-template-columns: repeat(auto-fill, minmax(27rem, 1fr)); gap: 0.8rem; }
.plots figure { margin: 0; }
.plots figure.worse { border-color: var(--bad); }
figcaption { font-size: 13px; } figcaption b { font-weight: 600; } figcaption .worse, figcaption .suspect { color: var(--bad); } figcaption .better { color: var(--good); }
svg.nights { width: 100%; height: auto; } svg.nights text { font-size: 11px; fill: var(--soft); }
svg.nights .grid { stroke: var(--grid); } svg.nights .line { fill: none; stroke: var(--c0); stroke-width: 1; opacity: 0.5; }
svg.nights circle { fill: var(--c0); } svg.nights circle.recent { fill: var(--c3); } svg.nights circle:hover { r: 5; }
svg.nights .before { stroke: var(--c1); stroke-dasharray: 4 3; } svg.nights .spread { stroke: var(--c0); opacity: 0.35; }
svg.nights .accepted { stroke: var(--c2); stroke-dasharray: 2 2; }
</style>"""


def plain(value):
    """Four digits and a letter for the power of a thousand, as an axis has room for."""
    for power, letter in ((9, " G"), (6, " M"), (4, " k")):
        if abs(value) >= 10.0**power:
            return f"{value / 10.0**(power // 3 * 3):.4g}{letter}"
    return f"{value:.4g}".replace("-", "−")


class Scale:
    """Values to pixels; a metric that hardly moves still gets 4 % of its height, so that noise looks like noise."""

    def __init__(self, records):
        low, high = min(r["value"] - r["spread"] for r in records), max(r["value"] + r["spread"] for r in records)
        margin = max(0.02 * abs(high), 0.05 * (high - low)) or 1.0
        self.low, self.high, self.count = low - margin, high + margin, len(records)

    def x(self, i):
        return LEFT + (WIDTH - LEFT - RIGHT) * (i + 0.5) / self.count

    def y(self, value):
        return TOP + (HEIGHT - TOP - BOTTOM) * (self.high - value) / (self.high - self.low)


def plot(series, verdict):
    """Nights from left to right, a dot a median, a bar its spread; the last five in another colour, the median before them dashed."""
    skipped = max(0, len(series.records) - NIGHTS_SHOWN)
    records = series.records[skipped:]
    scale = Scale(records)
    marks = []
    for value in (scale.low + 0.1 * (scale.high - scale.low), scale.high - 0.1 * (scale.high - scale.low)):
        y = scale.y(value)
        marks.append(f'<path class="grid" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/><text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{plain(value)}</text>')
    for place, reason in series.accepted:
        if place >= skipped:
            marks.append(f'<path class="accepted" d="M{scale.x(place - skipped - 0.5):.1f} {TOP}V{HEIGHT - BOTTOM}"><title>accepted: {escape(reason)}</title></path>')
    if verdict.before:
        marks.append(f'<path class="before" d="M{scale.x(max(0, len(records) - RECENT - BEFORE)):.1f} {scale.y(verdict.before):.1f}H{WIDTH - RIGHT}"/>')
    if len(records) > 1:
        marks.append('<path class="line" d="M' + "L".join(f"{scale.x(i):.1f} {scale.y(r['value']):.1f}" for i, r in enumerate(records)) + '"/>')
    radius = 3 if len(records) < 100 else 1.6
    for i, r in enumerate(records):
        x = scale.x(i)
        if r["spread"]:
            marks.append(f'<path class="spread" d="M{x:.1f} {scale.y(r["value"] - r["spread"]):.1f}V{scale.y(r["value"] + r["spread"]):.1f}"/>')
        recent = ' class="recent"' if i >= len(records) - RECENT else ""
        title = f'{r["date"][:16]}, {r["commit"][:10]}: {plain(r["value"])} ± {plain(r["spread"])} {r["unit"]}, n = {r["n"]}'
        marks.append(f'<circle{recent} cx="{x:.1f}" cy="{scale.y(r["value"]):.1f}" r="{radius}"><title>{escape(title)}</title></circle>')
    marks.append(f'<text x="{LEFT}" y="{HEIGHT - 5}">{records[0]["date"][:10]}</text>'
                 f'<text x="{WIDTH - RIGHT}" y="{HEIGHT - 5}" text-anchor="end">{records[-1]["date"][:10]}</text>')
    return f'<svg class="nights" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{escape(series.name, quote=True)}">{"".join(marks)}</svg>'


def figure(series, verdict):
    last, unit = number(float(f"{series.values[-1]:.9g}")), METRICS[series.metric].unit
    change = f", {100.0 * verdict.change:+.1f} %".replace("-", "−") if verdict.status in ("worse", "better", "suspect", "same") else ""
    chance = f", p = {verdict.p:.1g}" if verdict.status in ("worse", "better", "suspect") and verdict.p > 0.0 else ""
    status = f'<span class="{verdict.status}">{STATUS[verdict.status]}{change}{chance}</span>'
    return (f'<figure class="{verdict.status}"><figcaption><b>{escape(series.name)}</b>, {escape(series.metric.replace("_", " "))}: {f"{last} {unit}".strip()}, {status}'
            f"</figcaption>{plot(series, verdict)}</figure>")


def summary(judged):
    worse = [(series, verdict) for series, verdict in judged if verdict.is_alarm]
    last = judged[0][0].records[-1]
    nights = max(len(series.records) for series, _ in judged)
    cards = (card(len(worse), "worse", "missed" if worse else "met") + card(sum(v.status == "better" for _, v in judged), "better")
             + card(sum(v.status in ("same", "worse", "better", "suspect") for _, v in judged), "judged") + card(nights, "nights"))
    lead = f'Last night {escape(last["date"][:16].replace("T", " "))} UTC, commit {escape(last["commit"])}, machine {escape(last["machine"])}, build {escape(last["build"])}.'
    return f'<h1 id="top">hdem: nights</h1><p class="lead">{lead}</p><div class="cards">{cards}</div>', worse


def section(title, note, pairs):
    return f'<h2 id="{anchor(title)}">{escape(title)}</h2><p class="note">{escape(note)}</p><div class="plots">{"".join(figure(*pair) for pair in pairs)}</div>'


def build(judged):
    """HTML of (series, verdict) pairs."""
    head, worse = summary(judged)
    parts = [("Worse", "Compared with the nights before; the dashed line is their median.", worse)] if worse else []
    for metric, facts in METRICS.items():
        pairs = [pair for pair in judged if pair[0].metric == metric]
        if pairs:
            parts.append((metric.replace("_", " "), f"{facts.text[0].upper()}{facts.text[1:]}{f' [{facts.unit}]' if facts.unit else ''}.", pairs))
    contents = '<a class="home" href="#top">Top</a>' + "".join(f'<a href="#{anchor(title)}">{escape(title)}<span>{len(pairs)}</span></a>' for title, _, pairs in parts)
    return document("hdem: nights", contents, STYLE + head + "".join(section(*part) for part in parts))
