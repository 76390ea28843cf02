#!/usr/bin/python3
"""`hdem fos` and `hdem critical` as a user runs them: the answer, its files, an interruption, what they refuse.

    fos_test.py HDEM CASES    the program, and the folder of the cases
"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

HDEM, CASES = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve() / "fos"

TOE = """
[material.rock]
density = 2500.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 2.5e9
friction_angle_deg = 32.0
cohesion = 15e3
[contact]
method = "force"
[[block]]
name = "ground"
polygon = [[-12, -12], [29.1377760809, -12], [29.1377760809, 12], [17.1377760809, 12], [0, 0], [-12, 0]]
fixed = true
[[block]]
name = "wedge"
polygon = [[0, 0], [17.1377760809, 12], [5.5956918979, 12]]
[[stage]]
until = "converged"
max_cycles = 60000
[factor_of_safety]
check_stiffness = 1
"""


def hdem(*arguments, code=0):
    done = subprocess.run([HDEM, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == code, (done.returncode, done.stdout, done.stderr)
    return done.stdout + done.stderr


def answer(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))["factor_of_safety"]


class Fos(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="hdem_fos_")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name) / "out"

    def test_says_factor_bound_and_blocks(self):
        text = hdem("fos", CASES / "plane.toml", "-o", self.folder)
        self.assertIn("factor of safety  1.13", text)
        self.assertIn("limit analysis", text)
        found = answer(self.folder)
        self.assertAlmostEqual(found["factor"], 1.1375, delta=0.01)
        self.assertAlmostEqual(found["bound"], 1.1375, delta=0.001)
        self.assertEqual(found["failing_blocks"], ["wedge"])
        self.assertEqual(found["verdict"], "failed")
        self.assertLessEqual(found["failed_at"] - found["stable_at"], 0.0101)
        for arguments in (["plot", self.folder, "--factor"], ["plot", self.folder / "failure"], ["report", self.folder]):
            hdem(*arguments)
        page = (self.folder / "report.html").read_text(encoding="utf-8")
        self.assertIn("Factor of safety", page)
        self.assertIn("Blocks that fail", page)

    def test_warns_of_a_toe_on_the_floor(self):
        # Plane failure at 35 degrees, F = 1.2145. The floor before the slope holds the tip of the wedge, until it slides out on the floor as the foot of a
        # ladder does: F = 3.199 on joints that are 10 and 100 times as stiff.
        case = self.folder.with_name("toe.toml")
        case.write_text(TOE, encoding="utf-8")
        text = hdem("fos", case, "-o", self.folder)
        self.assertIn("rock stands above the bound of limit analysis (1.21", text)
        found = answer(self.folder)
        self.assertAlmostEqual(found["factor"], 3.2, delta=0.03)
        self.assertAlmostEqual(found["bound"], 1.2145, delta=0.001)
        self.assertEqual(sum("bound of limit analysis" in warning for warning in found["warnings"]), 1)

    def test_no_factor_of_what_no_strength_holds(self):
        # A column of 4 m on a base of 1 m turns over at 30 degrees. Where it lies then its factor would be tan 40 / tan 30 = 1.45.
        # Without friction and cohesion a thousand times the strength is none: the slab slides.
        for more, what in ((["block[1].polygon=[[0,0],[1,0],[1,4],[0,4]]"], "slab"),
                           (["joint.default.friction_angle_deg=0"], "slab")):
            text = hdem("fos", CASES / "slab.toml", "-o", self.folder, "--overwrite", *[x for m in more for x in ("--set", m)], code=4)
            self.assertIn("fails at any strength", text)
            self.assertIn(f"these fell again: {what}", text)
            found = answer(self.folder)
            self.assertIsNone(found["factor"])
            self.assertIsNone(found["stable_at"])
            self.assertEqual(found["failing_blocks"], [what])
            self.assertEqual(found["verdict"], "failed")
            self.assertEqual(len(found["warnings"]), 1)
            hdem("report", self.folder)
            hdem("plot", self.folder / "failure")
        # As it lies it has one.
        hdem("fos", CASES / "slab.toml", "-o", self.folder, "--overwrite", "--set", "block[1].polygon=[[0,0],[1,0],[1,4],[0,4]]",
             "--set", 'factor_of_safety.begin="last_state"')
        self.assertAlmostEqual(answer(self.folder)["factor"], 1.4534, delta=0.01)

    def test_goes_on_after_it_was_killed(self):
        whole, broken = self.folder / "whole", self.folder / "broken"
        hdem("fos", CASES / "toppling.toml", "-o", whole, "-q")
        for how in (signal.SIGKILL, signal.SIGTERM):
            run = subprocess.Popen([HDEM, "fos", CASES / "toppling.toml", "-o", broken, "-q"], stderr=subprocess.DEVNULL)
            known = (broken / "trials.json").read_text(encoding="utf-8").count('"at"') if (broken / "trials.json").exists() else 0
            end = time.monotonic() + 60.0
            while time.monotonic() < end and run.poll() is None:
                if (broken / "trials.json").exists() and (broken / "trials.json").read_text(encoding="utf-8").count('"at"') > known:
                    break
                time.sleep(0.005)
            run.send_signal(how)
            run.wait()
        hdem("fos", CASES / "toppling.toml", "-o", broken, "-q")
        self.assertEqual(answer(broken), answer(whole))

    def test_another_case_begins_anew(self):
        hdem("fos", CASES / "plane.toml", "-o", self.folder, "-q", "--set", "factor_of_safety.check_stiffness=1")
        hdem("fos", CASES / "plane.toml", "-o", self.folder, "-q", "--set", "factor_of_safety.check_stiffness=1", "--set", "joint.default.cohesion=0")
        self.assertAlmostEqual(answer(self.folder)["factor"], 0.8345, delta=0.01)
        self.assertEqual(answer(self.folder)["did_not_stand"], ["wedge"])

    def test_refuses_what_it_cannot_read(self):
        for key, why in ((("reduce", '["beding"]'), "no joint has this name"), (("bracket", "[2.0, 1.0]"), "not above its beginning"),
                         (("tolerance", "0"), "tolerance"), (("displacement", '"some"'), "displacement")):
            text = hdem("fos", CASES / "plane.toml", "-o", self.folder, "--set", f"factor_of_safety.{key[0]}={key[1]}", code=2)
            self.assertIn(why, text)

    def test_warns_of_a_displacement_that_rock_reaches_as_it_deforms(self):
        for displacement, is_small in ((1e-6, True), (0.01, False)):
            text = hdem("fos", CASES / "slab.toml", "-o", self.folder, "--overwrite", "--set", "factor_of_safety.check_stiffness=1",
                        "--set", f"factor_of_safety.displacement={displacement}")
            warning = f"factor_of_safety.displacement = {displacement:g} m is less than twice the elastic deformation of the joints of block slab"
            self.assertEqual(warning in text, is_small, text)
            if is_small:
                self.assertRegex(text, r"m before it came to rest, more than 1e-06 m")

    def test_where_nothing_fails_no_picture_of_it_is_offered(self):
        words = ("fos", CASES / "slab.toml", "-o", self.folder, "--set", "factor_of_safety.check_stiffness=1", "--set", "gravity.tilt_deg=30")
        self.assertIn("blocks that fail: hdem plot", hdem(*words))
        self.assertTrue((self.folder / "failure").is_dir())
        text = hdem(*words, "--set", "joint.default.friction_angle_deg=89.9", code=4)
        self.assertIn("nothing fails", text)
        self.assertNotIn("blocks that fail", text)
        self.assertFalse((self.folder / "failure").exists(), "that of the search before")

    def test_small_blocks_that_fall_are_why_rock_stands_above_the_bound(self):
        text = hdem("fos", CASES / "slab.toml", "-o", self.folder, "--set", "factor_of_safety.check_stiffness=1", "--set", "gravity.tilt_deg=30",
                    "--set", "factor_of_safety.least_size=100", code=4)
        self.assertIn("it counts the blocks, smaller than least_size, that fell", text)

    def test_says_that_forces_of_excavated_rock_do_not_act(self):
        case = self.folder.parent / "held.toml"
        case.write_text((CASES / "slab.toml").read_text(encoding="utf-8") + """
[[block]]
name = "stop"
polygon = [[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [-1.0, 1.0]]
fixed = true
[[stage]]
name = "dig"
excavate = ["stop"]
relax_cycles = 500
relax_to = 0.8
until = "converged"
""", encoding="utf-8")
        words = ("fos", case, "-o", self.folder, "--set", "factor_of_safety.check_stiffness=1", "--set", "gravity.tilt_deg=30")
        self.assertIn("forces of excavated rock that are left", hdem(*words))
        self.assertNotIn("forces of excavated rock", hdem(*words, "--set", "stage[1].relax_to=0"))

    def test_refuses_rock_without_a_free_block(self):
        text = hdem("fos", CASES / "slab.toml", "-o", self.folder, "--set", 'stage[0].fix=["slab"]', code=1)
        self.assertIn("no block is free in the last stage", text)

    def test_says_that_all_blocks_have_fallen_before(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        case = self.folder / "falls.toml"
        case.write_text("""schema = 1
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 2e9
shear_stiffness = 1e9
friction_angle_deg = 20.0
[gravity]
tilt_deg = 35.0
[[block]]
name = "base"
polygon = [[-4.0, -1.0], [4.0, -1.0], [4.0, 0.0], [-4.0, 0.0]]
fixed = true
[[block]]
name = "slab"
polygon = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]
[[stage]]
until = "converged"
[[stage]]
set = ["joint.default.friction_angle_deg = 30.0"]
until = "converged"
""", encoding="utf-8")
        text = hdem("fos", case, "-o", self.folder / "out", code=1)
        self.assertIn("all free blocks, as slab, have fallen out of the model", text)

    def test_critical_slope(self):
        text = hdem("critical", CASES / "slab.toml", "--vary", "gravity.tilt_deg=20:60", "--fails", "displacement:slab>0.1", "-o", self.folder)
        self.assertIn("critical gravity.tilt_deg", text)
        found = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        self.assertAlmostEqual(found["critical"], 40.0, delta=0.1)
        again = hdem("critical", CASES / "slab.toml", "--vary", "gravity.tilt_deg=20:60", "--fails", "displacement:slab>0.1", "-o", self.folder)
        self.assertEqual(text, again)

    def test_critical_says_which_runs_were_too_short(self):
        arguments = ("critical", CASES / "slab.toml", "--vary", "gravity.tilt_deg=20:60", "--fails", "displacement:slab>0.1", "-o", self.folder)
        text = hdem(*arguments, "--set", "stage[0].max_cycles=1200")
        found = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        short = [trial["value"] for trial in found["trials"] if not trial["met_ends"]]
        self.assertLess(found["critical"], 40.1, "slow slabs had no time, and are no proof that the slope stands")
        self.assertTrue(short and all(trial["verdict"] == "undecided" and trial["fails"] for trial in found["trials"] if not trial["met_ends"]), found["trials"])
        self.assertIn("warning: a stage that seeks rest ended while a block in question was not at rest", text)
        self.assertIn(f"{short[0]:.6g}", found["warnings"][0])
        self.assertEqual(hdem(*arguments, "--set", "stage[0].max_cycles=1200"), text, "also of trials that are remembered")
        hdem(*arguments)
        self.assertEqual(json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))["warnings"], [])

    def test_critical_says_which_runs_ended_while_a_block_moved(self):
        """A stage may end before the limit is reached: by another end, or by its cycles."""
        arguments = ("critical", CASES / "slab.toml", "--vary", "gravity.tilt_deg=20:60", "-o", self.folder, "--overwrite")
        hdem(*arguments, "--fails", "displacement:slab>0.205", "--set", 'stage[0].until=["converged", "displacement:slab > 0.2"]')
        found = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        self.assertAlmostEqual(found["critical"], 40.0, delta=0.2)
        self.assertIn("a stage that seeks rest ended while a block in question was not at rest", found["warnings"][0])
        case = self.folder.parent / "timed.toml"
        case.write_text((CASES / "slab.toml").read_text(encoding="utf-8").split("[[stage]]")[0] + "[[stage]]\nduration = 0.3\n", encoding="utf-8")
        hdem("critical", case, *arguments[2:], "--fails", "displacement:slab>0.1")
        found = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        self.assertGreater(found["critical"], 41.0, "it slides too slowly")
        self.assertRegex(found["warnings"][0], "the last stage ended while a block in question still moved, and the run counts as one that stands, at gravity.tilt_deg = 4")

    def test_critical_refuses_whole_numbers_before_it_runs(self):
        text = hdem("critical", CASES / "slab.toml", "--vary", "generator.seed=1:2", "--fails", "displacement:slab>0.1", "-o", self.folder, code=2)
        self.assertIn("whole number", text)
        self.assertFalse((self.folder / "trials.json").exists())

    def test_critical_tilt_of_a_column_by_its_rotation(self):
        for tilts, answer_deg in (("0:40", 14.036), ("-40:0", -14.036)):    # arc tan 1/4
            hdem("critical", CASES / "slab.toml", "--set", "block[1].polygon=[[0,0],[1,0],[1,4],[0,4]]", "--set", "joint.default.friction_angle_deg=50",
                 "--vary", f"gravity.tilt_deg={tilts}", "--fails", "rotation:slab>5", "-o", self.folder, "--overwrite", "-q")
            found = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
            self.assertAlmostEqual(found["critical"], answer_deg, delta=0.15)

    def test_critical_friction_fails_at_the_low_end(self):
        hdem("critical", CASES / "slab.toml", "--vary", "joint.default.friction_angle_deg=10:50", "--fails", "displacement:*>0.1", "-o", self.folder, "-q")
        found = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        self.assertAlmostEqual(found["critical"], 30.0, delta=0.1)
        self.assertGreater(found["stands_at"], found["fails_at"])

    def test_critical_sees_a_block_that_a_stage_frees(self):
        hdem("critical", CASES / "slab.toml", "--set", "block[1].fixed=true", "--set", 'stage[0].free=["slab"]', "--vary", "joint.default.friction_angle_deg=10:50",
             "--fails", "displacement:*>0.1", "--tolerance", "2", "-o", self.folder, "-q")
        found = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        self.assertAlmostEqual(found["critical"], 30.0, delta=2.0)

    def test_critical_refuses(self):
        for vary, fails, why in (("gravity.tilt_deg", "displacement:slab>0.1", "KEY=LOW:HIGH"), ("gravity.tilt_deg=9:3", "displacement:slab>0.1", "lower number first"),
                                 ("gravity.tilt_deg=3:9", "speed:slab>0.1", "displacement:BLOCK>METRES"), ("gravity.tilt_deg=3:9", "displacement:slob>0.1", "no block is called"),
                                 ("gravity.tilt_deg=1:5", "displacement:slab>0.1", "begins to fail"), ("gravity.tlt_deg=20:60", "displacement:slab>0.1", "did you mean")):
            self.assertIn(why, hdem("critical", CASES / "slab.toml", "--vary", vary, "--fails", fails, "-o", self.folder, code=2))

    def test_critical_leaves_no_answer_of_a_search_before(self):
        arguments = ("critical", CASES / "slab.toml", "--fails", "displacement:slab>0.1", "--tolerance", 10, "-q", "-o", self.folder / "search")
        hdem(*arguments, "--vary", "gravity.tilt_deg=20:60")
        self.assertTrue((self.folder / "search/summary.json").exists())
        hdem(*arguments, "--vary", "gravity.tilt_deg=1:20", code=2)
        self.assertFalse((self.folder / "search/summary.json").exists())

    def test_critical_leaves_a_run_alone(self):
        hdem("run", CASES / "slab.toml", "-q", "--set", "stage[0].max_cycles=10", "-o", self.folder / "run", code=4)
        before = (self.folder / "run/summary.json").read_bytes(), (self.folder / "run/run.log").read_bytes()
        text = hdem("critical", CASES / "slab.toml", "--vary", "gravity.tilt_deg=20:60", "--fails", "displacement:slab>0.1", "-o", self.folder / "run", code=2)
        self.assertIn("holds a run", text)
        self.assertEqual(before, ((self.folder / "run/summary.json").read_bytes(), (self.folder / "run/run.log").read_bytes()))

    def test_critical_of_a_file_whose_name_is_not_utf8(self):
        self.folder.mkdir()
        case = Path(os.fsdecode(bytes(self.folder) + b"/sl\xffab.toml"))
        case.write_bytes((CASES / "slab.toml").read_bytes())
        hdem("critical", case, "--vary", "gravity.tilt_deg=20:60", "--fails", "displacement:slab>0.1", "--tolerance", 10, "-q", "-o", self.folder / "search")
        self.assertEqual(json.loads((self.folder / "search/summary.json").read_text(encoding="utf-8"))["case"], "sl\ufffdab.toml")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
