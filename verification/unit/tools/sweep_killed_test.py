#!/usr/bin/python3
"""A sweep that is killed and goes on.

    sweep_killed_test.py HDEM TOOLS                the program, and the folder of its scripts
    sweep_killed_test.py HDEM TOOLS --runs 200     with so many runs of a tunnel; a minute on one processor
"""
import csv
import os
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from sweep_scratch import HDEM, TOOLS, Scratch

RUNS = int(sys.argv[4]) if sys.argv[3:4] == ["--runs"] else 24
TUNNEL = TOOLS / "guide/cases/first_tunnel.toml"


def wait_until(condition, seconds=600.0):    # under sanitizers a run takes minutes
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError("waited in vain")
        time.sleep(0.005)


def listens(process):
    """Has the worker set its own handlers? Runs that a killed worker left behind may be done before the next worker has begun: a signal would end it by the default action."""
    caught = next(line.split()[1] for line in Path(f"/proc/{process.pid}/status").read_text(encoding="ascii").splitlines() if line.startswith("SigCgt:"))
    return int(caught, 16) >> (signal.SIGTERM - 1) & 1    # set after the one for SIGINT


class Killed(Scratch):
    """Runs of a tunnel: the sweep is ended twice by a signal and twice by a kill, and goes on with the same line."""

    KEYS = ("--design", "latin", "--runs", RUNS, "--vary", "generator.seed=whole:1:9999", "--vary", "joint.default.friction_angle_deg=normal:25:5")
    FOR_HDEM = ("--", "--quiet", "--threads", "1", "--set", "output.checkpoint_every=3000")

    def words(self, folder):
        return [TOOLS / "sweep", "work", folder, "--jobs", "2", "--program", HDEM, *self.FOR_HDEM]

    def done(self):
        return len(list((self.folder / "broken").glob("run_*/summary.json")))

    def table(self, folder):
        self.sweep("collect", folder, "--fails", "detached_blocks>0")
        with open(self.folder / folder / "table.csv", encoding="utf-8") as file:
            return [(row["run"], row["generator.seed"], row["joint.default.friction_angle_deg"], row["detached_blocks"], row["state_hash"]) for row in csv.DictReader(file)]

    def test_goes_on_with_the_same_line_to_the_same_states(self):
        for folder in ("whole", "broken"):
            self.sweep("plan", TUNNEL, "-o", folder, *self.KEYS)
        end = subprocess.run(self.words("whole"), cwd=self.folder, check=False, capture_output=True).returncode
        self.assertIn(end, (0, 4), "4: one of these tunnels is not at rest in time")
        ended = 0
        for share, how in ((0.1, signal.SIGTERM), (0.25, signal.SIGKILL), (0.4, signal.SIGINT), (0.55, signal.SIGKILL)):
            worker = subprocess.Popen(self.words("broken"), cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                      preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))    # a shell ignores it for what runs beside it
            wait_until(lambda: worker.poll() is not None or (listens(worker) and self.done() >= share * RUNS))
            if self.done() == RUNS:    # beside other work this test may come too late
                worker.communicate()
                break
            worker.send_signal(how)
            worker.communicate()
            self.assertEqual(worker.returncode, -9 if how is signal.SIGKILL else 128 + how)
            ended += 1
        self.assertGreater(ended, 0, "one signal at least came before the end")
        time.sleep(1.0)    # what the killed worker has left behind comes to its end
        self.assertEqual(subprocess.run(self.words("broken"), cwd=self.folder, check=False, capture_output=True).returncode, end)
        whole, broken = self.table("whole"), self.table("broken")
        self.assertEqual(broken, whole)
        self.assertEqual(len({row[-1] for row in whole}), RUNS, "each run is another one")
        print((self.folder / "whole/fails.csv").read_text(encoding="utf-8"))


class Slurm(Scratch):
    def test_task_is_queued_again_after_its_signal(self):
        bin_folder = self.folder / "bin"
        bin_folder.mkdir()
        (bin_folder / "scontrol").write_text(f'#!/bin/bash\necho "$@" >> "{self.folder}/requeued"\n')
        (bin_folder / "scontrol").chmod(0o755)
        slow = self.folder / "slow"
        slow.write_text('#!/bin/bash\ntrap \'kill $!; exit 143\' TERM\necho begun >> begun\nsleep 30 & wait $!\n')
        slow.chmod(0o755)
        self.plan("--vary", "x=1:6")
        variables = os.environ | {"PATH": f"{bin_folder}:{os.environ['PATH']}", "HDEM_SOURCE": str(TOOLS.parent), "SLURM_CPUS_PER_TASK": "2", "SLURM_JOB_ID": "77", "HDEM": str(slow)}
        for more, name in (({}, "requeue 77"), ({"SLURM_ARRAY_JOB_ID": "70", "SLURM_ARRAY_TASK_ID": "3"}, "requeue 70_3")):
            (self.folder / "begun").unlink(missing_ok=True)
            task = subprocess.Popen(["bash", TOOLS / "sweep_many.slurm", "s"], cwd=self.folder, env=variables | more, stdout=subprocess.DEVNULL)
            wait_until(lambda: (self.folder / "begun").exists() and len((self.folder / "begun").read_text().split()) == 2)
            task.send_signal(signal.SIGTERM)
            self.assertEqual(task.wait(30), 143)
            self.assertEqual((self.folder / "requeued").read_text().splitlines()[-1], name)
        done = subprocess.run(["bash", TOOLS / "sweep_many.slurm", "s"], cwd=self.folder, env=variables | {"HDEM": str(self.program)}, check=False, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("6 runs: 6 done", done.stdout)
        self.assertEqual(len((self.folder / "requeued").read_text().splitlines()), 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
