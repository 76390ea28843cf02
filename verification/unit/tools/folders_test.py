#!/usr/bin/python3
"""Folders that hold something already: no run takes or loses what is another one's.

    folders_test.py HDEM CASES    the program, and the folder of the cases
"""
import json
import os
import re
import subprocess
import sys
import unittest

from folder_scratch import CASES, FINISHED, HDEM, OUT_OF_TIME, REFUSED, SLAB, FolderTest, content

# The last stage begins with what the first, whose length varies, leaves: one block slides away in it.
SLIDES_FIRST = """
[material.rock]
density = 2700.0
[material.wall]
density = 2700.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 1e9
friction_angle_deg = 40.0
[joint.key]
normal_stiffness = 1e10
shear_stiffness = 1e9
friction_angle_deg = 40.0
materials = ["wall", "rock"]
[gravity]
tilt_deg = 30.0
[contact]
method = "force"
[[block]]
name = "ground"
polygon = [[-60.0, -1.0], [6.0, -1.0], [6.0, 0.0], [-60.0, 0.0]]
fixed = true
[[block]]
name = "slab"
polygon = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [0.0, 1.0]]
material = "wall"
[[block]]
name = "stop"
polygon = [[-2.0, 0.0], [-1.0, 0.0], [-1.0, 1.0], [-2.0, 1.0]]
fixed = true
material = "wall"
[[block]]
name = "other"
polygon = [[-5.0, 0.0], [-4.0, 0.0], [-4.0, 1.0], [-5.0, 1.0]]
[[stage]]
name = "first"
set = ["joint.default.friction_angle_deg = 5", "joint.key.friction_angle_deg = 5"]
cycles = 200
[[stage]]
name = "stand"
set = ["joint.default.friction_angle_deg = 25", "joint.key.friction_angle_deg = 20"]
until = ["converged", "displacement > 0.02"]
max_cycles = 100000
"""


class Folders(FolderTest):
    def test_fos_begins_its_last_stage_with_its_own_run(self):
        case, longer = self.write("slides.toml", SLIDES_FIRST), ["--set", "stage[0].cycles=8000"]
        self.hdem("fos", case, "-o", self.folder, "-q")
        self.hdem("run", case, "-o", self.folder, "-q", *longer)
        self.assertFalse((self.folder / "before_last_stage").exists())
        self.assertIn("before_last_stage", self.hdem("fos", case, "-o", self.folder, "-q", *longer, code=REFUSED))
        self.hdem("fos", case, "-o", self.root / "short", "-q")
        (self.root / "short/before_last_stage").rename(self.folder / "before_last_stage")
        self.assertIn("is not of this run", self.hdem("fos", case, "-o", self.folder, "-q", *longer, code=REFUSED))

    def test_a_refused_search_leaves_the_trials(self):
        self.hdem("fos", CASES / "fos/slab.toml", "-o", self.folder, "-q")
        self.expect_untouched("stable limit", "fos", CASES / "fos/slab.toml", "-o", self.folder, "-q", "--set", "time.step=100")

    def test_a_search_cut_short_is_replaced_only_with_overwrite(self):
        slab = CASES / "fos/slab.toml"
        self.hdem("fos", slab, "-o", self.folder, "-q")
        summary = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        del summary["factor_of_safety"]
        (self.folder / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
        self.expect_untouched("cut short", "fos", slab, "-o", self.folder, "-q", "--set", "joint.default.cohesion=1e5")
        self.expect_untouched("cut short", "run", self.case, "-o", self.folder, "-q")
        self.run_case("--overwrite")
        self.assertFalse((self.folder / "trials.json").exists())

    def test_the_last_value_given_counts_in_a_restart(self):
        long = "stage[1].cycles=1000000"
        self.run_case("--set", "stage[1].cycles=900000", "--max-wall", "0.05s", code=OUT_OF_TIME)
        self.hdem("run", "--restart", self.folder, "-q", "--set", long, "--max-wall", "0.05s", code=OUT_OF_TIME)
        self.hdem("run", "--restart", self.folder, "-q", "--set", "output.row_every=1000", "--set", "stage[1].cycles=900000", "--max-wall", "0.05s",
                  code=OUT_OF_TIME)
        said = self.hdem("info", self.folder / "checkpoint.h5")
        self.assertLess(said.rindex("1000000"), said.rindex("900000"), said)

    def test_the_checkpoint_of_another_run_is_refused(self):
        self.run_case()
        self.hdem("run", self.other, "-o", self.root / "wide", "-q", "--set", "stage[1].cycles=500")
        (self.folder / "checkpoint.h5").write_bytes((self.root / "wide/checkpoint.h5").read_bytes())
        self.expect_untouched("of another one", "run", "--restart", self.folder, "-q", "--set", "stage[1].cycles=700")

    def test_a_refused_restart_puts_nothing_aside(self):
        self.run_case("--set", "output.checkpoint_every=150")
        previous = self.folder / "checkpoint.previous.h5"
        self.assertTrue(previous.exists())
        self.expect_untouched("keeps its blocks", "run", "--restart", previous, "-q", "--set", "joint.default.cohesion=1")
        self.hdem("run", "--restart", previous, "-q")
        self.assertTrue((self.folder / "checkpoint.h5.younger").exists())

    def test_a_folder_in_the_place_of_a_file_is_found_before_anything_goes(self):
        self.run_case()
        (self.folder / "run.log").unlink()
        for name in ("view.html", "run.log"):
            (self.folder / name).mkdir()
            self.expect_untouched("is a folder", "run", self.case, "-o", self.folder, "-q")
            (self.folder / name).rmdir()
        self.run_case()

    def test_a_file_in_the_place_of_a_folder_is_found_before_anything_goes(self):
        self.run_case()
        (self.folder / "frames").rename(self.root / "kept")
        (self.folder / "frames").touch()
        self.expect_untouched("is no folder", "run", self.case, "-o", self.folder, "-q")

    def test_frames_of_another_run_behind_a_link_stay(self):
        self.run_case()
        linked = self.root / "linked"
        linked.mkdir()
        before = content(self.folder)
        for name, target in (("frames", "frames"), ("failure", ".")):
            (linked / name).symlink_to(self.folder / target)
            self.assertIn("is a link", self.hdem("run", self.other, "-o", linked, "-q", code=REFUSED))
            self.assertEqual(content(self.folder), before)
            (linked / name).unlink()

    def test_a_search_of_critical_is_replaced_only_with_overwrite(self):
        self.hdem("critical", CASES / "fos/slab.toml", "--vary", "joint.default.friction_angle_deg=10:60", "--fails", "displacement:slab>0.1", "-o",
                  self.folder, "-q", "--tolerance", "20")
        self.expect_untouched("hdem critical", "run", self.case, "-o", self.folder, "-q")
        other = ["critical", CASES / "fos/slab.toml", "--vary", "joint.default.friction_angle_deg=10:60", "--fails", "displacement:slab>0.2", "-o",
                 self.folder, "-q", "--tolerance", "20"]
        (self.folder / "run.log").rename(self.folder / "kept.log")
        (self.folder / "run.log").mkdir()
        self.expect_untouched("is a folder", *other)
        (self.folder / "run.log").rmdir()
        (self.folder / "summary.json").unlink()    # as if it had been cut short
        self.expect_untouched("another search", *other)
        self.run_case("--overwrite")

    def test_a_whole_stage_is_not_free_to_change(self):
        self.case = self.write("named.toml", SLAB.replace('"two"', '"cycles"'))
        self.run_case("--set", "stage[0].cycles=1000000", "--max-wall", "0.05s", code=OUT_OF_TIME)
        self.expect_untouched("keeps its blocks", "run", "--restart", self.folder, "-q", "--set", 'stage.cycles={name="cycles", cycles=900}')

    def test_damaged_trials_are_none(self):
        slab = CASES / "fos/slab.toml"
        self.hdem("fos", slab, "-o", self.folder, "-q")
        trials, summary = self.folder / "trials.json", self.folder / "summary.json"
        text = trials.read_text(encoding="utf-8")
        factor = json.loads(summary.read_text(encoding="utf-8"))["factor_of_safety"]["factor"]
        for find, put in ((r'"failing": \[\s*1\s*\]', '"failing": [999999]'), (r'"failing": \[\s*1\s*\]', '"failing": [-5]'),
                          (r'"question": "[^"]*"', '"question": 5'), (r'"search": "[^"]*"', '"search": 5')):
            damaged = re.sub(find, put, text)
            self.assertNotEqual(damaged, text)
            trials.write_text(damaged, encoding="utf-8")
            self.hdem("fos", slab, "-o", self.folder, "-q")
            self.assertEqual(json.loads(summary.read_text(encoding="utf-8"))["factor_of_safety"]["factor"], factor)

    def test_damaged_trials_of_critical_are_none(self):
        command = ["critical", CASES / "fos/slab.toml", "--vary", "joint.default.friction_angle_deg=10:60", "--fails", "displacement:slab>0.1", "-o",
                   self.folder, "-q", "--tolerance", "20"]
        self.hdem(*command)
        trials = self.folder / "trials.json"
        text = trials.read_text(encoding="utf-8")
        for find in (r'"question": "[^"]*"', r'"search": "[^"]*"', r'"greatest": [^,]*', r'"cycles": \d+'):
            trials.write_text(re.sub(find, find[:find.index(":")] + ': {"a": 5}', text), encoding="utf-8")
            self.hdem(*command)

    def test_a_run_goes_on_when_nobody_reads_its_screen(self):
        reader, writer = os.pipe()
        os.close(reader)
        with subprocess.Popen([HDEM, "run", self.case, "-o", self.folder], stdout=writer, stderr=subprocess.PIPE, cwd=self.root) as program:
            os.close(writer)
            said = program.communicate(timeout=60)[1]
        self.assertEqual(program.returncode, FINISHED, said)
        self.assertIn("done after", (self.folder / "run.log").read_text(encoding="utf-8"))

    def test_a_pipe_as_joint_law_is_refused(self):
        os.mkfifo(self.root / "law.so")
        self.write("piped.toml", SLAB.replace("friction_angle_deg = 35.0", 'law = "law.so"'))
        self.assertIn("law.so", self.hdem("check", "piped.toml", code=REFUSED))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
