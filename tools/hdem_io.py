#!/usr/bin/python3
"""Reads the results of a run of hdem: frames, histories, energies, provenance.

    from hdem_io import open_run
    run = open_run("tunnel")                     # the run's folder, or its results.h5
    for frame in run.frames:
        print(frame.number, frame.cycle, frame.time, frame.stage)
    blocks = run.blocks("last")                  # or a number: run.blocks(3)
    print(blocks["name"][0], blocks["displacement"][0], blocks["polygon"][0])
    contacts = run.contacts("last")
    print(contacts["normal_force"].sum(), "N")
    contact = run.history("contact")             # columns as arrays, also cycle and time
    print(contact["time"][-1], contact["shear_force"][-1], contact.unit["shear_force"])
    print(run.energy()["kinetic_energy"], run.provenance()["git_commit"])

Every number is in SI units; io/hdf5_format.md says what each array means. Files are opened, read and closed at once: a run may
still be going on. Needs h5py and numpy.
"""
import json
import sys
import warnings
from collections import namedtuple
from pathlib import Path

import h5py
import numpy as np

from plain_text import one_line
from run_lock import is_interrupted, is_running

Frame = namedtuple("Frame", "number cycle time stage")
FORMAT_MAJOR = 1


class ResultError(Exception):
    """A file that is missing, damaged, or not written by hdem."""


def tell(command, result, make):
    """Makes a file of a run's results for `hdem COMMAND`: prints its path, or why there is none. The exit code."""
    try:
        if not result.exists():
            raise ResultError(f"{result}: no such file or folder")
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "Glyph .* missing from")    # a name in an alphabet that no letters are installed for
            print(make())
        return 0
    except (ResultError, ValueError) as error:
        why, code = error, 2
    except KeyError as error:
        why, code = f"{result}: {error.args[0]}: a file is damaged. Run the case again.", 2
    except OSError as error:
        why, code = error, 1
    print(f"error: hdem {command}: {one_line(why)}", file=sys.stderr)
    return code


class Table(dict):
    """Columns of a history as arrays; `unit` maps their names to units."""

    def __init__(self, columns, unit):
        super().__init__(columns)
        self.unit = unit


def _texts(array):
    return [text.decode("utf-8", "replace") for text in np.asarray(array)]


def _attributes(holder):
    return {name: value.decode("utf-8", "replace") if isinstance(value, bytes) else value for name, value in holder.attrs.items()}


def _open(file, filetype, holder):
    """Opened for reading; refuses what hdem did not write, or writes in another way by now."""
    if not Path(file).is_file():
        raise ResultError(f"{file}: no such file. Give the folder of a run, or a file of its results.")
    try:
        opened = h5py.File(file, "r")
    except OSError as error:
        raise ResultError(f"{file}: cannot be read ({error})") from None
    head = _attributes(opened[holder]) if holder in opened else {}
    if head.get("filetype") != filetype:
        opened.close()
        raise ResultError(f"{file}: not a file of type {filetype}")
    if head["version"][0] != FORMAT_MAJOR:
        opened.close()
        raise ResultError(f"{file}: written in version {head['version'][0]} of its format; this program knows version {FORMAT_MAJOR}")
    return opened


def read_blocks(file):
    """One block frame as a dict of arrays, one entry per block; `polygon` and `part_...` lists see Run.blocks."""
    with _open(file, "hdem-blocks", "hdem") as opened:
        grid, extra = opened["VTKHDF"], opened["hdem"]
        cells = {name: data[...] for name, data in grid["CellData"].items()}
        points = grid["Points"][:, :2]
        offsets = grid["Offsets"][...]
        first = np.unique(cells["id"], return_index=True)[1]    # a block's first part; ids ascend
        names = np.array(_texts(extra["names"]), dtype=object)
        blocks = {name: data[first] for name, data in cells.items()}
        for name in ("displacement", "velocity"):
            blocks[name] = blocks[name][:, :2]
        blocks["name"] = names[blocks["id"]]
        blocks["position"] = extra["block_position"][...]
        blocks["area"] = extra["block_area"][...]
        blocks["mass"] = extra["block_mass"][...]
        parts = [points[begin:end] for begin, end in zip(offsets, offsets[1:])]
        blocks["part_polygon"] = parts
        blocks["part_block"] = np.searchsorted(blocks["id"], cells["id"])
        outer = extra["outer_edge"][...].astype(bool)
        following = np.arange(1, len(points) + 1)
        following[offsets[1:] - 1] = offsets[:-1]
        blocks["edges"] = np.stack([points[outer], points[following[outer]]], axis=1) if len(points) else np.empty((0, 2, 2))
        block_of_vertex = np.repeat(blocks["part_block"], np.diff(offsets))
        blocks["edge_block"] = block_of_vertex[outer]
        blocks["polygon"] = _polygons(parts, blocks["part_block"], len(first), blocks["edges"], blocks["edge_block"])
        blocks["material_names"] = _texts(extra["material_names"])
        blocks["outline"] = extra["outline_segments"][...]
        blocks["outline_excavation"] = extra["outline_excavation"][...]
        blocks["excavation_names"] = _texts(extra["excavation_names"])
        blocks["info"] = _attributes(extra)
        return blocks


def _polygons(parts, part_block, blocks, edges, edge_block):
    """Outline of each block: its only part, or its outer edges joined end to end."""
    counts = np.bincount(part_block, minlength=blocks)
    polygons = [None] * blocks
    for part, block in zip(parts, part_block):
        polygons[block] = part
    for block in np.flatnonzero(counts > 1):
        polygons[block] = _joined(edges[edge_block == block])
    return polygons


def _joined(edges):
    """Ends of edges that meet were computed from the same corner, so they differ by rounding only."""
    left = list(range(1, len(edges)))
    ring = [edges[0][0], edges[0][1]]
    while left:
        nearest = min(left, key=lambda i: np.sum((edges[i][0] - ring[-1]) ** 2))
        left.remove(nearest)
        ring.append(edges[nearest][1])
    return np.array(ring[:-1])


def read_contacts(file):
    """One contact frame as a dict of arrays, one entry per contact; see Run.contacts."""
    with _open(file, "hdem-contacts", "hdem") as opened:
        grid = opened["VTKHDF"]
        contacts = {name: data[...] for name, data in grid["CellData"].items()}
        contacts["normal"] = contacts["normal"][:, :2]
        contacts["points"] = grid["Points"][:, :2].reshape(-1, 2, 2)
        contacts["info"] = _attributes(opened["hdem"])
        return contacts


class Run:
    """A run's folder; see the module's text."""

    def __init__(self, path):
        path = Path(path)
        self.file = path / "results.h5" if path.is_dir() else path
        self.folder = self.file.parent
        with self._results() as results:
            frames = results["frames"]
            self.frames = [Frame(int(n), int(cycle), float(time), stage) for n, cycle, time, stage in
                           zip(frames["number"], frames["cycle"], frames["time"], _texts(frames["stage"]))]
            self.histories = sorted(results["history"])
            self.has_ended = bool(_attributes(results["provenance"]).get("end"))
        if not self.has_ended:
            self.frames += self._younger_frames()

    def _younger_frames(self):
        """Written since results.h5 was, which follows every ten seconds only: the last of them is where a run was broken off."""
        last = self.frames[-1].number if self.frames else -1
        found = []
        for file in sorted((self.folder / "frames").glob("blocks_" + "[0-9]" * 6 + ".hdf")):
            if int(file.stem[-6:]) <= last:
                continue
            try:
                with _open(file, "hdem-blocks", "hdem") as opened:
                    info = _attributes(opened["hdem"])
                found.append(Frame(int(file.stem[-6:]), int(info["cycle"]), float(info["time"]), info["stage"]))
            except ResultError:    # was on its way to the disk when the power failed
                break
        return found

    def summary(self):
        """summary.json as a dict; empty before the end of the run."""
        file = self.folder / "summary.json"
        try:
            found = json.loads(file.read_text(encoding="utf-8"))
        except FileNotFoundError:
            return {}
        except ValueError as error:
            raise ResultError(f"{file}: not JSON ({error}). Remove it, or run the case again.") from None
        if not isinstance(found, dict):
            raise ResultError(f"{file}: not a summary of a run. Remove it, or run the case again.")
        return found

    def state(self):
        """"done", "running", or "interrupted": broken off by a signal or a limit of time, or killed."""
        if is_interrupted(self.summary()):
            return "interrupted"
        return "done" if self.has_ended else "running" if is_running(self.folder) else "interrupted"

    def _results(self):
        return _open(self.file, "hdem-results", "/")

    def frame(self, which="last"):
        """The frame with this number, or the last one."""
        if not self.frames:
            raise ResultError(f"{self.file}: holds no frames")
        if which == "last":
            return self.frames[-1]
        for frame in self.frames:
            if frame.number == int(which):
                return frame
        raise ResultError(f"{self.file}: has no frame {which}; there are frames {self.frames[0].number} to {self.frames[-1].number}")

    def blocks(self, frame="last"):
        """Arrays with one entry per block, in the order of `id`.

        The frame's cell data (id, displacement, regime, ...), name, position, area, mass; polygon: list of outlines (n, 2).
        part_polygon, part_block: convex parts and the position of their blocks in the other arrays.
        edges (n, 2, 2), edge_block: outer edges. outline (n, 2, 2): edges around excavations.
        info: dict with cycle, time, stage, title and so on.
        """
        return read_blocks(self._file("blocks", frame))

    def contacts(self, frame="last"):
        """Arrays with one entry per contact: the frame's cell data, and points (n, 2, 2), its two ends."""
        return read_contacts(self._file("contacts", frame))

    def has_contacts(self, frame="last"):
        """Whether this frame has contacts: output.contacts of the case."""
        return self._file("contacts", frame).exists()

    def _file(self, kind, frame):
        return self.folder / "frames" / f"{kind}_{self.frame(frame).number:06d}.hdf"

    def _table(self, path):
        with self._results() as results:
            if path not in results:
                raise ResultError(f"{self.file}: has no {path}; histories are {', '.join(self.histories) or 'none'}")
            group = results[path]
            return Table({name: data[...] for name, data in group.items()},
                         {name: _attributes(data).get("unit", "1") for name, data in group.items()})

    def history(self, name):
        return self._table(f"history/{name}")

    def energy(self):
        return self._table("energy")

    def provenance(self):
        """Program, machine, case and command as a dict; case_text is the whole case file."""
        with self._results() as results:
            group = results["provenance"]
            found = _attributes(group)
            found.update({name: _texts(data) for name, data in group.items()})
            found["case_text"] = "".join(found["case_text"])
            return found


def open_run(path):
    """A run by its folder or its results.h5."""
    return Run(path)
