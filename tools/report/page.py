"""The page: verdicts, tables and figures of hdem_verify as one HTML file."""
import re
from collections import Counter
from html import escape

import curves
import maps
from shell import anchor, card, document, number

LONG_TABLE = 60    # rows; longer ones are folded
GROUPS = {"paper": "The paper's tables and figures", "closed_form": "Closed forms", "": "Other"}
VERDICTS = {True: ("met", "✓ met"), False: ("missed", "✗ missed"), None: ("informs", "informs")}


def group_of(check):
    return next((group for group in GROUPS if group and check.startswith(group + ".")), "")


def deviation(row):
    """In per cent, except where the bar or a reference of 0 makes it a plain difference."""
    off, bar = row.get("deviation"), row.get("bar", "none")
    if off is None or row.get("reference") is None:
        return ""
    if row["reference"] == 0 or (bar.startswith("±") and not bar.endswith("%")):
        text = f"{off:+.3g}"
    elif abs(off) < 10:
        text = f"{100 * off:+.3g} %"
    else:
        text = f"× {1 + off:.3g}"
    return re.sub(r"e([+-])0?(\d+)", r"e\1\2", text).replace("e+", "e").replace("-", "−")


def bar_text(row):
    return {"none": "–", "at most": "≤ reference", "at least": "≥ reference"}.get(row.get("bar", ""), row.get("bar", ""))


def table_row(row, with_check):
    kind, word = VERDICTS[row["pass"]]
    check = f'<td><a href="#{anchor(row["case"])}">{escape(row["case"])}</a></td>' if with_check else ""
    source = "" if row["source"] == "-" else escape(row["source"])
    return (f'<tr class="{kind}">{check}<td class="what">{escape(row["quantity"])}</td><td class="source">{source}</td>'
            f'<td class="n">{number(row.get("reference"))}</td><td class="n">{number(row.get("measured"))}</td><td class="n">{deviation(row)}</td>'
            f'<td class="n">{escape(bar_text(row))}</td><td class="verdict">{word}</td></tr>')


def table(rows, with_check=False):
    head = ("<th>check</th>" if with_check else "") + "<th>quantity</th><th>source</th>" + "".join(
        f'<th class="n">{name}</th>' for name in ("reference", "ours", "deviation", "bar")) + "<th>verdict</th>"
    return (f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>'
            + "".join(table_row(row, with_check) for row in rows) + "</tbody></table></div>")


def tables(rows):
    """A long table is folded; what misses its bar is shown in any case."""
    if len(rows) <= LONG_TABLE:
        return table(rows)
    missed = [row for row in rows if row["pass"] is False]
    return (table(missed) if missed else "") + f"<details><summary>All {len(rows)} rows ({words(count(rows))})</summary>{table(rows)}</details>"


def numbered(check):
    """closed_form.A2 comes before closed_form.A12; the paper's keep their order."""
    digits = re.fullmatch(r"closed_form\.\D*(\d+)", check["name"])
    return int(digits[1]) if digits else 0


def count(rows):
    return Counter(VERDICTS[row["pass"]][0] for row in rows)


def words(counts):
    return f'{counts["met"]} met, {counts["missed"]} missed, {counts["informs"]} inform'


def figure(data):
    body = ""
    if data["maps"]:
        body += maps.draw(data["maps"])
    if data["panels"]:
        svg, legend = curves.draw(data)
        body += legend + f'<div class="wide">{svg}</div>'
    note = f' <span class="note">{escape(data["note"])}</span>' if data["note"] else ""
    return (f'<figure id="{anchor(data["id"])}">{body}<figcaption><b>{escape(data["title"])}.</b> '
            f'{escape(data["source"])}.{note}</figcaption></figure>')


def section(check, rows, figures):
    counts = count(rows)
    state = "missed" if counts["missed"] else "met"
    seconds = f' · {check["seconds"]:.1f} s' if "seconds" in check else ""
    what = escape(check.get("what", ""))
    return (f'<section id="{anchor(check["name"])}"><h3>{escape(check["name"])}</h3>'
            f'<p class="lead">{what[:1].upper() + what[1:]}. <span class="{state}">{words(counts)}</span><span class="note">{seconds}</span></p>'
            + "".join(figure(f) for f in figures) + tables(rows) + "</section>")


def summary(checks, rows, build):
    counts = count(rows)
    missed = [row for row in rows if row["pass"] is False]
    cards = "".join(card(counts[kind], text, kind) for kind, text in (
        ("met", "bars met"), ("missed", "bars missed"), ("informs", "rows without a bar")))
    version = f'<p class="note">{escape(build["line"])}</p>' if build else '<p class="note">version unknown: made without --curves</p>'
    text = f'<header id="top"><h1>hdem: verification</h1>{version}<div class="cards">{cards}{card(len(checks), "checks")}</div></header>'
    if missed:
        text += f'<section id="missed"><h2>Bars that are missed</h2>{table(missed, with_check=True)}</section>'
    return text


def contents(checks, rows_of):
    text = '<a class="home" href="#top">Summary</a>'
    if any(row["pass"] is False for rows in rows_of.values() for row in rows):
        text += '<a href="#missed">Missed bars</a>'
    for group, title in GROUPS.items():
        inside = [check for check in checks if group_of(check["name"]) == group]
        if inside:
            text += f"<h2>{escape(title)}</h2>"
        for check in inside:
            missed = count(rows_of[check["name"]])["missed"]
            flag = f'<span class="missed">{missed} ✗</span>' if missed else '<span class="met">✓</span>'
            text += f'<a href="#{anchor(check["name"])}">{escape(check["name"])} {flag}</a>'
    return text


def build(rows, drawn):
    """HTML of rows (`hdem_verify --json`) and figures (`--curves`; without them only tables)."""
    rows_of = {}
    for row in rows:
        rows_of.setdefault(row["case"], []).append(row)
    known = {check["name"]: check for check in drawn.get("checks", [])}
    checks = sorted((known.get(name, {"name": name}) for name in rows_of), key=numbered)
    figures = drawn.get("figures", [])
    main = summary(checks, rows, drawn.get("hdem"))
    for group, title in GROUPS.items():
        inside = [check for check in checks if group_of(check["name"]) == group]
        main += f"<h2>{escape(title)}</h2>" if inside else ""
        main += "".join(section(check, rows_of[check["name"]], [f for f in figures if f["check"] == check["name"]]) for check in inside)
    return document("hdem: verification", contents(checks, rows_of), main)
