#!/usr/bin/python3
"""Kills runs at each call to the system that changes files, one after another: no moment is left to chance.

    kill_at_calls.py HDEM [--calls rename,unlink]    HDEM: the program; needs strace

A small run is killed as it enters its first, second, third ... call of each kind, in three situations: in a new folder, with --overwrite over a run
that was over, and restarted. Afterwards all files must be whole, summary.json may only be there with the results that it tells of, and the run that
goes on, or begins anew, must end as one that nobody killed, to the last bit. Exit code 1 if anything was wrong, 77 without h5py or strace.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import run_folder
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

CALLS = ("write", "pwrite64", "ftruncate", "fsync", "syncfs", "link", "rename", "unlink", "mkdir", "rmdir", "flock")
CASE = run_folder.CASE.replace("cycles = 800", "cycles = 60").replace("cycles = 2200", "cycles = 100").replace("row_every = 500", "row_every = 20") \
    .replace("frame_every = 1000", "frame_every = 50").replace("checkpoint_every = 200", "checkpoint_every = 40").replace("every = 70", "every = 7")


class Situation:
    """A folder as `prepare` leaves it, and how a run is started there."""

    def __init__(self, name, before, arguments):
        self.name, self.before, self.arguments = name, before, arguments


def situations(hdem, case, root):
    over, short = root / "over", root / "short"
    run_folder.run(hdem, case, "-o", over, "--threads", "1")
    strace = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", "trace=link", "-e", "inject=link:signal=KILL:when=3"]
    subprocess.run([*strace, hdem, "run", case, "-o", short, "--threads", "1", "--quiet"], check=False)
    if run_folder.checkpoint_cycle(short) < 0:
        sys.exit("the run to restart has no checkpoint")
    return (Situation("in a new folder", None, [case, "-o", root / "run"]),
            Situation("with --overwrite over a run that was over", over, [case, "-o", root / "run", "--overwrite"]),
            Situation("restarted", short, ["--restart", root / "run"]))


class Killing:
    """One situation, call and number of the call."""

    def __init__(self, hdem, case, root):
        self.hdem, self.case, self.folder, self.whole = hdem, case, root / "run", root / "whole"

    def kill(self, situation, call, number):
        """False when the run came to its end before that call."""
        shutil.rmtree(self.folder, ignore_errors=True)
        if situation.before is not None:
            shutil.copytree(situation.before, self.folder)
        strace = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={call}", "-e", f"inject={call}:signal=KILL:when={number}"]
        ended = subprocess.run([*strace, self.hdem, "run", *map(str, situation.arguments), "--threads", "1", "--quiet"],
                               capture_output=True, text=True, check=False)
        if ended.returncode not in (0, -9, 137):
            raise RuntimeError(f"{situation.name}, {call} {number}: exit code {ended.returncode}: {ended.stderr}")
        return ended.returncode != 0

    def problems(self):
        """Of what the kill left, and of the run that follows."""
        if not self.folder.exists():
            return []
        found = run_folder.broken_files(self.folder)
        if (self.folder / "summary.json").exists():
            found += [f"summary.json is there without {name}" for name in ("results.h5", "run.log", "checkpoint.h5", "frames/blocks_000000.hdf")
                      if not (self.folder / name).exists()]
        source = ["--restart", self.folder] if run_folder.checkpoint_cycle(self.folder) >= 0 else [self.case, "-o", self.folder]
        done = run_folder.run(self.hdem, *source, "--quiet", "--threads", "1")
        if done.returncode != 0:
            return [*found, f"the next run: exit code {done.returncode}: {done.stderr.strip()}"]
        found += [f"at the end, {name} differs" for name in run_folder.differing_results(self.folder, self.whole)]
        found += [f"at the end, summary.json: {name} differs" for name in run_folder.differing_summary(self.folder, self.whole)]
        left = list(self.folder.rglob("*.tmp")) + list(self.folder.rglob(".lock"))
        return found + [f"at the end, {file.name} is left" for file in left] + run_folder.broken_files(self.folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("hdem", type=lambda name: Path(name).resolve())
    parser.add_argument("--calls", type=lambda text: text.split(","), default=CALLS)
    options = parser.parse_args()
    if shutil.which("strace") is None or subprocess.run(["strace", "-qq", "-o", "/dev/null", "true"], check=False).returncode != 0:
        print("skipped: strace is not there, or may not trace")
        return 77
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    kills, wrong = 0, 0
    with tempfile.TemporaryDirectory() as scratch:
        root = Path(scratch)
        case = root / "case.toml"
        case.write_text(CASE, encoding="utf-8")
        done = run_folder.run(options.hdem, case, "-o", root / "whole", "--threads", "1")
        if done.returncode != 0:
            sys.exit(f"the unbroken run failed: {done.stderr}")
        killing = Killing(options.hdem, case, root)
        for situation in situations(options.hdem, case, root):
            for call in options.calls:
                number = 1
                while killing.kill(situation, call, number):
                    found = killing.problems()
                    for text in found:
                        print(f"{situation.name}, killed at {call} {number}: {text}", flush=True)
                    wrong, number = wrong + bool(found), number + 1
                print(f"{situation.name}: {number - 1} kills at {call}", flush=True)
                kills += number - 1
    print(f"{kills} kills, {wrong} left something wrong")
    return 1 if wrong or kills == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
