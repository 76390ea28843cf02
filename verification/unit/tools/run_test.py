#!/usr/bin/python3
"""What `hdem run` says: notes and warnings at its start, energies and times at its end; on the screen, in run.log and in summary.json.

    run_test.py HDEM    the program
"""
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import small_case

HDEM = Path(sys.argv[1]).resolve()

# A block slides to rest and is pushed, another falls on the ground, a third is removed: no term of the ledger but global damping stays zero.
CASE = 'title = "Energy of a small run"' + small_case.ROCK + """
[time]
step = 1e-4
[contact]
threshold_scale = 1
[[block]]
name = "ground"
polygon = [[-1, -1], [9, -1], [9, 0], [-1, 0]]
fixed = true
[[block]]
name = "sledge"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
velocity = [1, 0]
[[block]]
name = "ball"
polygon = [[4, 0.1], [5, 0.1], [5, 1.1], [4, 1.1]]
[[block]]
name = "prop"
polygon = [[6, 0], [7, 0], [7, 1], [6, 1]]
[[load]]
blocks = ["sledge"]
acceleration = [1, 0]
until_cycle = 1000
[[stage]]
cycles = 2500
[[stage]]
excavate = ["prop"]
cycles = 2500
"""

# Terms of summary.json that this case has, and their signs in the balance; those that are 0 are not in run.log.
TERMS = {"initial": 1, "gravity_work": 1, "load_work": 1, "position_correction": 1, "friction": -1, "local_damping": -1, "impulse_loss": -1,
         "contact_changes": -1, "removed": -1}
NOT_USED = ("insitu", "boundary", "water", "dilation", "bond_breaking", "global_damping", "property_changes")
NUMBER = r"(-?[\d.]+(?:e[-+]\d+)?)"


class TheStart(unittest.TestCase):
    def said(self, *arguments, until="", case=CASE):
        """Standard output and run.log, which are the same, of ten cycles and a second stage."""
        with tempfile.TemporaryDirectory() as folder:
            case = case.replace("cycles = 2500", "cycles = 10", 1).replace("cycles = 2500", until or "cycles = 10")
            (Path(folder) / "small.toml").write_text(case, encoding="utf-8")
            run = subprocess.run([HDEM, "run", "small.toml", "-o", "out", *arguments], cwd=folder, check=False, capture_output=True, text=True)
            self.assertEqual(run.stderr, "")
            self.assertEqual(run.stdout, (Path(folder) / "out/run.log").read_text(encoding="utf-8"))
            return run.stdout

    def test_pages_of_the_run_before_go(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "small.toml").write_text(CASE.replace("cycles = 2500", "cycles = 10"), encoding="utf-8")
            words = [HDEM, "run", "small.toml", "-o", "out", "--quiet"]
            subprocess.run(words, cwd=folder, check=True)
            others = ("view.html", "report.html", "notes.txt")
            for name in others:
                (Path(folder) / "out" / name).write_text("of the first run")
            subprocess.run(words, cwd=folder, check=True)
            self.assertEqual([(Path(folder) / "out" / name).exists() for name in others], [False, False, True])

    def test_blocks_are_written_where_there_is_a_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "small.toml").write_text(CASE, encoding="utf-8")
            done = subprocess.run([HDEM, "check", "small.toml", "--write-blocks", "nowhere/all.wkt"], cwd=folder, check=False, capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn("--write-blocks nowhere/all.wkt: (there is no folder nowhere). Make it", done.stderr)
            self.assertFalse((Path(folder) / "nowhere").exists())

    def test_more_threads_than_processors_are_warned_of_once(self):
        processors = len(os.sched_getaffinity(0))
        said = self.said("--threads", str(processors + 1))
        self.assertEqual(said.count("warning: "), 1, said)
        self.assertRegex(said, rf"(?m)^warning: threads = {processors + 1} \(more than the {processors} processors at hand.* Give --threads {processors}\.$")
        self.assertNotIn("warning: ", self.said("--threads", str(processors)))

    def test_the_threads_adapt_unless_a_number_is_given(self):
        processors = len(os.sched_getaffinity(0))
        for arguments in ((), ("--threads", "auto")):
            said = self.said(*arguments)
            if processors > 1:
                self.assertIn(f"threads   1 to {processors} (auto: as many as are fastest, up to the processors at hand)", said)
            self.assertRegex(said, r"(?m)^threads   cycles: 100 % on 1; chosen 1 from cycle 0; 0 trials of others$", "so few contacts are work for one")
        said = self.said("--threads", "2")
        self.assertIn("threads   2 (--threads)", said)
        self.assertRegex(said, r"(?m)^threads   cycles: 100 % on 1$")

    def test_wrong_words_are_told_in_one_line(self):
        for words, said in (((), "error: hdem: needs a command. There are run, check, "), (("rum",), "error: hdem: rum is no command. There are run, "), (("run",), "error: hdem run: case is required"),
                            (("run", "a.toml", "--metod", "force"), "error: hdem run: The following arguments were not expected: "), (("fos", "--quite"), "error: hdem fos: ")):
            done = subprocess.run([HDEM, *words], check=False, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (2, ""), words)
            self.assertTrue(done.stderr.startswith(said), done.stderr)
            self.assertRegex(done.stderr, r"--help [a-z ]+\.\n\Z")
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_method_does_not_pass_over_that_of_a_stage(self):
        case = CASE.replace('[[stage]]', '[[stage]]\nmethod = "impulse"', 1)
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "small.toml").write_text(case, encoding="utf-8")
            run = [HDEM, "run", "small.toml", "-o", "out", "--method", "force"]
            done = subprocess.run(run, cwd=folder, check=False, capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr, r'--method force: \(stage "[^"]+" has method = "impulse" of its own\)\..* --set stage\.[^.]+\.method=force as well')
            done = subprocess.run([*run, "--set", "stage[0].method=force", "--quiet"], cwd=folder, check=False, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_number_of_threads_is_a_number_or_auto(self):
        for wrong in ("0", "4097", "2.5", "all", "-1", "2x"):
            done = subprocess.run([HDEM, "run", "small.toml", f"--threads={wrong}"], check=False, capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(f"--threads {wrong}: give a whole number from 1 to 4096, or auto", done.stderr)

    def test_stages_where_loose_blocks_take_longer_steps_say_so(self):
        note = r"note: the 0\.0001 s given are kept while a block that has moved less than 0\.02 m in this stage is faster than 0\.\d+ m/s\. Else steps"
        case = CASE.replace(CASE[CASE.index("[[load]]"):CASE.index("[[stage]]")], "")
        until, settings = 'until = "converged"\nmax_cycles = 100', ("--set", "convergence.loose_distance=0.02")
        said = self.said(*settings, until=until, case=case)
        self.assertEqual(said.count("note: "), 1, said)
        self.assertRegex(said, rf'stage "stage2": until converged.*\n{note}.*A stage with duration')
        for preset in ("paper", "dynamic"):
            self.assertNotIn("note: ", self.said(*settings, "--set", f'damping.preset="{preset}"', until=until, case=case))
        self.assertNotIn("note: ", self.said(*settings, case=case))

    def test_stages_that_take_the_stable_step_say_so(self):
        until = 'until = "converged"\nmax_cycles = 100'
        note = r"(?m)^note: no time\.step is given: in this stage a cycle takes 0\.9 \(time\.stable_fraction\) of the largest step that is stable for the blocks that are not at rest\.$"
        load = CASE[CASE.index("[[load]]"):CASE.index("[[stage]]")]
        free = CASE.replace(load, "").replace("step = 1e-4", "fraction = 0.1")
        self.assertRegex(self.said(until=until, case=free), note)
        self.assertNotRegex(self.said(until=until, case=free.replace("fraction = 0.1", "step = 1e-4")), note)
        loaded = CASE.replace("step = 1e-4", "fraction = 0.1")
        self.assertNotRegex(self.said(until=until.replace("100", "2000"), case=loaded), note, "a load ends in this stage")
        self.assertRegex(self.said(until=until, case=loaded), note, "it ends later")
        driven = self.said(until=until, case=free.replace("fixed = true", "fixed = true\nvelocity = [0.1, 0]"))
        self.assertNotIn("note: ", driven, "prescribed motions are those of the clock")


class ManyOfAKind(unittest.TestCase):
    def run_in(self, folder, name, text):
        (Path(folder) / f"{name}.toml").write_text(text, encoding="utf-8")
        done = subprocess.run([HDEM, "run", f"{name}.toml", "-o", name], cwd=folder, check=False, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((Path(folder) / name / "summary.json").read_text(encoding="utf-8"))

    def test_energies_of_results_balance_where_motion_is_prescribed(self):
        """As summary.json does: the energy of a block that is driven is in a column of its own."""
        text = small_case.CASE.replace("[[stage]]", '[[load]]\nblocks = ["ground"]\nvelocity_x = 0.5\nuntil_cycle = 5000\n[[stage]]', 1)
        with tempfile.TemporaryDirectory() as folder:
            summary = self.run_in(folder, "driven", text)
            with h5py.File(Path(folder) / "driven/results.h5") as results:
                last = {name: float(column[-1]) for name, column in results["energy"].items()}
        taken = ("friction", "bond_breaking", "local_damping", "global_damping", "impulse_loss", "contact_changes", "property_changes", "removed",
                 "kinetic_energy", "driven_kinetic", "elastic_normal", "elastic_shear")
        given = ("initial", "insitu", "gravity_work", "load_work", "boundary", "water", "support", "position_correction", "dilation")
        self.assertGreater(last["driven_kinetic"], 1e3)
        self.assertAlmostEqual(last["driven_kinetic"] + last["kinetic_energy"], summary["energy"]["kinetic"], delta=1e-9 * summary["energy"]["kinetic"])
        balance = sum(last[name] for name in given) - sum(last[name] for name in taken)
        self.assertAlmostEqual(balance, last["residual"], delta=1e-6 * last["load_work"])

    def test_stages_of_one_cycle_do_not_each_have_a_frame(self):
        """A frame takes as long as forty cycles of this model, and a stage is to cost no more than a few. From 2000 stages on no copy of them is made for a frame."""
        base = CASE[:CASE.index("[[stage]]")]
        with tempfile.TemporaryDirectory() as folder:
            whole = self.run_in(folder, "whole", base + "[[stage]]\ncycles = 2100\n")
            many = self.run_in(folder, "many", base + "[[stage]]\ncycles = 1\n" * 2100)
            few = self.run_in(folder, "few", base + "[[stage]]\ncycles = 1\n" * 30)
            for told in ("energy", "cycles", "time", "kinetic_energy", "unbalanced_force_ratio"):    # to the bit; the hash knows which stage it is
                self.assertEqual(many[told], whole[told])
            self.assertEqual((len(many["stages"]), len(few["stages"])), (2100, 30))
            frames = {name: len(list((Path(folder) / name / "frames").glob("blocks_*"))) for name in ("whole", "many", "few")}
            self.assertEqual(frames, {"whole": 2, "many": 4, "few": 31})

    def test_blocks_with_very_many_neighbours_have_a_default_step_that_they_bear(self):
        """Eq. (32) of the lightest block is above the stable limit here: no advice in circles."""
        chance = random.Random(1)
        sets = "".join(f"[[joint_set]]\ndip_deg = {chance.uniform(-90, 90):.3f}\nspacing = {chance.uniform(3, 30):.2f}\n" for _ in range(300))
        text = '[domain]\nwidth = 20.0\nheight = 20.0\nfixed = ["left", "right", "bottom"]\n[generator]\nsmallest_block_area = 0.5\n' + small_case.ROCK + sets
        with tempfile.TemporaryDirectory() as folder:
            summary = self.run_in(folder, "sets", text + "[[stage]]\ncycles = 40\n[output]\ncheckpoint_every = 20\n")
            self.assertLess(summary["time_step"], summary["paper_time_step"])
            (Path(folder) / "sets/checkpoint.h5").unlink()    # goes on from the one before
            again = subprocess.run([HDEM, "run", "--restart", "sets"], cwd=folder, check=False, capture_output=True, text=True)
            self.assertEqual(again.returncode, 0, again.stderr)
            repeated = json.loads((Path(folder) / "sets/summary.json").read_text(encoding="utf-8"))
            self.assertEqual((repeated["state_hash"], repeated["time_step"]), (summary["state_hash"], summary["time_step"]))


class TheEnd(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "small.toml").write_text(CASE, encoding="utf-8")
            done = subprocess.run([HDEM, "run", "small.toml", "-o", "out"], cwd=folder, check=True, capture_output=True, text=True)
            cls.screen = done.stdout
            cls.log = (Path(folder) / "out/run.log").read_text(encoding="utf-8")
            cls.summary = json.loads((Path(folder) / "out/summary.json").read_text(encoding="utf-8"))
            cls.energy = cls.summary["energy"]

    def line(self, text):
        lines = [line for line in text.splitlines() if line.startswith("energy [J]:")]
        self.assertEqual(len(lines), 1, text)
        return lines[0]

    def value(self, name):
        found = re.search(rf"[:,>;] {name} {NUMBER}", self.line(self.log))
        self.assertIsNotNone(found, f"{name}: not in \"{self.line(self.log)}\"")
        return float(found.group(1))

    def stored(self):
        return sum(self.energy[name] for name in ("kinetic", "elastic_normal", "elastic_shear"))

    def test_screen_and_log_say_the_same(self):
        self.assertEqual(self.line(self.screen), self.line(self.log))

    def test_every_term_is_there(self):
        for name in TERMS:
            self.assertAlmostEqual(self.value(name.replace("_", " ")), self.energy[name], delta=1e-3 * abs(self.energy[name]), msg=name)
            self.assertNotEqual(self.energy[name], 0.0, f"{name}: the case should use it")
        for name in NOT_USED:
            self.assertEqual(self.energy[name], 0.0, name)
            self.assertNotIn(name.replace("_", " "), self.line(self.log))
        self.assertAlmostEqual(self.value("stored"), self.stored(), delta=1e-3 * self.stored())

    def test_terms_add_up_to_the_residual(self):
        balance = sum(sign * self.energy[name] for name, sign in TERMS.items()) - self.stored()
        self.assertAlmostEqual(balance, self.energy["residual"], delta=1e-9 * self.energy["gravity_work"])
        self.assertAlmostEqual(self.value("residual"), self.energy["residual"], delta=0.06 * abs(self.energy["residual"]))
        self.assertLess(abs(self.energy["relative_residual"]), 1e-4)

    def test_the_table_of_times_has_every_stage(self):
        timing = self.summary["timing"]
        self.assertEqual(list(timing), ["broad", "narrow", "force", "impulse", "update", "wait", "unused", "output", "other"])
        for name, row in timing.items():
            self.assertTrue(0.0 <= row["min"] <= row["mean"] <= row["max"], name)
            self.assertRegex(self.log, rf"(?m)^{name} +{row['min']:.3f} +{row['mean']:.3f} +{row['max']:.3f} +{100 * row['share']:.1f} %$")
        self.assertAlmostEqual(sum(row["share"] for row in timing.values()), 1.0, places=9)
        self.assertGreater(timing["force"]["mean"], 0.0)
        self.assertGreater(timing["output"]["mean"], 0.0)


# A lining below a roof that does not move, longer than the roof by a metre.
LINING = small_case.ROCK + """
[[block]]
name = "roof"
polygon = [[-1, 0], [1, 0], [1, 1], [-1, 1]]
fixed = true
[[block]]
name = "stand"
polygon = [[3, 0], [5, 0], [5, 1], [3, 1]]
fixed = true
[[block]]
name = "stone"
polygon = [[3.5, 1], [4.5, 1], [4.5, 2], [3.5, 2]]
[[liner]]
name = "coat"
path = [[2, 0], [-1, 0]]
thickness = 0.05
modulus = 1e9
normal_stiffness = 1e8
%s
[[stage]]
name = "hang"
until = "converged"
max_cycles = 8000
"""


SLIDING = """
[material.rock]
density = 2700
[joint.default]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 0
[gravity]
vector = [%g, -9.0]
[[block]]
name = "ground"
polygon = [[-90, -1], [90, -1], [90, 0], [-90, 0]]
fixed = true
[[block]]
name = "slow"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
velocity = [0.1, 0]
[[block]]
name = "fast"
polygon = [[5, 0], [6, 0], [6, 1], [5, 1]]
velocity = [1, 0]
[[stage]]
until = "converged"
max_cycles = 1000
"""


class NotAtRest(unittest.TestCase):
    def test_the_fastest_block_is_named_first(self):
        with tempfile.TemporaryDirectory() as folder:
            case = Path(folder) / "case.toml"
            case.write_text(SLIDING % 1.0)
            run = subprocess.run([HDEM, "run", case, "-o", folder + "/run"], capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 4, run.stderr)
            self.assertIn("2 blocks, the fastest first: fast, slow", run.stdout)


class Linings(unittest.TestCase):
    def warnings(self, keys):
        with tempfile.TemporaryDirectory() as folder:
            case, out = Path(folder) / "case.toml", Path(folder) / "run"
            case.write_text(LINING % keys)
            run = subprocess.run([HDEM, "run", case, "-o", out], capture_output=True, text=True, check=False)
            self.assertIn(run.returncode, (0, 4), run.stderr)
            return json.loads((out / "summary.json").read_text())["warnings"], run.stdout + (out / "run.log").read_text()

    def test_one_that_bears_is_not_warned_of(self):
        self.assertEqual(self.warnings("bond_strength = 1e6")[0], [])

    def test_one_that_falls_is_in_the_summary(self):
        warnings, _ = self.warnings("bond_strength = 0.0")
        self.assertIn('liner "coat" has come off the rock', warnings[0])

    def test_one_that_collapses_is_in_the_summary_and_not_at_rest(self):
        warnings, said = self.warnings("bond_strength = 1e6\nmoment_strength = 100.0")
        self.assertIn('liner "coat" is not at rest', warnings[0])
        self.assertIn('not at rest at the end of stage "hang": liner "coat"', said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
