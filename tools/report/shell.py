"""What every page shares: the document around it, links inside it, and how numbers are written."""
import re
from html import escape
from pathlib import Path


def anchor(name):
    return re.sub(r"[^A-Za-z0-9]+", "-", name)


def number(value):
    """Six digits; powers of ten written out."""
    if value is None:
        return "–"
    text = f"{value:.6g}"
    if "e" in text:
        digits, power = text.split("e")
        text = f"{digits} × 10<sup>{int(power)}</sup>".replace("<sup>-", "<sup>−")
    return text.replace("-", "−")


def card(value, text, kind=""):
    return f'<div class="card {kind}"><b>{value}</b>{text}</div>'


def document(title, contents, main):
    """HTML that asks the network for nothing."""
    style = (Path(__file__).parent / "style.css").read_text(encoding="utf-8")
    return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">'
            f"<title>{escape(title)}</title><style>{style}</style></head>\n<body><nav>{contents}</nav><main>{main}</main></body></html>\n")
