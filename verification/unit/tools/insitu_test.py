#!/usr/bin/python3
"""A run whose stress is not in equilibrium, or beyond what its joints are ready for, says so; one that is in order says nothing.

    insitu_test.py HDEM    the program
"""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HDEM = Path(sys.argv[1]).resolve()
CASE = """
[[block]]
name = "ground"
polygon = [[-1, -1], [2, -1], [2, 0], [-1, 0]]
fixed = true
[[block]]
name = "top"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 30.0
[[stage]]
cycles = 10
[insitu]
"""


def said(keys, command):
    with tempfile.TemporaryDirectory(prefix="hdem_insitu_") as folder:
        case = Path(folder) / "case.toml"
        case.write_text(CASE + keys, encoding="utf-8")
        more = ["-o", Path(folder) / "out"] if command == "run" else []
        done = subprocess.run([HDEM, command, case, *more], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout


class Insitu(unittest.TestCase):
    def test_tells_of_stress_out_of_balance(self):
        for command in ("check", "run"):
            text = said("stress = [0.0, -1e3, 2e3]\n", command)
            self.assertIn("not in equilibrium with gravity", text)
            self.assertIn("block top is out of balance", text)
            self.assertIn("bear more shear than their strength", text)

    def test_summary_has_the_warnings_of_the_start_after_a_restart_too(self):
        with tempfile.TemporaryDirectory(prefix="hdem_insitu_") as folder:
            case, out = Path(folder, "case.toml"), Path(folder, "out")
            case.write_text(CASE.replace("[insitu]", "[output]\ncheckpoint_every = 5\n[insitu]") + "stress = [0.0, -1e3, 2e3]\n", encoding="utf-8")
            warnings = []
            for options in ([], ["--restart", out / "checkpoint.previous.h5", "--overwrite"]):
                subprocess.run([HDEM, "run", *([] if options else [case]), *options, "-o", out, "--quiet"], check=True)
                warnings.append(json.loads((out / "summary.json").read_text(encoding="utf-8"))["warnings"])
            self.assertEqual(len([w for w in warnings[0] if w.startswith("[insitu]: ")]), 3, warnings[0])
            self.assertEqual(warnings[0], warnings[1])

    def test_says_nothing_of_rock_in_balance(self):
        for command in ("check", "run"):
            self.assertNotIn("warning: [insitu]", said("surface = 1.0\nratio = 0.5\n", command))

    def test_tells_of_joints_above_the_stress_they_are_ready_for(self):
        curved = "surface = 1.0\nratio = 0.5\n[joint.j]\nmaterials = ['rock', 'rock']\nnormal_stiffness = 7e9\nshear_stiffness = 5e8\nfriction_angle_deg = 30\ngreatest_closure = 1e-3\n"
        self.assertIn('warning: joint "j" bears up to', said(curved + "normal_stress = 1e4\n", "run"))
        self.assertNotIn("warning: joint", said(curved, "run"))
        with tempfile.TemporaryDirectory(prefix="hdem_insitu_") as folder:
            case = Path(folder, "case.toml")
            case.write_text(CASE + curved + "normal_stress = 1e4\n", encoding="utf-8")
            subprocess.run([HDEM, "run", case, "-o", folder + "/out", "--quiet"], check=True)
            warnings = json.loads(Path(folder, "out", "summary.json").read_text(encoding="utf-8"))["warnings"]
            self.assertTrue([w for w in warnings if w.startswith('joint "j" bears up to')], warnings)

    def test_tells_of_a_static_solution_that_joints_do_not_allow(self):
        joint = "surface = 1.0\nratio = 0.5\n[joint.j]\nnormal_stiffness = 7e9\nshear_stiffness = 5e8\nfriction_angle_deg = 30\n"
        stage = "[[stage]]\nuntil = 'converged'\nsolver = 'static'\nmax_cycles = 10\n"
        self.assertIn('joint "j" has a memory', said(joint + "residual_cohesion = 0\n" + stage, "check"))
        self.assertNotIn("has a memory", said(joint + stage, "check"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
