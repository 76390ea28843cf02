#!/usr/bin/python3
"""Turns a DXF drawing into files for hdem: closed polylines into blocks, open lines into joint traces.

    tools/import_dxf.py DRAWING.dxf --traces traces.wkt [--layer JOINTS]... [--scale 0.001]
    tools/import_dxf.py DRAWING.dxf --blocks blocks.wkt [--arc 0.01]

Reads LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE, ELLIPSE and SPLINE in the model space, also inside block references; curves become
straight stretches. What is left out is counted. hdem wants metres: --scale is what one unit of the drawing is in metres.
"""
import argparse
import sys
from collections import Counter
from pathlib import Path

from needed_modules import need
need("ezdxf")
import ezdxf    # noqa: E402
import ezdxf.path    # noqa: E402

DRAWN = {"LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"}


def parse(arguments):
    parser = argparse.ArgumentParser(prog="import_dxf.py", description="A DXF drawing as blocks and joint traces for hdem.")
    parser.add_argument("drawing", type=Path)
    parser.add_argument("--blocks", type=Path, metavar="FILE", help="write closed polylines there, for blocks_file")
    parser.add_argument("--traces", type=Path, metavar="FILE", help="write open lines there, for domain.traces_file")
    parser.add_argument("--layer", action="append", default=[], help="only what lies on this layer; repeatable (default: all)")
    parser.add_argument("--scale", type=float, default=1.0, help="metres in one unit of the drawing (default: 1)")
    parser.add_argument("--arc", type=float, default=0.01, help="greatest distance of a curve from its stretches [m] (default: 0.01)")
    options = parser.parse_args(arguments)
    if not (options.blocks or options.traces):
        parser.error("give --blocks or --traces, or both")
    for name in ("scale", "arc"):
        if not 0.0 < getattr(options, name) < float("inf"):
            parser.error(f"argument --{name}: must be positive")
    return options


def entities_of(space):
    """All that is drawn, block references taken apart."""
    for entity in space:
        if entity.dxftype() == "INSERT":
            yield from entities_of(entity.virtual_entities())
        else:
            yield entity


def points_of(entity, scale, arc):
    """Corners [m], without those that repeat, and whether the line is closed."""
    path = ezdxf.path.make_path(entity)
    points = []
    for vertex in path.flattening(arc / scale):
        point = (scale * vertex.x, scale * vertex.y)
        if not points or point != points[-1]:
            points.append(point)
    closed = path.is_closed and len(points) > 3
    return (points[:-1] if closed and points[0] == points[-1] else points), closed


def wkt(points):
    return ", ".join(f"{x:.17g} {y:.17g}" for x, y in points)


def read(options):
    """Lines of text for blocks and for traces, and what was left out."""
    blocks, traces, left_out = [], [], Counter()
    layers = {layer.lower() for layer in options.layer}
    for entity in entities_of(ezdxf.readfile(options.drawing).modelspace()):
        if layers and entity.dxf.layer.lower() not in layers:
            left_out["on other layers"] += 1
        elif entity.dxftype() not in DRAWN:
            left_out[entity.dxftype()] += 1
        else:
            points, closed = points_of(entity, options.scale, options.arc)
            if len(points) < 2:
                left_out["without length"] += 1
            elif closed and options.blocks:
                blocks.append(f"POLYGON(({wkt(points + points[:1])}))")
            elif options.traces:
                traces.append(f"LINESTRING({wkt(points + points[:1] if closed else points)})")
            else:
                left_out["open lines"] += 1
    return blocks, traces, left_out


def main(arguments):
    options = parse(arguments)
    try:
        blocks, traces, left_out = read(options)
        for file, lines, what in ((options.blocks, blocks, "blocks"), (options.traces, traces, "traces")):
            if file is None:
                continue
            if not lines:
                print(f"error: import_dxf: {options.drawing}: no {what} found (left out: {dict(left_out) or 'nothing'}). Check --layer.", file=sys.stderr)
                return 1
            file.write_text(f"# {options.drawing.name}\n" + "\n".join(lines) + "\n", encoding="utf-8")
            print(f"{file}: {len(lines)} {what}")
    except (OSError, ezdxf.DXFError) as error:
        print(f"error: import_dxf: {options.drawing}: cannot be read ({error}). Give a DXF file.", file=sys.stderr)
        return 1
    for what, count in left_out.items():
        print(f"left out: {count} {what}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
