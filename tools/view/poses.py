"""Shapes of blocks once, and from where their displacements count. For run_pack.py."""
import numpy as np


def morton(position):
    """Order along a curve that keeps neighbours together, so that the page can leave out what is not in sight."""
    low, high = position.min(axis=0), position.max(axis=0)
    cells = ((position - low) / np.maximum(high - low, 1e-300) * 65535.0).astype(np.uint64)
    code = np.zeros(len(position), np.uint64)
    for bit in range(16):
        for axis in (0, 1):
            code |= (cells[:, axis] >> np.uint64(bit) & np.uint64(1)) << np.uint64(2 * bit + axis)
    return np.argsort(code, kind="stable")


def ranges(begin, count):
    """begin[0], begin[0] + 1, ... for each of them."""
    total = int(count.sum())
    first = np.cumsum(count) - count
    return np.arange(total) - np.repeat(first, count) + np.repeat(begin, count)


class Shapes:
    """Each block as it was first seen, about its centroid. `slot` of an id is its place in all arrays of the page."""

    def __init__(self):
        self.origin = None
        self.slot_of_id = np.empty(0, np.int64)
        self.id, self.base = np.empty(0, np.int64), np.empty((0, 2))
        self.area, self.mass, self.radius = (np.empty(0) for _ in range(3))
        self.material = np.empty(0, np.int64)
        self.vertex_count = np.empty(0, np.int64)    # of all parts of a block
        self.local = np.empty((0, 2))
        self.part_size, self.part_block, self.outer = np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0, bool)

    def slots(self, blocks):
        """Of the frame's blocks; those not yet known are added."""
        ids = blocks["id"]
        if len(ids) and ids.max() >= len(self.slot_of_id):
            self.slot_of_id = np.concatenate([self.slot_of_id, np.full(int(ids.max()) + 1 - len(self.slot_of_id), -1)])
        new = np.flatnonzero(self.slot_of_id[ids] < 0)
        if len(new):
            self._add(blocks, new)
        return self.slot_of_id[ids]

    def _add(self, blocks, new):
        if self.origin is None:
            self.origin = 0.5 * (blocks["points"].min(axis=0) + blocks["points"].max(axis=0))
        new = new[morton(blocks["position"][new])]
        position = blocks["position"][new]
        self.slot_of_id[blocks["id"][new]] = len(self.id) + np.arange(len(new))
        parts_of, part_block = np.bincount(blocks["part_block"], minlength=len(blocks["id"])), blocks["part_block"]
        first_part = np.cumsum(parts_of) - parts_of
        part_size = np.diff(blocks["offsets"])
        vertices_of = np.bincount(part_block, weights=part_size, minlength=len(blocks["id"])).astype(np.int64)
        mine = ranges(blocks["offsets"][first_part[new]], vertices_of[new])
        local = blocks["points"][mine] - np.repeat(position, vertices_of[new], axis=0)
        parts = ranges(first_part[new], parts_of[new])
        self.part_block = np.concatenate([self.part_block, np.repeat(len(self.id) + np.arange(len(new)), parts_of[new])])
        self.part_size = np.concatenate([self.part_size, part_size[parts]])
        self.local = np.concatenate([self.local, local])
        self.outer = np.concatenate([self.outer, blocks["outer"][mine]])
        begin = np.cumsum(vertices_of[new]) - vertices_of[new]
        radius = np.sqrt(np.maximum.reduceat(np.sum(local**2, axis=1), begin))
        for name, values in (("id", blocks["id"][new]), ("base", position - self.origin), ("area", blocks["area"][new]), ("mass", blocks["mass"][new]),
                             ("radius", radius), ("material", blocks["material"][new]), ("vertex_count", vertices_of[new])):
            setattr(self, name, np.concatenate([getattr(self, name), values]))

    def angles(self, blocks, slots):
        """By how much each of the frame's blocks has turned since it was first seen, -pi to pi: from its vertices."""
        begin = np.cumsum(self.vertex_count) - self.vertex_count
        count = self.vertex_count[slots]
        local = self.local[ranges(begin[slots], count)]
        now = blocks["points"] - np.repeat(blocks["position"], count, axis=0)
        first = np.cumsum(count) - count
        cross = np.add.reduceat(local[:, 0] * now[:, 1] - local[:, 1] * now[:, 0], first)
        dot = np.add.reduceat(np.sum(local * now, axis=1), first)
        return np.arctan2(cross, dot)


class References:
    """Where blocks stood when their displacements began to count: once a stage, so that frames need displacements only."""

    def __init__(self):
        self.sets, self._key = [], None    # arrays [slots, 3]: x, y from the base, angle

    def number_for(self, blocks, slots, shapes):
        """Of the set that this frame's displacements count from. A new one where none fits."""
        key = blocks["info"]["stage_begin_cycle"]
        moved = blocks["position"] - shapes.origin - shapes.base[slots] - blocks["displacement"]
        if self.sets and key == self._key and len(self.sets[-1]) == len(shapes.id):
            known = self.sets[-1][slots]
            if np.all(np.isfinite(known)) and np.all(np.abs(known[:, :2] - moved) <= 1e-4 * shapes.radius[slots, None] + 1e-7 * np.abs(shapes.base[slots])):
                return len(self.sets) - 1
        made = np.full((len(shapes.id), 3), np.nan)
        made[slots, :2] = moved
        turned = shapes.angles(blocks, slots) - blocks["rotation"]
        made[slots, 2] = np.arctan2(np.sin(turned), np.cos(turned))
        self.sets.append(made)
        self._key = key
        return len(self.sets) - 1
