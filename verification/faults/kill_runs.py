#!/usr/bin/python3
"""Kills runs with SIGKILL at random moments, and looks at what they leave behind.

    kill_runs.py HDEM [--kills 100] [--seed 1]             HDEM: the program; one scene, killed and restarted again and again
    kill_runs.py HDEM --random [--kills 1000] [--seed 1]   each run is another random scene (random_scene.py, random_support.py)
    kill_runs.py HDEM --random --scene 17 [--kills 12]     only this scene
    kill_runs.py HDEM --case woken_by_stage.toml           only this case, whose checkpoints are by cycles

After each kill every file must open and be readable to its last byte, no more than one checkpoint interval may be lost, and the run goes on from
the folder, or begins anew where there was no checkpoint yet. What is left of a kill (`.lock`, temporary files) neither locks out nor stays. Once a
run has come to its end, its state hash, summary, histories, energies and frames must be those of an unbroken run to the last bit; then the next one
begins. Prints one line a run and a sum; exit code 1 if anything was wrong, 77 without h5py.

With --from-previous a restart is sometimes from checkpoint.previous.h5, which is older than the last one.
"""
import argparse
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    import run_folder
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

from random_support import scene_of

KILLS_A_SCENE = 12
LONGEST = 20.0    # seconds: scenes that take longer are left out


class TheScene:
    """The one scene of runs without --random."""
    interval = run_folder.INTERVAL
    text = run_folder.CASE.replace("row_every = 500", "row_every = 50")    # rows of run.log must tell how far a killed run had come


class GivenScene:
    """The case of --case."""

    def __init__(self, file):
        self.text = file.read_text(encoding="utf-8")
        self.interval = int(re.search(r"(?m)^checkpoint_every = (\d+)", self.text)[1])


def cycles_logged(folder):
    """The last cycle that a row of run.log speaks of since the last restart, which may have gone back: so far the run had come at least."""
    lines = (folder / "run.log").read_text(encoding="utf-8").splitlines()
    begun = max((at for at, line in enumerate(lines) if line.startswith("restart   ")), default=0)
    numbers = [line.split()[0] for line in lines[begun:] if line[:9].strip().isdigit()]
    return int(numbers[-1]) if numbers else 0


def temporary_files(folder):
    return set(folder.rglob("*.tmp"))


class Killer:
    """Runs of one scene in one folder, killed at moments that `chance` says."""

    def __init__(self, options, chance, root, scene):
        self.options, self.chance, self.scene = options, chance, scene
        self.folder, self.whole, self.case = root / "run", root / "whole", root / "case.toml"
        self.case.write_text(scene.text, encoding="utf-8")
        self.problems, self.manners = [], {}
        self.seconds, self.exit_code = 0.0, 0

    def run_unbroken(self):
        begin = time.monotonic()
        try:
            done = run_folder.run(self.options.hdem, self.case, "-o", self.whole, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            return f"takes more than {LONGEST:.0f} s"
        self.seconds, self.exit_code = time.monotonic() - begin, done.returncode
        return "" if done.returncode in (0, 4) else done.stderr.strip()

    def source(self):
        """What the next start is told."""
        if run_folder.checkpoint_cycle(self.folder) < 0:
            return [self.case, "-o", self.folder]
        previous = self.folder / "checkpoint.previous.h5"
        if self.options.from_previous and previous.exists() and self.chance.random() < 0.3:
            return ["--restart", previous]
        return ["--restart", self.folder]

    def await_moment(self, program):
        """Until the moment to kill; which manner of moment it was."""
        manner = self.chance.choice(("while it begins", "at any time", "at any time", "while it writes"))
        at = time.monotonic() + self.chance.uniform(0.0, 0.03 if manner == "while it begins" else 0.25 * self.seconds)
        while program.poll() is None and time.monotonic() < at:
            time.sleep(0.0005)
        if manner == "while it writes":
            kind = self.chance.choice(("checkpoint.*.tmp", "results.*.tmp", "frames/*.tmp", "*.tmp"))
            until = time.monotonic() + 0.5 * self.seconds
            while program.poll() is None and time.monotonic() < until and not list(self.folder.glob(kind)):
                pass
            time.sleep(self.chance.choice((0.0, 0.0, 0.0005, 0.002)))
        return manner

    def start(self):
        arguments = [self.options.hdem, "run", *map(str, self.source()), "--quiet", "--threads", str(self.chance.choice((1, 2, 3, 4)))]
        return subprocess.Popen(arguments, stderr=subprocess.PIPE, text=True)

    def expect_right_end(self, program, said):
        if program.returncode != self.exit_code:
            self.problems.append(f"exit code {program.returncode} instead of {self.exit_code}: {said.strip()} ({' '.join(map(str, program.args))})")

    def kill_once(self):
        """Begin or go on, and kill; True when it was killed before its end."""
        before, leftovers = run_folder.checkpoint_cycle(self.folder), temporary_files(self.folder)
        log = self.folder / "run.log"
        logged = log.stat().st_mtime_ns if log.exists() else 0
        with self.start() as program:
            manner = self.await_moment(program)
            if program.poll() is not None:
                self.expect_right_end(program, program.stderr.read())
                return False
            program.kill()
            said = program.stderr.read()
            if program.wait() != -9:    # it came to its end just before
                self.expect_right_end(program, said)
                return False
        self.manners[manner] = self.manners.get(manner, 0) + 1
        self.problems += run_folder.broken_files(self.folder)
        has_begun = log.exists() and log.stat().st_mtime_ns != logged    # so it had the folder to itself
        if has_begun:
            self.problems += [f"{file.name} of an earlier kill is still there" for file in leftovers & temporary_files(self.folder)]
            self.expect_little_lost(before)
        return True

    def expect_little_lost(self, before):
        kept, reached = run_folder.checkpoint_cycle(self.folder), cycles_logged(self.folder)
        if kept < before and not self.options.from_previous:
            self.problems.append(f"checkpoint of cycle {kept} after one of cycle {before}")
        if reached - max(kept, 0) > self.scene.interval:
            self.problems.append(f"cycle {reached} was reached, the checkpoint is of cycle {kept}")

    def claim_lock(self):
        """A lock left by a kill may name a process that is another one by now."""
        lock = self.folder / ".lock"
        if lock.exists() and self.chance.random() < 0.1:
            try:
                owner = json.loads(lock.read_text(encoding="utf-8"))
            except ValueError:    # killed before it had written its name
                return
            lock.write_text(json.dumps(owner | {"process": os.getpid()}), encoding="utf-8")

    def finish(self):
        with self.start() as program:
            said = program.communicate(timeout=600)[1]
            self.expect_right_end(program, said)

    def expect_unbroken(self):
        folder, whole = self.folder, self.whole
        if not (folder / "summary.json").exists():
            self.problems.append("no summary.json at the end")
            return
        self.problems += [f"{name} differs from the unbroken run" for name in run_folder.differing_results(folder, whole)]
        self.problems += [f"summary.json: {name} differs from the unbroken run" for name in run_folder.differing_summary(folder, whole)]
        self.problems += run_folder.broken_files(folder)
        self.problems += [f"{file.name} is left at the end" for file in sorted(temporary_files(folder)) + list(folder.rglob(".lock"))]

    def kill_many(self, kills):
        """How often it was killed, at most `kills` times."""
        killed = 0
        while killed < kills:
            if not self.kill_once():
                break
            killed += 1
            self.claim_lock()
        else:
            self.finish()
        self.expect_unbroken()
        return killed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("hdem", type=lambda name: Path(name).resolve())
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--random", action="store_true")
    parser.add_argument("--scene", type=int)
    parser.add_argument("--case", type=Path)
    parser.add_argument("--from-previous", action="store_true")
    options = parser.parse_args()
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")    # more threads than processors
    problems, kills, runs, left_out, manners = [], 0, 0, 0, {}
    while kills < options.kills or runs == 0:
        number = options.scene if options.scene is not None else options.seed * 10000 + runs + left_out
        scene = GivenScene(options.case) if options.case else scene_of(number) if options.random else TheScene()
        with tempfile.TemporaryDirectory() as scratch:
            killer = Killer(options, random.Random(number + 10 ** 7 * options.seed), Path(scratch), scene)
            name = f"scene {number}" if options.random else f"run {runs}"
            failed = killer.run_unbroken()
            if failed:
                print(f"{name}: left out: {failed}", flush=True)
                if not options.random or options.scene is not None:
                    return 1
                left_out += 1
                continue
            killed = killer.kill_many(min(KILLS_A_SCENE, options.kills - kills))
            kills, runs = kills + killed, runs + 1
            summary = killer.folder / "summary.json"
            ending = run_folder.summary(killer.folder)["state_hash"] if summary.exists() else "not reached"
            print(f"{name}: killed {killed} times, {killer.seconds:.1f} s, state hash {ending}", flush=True)
            for text in killer.problems:
                print(f"    {text}", flush=True)
            problems += killer.problems
            for manner, times in killer.manners.items():
                manners[manner] = manners.get(manner, 0) + times
    print(", ".join(f"{times} {manner}" for manner, times in sorted(manners.items())))
    print(f"{kills} kills, {runs} runs, {left_out} scenes left out, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
