#!/usr/bin/python3
"""Turns a DXF drawing into files for hdem: closed polylines into blocks, open lines into joint traces.

    tools/import_dxf.py DRAWING.dxf --traces traces.wkt [--layer JOINTS]... [--scale 0.001]
    tools/import_dxf.py DRAWING.dxf --blocks blocks.csv [--material SANDSTONE=rock]... [--fixed GROUND]... [--arc 0.01]

The ending of a file says what is written: .wkt or .csv, both are read by hdem. Blocks, and traces in a .csv, are called LAYER_1, LAYER_2, ...
--material gives the blocks of a layer a material of the case, --fixed fixes them. Traces carry no properties in hdem.

Reads LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE, ELLIPSE and SPLINE in the model space, also inside block references, whose layer counts for
what lies on layer 0 in them; curves become straight stretches. What the drawing does not show is left out, as are other entities; both are counted. hdem wants metres:
--scale is what one unit of the drawing is in metres.
"""
import itertools
import math
import resource
import sys
from collections import Counter, namedtuple
from pathlib import Path

from needed_modules import end_in_one_line, need
if __name__ == "__main__":
    end_in_one_line("import_dxf")
need("ezdxf")
import ezdxf    # noqa: E402
import ezdxf.path    # noqa: E402
from ezdxf.lldxf.const import VTX_SPLINE_FRAME_CONTROL_POINT    # noqa: E402
from ezdxf.math import Matrix44    # noqa: E402

from output_file import OutputRefused, write_output    # noqa: E402
from plain_text import LARGEST_FILE, OneLineParser, one_line, open_regular, printable    # noqa: E402

DRAWN = {"LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"}
DEEPEST = 50    # references of blocks in blocks
MOST_PIECES = 2000000    # references that are taken apart count too
MOST_MEMORY = 900 << 20    # bytes; ordinary drawings take 10 for each of theirs, odd ones 70
SMALLER = "Save the layers of joints and blocks in a drawing of their own, and give that"
SURVEY = 1200 / 3937    # foot of the US survey [m]
# Name and metres of the units of $INSUNITS; 0 is none. ezdxf.units has neither those of the US survey nor all digits.
METRES = {1: ("inches", 0.0254), 2: ("feet", 0.3048), 3: ("miles", 1609.344), 4: ("mm", 0.001), 5: ("cm", 0.01), 6: ("metres", 1.0), 7: ("km", 1000.0),
          8: ("microinches", 2.54e-8), 9: ("mils", 2.54e-5), 10: ("yards", 0.9144), 11: ("angstroms", 1e-10), 12: ("nanometres", 1e-9), 13: ("micrometres", 1e-6),
          14: ("dm", 0.1), 15: ("decametres", 10.0), 16: ("hectometres", 100.0), 17: ("gigametres", 1e9), 18: ("astronomical units", 149597870700.0),
          19: ("light years", 9460730472580800.0), 20: ("parsecs", 3.0856775814913673e16), 21: ("US survey feet", SURVEY), 22: ("US survey inches", SURVEY / 12),
          23: ("US survey yards", 3 * SURVEY), 24: ("US survey miles", 5280 * SURVEY)}
SAME_SCALE = 1e-6    # a foot of the US survey is 2e-6 longer than others
ROUND_OFF = 1e-12    # of coordinates, in the ends of arcs
LONGEST_LAYER = 180    # characters of a name; hdem takes 200, the number included
ELSEWHERE = "give another place with --blocks or --traces"
HIDDEN, IN_FROZEN, INVISIBLE = "on layers that are off or frozen (name them by --layer)", "in block references on frozen layers (name these by --layer)", "invisible"
Line = namedtuple("Line", "name layer points")    # points [m], the first not repeated at the end of a closed line
Piece = namedtuple("Piece", "entity layer place unseen")    # `place`: from its block to the model space; `unseen`: why the drawing does not show it, or ""


class DrawingError(Exception):
    """Told to the user in one line."""


def parse(arguments):
    parser = OneLineParser(prog="import_dxf.py", description="A DXF drawing as blocks and joint traces for hdem.")
    parser.add_argument("drawing", type=Path)
    parser.add_argument("--blocks", type=Path, metavar="FILE", help="write closed polylines there, for blocks_file: .wkt or .csv")
    parser.add_argument("--traces", type=Path, metavar="FILE", help="write open lines there, for domain.traces_file: .wkt or .csv")
    parser.add_argument("--layer", action="append", default=[], help="only what lies on this layer; repeatable (default: all)")
    parser.add_argument("--material", action="append", default=[], metavar="LAYER=NAME", help="material of the blocks of this layer; repeatable")
    parser.add_argument("--fixed", action="append", default=[], metavar="LAYER", help="blocks of this layer are fixed; repeatable")
    parser.add_argument("--scale", type=float, default=1.0, help="metres in one unit of the drawing (default: 1)")
    parser.add_argument("--arc", type=float, default=0.01, help="greatest distance of a curve from its stretches [m] (default: 0.01)")
    options = parser.parse_args(arguments)
    if not (options.blocks or options.traces):
        parser.error("give --blocks or --traces, or both")
    for name in ("blocks", "traces"):
        file = getattr(options, name)
        if file and file.suffix not in (".wkt", ".csv"):
            parser.error(f"argument --{name}: {file}: ends in neither .wkt nor .csv. Give it one of these endings: hdem reads the file by it.")
    if (options.material or options.fixed) and not options.blocks:
        parser.error("--material and --fixed are of blocks: give --blocks too")
    for text in options.material:
        layer, equals, material = text.partition("=")
        if not (layer and equals and material) or not all(c.isascii() and (c.isalnum() or c in "_-") for c in material):
            parser.error(f"argument --material: {text}: not LAYER=NAME. A material's name has letters, digits, _ and -.")
    for name in ("scale", "arc"):
        if not 0.0 < getattr(options, name) < float("inf"):
            parser.error(f"argument --{name}: must be positive")
    options.material = {layer.lower(): material for layer, _, material in (text.partition("=") for text in options.material)}
    options.fixed = {layer.lower() for layer in options.fixed}
    return options


def drawing_of(file):
    """What ezdxf makes of the file; over a damaged one it raises nearly any exception."""
    try:
        open_regular(file).close()    # others would be waited for, or read without end
        return ezdxf.readfile(file)
    except MemoryError:
        raise
    except Exception as error:
        raise DrawingError(f"cannot be read ({error or type(error).__name__}). Give a DXF file of at most {LARGEST_FILE} bytes.") from None


def each(pieces, count):
    for piece in pieces:
        if next(count) > MOST_PIECES:
            raise DrawingError(f"has more than {MOST_PIECES} entities, with those of block references. {SMALLER}.")
        yield piece


def entities_of(space, hidden, count, outer=Piece(None, None, Matrix44(), ""), depth=0):
    """All that is drawn, block references taken apart. `hidden`: of each layer that is not shown, whether it is frozen. `count`: of all, from 1."""
    if depth > DEEPEST:
        raise DrawingError(f"blocks refer to blocks more than {DEEPEST} deep, or to themselves. Take the references apart.")
    for entity in each(space, count):
        kind, layer = entity.dxftype(), entity.dxf.layer
        if kind == "ATTDEF" and depth > 0:    # a text that the reference has
            continue
        layer = outer.layer if depth > 0 and layer == "0" else layer
        unseen = outer.unseen or (INVISIBLE if entity.dxf.get("invisible", 0) else "")
        if kind != "INSERT":
            yield Piece(entity, layer, outer.place, unseen or (HIDDEN if layer.lower() in hidden else ""))
            continue
        unseen = unseen or (IN_FROZEN if hidden.get(layer.lower()) else "")    # where its layer is off, a reference still shows what lies on others
        for one in each(entity.multi_insert(), count) if entity.mcount > 1 else [entity]:    # an array of them
            block = one.block()
            if block is None:
                raise DrawingError(f"the block {one.dxf.name} is not there. Save the drawing anew.")
            yield from entities_of(block, hidden, count, Piece(one, layer, one.matrix44() * outer.place, unseen), depth + 1)


def path_of(piece):
    """Its line in the model space. Of a polyline that was fitted by a spline, the vertices that shaped the spline are no part of it."""
    if piece.entity.dxftype() == "POLYLINE":
        piece.entity.vertices[:] = [vertex for vertex in piece.entity.vertices if not vertex.dxf.flags & VTX_SPLINE_FRAME_CONTROL_POINT]
    return ezdxf.path.make_path(piece.entity).transform(piece.place)    # arcs are Bezier curves by now, which any scale keeps


def points_of(path, scale, arc):
    """Corners [m], without those that repeat, and whether the line is closed."""
    drawn = [(scale * vertex.x, scale * vertex.y) for vertex in path.flattening(arc / scale)]
    farthest = max((abs(x) for point in drawn for x in point), default=0.0)
    if not math.isfinite(farthest + sum(x for point in drawn for x in point)):
        raise ValueError("not finite")
    points = []
    for point in drawn:
        if not points or math.dist(point, points[-1]) > ROUND_OFF * farthest:
            points.append(point)
    closed = path.is_closed and len(points) > 3
    return (points[:-1] if closed and math.dist(points[0], points[-1]) <= ROUND_OFF * farthest else points), closed


def name_of(layer):
    """What hdem takes as a part of a name: no ; , / and nothing that would make the line a comment."""
    return "".join("_" if c in ";,/#*" or not c.isprintable() else c for c in layer).strip()[:LONGEST_LAYER] or "layer"


def read(options):
    """Blocks, traces, and what was left out."""
    blocks, traces, left_out, numbers = [], [], Counter(), Counter()
    layers = {layer.lower() for layer in options.layer}

    def add(lines, layer, points):
        name = name_of(layer)
        numbers[name, lines is blocks] += 1
        lines.append(Line(f"{name}_{numbers[name, lines is blocks]}", layer.lower(), points))
    drawing = drawing_of(options.drawing)
    unshown = {layer.dxf.name.lower(): layer.is_frozen() for layer in drawing.layers if layer.is_off() or layer.is_frozen()}
    for piece in entities_of(drawing.modelspace(), {name: frozen for name, frozen in unshown.items() if name not in layers}, itertools.count(1)):
        entity, layer = piece.entity, piece.layer
        if piece.unseen:
            left_out[piece.unseen] += 1
            continue
        if layers and layer.lower() not in layers:
            left_out["on other layers"] += 1
            continue
        if entity.dxftype() not in DRAWN:
            left_out[entity.dxftype()] += 1
            continue
        try:
            points, closed = points_of(path_of(piece), options.scale, options.arc)
        except (TypeError, ValueError, ArithmeticError):
            left_out[f"{entity.dxftype()} that is no line in a plane"] += 1
            continue
        if len(points) < 2:
            left_out["without length"] += 1
        elif closed and options.blocks:
            add(blocks, layer, points)
        elif options.traces:
            add(traces, layer, points + points[:1] if closed else points)
        else:
            left_out["open lines"] += 1
    unit, metres = METRES.get(drawing.header.get("$INSUNITS", 0), ("", options.scale))
    if not math.isclose(options.scale, metres, rel_tol=SAME_SCALE):
        print(f"note: the drawing says that its unit is {unit}: --scale {metres:.10g}, not {options.scale:.10g}", file=sys.stderr)
    return blocks, traces, left_out


def wkt(points):
    return ", ".join(f"{x:.17g} {y:.17g}" for x, y in points)


def text_of_blocks(lines, options, is_csv):
    """Name, material and what is fixed behind each polygon, or in its first row."""
    rows = ["name,x,y,material,fixed"] if is_csv else []
    for line in lines:
        material, fixed = options.material.get(line.layer, ""), "fixed" if line.layer in options.fixed else ""
        if is_csv:
            more = f",{material},{fixed}"
            rows += [f"{line.name},{x:.17g},{y:.17g}{'' if i else more}" for i, (x, y) in enumerate(line.points)]
        else:
            rows.append(f"POLYGON(({wkt(line.points + line.points[:1])})); {line.name}; {material}; {fixed}".rstrip("; "))
    return rows


def text_of_traces(lines, is_csv):
    if is_csv:
        return ["name,x,y"] + [f"{line.name},{x:.17g},{y:.17g}" for line in lines for x, y in line.points]
    return [f"LINESTRING({wkt(line.points)})" for line in lines]


def check_layers(options, blocks):
    """What is said of a layer without blocks would be lost without a word."""
    there = {line.layer for line in blocks}
    for key, layers in (("--material", options.material), ("--fixed", options.fixed)):
        for layer in layers:
            if layer not in there:
                raise DrawingError(f"{options.drawing}: {key} {layer}: no block lies on this layer. Layers with blocks are {', '.join(sorted(there))}.")


def convert(options):
    """Writes the files; what was left out."""
    try:
        blocks, traces, left_out = read(options)
    except DrawingError as error:
        raise DrawingError(f"{options.drawing}: {error}") from None
    except (OSError, ValueError, ezdxf.DXFError) as error:
        raise DrawingError(f"{options.drawing}: cannot be read ({error}). Give a DXF file.") from None
    for file, lines, what in ((options.blocks, blocks, "blocks"), (options.traces, traces, "traces")):
        if file and not lines:
            raise DrawingError(f"{options.drawing}: no {what} found (left out: {dict(left_out) or 'nothing'}). Check --layer.")
    if options.blocks:
        check_layers(options, blocks)
        write(options.blocks, options.drawing, text_of_blocks(blocks, options, options.blocks.suffix == ".csv"), f"{len(blocks)} blocks")
    if options.traces:
        write(options.traces, options.drawing, text_of_traces(traces, options.traces.suffix == ".csv"), f"{len(traces)} traces")
    return left_out


def write(file, drawing, rows, what):
    write_output(file, [f"# {one_line(drawing.name)}\n", "\n".join(rows), "\n"], [drawing], ELSEWHERE, into_streams=True)
    print(f"{printable(file)}: {what}")


def limit_memory():
    """What needs more is a MemoryError."""
    hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
    resource.setrlimit(resource.RLIMIT_DATA, (MOST_MEMORY if hard == resource.RLIM_INFINITY else min(MOST_MEMORY, hard), hard))


def main(arguments):
    options = parse(arguments)
    limit_memory()
    try:
        left_out = convert(options)
    except MemoryError:
        print(f"error: import_dxf: {one_line(options.drawing)}: takes more than {MOST_MEMORY} bytes of memory. {SMALLER}, or a greater --arc.", file=sys.stderr)
        return 1
    except (DrawingError, OutputRefused, OSError) as error:
        print(f"error: import_dxf: {one_line(error)}", file=sys.stderr)
        return 1 if isinstance(error, OSError) else 2
    for what, count in left_out.items():
        print(f"left out: {count} {printable(what)}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
