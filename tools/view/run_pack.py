"""A run as chunks of the page: shapes once, then what moves and what is carried, frame by frame.

A run that goes on is packed by and by: update() reads the frames that have come since, and nothing twice.
"""
from pathlib import Path

import numpy as np

from coding import Chunk, groomed
from contact_rows import QUANTITIES, STEP, ContactRows
from extent import Extent
from fields import STORED, all_fields, more_fields, range_of
from hdem_frames import read_block_arrays, read_bolts, read_contacts, read_liners, read_names
from hdem_io import ResultError
from plain_text import printable
from poses import References, Shapes
from tables import tables_of

FINEST = 1e-5    # of a block's typical size: smaller steps in place are not seen
MOST_CONTACT_ROWS = 3_000_000    # contacts of all frames together that a page takes; else those of each stage's last frame


def width_reference(values):
    """What the widest line stands for: nearly the greatest value."""
    values = np.abs(np.nan_to_num(values.astype(float), nan=0.0, posinf=0.0, neginf=0.0))
    values = values[values > 0.0]
    return float(f"{np.percentile(values, 99.0):.5g}") if len(values) else 0.0


def greatest_of_liners(liners):
    """By which the page scales their diagrams: greatest thrust and moment."""
    def most(*names):
        return max(float(np.max(np.abs(np.nan_to_num(liners[name].astype(float), posinf=0.0, neginf=0.0)), initial=0.0)) for name in names)

    greatest = {"thrust": most("thrust"), "moment": most("moment_from", "moment_to")}
    return {name: float(f"{value:.5g}") for name, value in greatest.items()}


class RunPack:
    def __init__(self, contacts="auto"):
        self.contacts = contacts    # auto, all, ends or none
        self.shapes, self.references, self.rows = Shapes(), References(), ContactRows()
        self.frames, self.names, self.outlines, self.waters, self.extent = [], [], [], [], Extent()
        self.run = None
        self._fixed_facts, self._poses_at_hand = {}, {}    # the latter: of frames that were read in this update
        self.is_over = False    # known from elsewhere than the files

    def update(self, run):
        """Frames that are not yet in it. Those that the run has dropped since, as a restart does, begin everything anew."""
        if [f["number"] for f in self.frames] != [f.number for f in run.frames[:len(self.frames)]]:
            self.__init__(self.contacts)
        self.run = run
        if not run.frames:
            raise ResultError(f"{run.folder}: holds no frames. A run writes one at the end of each stage; output.frame_every in the case asks for more.")
        for frame in run.frames[len(self.frames):]:
            try:
                self._add(frame)
            except ResultError:
                if run.has_ended or frame.number != run.frames[-1].number:
                    raise
                break    # on its way to the disk
        if not self.frames:
            raise ResultError(f"{run.folder}: has no whole frame yet. Try again in a moment.")
        self._choose_contacts()
        self._poses_at_hand.clear()

    def _file(self, kind, number):
        return self.run.file_of(kind, number)

    def _add(self, frame):
        file = self._file("blocks", frame.number)
        blocks = self.run.read(read_block_arrays, "blocks", frame.number)
        if not len(blocks["id"]) and self.shapes.origin is None:
            raise ResultError(f"{file}: holds no blocks, and no frame before it does")
        if not self.names:
            self.names = self.run.read(read_names, "blocks", frame.number)
        if len(blocks["id"]) and blocks["id"][-1] >= len(self.names):
            raise ResultError(f"{file}: block {blocks['id'][-1]} is not one of the model's {len(self.names)}: frames are of different runs. Run the case again.")
        slots = self.shapes.slots(blocks)
        reference = self.references.number_for(blocks, slots, self.shapes)
        self._fixed_facts = {"materials": blocks["material_names"], "excavations": blocks["excavation_names"], "title": blocks["info"]["title"],
                             "detached_distance": float(blocks["info"]["detached_distance"])}
        entry = {"number": frame.number, "cycle": frame.cycle, "time": frame.time, "stage": frame.stage, "begin": int(blocks["info"]["stage_begin_cycle"]),
                 "reference": reference, "outline": self._number_of(self.outlines, blocks["outline"]), "detached": int(np.count_nonzero(blocks["detached"]))}
        self.extent.add_places(blocks["outline"])
        self.extent.add_places(blocks["water_table"])
        if len(blocks["water_table"]):
            entry["water"] = self._number_of(self.waters, blocks["water_table"])
        liners = self.run.read(read_liners, "liners", frame.number) if self._file("liners", frame.number).exists() else None
        entry["chunk"] = self._block_chunk(blocks, slots, liners)
        if liners is not None:
            entry["liners"] = greatest_of_liners(liners)
            self.extent.add_linings(liners)
        detached = blocks["detached"].astype(bool)
        entry["ranges"] = {name: range_of(name, values, detached) for name, values in all_fields(blocks).items()}
        if self._file("bolts", frame.number).exists():
            found = self.run.read(read_bolts, "bolts", frame.number)
            entry["bolts"] = self._bolts(found)
            self.extent.add_bolts(found)
        self._poses_at_hand[frame.number] = self._poses(blocks, slots, reference)
        self.frames.append(entry)

    def _block_chunk(self, blocks, slots, liners):
        order = np.argsort(slots, kind="stable")
        chunk = Chunk()
        if len(slots) < len(self.shapes.id) or len(self.frames) == 0:
            chunk.add("index", "u4", slots[order])
        size = float(np.median(self.shapes.radius))
        for axis, name in enumerate(("displacement_x", "displacement_y")):
            chunk.add(name, "f4", groomed(blocks["displacement"][order, axis], FINEST * size))
        chunk.add("rotation", "f4", groomed(blocks["rotation"][order], FINEST))
        velocity = blocks["velocity"]
        for name in STORED:
            values = velocity[:, "xy".index(name[-1])] if name.startswith("velocity") else blocks[name]
            chunk.add(name, "f2", values[order])
        for name in more_fields(blocks):
            chunk.add(name, "f2", blocks[name][order])
        flags = blocks["regime"] | blocks["fixed"] << 2 | blocks["detached"] << 3 | blocks["next_to_excavation"] << 4
        chunk.add("flags", "u1", flags[order])
        if liners is not None:
            chunk.add("liner_ends", "f4", liners["points"] - self.shapes.origin)
            for name in ("thrust", "moment_from", "moment_to"):
                chunk.add(f"liner_{name}", "f4", liners[name])
        return chunk.close()

    def _number_of(self, known, points):
        """Of these places among the known ones; most frames have the same."""
        places = np.round(points - self.shapes.origin, 5).ravel().tolist()
        if places not in known:
            known.append(places)
        return known.index(places)

    def _bolts(self, bolts):
        return {"ends": np.round(bolts["points"].reshape(-1, 4) - np.tile(self.shapes.origin, 2), 5).tolist(),
                "force": [float(f"{value:.4g}") for value in bolts["axial_force"]]}

    def _choose_contacts(self):
        """Contacts of all frames, or where these are too many of each stage's last one."""
        if self.contacts == "none":
            return
        ends = [i for i, f in enumerate(self.frames) if i + 1 == len(self.frames) or self.frames[i + 1]["begin"] != f["begin"]]
        if self.contacts == "ends" or (self.contacts == "auto" and self._contacts_expected() > MOST_CONTACT_ROWS):
            for i, frame in enumerate(self.frames):
                if i not in ends:
                    frame.pop("contacts", None)
            wanted = ends
        else:
            wanted = range(len(self.frames))
        for i in wanted:
            if "contacts" not in self.frames[i]:
                self.frames[i]["contacts"] = self._contact_chunk(self.frames[i])

    def contacts_left_out(self):
        """How many frames are without theirs because there are too many."""
        return sum("contacts" not in frame for frame in self.frames) if self.contacts == "auto" else 0

    def _contacts_expected(self):
        return len(self.frames) * self._contact_count()

    def _contact_count(self):
        """Of the last frame that has them, without reading it; a row takes at least 100 bytes there."""
        file = self._file("contacts", self.frames[-1]["number"])
        return file.stat().st_size / 120.0 if file.exists() else 0.0

    def _contact_chunk(self, frame):
        file = self._file("contacts", frame["number"])
        if not file.exists():
            return None
        contacts = self.run.read(read_contacts, "contacts", frame["number"])
        if len(contacts["blocks"]) and not np.all(self._known(contacts["blocks"])):
            raise ResultError(f"{file}: contacts name blocks that no frame has: the two files are of different runs, or damaged. Run the case again.")
        rows, order = self.rows.rows_of(contacts, self.shapes.slot_of_id, self._poses_of(frame), self.shapes.radius)
        chunk = Chunk()
        chunk.add("row", "u4", rows)
        for name in QUANTITIES:
            if name in contacts:
                chunk.add(name, "f2", contacts[name][order])
        chunk.add("regime", "u1", contacts["regime"][order])
        chunk.references = {name: width_reference(contacts[name]) for name in [*QUANTITIES, "mobilised_friction"] if name in contacts}
        return chunk.close()

    def _known(self, ids):
        inside = (ids >= 0) & (ids < len(self.shapes.slot_of_id))
        return inside & (self.shapes.slot_of_id[np.where(inside, ids, 0)] >= 0)

    def _poses(self, blocks, slots, reference):
        """x, y, angle of all blocks that the frame has, as in its file."""
        poses = np.full((len(self.shapes.id), 3), np.nan)
        poses[slots, :2] = blocks["position"]
        poses[slots, 2] = self.references.sets[reference][slots, 2] + blocks["rotation"]
        return poses

    def _poses_of(self, frame):
        if frame["number"] not in self._poses_at_hand:
            blocks = self.run.read(read_block_arrays, "blocks", frame["number"])
            return self._poses(blocks, self.shapes.slots(blocks), frame["reference"])
        return self._poses_at_hand[frame["number"]]

    def static_chunk(self):
        shapes, chunk = self.shapes, Chunk()
        chunk.add("id", "u4", shapes.id)
        for axis, name in enumerate(("base_x", "base_y")):
            chunk.add(name, "f4", shapes.base[:, axis])
        for name in ("area", "mass", "radius"):
            chunk.add(name, "f4", getattr(shapes, name))
        chunk.add("material", "u4", shapes.material)
        for axis, name in enumerate(("local_x", "local_y")):
            chunk.add(name, "f4", shapes.local[:, axis])
        chunk.add("part_size", "u4", shapes.part_size)
        chunk.add("part_block", "u4", shapes.part_block)
        chunk.add("outer", "u1", shapes.outer)
        for number, made in enumerate(self.references.sets):
            padded = np.full((len(shapes.id), 3), np.nan)
            padded[:len(made)] = made
            for axis, name in enumerate(("x", "y", "angle")):
                chunk.add(f"reference_{name}/{number}", "f4", groomed(padded[:, axis], 1e-7 * float(np.median(shapes.radius))))
        chunk.add("names", "text", [self.names[i] for i in shapes.id])
        return chunk.close()

    def contact_row_chunk(self):
        blocks, ends = self.rows.tables()
        chunk = Chunk()
        for side, name in enumerate(("first", "second")):
            chunk.add(name, "u4", blocks[:, side])
        for number, name in enumerate(("x0", "y0", "x1", "y1")):
            chunk.add(name, "i2", ends[:, number], STEP)
        return chunk.close()

    def document(self, prefix):
        """What the page knows of this run, and its chunks: id -> text."""
        run, parts = self.run, {}

        def put(name, chunk):
            parts[prefix + name] = chunk
            return {"id": prefix + name, "layout": chunk.layout}

        tables_chunk, tables = tables_of(run)
        frames = []
        for frame in self.frames:
            number = frame["number"]
            contacts = frame.get("contacts")
            frames.append(frame | {"chunk": put(f"b{number}", frame["chunk"]), "contacts": put(f"c{number}", contacts) | {"references": contacts.references} if contacts else None})
        try:
            made_by = run.provenance()
        except ResultError:
            made_by = {}
        facts = {"name": printable(Path(run.folder).resolve().name), "state": "interrupted" if self.is_over and run.state() == "running" else run.state(), "origin": self.shapes.origin.tolist(), "blocks": len(self.shapes.id),
                 "case": Path(str(made_by.get("case_file", ""))).name, "program": " ".join(filter(None, [made_by.get("hdem_version", ""), made_by.get("git_commit", "")[:10]])),
                 "static": put("s", self.static_chunk()), "rows": put("r", self.contact_row_chunk()), "tables_chunk": put("h", tables_chunk), "tables": tables,
                 "outlines": self.outlines, "waters": self.waters, "frames": frames, "contacts_left_out": self.contacts_left_out()}
        return facts | self._fixed_facts | self.extent.boxes(self.shapes.origin), parts
