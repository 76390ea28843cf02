#!/usr/bin/python3
"""Starts two to ten runs at once in one folder, in any order and with any options, kills some of them, and looks at what is there in the end.

    meeting_runs.py HDEM [--rounds 100] [--seed 1]    HDEM: the program

Some begin anew, some with --overwrite, some with --restart; the folder is new, or as the round before left it. Whoever is refused must say why, with
exit code 2. In the end one result must be there, and whole: the state hash, summary, histories, energies and frames of a run that met nobody, no
lock and no temporary file. Where all were killed or refused one more run must bring it. Exit code 1 if anything was wrong, 77 without h5py.
"""
import argparse
import collections
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

MET = r"another run is in this folder: (process \d+ on \S+ since |it has just begun)"
CUT_SHORT = r"the run in this folder was cut short"
NOTHING_TO_RESTART = r"--restart .*: \((does not exist|holds no checkpoint)\)"
REFUSALS = {"anew": (MET, CUT_SHORT), "overwrite": (MET,), "restart": (MET, NOTHING_TO_RESTART)}


class Round:
    """Runs that meet in `folder`."""

    def __init__(self, hdem, chance, case, folder):
        self.hdem, self.chance, self.case, self.folder = hdem, chance, case, folder
        self.problems, self.counts = [], collections.Counter()

    def arguments(self, kind):
        source = ["--restart", self.folder] if kind == "restart" else [self.case, "-o", self.folder]
        return [self.hdem, "run", *map(str, source), *(["--overwrite"] if kind == "overwrite" else []), "--quiet", "--threads", "1"]

    def start(self, kind):
        # pylint: disable=consider-using-with
        return kind, subprocess.Popen(self.arguments(kind), stderr=subprocess.PIPE, text=True)

    def look_at(self, kind, program):
        said = program.communicate(timeout=300)[1].strip()
        if program.returncode == 0:
            self.counts["came to their end"] += 1
        elif program.returncode == -9:
            self.counts["killed"] += 1
        elif program.returncode == 2 and any(re.search(text, said) for text in REFUSALS[kind]):
            self.counts["refused: another run" if re.search(MET, said) else "refused: nothing to restart, or a run cut short"] += 1
        else:
            self.problems.append(f"{kind}: exit code {program.returncode}: {said}")
        return program.returncode

    def meet(self, seconds):
        number = self.chance.choice((2, 3, 3, 10))
        kinds = [self.chance.choice(("anew", "overwrite", "restart")) for _ in range(number)]
        is_new, kills = not self.folder.exists(), self.chance.random() < 0.6
        apart = self.chance.choice((0.0, 0.0, 0.02))
        programs = []
        for kind in kinds:
            programs.append(self.start(kind))
            time.sleep(self.chance.uniform(0.0, apart))
        if kills:
            for _, program in self.chance.sample(programs, self.chance.randint(1, number)):
                time.sleep(self.chance.uniform(0.0, self.chance.choice((0.005, 0.4 * seconds))))
                program.kill()
        codes = [self.look_at(kind, program) for kind, program in programs]
        if is_new and not kills and kinds[0] != "restart" and 0 not in codes:
            self.counts["rounds where nobody went ahead"] += 1
        self.problems += run_folder.broken_files(self.folder) if self.folder.exists() else []

    def bring_to_its_end(self):
        """One run alone, if those that met left no result."""
        if (self.folder / "summary.json").exists():
            return
        self.counts["rounds brought to their end by one more run"] += 1
        kind = "restart" if run_folder.checkpoint_cycle(self.folder) >= 0 else "anew"
        _, program = self.start(kind)
        if self.look_at(kind, program) != 0:
            self.problems.append("a run alone in the folder did not come to its end")

    def expect_one_result(self, whole):
        missing = [name for name in ("results.h5", "checkpoint.h5", "run.log", "frames") if not (self.folder / name).exists()]
        if missing:
            self.problems.append(f"summary.json is there, but not {', '.join(missing)}")
            return
        self.problems += run_folder.broken_files(self.folder)
        self.problems += [f"{name} differs from the run that met nobody" for name in run_folder.differing_results(self.folder, whole)]
        self.problems += [f"summary.json: {name} differs" for name in run_folder.differing_summary(self.folder, whole)]
        self.problems += [f"{file.name} is left" for file in list(self.folder.rglob("*.tmp"))]
        log = (self.folder / "run.log").read_text(encoding="utf-8")
        if log.count("state hash") != 1 and log.count("restart ") == 0:
            self.problems.append(f"run.log tells of {log.count('state hash')} ends")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("hdem", type=lambda name: Path(name).resolve())
    parser.add_argument("--rounds", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    chance = random.Random(options.seed)
    counts, problems = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as scratch:
        root = Path(scratch)
        case, whole = run_folder.write_case(root), root / "whole"
        begin = time.monotonic()
        done = run_folder.run(options.hdem, case, "-o", whole, "--threads", "1")
        seconds = time.monotonic() - begin
        if done.returncode != 0:
            sys.exit(f"the run that meets nobody failed: {done.stderr}")
        folder = root / "round0"
        for number in range(options.rounds):
            meeting = Round(options.hdem, chance, case, folder)
            meeting.meet(seconds)
            if chance.random() < 0.3:    # the next round meets what this one left
                counts["rounds that left the folder to the next one"] += 1
            else:
                if folder.exists() or chance.random() < 0.5:
                    meeting.bring_to_its_end()
                    meeting.expect_one_result(whole)
                    counts["results looked at"] += 1
                folder = root / f"round{number + 1}"
            counts += meeting.counts
            problems += len(meeting.problems)
            for text in meeting.problems:
                print(f"round {number}: {text}", flush=True)
    print("\n".join(f"{times} {what}" for what, times in sorted(counts.items())))
    print(f"{options.rounds} rounds, {problems} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
