#!/usr/bin/python3
"""Reads many damaged results and frames with hdem's scripts: each is read, or refused with a ResultError, soon and without much memory.

    damaged_results.py HDEM TOOLS [--results N] [--frames N] [--draw-every N] [--seed N] [--keep FOLDER]

A results.h5, a frame of blocks, of contacts or of bolts, or now and then the summary.json of a small run is changed byte by byte or object by object
(hdf5_changes.py) and read as hdem_io.py does; of those that are read, one in N becomes a picture, a page, or what `hdem view` shows. The reading is done by a process of its own: a crash of the library,
a file that takes 20 s of the processor or hangs, and 1 GB of memory are told too. Exit code 1 when anything is found; --keep gets the files.
"""
import argparse
import mmap
import os
import random
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "unit/tools"))
import hdf5_changes    # noqa: E402
import small_case    # noqa: E402

KINDS = ("results", "summary", "blocks", "contacts", "bolts")
FRAMES = KINDS[2:]
SLOWEST = 20.0          # s of the processor, of one file: a stop of the whole process, or other work on the machine, is nothing
HANGS = 600.0           # s of the clock
LARGEST = 1 << 30       # bytes in memory
MEMORY = 3 << 30        # bytes of addresses
CRASHED, SLOW, HUNG, LARGE = "the process crashed", f"took {SLOWEST:g} s of the processor", f"did not end in {HANGS:g} s", "took 1 GB of memory"
TICKS = os.sysconf("SC_CLK_TCK")


def parse(arguments):
    parser = argparse.ArgumentParser(prog="damaged_results.py", description="Damaged results and frames, read by hdem's scripts.")
    parser.add_argument("hdem", type=Path)
    parser.add_argument("tools", type=Path)
    parser.add_argument("--results", type=int, default=300, help="files of results (default: 300)")
    parser.add_argument("--frames", type=int, default=300, help="frames, of blocks, contacts and bolts in turn (default: 300)")
    parser.add_argument("--draw-every", type=int, default=20, help="one of so many files that are read is drawn (default: 20)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, help="folder for the files over which something was found")
    return parser.parse_args(arguments)


class Reader:
    """One file after the other, in the folder of a run that is whole but for this file."""

    def __init__(self, folder, draw_every):
        import hdem_io
        import plot
        import plot_rock
        import run_pack
        import run_page
        self.io, self.plot, self.joints, self.page, self.pack = hdem_io, plot, plot_rock.JOINTS, run_page, run_pack
        self.folder, self.draw_every, self.read = folder, draw_every, 0
        self.files = {kind: file_of(folder, kind) for kind in KINDS}
        self.whole = {kind: file.read_bytes() for kind, file in self.files.items()}
        self.run = hdem_io.open_run(folder)
        self.objects = {kind: hdf5_changes.objects_of(file) for kind, file in self.files.items() if kind != "summary"}

    def damage(self, chance, kind):
        """What was done."""
        file = self.files[kind]
        if kind == "summary" and chance.random() < 0.8:
            return hdf5_changes.change_json(chance, file, self.whole[kind])
        if kind == "summary" or chance.random() < 0.5:
            file.write_bytes(hdf5_changes.changed_bytes(chance, self.whole[kind]))
            return "bytes"
        file.write_bytes(self.whole[kind])
        try:
            return hdf5_changes.change_object(chance, file, self.objects[kind])
        except Exception as error:    # not every change can be made of every object; what there is by then is read
            return f"half a change ({error})"

    def try_one(self, kind, chance):
        """Whether it was read, and a traceback or ""."""
        try:
            run = self.run
            if kind == "results":
                run = self.io.open_run(self.folder)
                run.provenance(), run.state(), run.energy(), [run.history(name) for name in run.histories]
            else:
                run.summary() if kind == "summary" else getattr(run, kind)("last")
            self.read += 1
            if self.read % self.draw_every == 0:
                self.draw(run, chance)
            return True, ""
        except self.io.ResultError as error:
            return False, "" if "\n" not in str(error) and len(str(error)) < 2000 else f"not one line: {error}"
        except Exception:
            return False, traceback.format_exc()
        finally:
            self.plot.plt.close("all")

    def draw(self, run, chance):
        colour = chance.choice([*self.plot.FIELDS, *self.plot.CLASSES])
        over = chance.choice([["--contacts"], ["--crosses"], ["--joints", chance.choice([*self.joints])], ["--bolts"],
                              ["--liners", chance.choice(["thrust", "moment"])]])
        for words in (["--colour", colour, *over], ["--history", chance.choice(["energy", *run.histories])]):
            self.plot.make_picture(self.plot.parse([*words, "--dpi", "40", "-o", str(self.folder / "a.png"), "--", str(self.folder)]))
        if chance.random() < 0.2:
            self.page.build(run, run.summary(), "")
        if chance.random() < 0.2:
            pack = self.pack.RunPack()
            pack.update(run)
            pack.document("r0")


def file_of(folder, kind):
    return folder / {"results": "results.h5", "summary": "summary.json"}.get(kind, f"frames/{kind}_000002.hdf")


def kind_of(number, results):
    if number < results:
        return "summary" if number % 20 == 19 else "results"
    return FRAMES[number % len(FRAMES)]


def work(options, folder, first, shared):
    """Of a process of its own: numbers from `first` on; the number at hand, and the processor time at its beginning, are shared."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    warnings.simplefilter("ignore")
    reader = Reader(folder, options.draw_every)
    for number in range(first, options.results + options.frames):
        shared[:16] = struct.pack("<qd", number, 0.0)    # to damage a file may take longer than to read it: a text of zeros 18 s
        chance, kind = random.Random(f"{options.seed} {number}"), kind_of(number, options.results)
        done = reader.damage(chance, kind)
        shared[:16] = struct.pack("<qd", number, time.process_time())
        was_read, found = reader.try_one(kind, chance)
        at = 16 + 8 * (2 * KINDS.index(kind) + was_read)
        shared[at:at + 8] = struct.pack("<q", struct.unpack("<q", shared[at:at + 8])[0] + 1)
        if found:
            tell(options, reader.files[kind], number, done, found)
        reader.files[kind].write_bytes(reader.whole[kind])


def tell(options, file, number, done, found):
    print(f"number {number}, {file.name}, {done}: {found}", file=sys.stderr, flush=True)
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
        shutil.copy(file, options.keep / f"{number}_{file.name}")
    with open(file.parent / ("found" if file.parent.name != "frames" else "../found"), "a", encoding="utf-8") as list_of:
        list_of.write(f"{number}\n")


def used_by(process):
    """Seconds of the processor, and bytes in memory, of a process that may have ended."""
    try:
        words = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0, 0
    return (int(words[11]) + int(words[12])) / TICKS, int(words[21]) * mmap.PAGESIZE


def watched(process, shared):
    """What went wrong with the process, or ""."""
    at_hand, since = -1, 0.0
    while True:
        pid, status = os.waitpid(process, os.WNOHANG)
        if pid:
            return "" if status == 0 else f"{CRASHED} (status {status})"
        number, began = struct.unpack("<qd", shared[:16])
        if number != at_hand:
            at_hand, since = number, time.monotonic()
        seconds, memory = used_by(process)
        wrong = SLOW if began and seconds - began > SLOWEST else HUNG if time.monotonic() - since > HANGS else LARGE if memory > LARGEST else ""
        if wrong:
            os.kill(process, 9)
            os.waitpid(process, 0)
            return wrong
        time.sleep(0.02)


def run_all(options, folder):
    """Counts by kind, and how many were found."""
    shared = mmap.mmap(-1, 16 + 8 * 2 * len(KINDS))
    first, total = 0, options.results + options.frames
    whole = folder.with_name("whole")
    shutil.copytree(folder, whole)
    while first < total:
        process = os.fork()
        if process == 0:
            code = 1
            try:
                work(options, folder, first, shared)
                code = 0
            finally:
                sys.stderr.flush()
                os._exit(code)
        wrong = watched(process, shared)
        if not wrong:
            break
        number = struct.unpack("<q", shared[:8])[0]
        tell(options, file_of(folder, kind_of(number, options.results)), number, "", wrong)
        shutil.copytree(whole, folder, dirs_exist_ok=True)
        first, shared[:16] = number + 1, struct.pack("<qd", number + 1, 0.0)
    counts = struct.unpack(f"<{2 * len(KINDS)}q", shared[16:])
    found = (folder / "found").read_text().split() if (folder / "found").exists() else []
    return {kind: Counter(refused=counts[2 * i], read=counts[2 * i + 1]) for i, kind in enumerate(KINDS)}, len(found)


def main(arguments):
    options = parse(arguments)
    sys.path[:0] = [str(options.tools.resolve()), *(str(options.tools.resolve() / folder) for folder in ("report", "view"))]
    with tempfile.TemporaryDirectory(prefix="hdem_damaged_", dir="/dev/shm" if Path("/dev/shm").is_dir() else None) as scratch:
        folder = small_case.run(options.hdem.resolve(), Path(scratch), small_case.SUPPORTED)
        counts, found = run_all(options, folder)
    for kind, count in counts.items():
        print(f"{kind}: {count['refused'] + count['read']} files, {count['refused']} refused, {count['read']} read")
    print(f"{found} found")
    return 1 if found else 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"error: damaged_results.py: {error}")
