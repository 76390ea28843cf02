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
still be going on. Needs h5py and numpy, and the modules beside it. What is damaged, or no file of hdem, is a ResultError.
"""
import os
import sys
import warnings
from collections import namedtuple
from pathlib import Path

import numpy as np

from checked_hdf5 import ANY, MissingFile, ResultError, open_checked
from hdem_frames import FORMAT_MAJOR, head_of, read_blocks, read_bolts, read_contacts, read_liners
from output_file import OutputFailed, is_stream
from plain_text import one_line, printable, read_bytes, read_json, reason_of
from run_lock import is_running

Frame = namedtuple("Frame", "number cycle time stage")
PROVENANCE = {"hdem_version": "text", "git_commit": "text", "git_dirty": "u1", "compiler": "text", "flags": "text", "build_type": "text", "cpu": "text",
              "hostname": "text", "threads": "i8", "seed": "u8", "begin": "text", "end": "text", "case_file": "text", "case_sha256": "text"}
PROVENANCE_LISTS = ("overrides", "command_line", "environment")
MOST_PROVENANCE = 1 << 26    # bytes: a case file has at most 16 000 000
ENERGIES = ("kinetic_energy", "unbalanced_force_ratio", "greatest_speed", "residual")    # all others may be missing in older files
LATEST = 1e15    # s, thirty million years


def tell(command, result, make):
    """Makes a file of a run's results for a command, "hdem plot": prints its path, or why there is none. The exit code."""
    try:
        if not result.exists():
            raise ResultError(f"{result}: no such file or folder")
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "Glyph .* missing from")    # a name in an alphabet that no letters are installed for
            made = make()
        if not is_stream(made):
            print(printable(made))
        return 0
    except (ResultError, ValueError) as error:
        why, code = error, 2
    except OutputFailed as error:
        why, code = error, 1
    except OSError as error:
        why, code = reason_of(error), 1
    except MemoryError:
        why, code = f"{result}: there is not enough memory for it. Free some, or look at it on another machine.", 1
    print(f"error: {command}: {one_line(why)}", file=sys.stderr)
    return code


class Table(dict):
    """Columns of a history as arrays; `unit` maps their names to units."""

    def __init__(self, columns, unit):
        super().__init__(columns)
        self.unit = unit


class Run:
    """A run's folder; see the module's text."""

    def __init__(self, path):
        path = Path(path)
        self.file = path / "results.h5" if path.is_dir() else path
        self.folder = self.file.parent
        self._begin = self._stamp()
        with self._results() as results:
            self.frames = self._frames(results)
            self.histories = results.children("history") if results.has("history") else []
            self.has_ended = bool(results.attributes("provenance", {"end": "text"})["end"])
        if not self.has_ended:
            self.frames += self._younger_frames()

    def _stamp(self):
        """Another one says that results.h5 was written anew."""
        try:
            found = os.stat(self.file)
            return found.st_ino, found.st_mtime_ns
        except OSError:
            return None

    def _missing(self, file):
        """Of a file that the results name."""
        if is_running(self.folder) or self._stamp() != self._begin:
            return ResultError(f"{file}: is not there any more: it went away while it was read, as when the run is begun anew. Try again.")
        return ResultError(f"{file}: no such file, but the results name it: it was removed. Run the case again, or take a copy.")

    @staticmethod
    def _frames(results):
        number = results.array("frames/number", "i4", (ANY,))
        cycle, time = (results.array(f"frames/{name}", kind, number.shape) for name, kind in (("cycle", "i8"), ("time", "f8")))
        if np.any(number < 0) or np.any(np.diff(number) <= 0):
            results.fail("frames/number", "not in ascending order")
        if not np.all(np.abs(time) < LATEST):
            results.fail("frames/time", f"not a number below {LATEST:g}")
        return [Frame(*row) for row in zip(number.tolist(), cycle.tolist(), time.tolist(), results.texts("frames/stage", len(number)))]

    def _younger_frames(self):
        """Written since results.h5 was, which follows every ten seconds only: the last of them is where a run was broken off."""
        last = self.frames[-1].number if self.frames else -1
        found = []
        for file in sorted((self.folder / "frames").glob("blocks_" + "[0-9]" * 6 + ".hdf")):
            if int(file.stem[-6:]) <= last:
                continue
            try:
                info = head_of(file)
                found.append(Frame(int(file.stem[-6:]), int(info["cycle"]), float(info["time"]), info["stage"]))
            except ResultError:    # was on its way to the disk when the power failed
                break
        return found

    def summary(self):
        """summary.json as a dict; empty before the end of the run."""
        file = self.folder / "summary.json"
        try:
            found = read_json(file)
        except FileNotFoundError:
            return {}
        except ValueError as error:
            raise ResultError(f"{file}: not JSON ({error}). Remove it, or run the case again.") from None
        if not isinstance(found, dict):
            raise ResultError(f"{file}: not a summary of a run. Remove it, or run the case again.")
        return found

    def log(self):
        """run.log; empty without one."""
        file = self.folder / "run.log"
        try:
            return read_bytes(file).decode("utf-8", "replace")
        except FileNotFoundError:
            return ""
        except (OSError, ValueError) as error:
            raise ResultError(f"{file}: cannot be read ({getattr(error, 'strerror', None) or error}). Move it away.") from None

    def state(self):
        """"done", "running", or "interrupted": broken off by a signal or a limit of time, or killed."""
        return "done" if self.has_ended else "running" if is_running(self.folder) else "interrupted"

    def _results(self):
        try:
            return open_checked(self.file, "hdem-results", "/", FORMAT_MAJOR)
        except MissingFile:
            if self._begin is None and not is_running(self.folder):
                raise
            raise self._missing(self.file) from None

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

        The frame's cell data (id, displacement, regime, ...), name, position, area, mass; polygon: list of outlines (n, 2);
        holes: for each block a list of the outlines of its holes (n, 2), most have none.
        part_polygon, part_block: convex parts and the position of their blocks in the other arrays.
        edges (n, 2, 2), edge_block: outer edges. outline (n, 2, 2): edges around excavations.
        info: dict with cycle, time, stage, title and so on.
        """
        return self.read(read_blocks, "blocks", self.frame(frame).number)

    def contacts(self, frame="last"):
        """Arrays with one entry per contact: the frame's cell data, and points (n, 2, 2), its two ends."""
        if not self.has_contacts(frame):
            raise ResultError(f"{self.folder}: holds no contacts of frame {self.frame(frame).number}: output.contacts of the case is false, or the file was removed. "
                              "Set output.contacts = true, and run the case again.")
        return self.read(read_contacts, "contacts", self.frame(frame).number)

    def has_contacts(self, frame="last"):
        """Whether this frame has contacts: output.contacts of the case."""
        return self._file("contacts", frame).exists()

    def bolts(self, frame="last"):
        """Arrays with one entry per bolt that is installed: the frame's cell data, name, and points (n, 2, 2), its head and its end."""
        return self.read(read_bolts, "bolts", self.frame(frame).number)

    def has_bolts(self, frame="last"):
        """Whether the case has bolts."""
        return self._file("bolts", frame).exists()

    def liners(self, frame="last"):
        """Arrays with one entry per segment of the linings that are installed: the frame's cell data, name, and points (n, 2, 2), its two ends."""
        return self.read(read_liners, "liners", self.frame(frame).number)

    def has_liners(self, frame="last"):
        """Whether the case has linings."""
        return self._file("liners", frame).exists()

    def _file(self, kind, frame):
        return self.file_of(kind, self.frame(frame).number)

    def file_of(self, kind, number):
        """Of one frame: blocks, contacts, bolts or liners."""
        return self.folder / "frames" / f"{kind}_{number:06d}.hdf"

    def read(self, reader, kind, number):
        """What a reader of hdem_frames.py makes of such a file."""
        file = self.file_of(kind, number)
        try:
            return reader(file)
        except MissingFile:
            raise self._missing(file) from None

    def _table(self, path, known=()):
        """Columns of float64 besides the cycle; as many rows in each."""
        with self._results() as results:
            if not results.has(path):
                raise ResultError(f"{self.file}: has no {path}; histories are {', '.join(self.histories) or 'none'}")
            rows = results.array(f"{path}/cycle", "i8", (ANY,)).shape
            names = sorted({"cycle", "time", *known, *results.children(path)})
            columns = {name: results.array(f"{path}/{name}", "i8" if name == "cycle" else "f8", rows) for name in names}
            if not np.all(np.abs(columns["time"]) < LATEST):    # also false for what is no number
                results.fail(f"{path}/time", f"not a number below {LATEST:g}")
            return Table(columns, {name: results.attributes(f"{path}/{name}", {"unit": "text"})["unit"] for name in names})

    def history(self, name):
        return self._table(f"history/{name}")

    def energy(self):
        return self._table("energy", ENERGIES)

    def provenance(self):
        """Program, machine, case and command as a dict; case_text is the whole case file."""
        with self._results() as results:
            found = results.attributes("provenance", PROVENANCE)
            lists = [*PROVENANCE_LISTS, "case_text", *(["restarts"] if results.has("provenance/restarts") else [])]
            found.update({name: results.texts(f"provenance/{name}", most=MOST_PROVENANCE) for name in lists})
            found["case_text"] = "".join(found["case_text"])
            return found


def open_run(path):
    """A run by its folder or its results.h5."""
    return Run(path)
