"""Maps of blocks as SVG, one a field and method, with one scale of colours a field."""
from html import escape

import matplotlib
import numpy as np

from curves import plain

SEQUENTIAL, DIVERGING = matplotlib.colormaps["YlGnBu"], matplotlib.colormaps["RdBu_r"]
STEPS = 32    # of colour, as many as an eye tells apart


def colour(value, low, high, colours):
    share = 0.0 if high == low else (value - low) / (high - low)
    step = min(max(int(share * STEPS), 0), STEPS - 1)
    return matplotlib.colors.to_hex(colours((step + 0.5) / STEPS))


def scale_of(maps, number):
    """Low, high: of the blocks that stay in place, in all maps, without the last percent."""
    field = maps[0]["fields"][number]
    values = [abs(v) for m in maps for v, gone in zip(m["fields"][number]["values"], m["detached"]) if not gone]
    high = float(np.percentile(values, 99)) or 1.0
    return (-high if field["has_both_signs"] else 0.0), high


def outline(parts, top):
    """Path data of a block; y runs downwards in SVG."""
    def at(p):
        return f"{p[0]:.2f} {top - p[1]:.2f}"
    return "".join("M" + "L".join(at(p) for p in part) + "Z" for part in parts)


def draw_map(block_map, number, low, high):
    field = block_map["fields"][number]
    colours = DIVERGING if field["has_both_signs"] else SEQUENTIAL
    points = np.concatenate([np.array(part) for block in block_map["parts"] for part in block])
    left, bottom = points.min(axis=0)
    right, top = points.max(axis=0)
    shapes = []
    for parts, value, gone in zip(block_map["parts"], field["values"], block_map["detached"]):
        fill = ' class="gone"' if gone else f' fill="{colour(value, low, high, colours)}"'
        shapes.append(f'<path{fill} d="{outline(parts, top)}"/>')
    label = escape(f'{field["title"]}, {block_map["title"]}', quote=True)
    return (f'<svg class="map" xmlns="http://www.w3.org/2000/svg" viewBox="{left - 0.1:.2f} -0.1 {right - left + 0.2:.2f} {top - bottom + 0.2:.2f}" '
            f'role="img" aria-label="{label}">{"".join(shapes)}</svg>')


def rounded(value):
    return plain(float(f"{value:.3g}"))


def scale_bar(title, low, high, both):
    colours = DIVERGING if both else SEQUENTIAL
    cells = "".join(f'<rect x="{i}" width="1.05" height="4" fill="{matplotlib.colors.to_hex(colours((i + 0.5) / STEPS))}"/>' for i in range(STEPS))
    bar = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {STEPS} 4" preserveAspectRatio="none" aria-hidden="true">{cells}</svg>'
    return f'<p class="scale"><b>{escape(title)}</b><span>{rounded(low)}</span>{bar}<span>{rounded(high)}</span></p>'


def draw(maps):
    """HTML: for each field a scale, and the maps beside each other."""
    parts = []
    for number, field in enumerate(maps[0]["fields"]):
        low, high = scale_of(maps, number)
        pictures = "".join(f"<div>{draw_map(m, number, low, high)}<p>{escape(m['title'])}</p></div>" for m in maps)
        parts.append(f'{scale_bar(field["title"], low, high, field["has_both_signs"])}<div class="maps">{pictures}</div>')
    return "".join(parts)
