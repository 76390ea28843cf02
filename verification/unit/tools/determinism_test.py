#!/usr/bin/python3
"""The state of a run does not depend on the number of threads, nor on what is written while it goes on.

    determinism_test.py HDEM CASES    the program, and verification/cases
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HDEM = Path(sys.argv[1]).resolve()
TUNNEL = Path(sys.argv[2]).resolve() / "paper_tunnel" / "tunnel.toml"
MAPPED = Path(sys.argv[2]).resolve() / "rockmass" / "mapped.toml"
FALL = 20000  # cycles after the excavation, while blocks fall


def summary(*arguments):
    """summary.json of the tunnel, excavated, with blocks on their way down."""
    with tempfile.TemporaryDirectory(prefix="hdem_determinism_") as folder:
        done = subprocess.run([HDEM, "run", TUNNEL, "-o", folder, "--quiet", "--set", f"stage[1].max_cycles={FALL}", *arguments],
                              capture_output=True, text=True, check=False)
        assert done.returncode == 4, done.stderr  # not converged yet
        return json.loads((Path(folder) / "summary.json").read_text(encoding="utf-8"))


SHORT_STAGES = """
[domain]
width = 16.0
height = 16.0
fixed = ["left", "right", "bottom"]
[[joint_set]]
dip_deg = 10.0
spacing = 0.8
deviation_deg = 2.0
[[joint_set]]
dip_deg = -80.0
spacing = 0.8
deviation_deg = 2.0
[[excavation]]
name = "tunnel"
shape = "circle"
position = [8.0, 8.0]
diameter = 5.0
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 30.0
[contact]
method = "force"
[generator]
smallest_block_area = 0.032
smallest_edge = 0.04
[[stage]]
until = "converged"
max_cycles = 300
[[stage]]
excavate = ["tunnel"]
until = "converged"
max_cycles = 400
""" + 20 * """
[[stage]]
until = "converged"
max_cycles = 100
[[stage]]
cycles = 10
"""


def short_stages(threads):
    """summary.json of a run whose stages begin with another step than the one before ended with."""
    with tempfile.TemporaryDirectory(prefix="hdem_determinism_") as folder:
        case = Path(folder) / "case.toml"
        case.write_text(SHORT_STAGES, encoding="utf-8")
        done = subprocess.run([HDEM, "run", case, "-o", Path(folder) / "out", "--quiet", "--threads", threads],
                              env=os.environ | {"OMP_WAIT_POLICY": "passive"}, capture_output=True, text=True, check=False)
        assert done.returncode == 4, done.stderr  # not converged in so few cycles
        return json.loads((Path(folder) / "out" / "summary.json").read_text(encoding="utf-8"))


class Determinism(unittest.TestCase):
    def expect_same(self, method, thread_counts):
        one = summary("--method", method, "--threads", "1")
        self.assertGreater(len(one["detached_blocks"]), 0)
        for threads in thread_counts:
            many = summary("--method", method, "--threads", threads)
            self.assertEqual(many["state_hash"], one["state_hash"], f"{threads} threads")
            self.assertEqual(many["energy"], one["energy"], f"{threads} threads")
        changing = summary("--method", method)
        self.assertEqual(changing["state_hash"], one["state_hash"], "as many threads as are fastest")
        if len(os.sched_getaffinity(0)) > 1:
            self.assertEqual(changing["thread_use"]["rule"], "auto")
            self.assertGreater(changing["thread_use"]["trials"], 0)
        written = summary("--method", method, "--threads", "2", "--set", "output.frame_every=500", "--set", "output.row_every=70")
        self.assertEqual(written["state_hash"], one["state_hash"], "with frames and rows")

    def test_force_based(self):
        self.expect_same("force", "3")

    def test_hybrid(self):
        self.expect_same("hybrid", "2348")

    def test_rock_that_is_drawn(self):
        with tempfile.TemporaryDirectory(prefix="hdem_determinism_") as folder:
            def run(name, *arguments):
                done = subprocess.run([HDEM, "run", *arguments, "-o", Path(folder) / name, "--quiet"],
                                      env=os.environ | {"OMP_WAIT_POLICY": "passive"}, capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                return json.loads((Path(folder) / name / "summary.json").read_text(encoding="utf-8"))

            one = run("1", MAPPED, "--threads", "1", "--set", "output.checkpoint_every=150")
            self.assertGreater(one["joint_sets"][1]["dead_ends_share"], 0.0)
            self.assertGreater(one["blocks"], 300)
            for threads in "23":
                self.assertEqual(run(threads, MAPPED, "--threads", threads)["state_hash"], one["state_hash"], f"{threads} threads")
            again = run("again", "--restart", Path(folder) / "1" / "checkpoint.previous.h5")
            self.assertEqual(again["state_hash"], one["state_hash"], "from a checkpoint, where the rock is drawn once more")
            other = run("other", MAPPED, "--set", "generator.seed=6")
            self.assertNotEqual(other["state_hash"], one["state_hash"])

    def test_where_stages_change_the_step(self):
        one = short_stages("1")
        for threads in "33322":
            many = short_stages(threads)
            self.assertEqual(many["state_hash"], one["state_hash"], f"{threads} threads")
            self.assertEqual(many["energy"], one["energy"], f"{threads} threads")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
