#!/usr/bin/python3
"""Kills runs with SIGKILL at random moments, and looks at what they leave behind.

    kill_runs.py HDEM [--kills 100] [--seed 1]    HDEM: the program

After each kill every file must open and be readable to its last byte, no more than one checkpoint interval may be lost, and the run goes on from
the folder. Once a run has come to its end, its state hash, stages, histories, energies and frames must be those of an unbroken run; then the next
one begins. Prints one line a run and a sum; exit code 1 if anything was wrong, 77 without h5py.
"""
import argparse
import random
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


def cycles_logged(folder):
    """The last cycle that a row of run.log speaks of: so far the run had come at least."""
    numbers = [line.split()[0] for line in (folder / "run.log").read_text(encoding="utf-8").splitlines() if line[:9].strip().isdigit()]
    return int(numbers[-1]) if numbers else 0


def kill_once(hdem, case, folder, delay, threads):
    """Begin or go on, kill after `delay` seconds; True when it was killed before its end."""
    source = ["--restart", folder] if run_folder.checkpoint_cycle(folder) >= 0 else [case, "-o", folder]
    arguments = [hdem, "run", *map(str, source), "--quiet", "--threads", str(threads), "--set", f"output.row_every={run_folder.ROW_EVERY}"]
    with subprocess.Popen(arguments) as program:
        try:
            program.wait(delay)
        except subprocess.TimeoutExpired:
            program.kill()
            program.wait()
            return True
        if program.returncode != 0:
            raise RuntimeError(f"exit code {program.returncode} of {' '.join(arguments)}")
        return False


def problems_of_killed(folder, before):
    problems = run_folder.broken_files(folder)
    if not (folder / "run.log").exists():
        return problems
    kept, reached = run_folder.checkpoint_cycle(folder), cycles_logged(folder)
    if kept < before:
        problems.append(f"checkpoint of cycle {kept} after one of cycle {before}")
    if reached - max(kept, 0) > run_folder.INTERVAL:
        problems.append(f"cycle {reached} was reached, the checkpoint is of cycle {kept}")
    return problems


def problems_of_ended(folder, whole):
    problems = [f"{name} differs from the unbroken run" for name in run_folder.differing_results(folder, whole)]
    for key in ("state_hash", "stages", "cycles"):
        if run_folder.summary(folder)[key] != run_folder.summary(whole)[key]:
            problems.append(f"{key} differs from the unbroken run")
    return problems + run_folder.broken_files(folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("hdem", type=lambda name: Path(name).resolve())
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    moments = random.Random(options.seed)
    problems, kills, runs = [], 0, 0
    with tempfile.TemporaryDirectory() as scratch:
        root = Path(scratch)
        case = run_folder.write_case(root)
        begin = time.monotonic()
        done = run_folder.run(options.hdem, case, "-o", root / "whole", "--set", f"output.row_every={run_folder.ROW_EVERY}")
        seconds = time.monotonic() - begin
        if done.returncode != 0:
            sys.exit(f"the unbroken run failed: {done.stderr}")
        while kills < options.kills or runs == 0:
            folder = root / f"run{runs}"
            killed_here = 0
            while True:
                before = run_folder.checkpoint_cycle(folder)
                enough = kills >= options.kills
                delay = 600.0 if enough else moments.uniform(0.0, 0.25 * seconds)
                begin = time.monotonic()
                if not kill_once(options.hdem, case, folder, delay, moments.choice((1, 2, 3))):
                    if killed_here == 0:    # the machine was busier when the unbroken run was timed
                        seconds = min(seconds, time.monotonic() - begin)
                    break
                kills, killed_here = kills + 1, killed_here + 1
                problems += [f"run {runs}, kill {killed_here}: {text}" for text in problems_of_killed(folder, before)]
            problems += [f"run {runs}: {text}" for text in problems_of_ended(folder, root / "whole")]
            print(f"run {runs}: killed {killed_here} times, state hash {run_folder.summary(folder)['state_hash']}", flush=True)
            runs += 1
    print("\n".join(problems + [f"{kills} kills, {runs} runs, {len(problems)} problems"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
