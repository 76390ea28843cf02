#!/usr/bin/python3
"""Long runs, watched: does energy leak, does what rests creep, does memory or a file grow? About half an hour on two cores.

    soak_runs.py HDEM                       HDEM: the program; all runs in full
    soak_runs.py HDEM --minutes 15          a quarter of the cycles (15 of 60)
    soak_runs.py HDEM wall pile             of wall, pile and rubble only these
    soak_runs.py HDEM wall --slope          a wall on a slope above friction: the verdict on creep must fail

A wall at rest and a pile under loads that come and go for 10^7 cycles by each method, rubble of 10^4 blocks that slides for 10^5 by the hybrid one.
Prints a table with a verdict on each quantity; exit code 1 if a bar is missed, 77 without h5py. README.md of the folder above says what the bars are.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    import h5py
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

import soak_cases

ROWS = 200             # of the energies and of run.log
CHECKPOINTS = 20
SETTLED = 100_000      # cycles after which nothing at rest may move
MB = 2 ** 20

# Bars: see verification/README.md.
LEDGER = {"force": 1e-6, "impulse": 1e-4, "hybrid": 1e-4}
CREEP = {"wall": 1e-9, "pile": 1e-5}       # m
MEMORY = {"wall": 4.0, "pile": 4.0, "rubble": 32.0}    # MB
LOG_HEAD, LOG_ROW = 8000, 160              # bytes
RESULTS_HEAD, RESULTS_VALUE = 60000, 12    # bytes


class Watch:
    """Memory and cycle of a run, as samples (cycle, MB, bytes of its checkpoint)."""

    def __init__(self, program, folder):
        self.samples = []
        while program.poll() is None:
            resident = self.resident(program.pid)
            if resident:
                checkpoint = folder / "checkpoint.h5"
                self.samples.append((self.cycle(folder), resident, checkpoint.stat().st_size if checkpoint.exists() else 0))
            time.sleep(min(0.1, 0.002 * len(self.samples)))

    @staticmethod
    def resident(process):
        try:
            lines = Path(f"/proc/{process}/status").read_text(encoding="utf-8").splitlines()
        except OSError:
            return 0.0
        return sum(int(line.split()[1]) / 1024.0 for line in lines if line.startswith("VmRSS:"))

    @staticmethod
    def cycle(folder):
        try:
            rows = (folder / "run.log").read_text(encoding="utf-8").splitlines()
        except OSError:
            return 0
        return max((int(row.split()[0]) for row in rows if row[:9].strip().isdigit()), default=0)

    def peak(self, least, most):
        """Not a number, which misses every bar, when the run was too short to be sampled in both parts."""
        return max((memory for cycle, memory, _ in self.samples if least <= cycle <= most), default=float("nan"))

    def first_checkpoint(self):
        """Bytes of the first one seen; 0 when the run was too short to see one."""
        return next((size for *_, size in self.samples if size > 0), 0)


def vertices(folder, cycle):
    """Of all blocks in the frame of that cycle."""
    for file in sorted((folder / "frames").glob("blocks_*.hdf")):
        with h5py.File(file, "r") as frame:
            if frame["hdem"].attrs["cycle"] == cycle:
                return frame["VTKHDF/Points"][:, :2], len(frame["hdem/block_id"])
    raise RuntimeError(f"{folder} has no frame of cycle {cycle}")


def values_in(file):
    """Numbers in results.h5, and rows of its energies."""
    counts = []
    with h5py.File(file, "r") as results:
        for group in ("energy", "history"):
            results[group].visititems(lambda _, item: counts.append(item.size) if isinstance(item, h5py.Dataset) else None)
        return sum(counts), len(results["energy/cycle"])


class Soak:
    """One long run and its verdicts."""

    def __init__(self, hdem, scene, method, cycles, any_memory=False):
        self.hdem, self.scene, self.method, self.cycles, self.any_memory = hdem, scene, method, cycles, any_memory
        # Rubble need not settle: the copies for the frame at the end of its first stage shall be there at a tenth of the run.
        self.settled = cycles // 20 if scene == "rubble" else min(SETTLED, cycles // 5)
        self.rows = []

    def expect(self, quantity, measured, bar, unit=""):
        self.rows.append((quantity, f"{measured:.3g}", f"{bar:.3g} {unit}".strip(), bool(measured <= bar)))

    def run(self, root, slope):
        text = {"wall": lambda: soak_cases.wall(self.method, self.settled, self.cycles, slope),
                "pile": lambda: soak_cases.pile(self.method, self.settled, self.cycles),
                "rubble": lambda: soak_cases.rubble(self.method, self.settled, self.cycles, 116.0)}[self.scene]()
        case, folder = root / f"{self.scene}_{self.method}.toml", root / f"{self.scene}_{self.method}"
        case.write_text(text + soak_cases.OUTPUT.format(row_every=self.cycles // ROWS, checkpoint_every=self.cycles // CHECKPOINTS), encoding="utf-8")
        begin = time.monotonic()
        with subprocess.Popen([self.hdem, "run", case, "-o", folder, "--quiet"], stderr=subprocess.PIPE, text=True) as program:
            watch = Watch(program, folder)
            said = program.stderr.read()
        self.seconds = time.monotonic() - begin
        if program.returncode != 0:
            self.rows.append((f"exit code {program.returncode}: {said.strip()[:200]}", "", "", False))
            return
        self.judge(folder, watch)

    def judge(self, folder, watch):
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        self.expect("ledger, relative residual", abs(summary["energy"]["relative_residual"]), LEDGER[self.method])
        before, blocks = vertices(folder, self.settled)
        after, _ = vertices(folder, self.cycles)
        moved = float(np.linalg.norm(after - before, axis=1).max())
        if self.scene in CREEP:
            self.expect(f"farthest move of a vertex after cycle {self.settled}", moved, CREEP[self.scene], "m")
        else:
            self.rows.append((f"{blocks} blocks; farthest move of a vertex", f"{moved:.3g}", "none, m", True))
        tenth = self.cycles // 10
        early, late = watch.peak(0, tenth), watch.peak(tenth + 1, self.cycles)
        grown = f"memory at 10 %, at the end: {early:.1f}, {late:.1f} MB; it grew by"
        if self.any_memory:
            self.rows.append((grown, f"{late - early:.3g}", "none, MB", True))
        else:
            self.expect(grown, late - early, MEMORY[self.scene], "MB")
        if self.scene != "rubble":    # its contacts grow in number as it breaks up
            first = watch.first_checkpoint() or (folder / "checkpoint.previous.h5").stat().st_size
            self.expect("checkpoint: size of the last over that of the first", (folder / "checkpoint.h5").stat().st_size / first, 1.1)
        values, rows = values_in(folder / "results.h5")
        self.expect("rows of the energies", rows, ROWS + 3)
        self.expect("results.h5", (folder / "results.h5").stat().st_size, RESULTS_HEAD + RESULTS_VALUE * values, "B")
        self.expect("run.log", (folder / "run.log").stat().st_size, LOG_HEAD + LOG_ROW * (ROWS + 3), "B")
        files = sorted(str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file())
        frames = [f"frames/{kind}_{number:06d}.hdf" for kind in ("blocks", "contacts") for number in range(3)]
        known = [*frames, "blocks.hdf.series", "contacts.hdf.series", "checkpoint.h5", "checkpoint.previous.h5", "results.h5", "run.log",
                 "summary.json"]
        self.expect("files that nobody asked for", len(set(files) - set(known)), 0)

    def print_rows(self):
        missed = sum(not good for *_, good in self.rows)
        print(f"{self.scene}, {self.method}: {self.cycles} cycles, {self.seconds:.0f} s")
        for quantity, measured, bar, good in self.rows:
            verdict = "met   " if good else "MISSED"
            print(f"    {verdict}  {quantity:<62} {measured:>10}   bar {bar}" if measured else f"    {verdict}  {quantity}", flush=True)
        return missed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("hdem", type=lambda name: Path(name).resolve())
    parser.add_argument("scenes", nargs="*", help="wall, pile, rubble")
    parser.add_argument("--minutes", type=float, default=60.0, help="60: in full")
    parser.add_argument("--method", choices=("force", "impulse", "hybrid"))
    parser.add_argument("--slope", action="store_true")
    parser.add_argument("--any-memory", action="store_true", help="no bar on memory: the address sanitizer keeps what is freed")
    options = parser.parse_args()
    if set(options.scenes) - {"wall", "pile", "rubble"} or not options.minutes > 0.0:
        parser.error("give wall, pile or rubble, and a time above zero")
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    share, missed, runs = min(options.minutes / 60.0, 1.0), 0, 0
    with tempfile.TemporaryDirectory() as scratch:
        for scene in options.scenes or ("wall", "pile", "rubble"):
            for method in ("hybrid",) if scene == "rubble" else ("force", "impulse", "hybrid"):
                if options.method and method != options.method:
                    continue
                cycles = max(int((1e5 if scene == "rubble" else 1e7) * share) // 1000 * 1000, 1000)
                soak = Soak(options.hdem, scene, method, cycles, options.any_memory)
                soak.run(Path(scratch), 40.0 if options.slope else 0.0)
                missed, runs = missed + soak.print_rows(), runs + 1
    print(f"{runs} runs, {missed} bars missed")
    return 1 if missed or runs == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
