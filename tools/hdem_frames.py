"""Reads one frame of blocks, of contacts, of bolts or of linings; hdem_io.py is what to import. io/hdf5_format.md says what each array means."""
import numpy as np

from checked_hdf5 import ANY, open_checked

FORMAT_MAJOR = 1
FARTHEST = 1e12    # m; no model reaches as far
REGIMES = 3    # of a block: none, force, impulse
HEAD = {"title": "text", "stage": "text", "cycle": "i8", "time": "f8", "time_step": "f8", "stage_begin_cycle": "i8", "hdem_version": "text",
        "git_commit": "text", "filetype": "text"}
BLOCK_CELLS = {"id": "i4", "material": "i4", "displacement": ("f4", 3), "rotation": "f4", "velocity": ("f4", 3), "speed": "f4", "angular_velocity": "f4",
               "kinetic_energy": "f4", "regime": "u1", "fixed": "u1", "detached": "u1", "next_to_excavation": "u1", "stress_xx": "f4", "stress_yy": "f4",
               "stress_xy": "f4", "stress_magnitude": "f4"}
CONTACT_CELLS = {"blocks": ("i4", 2), "normal": ("f4", 3), "length": "f4", "overlap": "f4", "normal_force": "f4", "shear_force": "f4", "normal_stress": "f4",
                 "shear_stress": "f4", "traction": "f4", "regime": "u1"}
BOLT_CELLS = {"bolt": "i4", "axial_force": "f4", "across_force": "f4", "greatest_force": "f4", "elongation": "f4", "status": "u1"}
LINER_CELLS = {"liner": "i4", "thrust": "f4", "shear": "f4", "moment_from": "f4", "moment_to": "f4"}
BOLT_STATES = ("planned", "elastic", "slips", "yielded", "ruptured", "lost")


def head_of(file, filetype="hdem-blocks"):
    """Attributes of a frame: cycle, time, stage, title and so on."""
    with open_checked(file, filetype, "hdem", FORMAT_MAJOR) as opened:
        return _head(opened, {})


def _head(opened, more):
    head = opened.attributes("hdem", HEAD | more)
    for name in ("time", *more):
        if not np.isfinite(head[name]):
            opened.fail(f"hdem@{name}", "not a finite number")
    return head


def _cells(opened, known):
    """Cell data, one value or row a cell: those that are known, and what a later version may have added."""
    count = len(opened.array("VTKHDF/CellData/" + next(iter(known)), None, None))
    cells = {}
    for name in sorted({*known, *opened.children("VTKHDF/CellData")}):
        kind, *width = known[name] if isinstance(known.get(name), tuple) else (known.get(name),)
        cells[name] = opened.array(f"VTKHDF/CellData/{name}", kind, (count, *width) if name in known else None)
        if cells[name].shape[:1] != (count,):
            opened.fail(f"VTKHDF/CellData/{name}", f"shape {list(cells[name].shape)}, expected {count} rows")
    return cells


def _positions(opened, path, shape):
    """Places [m]: finite, and on this side of the moon."""
    places = opened.array(path, "f8", shape)
    if not np.all(np.abs(places) <= FARTHEST):    # also false for what is no number
        opened.fail(path, f"not a number, or farther than {FARTHEST:g} m away")
    return places


def _indices(opened, path, values, low, high):
    if values.size and not (values.min() >= low and values.max() < high):
        opened.fail(path, f"numbers from {values.min()} to {values.max()}, expected {low} to {high - 1}")


def read_blocks(file):
    """One block frame as a dict of arrays, one entry per block; `polygon` and `part_...` lists see Run.blocks."""
    with open_checked(file, "hdem-blocks", "hdem", FORMAT_MAJOR) as opened:
        names = opened.texts("hdem/names")
        blocks = _block_arrays(opened, len(names))
        blocks["name"] = np.array(names, dtype=object)[blocks["id"]]
        points, offsets, outer, part_block = (blocks.pop(name) for name in ("points", "offsets", "outer", "part_block"))
        blocks |= _shapes(opened, points, offsets, outer, part_block, len(blocks["id"]))
        return blocks


def read_block_arrays(file):
    """The same without names and without lists, for those who read many large frames. Cells as arrays: points (n, 2), offsets, outer, part_block."""
    with open_checked(file, "hdem-blocks", "hdem", FORMAT_MAJOR) as opened:
        return _block_arrays(opened, np.iinfo("i4").max)


def read_names(file):
    """Of all blocks of the model, by `id`."""
    with open_checked(file, "hdem-blocks", "hdem", FORMAT_MAJOR) as opened:
        return opened.texts("hdem/names")


def _block_arrays(opened, names):
    cells = _cells(opened, BLOCK_CELLS)
    material_names, excavation_names = (opened.texts(f"hdem/{what}_names") for what in ("material", "excavation"))
    ids = cells["id"]
    _indices(opened, "VTKHDF/CellData/id", ids, 0, names)
    _indices(opened, "VTKHDF/CellData/material", cells["material"], 0, len(material_names))
    _indices(opened, "VTKHDF/CellData/regime", cells["regime"], 0, REGIMES)
    if np.any(np.diff(ids) < 0):
        opened.fail("VTKHDF/CellData/id", "not in ascending order")
    first = np.unique(ids, return_index=True)[1]    # a block's first part
    count = len(first)
    if not np.array_equal(opened.array("hdem/block_id", "i4", (count,)), ids[first]):
        opened.fail("hdem/block_id", "not the blocks of the cells")
    points = _positions(opened, "VTKHDF/Points", (ANY, 3))[:, :2]
    offsets = opened.array("VTKHDF/Offsets", "i8", (len(ids) + 1,))
    _indices(opened, "VTKHDF/Offsets", offsets, 0, len(points) + 1)
    if offsets[0] != 0 or offsets[-1] != len(points) or np.any(np.diff(offsets) < 3):
        opened.fail("VTKHDF/Offsets", "not the ends of polygons of all points")
    blocks = {name: data[first] for name, data in cells.items()}
    for name in ("displacement", "velocity"):
        blocks[name] = blocks[name][:, :2]
    blocks["position"] = _positions(opened, "hdem/block_position", (count, 2))
    blocks["area"] = opened.array("hdem/block_area", "f8", (count,))
    blocks["mass"] = opened.array("hdem/block_mass", "f8", (count,))
    blocks["material_names"], blocks["excavation_names"] = material_names, excavation_names
    blocks["outline"] = _positions(opened, "hdem/outline_segments", (ANY, 2, 2))
    blocks["outline_excavation"] = opened.array("hdem/outline_excavation", "i4", (len(blocks["outline"]),))
    _indices(opened, "hdem/outline_excavation", blocks["outline_excavation"], -1, len(excavation_names))
    blocks["water_table"] = _positions(opened, "hdem/water_table", (ANY, 2)) if opened.has("hdem/water_table") else np.empty((0, 2))
    blocks["info"] = _head(opened, {"detached_distance": "f8"})
    blocks["outer"] = opened.array("hdem/outer_edge", "u1", (len(points),)).astype(bool)
    blocks |= {"points": points, "offsets": offsets, "part_block": np.searchsorted(blocks["id"], ids)}
    return blocks


def _shapes(opened, points, offsets, outer, part_block, count):
    """Parts, outer edges, and the outline of each block."""
    parts = [points[begin:end] for begin, end in zip(offsets, offsets[1:])]
    following = np.arange(1, len(points) + 1)
    following[offsets[1:] - 1] = offsets[:-1]
    edges = np.stack([points[outer], points[following[outer]]], axis=1) if len(points) else np.empty((0, 2, 2))
    edge_block = np.repeat(part_block, np.diff(offsets))[outer]
    first_part = np.searchsorted(part_block, np.arange(count + 1))
    first_edge = np.searchsorted(edge_block, np.arange(count + 1))
    polygons, holes = [], []
    for block in range(count):
        mine = edges[first_edge[block]:first_edge[block + 1]]
        if first_part[block + 1] - first_part[block] == 1:
            polygons.append(parts[first_part[block]])
            holes.append([])
        elif len(mine) < 3:
            opened.fail("hdem/outer_edge", "a block without an outline")
        else:
            outer, *inner = _rings(mine)
            polygons.append(outer)
            holes.append(inner)
    return {"part_polygon": parts, "part_block": part_block, "edges": edges, "edge_block": edge_block, "polygon": polygons, "holes": holes}


def _rings(edges):
    """The outline of a block from its outer edges, then its holes, which run the other way round."""
    left, rings = np.ones(len(edges), bool), []
    while np.any(left):
        rings.append(_take_ring(edges, left))
    return sorted(rings, key=_doubled_area, reverse=True)


def _take_ring(edges, left):
    """Each edge goes on with the one that begins where it ends. Ends that meet were computed from the same corner, so they differ by rounding only."""
    nearest = np.argmax(left)
    ring = []
    while True:
        left[nearest] = False
        ring.append(edges[nearest][0])
        end = edges[nearest][1]
        distance = np.where(left, np.sum((edges[:, 0] - end) ** 2, axis=1), np.inf)
        nearest = np.argmin(distance)
        if np.sum((ring[0] - end) ** 2) <= distance[nearest]:
            return np.array(ring)


def _doubled_area(ring):
    x, y = (ring - ring[0]).T
    return np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))


def read_contacts(file):
    """One contact frame as a dict of arrays, one entry per contact; see Run.contacts."""
    with open_checked(file, "hdem-contacts", "hdem", FORMAT_MAJOR) as opened:
        contacts = _cells(opened, CONTACT_CELLS)
        _indices(opened, "VTKHDF/CellData/regime", contacts["regime"], 0, REGIMES + 1)
        contacts["normal"] = contacts["normal"][:, :2]
        contacts["points"] = _positions(opened, "VTKHDF/Points", (2 * len(contacts["blocks"]), 3))[:, :2].reshape(-1, 2, 2)
        contacts["info"] = _head(opened, {})
        return contacts


def read_bolts(file):
    """One frame of bolts as a dict of arrays, one entry per bolt that is installed; see Run.bolts."""
    with open_checked(file, "hdem-bolts", "hdem", FORMAT_MAJOR) as opened:
        bolts = _cells(opened, BOLT_CELLS)
        names = opened.texts("hdem/bolt_names")
        _indices(opened, "VTKHDF/CellData/bolt", bolts["bolt"], 0, len(names))
        _indices(opened, "VTKHDF/CellData/status", bolts["status"], 0, len(BOLT_STATES))
        bolts["name"] = np.array(names, dtype=object)[bolts["bolt"]]
        bolts["points"] = _positions(opened, "VTKHDF/Points", (2 * len(bolts["bolt"]), 3))[:, :2].reshape(-1, 2, 2)
        bolts["info"] = _head(opened, {})
        return bolts


def read_liners(file):
    """One frame of linings as a dict of arrays, one entry per segment of those that are installed; see Run.liners."""
    with open_checked(file, "hdem-liners", "hdem", FORMAT_MAJOR) as opened:
        liners = _cells(opened, LINER_CELLS)
        names = opened.texts("hdem/liner_names")
        _indices(opened, "VTKHDF/CellData/liner", liners["liner"], 0, len(names))
        liners["name"] = np.array(names, dtype=object)[liners["liner"]]
        liners["points"] = _positions(opened, "VTKHDF/Points", (2 * len(liners["liner"]), 3))[:, :2].reshape(-1, 2, 2)
        liners["info"] = _head(opened, {})
        return liners
