#!/usr/bin/python3
"""The program tells how stages ended, in its closing lines, summary.json and exit code; water is drawn where there is some.

    stage_ends_test.py HDEM    the program
"""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HDEM = Path(sys.argv[1]).resolve()
ROCK = """
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e8
shear_stiffness = 5e8
friction_angle_deg = 30.0
"""
CASE = """
[[block]]
name = "ground"
polygon = [[-1, -1], [9, -1], [9, 0], [-1, 0]]
fixed = true
[[block]]
name = "top"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
""" + ROCK
SQUEEZED = """
[domain]
width = 4.0
height = 4.0
fixed = ["bottom"]
[[joint_set]]
name = "steep"
dip_deg = 100.0
spacing = 1.0
[[joint_set]]
name = "flat"
dip_deg = 30.0
spacing = 1.0
[[boundary]]
side = "left"
kind = "roller"
[[boundary]]
side = "right"
kind = "roller"
""" + ROCK


class StageEnds(unittest.TestCase):
    def run_case(self, more, code=0, case_text=CASE):
        with tempfile.TemporaryDirectory(prefix="hdem_stage_ends_") as folder:
            case = Path(folder) / "case.toml"
            case.write_text(case_text + more, encoding="utf-8")
            done = subprocess.run([HDEM, "run", case, "-o", Path(folder) / "out"], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, code, done.stderr + done.stdout)
            return done.stdout, json.loads((Path(folder) / "out/summary.json").read_text(encoding="utf-8"))

    def test_the_end_that_was_met_is_named(self):
        text, summary = self.run_case('[[load]]\nblocks = ["top"]\nforce = [1e5, 0]\nramp_cycles = [0, 100000]\n'
                                      '[[stage]]\nuntil = ["displacement:top > 0.01", "time > 50"]\n')
        stage = summary["stages"][0]
        self.assertEqual(stage["ended_by"], "displacement:top > 0.01")
        self.assertGreaterEqual(stage["end_value"], 0.01)
        self.assertEqual(stage["to_come"], ["load \"load1\" changes until cycle 100000"])
        self.assertIn("displacement:top > 0.01 (0.0", text)
        self.assertIn("load \"load1\" changes until cycle 100000", " ".join(summary["warnings"]))

    def test_an_end_that_is_not_met_is_told(self):
        text, summary = self.run_case('[[stage]]\nuntil = "time > 1e6"\nmax_cycles = 50\n', code=4)
        self.assertIn("NOT at its ends", text)
        self.assertIn("none of its ends was met", text)
        self.assertEqual(summary["stages"][0]["ended_by"], "max_cycles")

    def test_a_stage_that_ends_by_motion_has_not_converged(self):
        """The exit code is 0 all the same: it met an end that it asked for."""
        push = '[[load]]\nblocks = ["top"]\nforce = [1e5, 0]\n'
        _, summary = self.run_case(push + '[[stage]]\nuntil = ["converged", "displacement:top > 0.05"]\n')
        self.assertEqual((summary["converged"], summary["met_ends"], summary["stages"][0]["converged"]), (False, True, False))
        _, summary = self.run_case('[[stage]]\nuntil = ["converged", "displacement:top > 0.05"]\n')
        self.assertEqual((summary["converged"], summary["met_ends"]), (True, True))
        _, summary = self.run_case(push + '[[stage]]\nuntil = "converged"\nmax_cycles = 50\n', code=4)
        self.assertEqual((summary["converged"], summary["met_ends"]), (False, False))

    def test_rest_is_an_end_where_nothing_can_happen(self):
        text, summary = self.run_case('[[stage]]\nuntil = "displacement:top > 0.5"\n')
        self.assertEqual(summary["stages"][0]["ended_by"], "at rest")
        self.assertIn("nothing more can happen", text)

    def test_local_damping_of_what_is_carried_is_told(self):
        """It opposes velocities against a body that holds all, or absolute ones where a second held block does not move along."""
        lift = '[[load]]\nblocks = ["ground"]\nvelocity_y = 0.05\n[[stage]]\nduration = 1.0\n'
        far = '[[block]]\nname = "far"\npolygon = [[20, 0], [21, 0], [21, 1], [20, 1]]\nfixed = true\n'
        for more, told in ((far + lift, True), (lift, False), (far + '[damping]\npreset = "dynamic"\n' + lift, False), (far + "[[stage]]\ncycles = 500\n", False)):
            _, summary = self.run_case(more)
            self.assertEqual(any("local damping took" in warning for warning in summary["warnings"]), told, more)

    def test_a_servo_may_be_damped(self):
        """Its wall stops once it presses with its target: what damping took is in no force."""
        for kind, told in (('"servo"\ntarget = 1e6\nmax_velocity = 0.05', False), ('"velocity"\nvelocity = [0, -0.05]', True)):
            _, summary = self.run_case(f'[[boundary]]\nside = "top"\nkind = {kind}\n[[stage]]\ncycles = 1000\n', case_text=SQUEEZED)
            self.assertGreater(summary["energy"]["local_damping"], 10.0)
            self.assertEqual(any("local damping took" in warning for warning in summary["warnings"]), told, kind)

    def test_the_last_line_says_converged_only_of_a_last_stage_that_is_at_rest(self):
        text, _ = self.run_case('[[stage]]\nuntil = "converged"\n')
        self.assertIn("\nconverged after", text)
        text, _ = self.run_case('[[stage]]\nuntil = "converged"\n[[stage]]\ncycles = 10\n')
        self.assertIn("\ndone after", text)

    def test_stages_of_cycles_that_are_too_short_for_a_ramp_are_told(self):
        text, summary = self.run_case('[[load]]\nblocks = ["top"]\nforce = [1, 0]\nramp_cycles = [0, 80]\n[[stage]]\ncycles = 50\n')
        self.assertEqual(summary["stages"][0]["ended_by"], "cycles")
        self.assertIn("the run ended in cycle 50, but load \"load1\" changes until cycle 80", text)

    def test_water_is_drawn(self):
        with tempfile.TemporaryDirectory(prefix="hdem_water_") as folder:
            case, out = Path(folder) / "case.toml", Path(folder) / "out"
            for water, has in (("[water]\nlevel = 0.5\n", True), ("", False)):
                case.write_text(CASE + water + "[[stage]]\ncycles = 100\n", encoding="utf-8")
                subprocess.run([HDEM, "run", case, "-o", out, "--overwrite"], capture_output=True, check=True)
                for more in ([], ["--joints", "pore_pressure", "--numbers"]):
                    done = subprocess.run([HDEM, "plot", out, "-o", out / "p.svg", *more], capture_output=True, text=True, check=False)
                    self.assertEqual(done.returncode == 0, has or not more, done.stderr)
                    if done.returncode == 0:
                        picture = (out / "p.svg").read_text(encoding="utf-8")
                        self.assertEqual("water table" in picture, has)
                        self.assertEqual(">4.9" in picture, bool(more))    # kPa at the foot: 1000 kg/m3, 9.81 m/s2, 0.5 m
                    else:
                        self.assertIn("Only cases with [water] do", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
