"""One HTML file of one or two packed runs. Nothing in it asks the network for anything."""
import json
from datetime import datetime, timezone
from html import escape
from pathlib import Path

from hdem_io import ResultError
from output_file import make_folder_of, write_output

TEMPLATE = Path(__file__).resolve().parent / "viewer.html"
MARK = "<!--DATA-->"
REMEDY = "It is bundled when hdem is built where Node.js and npm are: run tools/setup, then build hdem again (cmake --build). hdem plot and hdem report work without it."


def template():
    try:
        text = TEMPLATE.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ResultError(f"{TEMPLATE}: the viewer is not part of this hdem. {REMEDY}") from None
    if text.count(MARK) != 1:
        raise ResultError(f"{TEMPLATE}: damaged. {REMEDY}")
    return text


def in_script(text):
    """JSON in which no element of the page ends or begins."""
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def build(packs, live=None):
    """The page's text, in parts. `live`: seconds after which a page of a run that goes on loads itself again."""
    before, after = template().split(MARK)
    documents = [pack.document(f"r{number}") for number, pack in enumerate(packs)]
    facts = {"version": 1, "made": datetime.now(timezone.utc).strftime("%Y-%m-%d %H:%M UTC"), "live": {"every": live} if live else None,
             "runs": [facts for facts, _ in documents]}
    title = " | ".join(dict.fromkeys(run["title"] or run["name"] for run in facts["runs"]))
    yield before.replace("<title>hdem</title>", f"<title>{escape(title)}</title>", 1)
    yield f'<script type="application/json" id="hdem-facts">{in_script(json.dumps(clean(facts), allow_nan=False, separators=(",", ":")))}</script>\n'
    for _, chunks in documents:
        for name, chunk in chunks.items():
            yield f'<script type="application/octet-stream" id="{name}">{chunk.text()}</script>\n'
    yield after


def clean(value):
    """Numbers that are none become null: JSON knows no others."""
    if isinstance(value, float):
        return value if value - value == 0.0 else None
    if isinstance(value, dict):
        return {name: clean(one) for name, one in value.items()}
    return [clean(one) for one in value] if isinstance(value, list) else value


def write(output, parts, read=()):
    """Whole or not at all: who has the page open never loads a half of it."""
    make_folder_of(output)
    write_output(output, parts, read)
    return output
