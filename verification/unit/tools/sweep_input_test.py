#!/usr/bin/python3
"""All runs of a sweep have the values that the plan says, and the same input otherwise.

    sweep_input_test.py HDEM TOOLS    the program, and the folder of its scripts
"""
import json
import math
import os
import resource
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import small_case

HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.path.insert(0, str(TOOLS))
from sweep_parts import common, keys, plans, settings    # noqa: E402

# Two loads, one of which has a name, and a file that the case names.
CASE = small_case.CASE.replace("[output]", """[[load]]
blocks = ["l"]
force = [1, 0]
[[load]]
name = "push"
blocks = ["l"]
force = [300, -400]
table_file = "table.csv"
[output]""")
TABLE = "cycle,factor\n0,0\n100,1\n"
PATIENCE = 300.0    # s, of what should never wait
# In place of a JSON file: how it is made, and what is said of it.
NO_JSON = {"deep": (lambda file: file.write_text("[" * 200000), "too deep in each other"), "huge": (lambda file: file.write_text('{"moved": 1%s}' % (400 * "0")), "401 digits"),
           "many": (lambda file: file.write_text("[" + 2000000 * "0," + "0]"), "2000000 values"), "large": (lambda file: (file.touch(), os.truncate(file, 2500 << 20)), "bytes, more than"),
           "bytes": (lambda file: file.write_bytes(b"\xff"), "decode"), "pipe": (os.mkfifo, "is a pipe"), "device": (lambda file: file.symlink_to("/dev/zero"), "a device"),
           "folder": (lambda file: file.mkdir(), "Is a directory")}


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="hdem_sweep_input_test_")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        (self.folder / "case.toml").write_text(CASE, encoding="utf-8")
        (self.folder / "table.csv").write_text(TABLE, encoding="utf-8")
        # In place of hdem: a run is done at once, or refused as one with an unknown key.
        self.program = self.folder / "stand_in"
        self.program.write_text('#!/bin/bash\necho "$*" >> calls\n[[ "$*" == *unknown* ]] && exit 2\nmkdir -p "$4" && echo "{}" > "$4/summary.json"\n')
        self.program.chmod(0o755)

    def sweep(self, *arguments, code=0, memory=1 << 30):
        """What was said."""
        done = subprocess.run([TOOLS / "sweep", *map(str, arguments)], capture_output=True, text=True, check=False, cwd=self.folder, timeout=PATIENCE,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (memory, memory)))
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        return done.stdout + done.stderr

    def plan(self, *varied, **more):
        return self.sweep("plan", "case.toml", "-o", "s", "--program", HDEM, *[word for text in varied for word in ("--vary", text)], **more)

    def run_one(self, number, *words, **more):
        return self.sweep("run", "s", number, "--program", self.program, "--", *words, **more)

    def work(self, *words, **more):
        return self.sweep("work", "s", "--jobs", "1", "--program", self.program, "--", *words, **more)

    def calls(self):
        file = self.folder / "calls"
        return len(file.read_text().splitlines()) if file.exists() else 0


class VariedKeys(Scratch):
    def test_have_one_place_under_all_names(self):
        document = keys.document_of(self.folder / "case.toml")
        for key, place in (("load.push.force", ["load", 1, "force"]), ("load[1].force", ["load", 1, "force"]), (" load[01].force", ["load", 1, "force"]),
                           ("load.load1.force[0]", ["load", 0, "force", 0]), ("load.push[5].force", ["load", 1, "force"]), ("load.new.force", ["load", "new", "force"]),
                           ("joint.default.cohesion", ["joint", "default", "cohesion"]), ("fault.a.dip", ["fault", "a", "dip"])):
            self.assertEqual(keys.place_of(key, document), place, key)
        sets = {"joint_set": [{"dip_deg": 1}, {"name": "b"}]}
        self.assertEqual([keys.place_of(f"joint_set.{name}.dip_deg", sets)[1] for name in ("set1", "b", "set2")], [0, 1, "set2"])
        self.assertEqual(keys.place_of("load[" + 5000 * "9" + "].force", document)[1:], ["force"], "hdem refuses it")
        self.assertFalse(keys.overlap("load[0].force", "load.push.force", document))
        self.assertFalse(keys.overlap("load.push.force[0]", "load.push.force[1]", document))
        self.assertTrue(keys.overlap("load.push.force[0]", "load[1].force", document))

    def test_are_not_laid_over(self):
        self.plan("load.push.force=1000,2000")
        for words in (["--set", "load.push.force=50"], ["--set=load.push.force = 50"], ["--set", "load[1].force=50"], ["--set", "time.step=1e-4", "load.push.force=50"],
                      ["--set=time.step=1e-4", "load[1].force=50"], ["--set", 'load=[{blocks=["l"],force=[50,0]}]'], ["--set", "load[1].force[0]=50"],
                      ["--set", "load[1].name=new", "load.new.force=50"], ["--set", "[time.step=1e-4,load[01].force=50]"], ["--set", "load[1].force=1", "--quiet"]):
            said = self.work(*words, code=2)
            self.assertRegex(said, r"^error: sweep: --set load\S*: the plan varies (it|load.push.force), and the table would show the plan's values. Leave it away, or", words)
            self.assertEqual(self.run_one(1, *words, code=2), said)
        self.assertEqual(self.calls(), 0)
        self.work("--set", "load[0].force=50")

    def test_of_a_chain_are_not_laid_over(self):
        self.sweep("plan", "case.toml", "-o", "s", "--program", HDEM, "--bisect", "load.push.force=0:9", "--tolerance", "1", "--fails", "detached_blocks>0")
        self.assertIn("--set load[1].force: the plan varies load.push.force", self.work("--set", "load[1].force=50", code=2))

    def test_may_be_laid_over_by_a_method(self):
        self.plan("contact.method=force,hybrid")
        for words in (["--method", "hybrid"], ["--method=hybrid"], ["--set", 'contact={method="force"}']):
            self.assertIn("the plan varies contact.method", self.work(*words, code=2))

    def test_vary_once(self):
        for other in ("load[1].force=50,60", "load.push.force=50,60", "load.push.force[1]=50,60"):
            said = self.plan("load.push.force=1000,2000", other, code=2)
            self.assertIn("load.push.force: varies twice", said)
            self.assertIn("Give each key once", said)
            self.assertFalse((self.folder / "s").exists())
        self.assertIn("varies twice, also by load.push.force", self.sweep("plan", "case.toml", "-o", "s", "--vary", "load[1].force=1,2", "--bisect", "load.push.force=0:9",
                                                                          "--tolerance", "1", "--fails", "detached_blocks>0", code=2))
        self.plan("load.push.force=1000,2000", "load[0].force=50,60")


class SameInput(Scratch):
    def test_named_files_stay_the_same(self):
        for name, varied in (("table.csv", "load.push.force=1,2"), ("b.csv", "load.push.table_file=table.csv,b.csv"), ("b.csv", "load.push.table_file=table.csv,'b.csv'")):
            (self.folder / "b.csv").write_text(TABLE, encoding="utf-8")
            self.plan(varied)
            self.run_one(1)
            (self.folder / name).write_text(TABLE + "200,2\n", encoding="utf-8")
            before = self.calls()
            for again in (self.work, lambda **more: self.run_one(2, **more)):
                self.assertIn(f"{name}: has changed since the plan was made: its runs do not belong together. Put the file back, or make a new plan", again(code=2))
            self.assertEqual(self.calls(), before)
            (self.folder / name).write_text(TABLE, encoding="utf-8")
            self.work()
            subprocess.run(["rm", "-r", self.folder / "s"], check=True)

    def test_files_of_options_stay_the_same(self):
        (self.folder / "b.csv").write_text(TABLE, encoding="utf-8")
        self.plan("load.push.force=1,2")
        words = ("--set", "load.push.table_file=b.csv")
        self.run_one(1, *words)
        (self.folder / "b.csv").write_text(TABLE + "200,2\n", encoding="utf-8")
        self.assertIn("b.csv: has changed since runs began", self.work(*words, code=2))

    def test_texts_that_are_no_files_are_left_alone(self):
        (self.folder / "Small run").write_text("a file that has the title of the case", encoding="utf-8")
        self.plan("load.push.force=1,2")
        self.assertEqual(list(json.loads((self.folder / "s/plan.json").read_text())["files_sha256"]), ["table.csv"])

    def test_a_case_that_is_no_case_is_left_to_hdem(self):
        for text in ("a" + 3000 * ".a" + " = 1", "a = " + 3000 * "[", "title = ", "\xff"):
            (self.folder / "case.toml").write_text(text, encoding="latin-1")
            self.assertIn("hdem refuses run 1", self.plan("load.push.force=1:2", code=2, memory=resource.RLIM_INFINITY))    # hdem under sanitizers takes terabytes
            self.sweep("plan", "case.toml", "-o", "s", "--vary", "load.push.force=1:2", "--program", "nowhere")
            self.work("--set", "time.step=1e-4")
            subprocess.run(["rm", "-r", self.folder / "s"], check=True)

    def test_options_that_shape_results_stay_the_same(self):
        self.plan("load.push.force=1:4")
        self.run_one(1, "--set", "time.step = 1e-4", "gravity.vector=[0,-9]", "--method", "hybrid", "--quiet")
        for words in ([], ["--set", "time.step=1e-4"], ["--set", "time.step=1e-4", "gravity.vector=[0,-9]", "--method", "force"], ["--method", "hybrid"], ["--new-option"]):
            said = self.work(*words, code=2)
            self.assertIn("s: hdem had --set time.step=1e-4 --set 'gravity.vector=[0,-9]' --method hybrid before, and now ", said)
            self.assertIn("Give the same options, or make a new plan in another folder", said)
        self.assertEqual(self.calls(), 1)
        self.work("--threads", "2", "-q", "--live", "--max-wall=5", "--method=hybrid", "--overwrite", "--set=time.step=1e-4", "--set", "gravity.vector=[0,-9]")

    def test_options_that_shape_nothing_may_change(self):
        self.plan("load.push.force=1:4")
        self.run_one(1, "--threads", "1")
        self.run_one(2, "-qq", "--threads=auto", "--max-wall", "1h", "--live")
        self.assertIn("now --set time.step=1e-4", self.work("--set", "time.step=1e-4", code=2))
        self.work()

    def test_options_that_hdem_refused_do_not_count(self):
        self.plan("load.push.force=1:2")
        self.assertIn("2 failed", self.work("--set", "time.unknown=1", code=2))
        self.work("--set", "time.step=1e-4")
        self.assertIn("hdem had --set time.step=1e-4 before, and now no option that shapes results", self.work(code=2))

    def test_where_and_whence_is_the_sweeps_own(self):
        self.plan("load.push.force=1:2")
        for words in (["--restart", "elsewhere"], ["-o", "elsewhere"], ["--output=elsewhere"]):
            self.assertIn(f"{words[0].split('=')[0]}: the sweep itself gives it to each run", self.work(*words, code=2))

    def test_sweeps_of_earlier_versions_go_on(self):
        self.plan("load.push.force=1:4")
        self.run_one(1, "--method", "hybrid")
        plan = json.loads((self.folder / "s/plan.json").read_text())
        del plan["files_sha256"]
        (self.folder / "s/plan.json").write_text(json.dumps(plan))
        (self.folder / "s/input.json").unlink()
        self.run_one(2, "--method", "hybrid")
        self.assertIn("Give the same options", self.work(code=2))
        (self.folder / "table.csv").write_text(TABLE + "200,2\n", encoding="utf-8")
        self.assertIn("table.csv: has changed since runs began", self.work("--method", "hybrid", code=2))

    def test_damaged_record_is_told(self):
        self.plan("load.push.force=1:2")
        for text in ("", "[]", "{}", '{"settings": [], "files_sha256": {}}'):
            (self.folder / "s/input.json").write_text(text)
            self.assertIn("s/input.json: damaged", self.work(code=2))

    def test_words_of_options(self):
        for words, found in (([], {}), (["-q", "--threads", "2"], {}), (["--set", "a=1", "b = 2", "--set=[c=3,d=4]"], {"--set": ["a=1", "b=2", "c=3", "d=4"]}),
                             (["--method=force", "-qq"], {"--method": ["force"]}), (["--new"], {"--new": []}), (["word"], {"": ["word"]})):
            self.assertEqual(settings.settings_of(words), found)


class StrangeFiles(Scratch):
    """In the folder of a sweep, made or damaged by somebody else: one line that says what to do, soon and without much memory."""

    def setUp(self):
        super().setUp()
        self.plan("load.push.force=1:3")
        self.work()

    def in_place_of(self, name):
        """Each kind of strange file, and the words for it; the old file is back afterwards."""
        file, old = self.folder / "s" / name, self.folder / "old"
        file.rename(old)
        for kind, (make, words) in NO_JSON.items():
            make(file)
            yield file, words
            file.rmdir() if kind == "folder" else file.unlink()
        old.rename(file)

    def refused(self, said, *words):
        self.assertEqual(said.count("\n"), 1, said)
        for word in ("error: sweep: ", *words):
            self.assertIn(word, said)

    def test_plan(self):
        for file, words in self.in_place_of("plan.json"):
            for said in (self.work(code=2), self.sweep("collect", "s", code=2)):
                self.refused(said, f"s/{file.name}: cannot be read (", words, "Make it with `sweep plan`")

    def test_values_of_a_plan(self):
        chain = {"key": "a", "low": 0.0, "high": 1.0, "tolerance": 0.1, "fails": ["b>0"]}
        for wrong in ({"runs": [{"a": {}}, {"b": [1]}]}, {"runs": [{"a": "1"}, {"b": "1"}]}, {"runs": [{"a": ["1"]}]}, {"runs": [{"a": "\0"}]}, {"runs": [{"a": "\ud800"}]}, {"runs": {}},
                      {"case": "\0"}, {"files_sha256": []}, {"bisect": []}, {"bisect": chain | {"low": "0"}}, {"bisect": chain | {"fails": [1]}}, {"bisect": chain | {"high": math.inf}}):
            (self.folder / "s/plan.json").write_text(json.dumps({"case": "/x", "runs": [{"a": "1"}]} | wrong))
            for said in (self.work(code=2), self.sweep("collect", "s", code=2)):
                self.refused(said, "s/plan.json: cannot be read (")

    def test_plan_that_could_not_be_read_is_not_made(self):
        with self.assertRaisesRegex(common.SweepError, "the plan would have more than .* 2000000 values. Give fewer runs or keys"):
            plans.content_of({"runs": [{str(key): "1" for key in range(25)}] * 100000})

    def test_summary(self):
        for file, words in self.in_place_of("run_000001/summary.json"):
            self.refused(self.work(code=2), f"run_000001/{file.name}: damaged (", words, "Remove it to run this again")
            error, table = self.sweep("collect", "s", code=1).split("\n")[1::-1]
            self.refused(error + "\n", f"run_000001/{file.name}: damaged (", words, "Remove it to run this again")
            self.assertEqual(table, "s/table.csv: 2 of 3 runs done, 1 damaged")

    def test_numbers_that_are_too_great_are_none(self):
        for number in range(1, 4):
            (self.folder / f"s/run_00000{number}/summary.json").write_text('{"moved": %d, "far": %de306, "late": 1e400}' % (number, 2 * number - 5))
        self.assertIn("moved: median 2, quartiles 1.5 and 2.5, 3 runs", self.sweep("collect", "s", "--of", "moved"))
        for name in ("far", "late"):
            self.assertIn(f"{name}: no run has such a number", self.sweep("collect", "s", "--fails", f"{name}>0", code=2))

    def test_summary_of_many_stages_counts(self):
        stage = {"name": "excavate", "cycles": 1000, "converged": True, "ended_by": "converged", **{f"value_{i}": 1.0 / 3.0 for i in range(8)}}
        (self.folder / "s/run_000001/summary.json").write_text(json.dumps({"stages": 20000 * [stage]}, indent=1))
        self.assertIn("3 of 3 runs done", self.sweep("collect", "s"))

    def test_text_that_is_none_is_told(self):
        (self.folder / "s/run_000001/summary.json").write_text('{"title": "\\ud800"}')
        self.refused(self.sweep("collect", "s", code=2), "s/table.csv: ", "cannot be written")

    def test_record_of_options(self):
        for file, words in self.in_place_of("input.json"):
            self.refused(self.work(code=2), f"s/{file.name}: damaged (", words, "Remove it")

    def test_claim(self):
        file = self.folder / "s/claims/run_000001"
        file.unlink()
        for make, remove in ((os.mkfifo, os.unlink), (os.mkdir, os.rmdir), (lambda file: os.symlink("/dev/null", file), os.unlink)):
            make(file)
            self.refused(self.work(code=2), "s/claims/run_000001: not what a worker has made. Remove it")
            remove(file)
        for other in file.parent.iterdir():
            other.unlink()
        file.parent.rmdir()
        os.mkfifo(file.parent)
        self.refused(self.work(code=2), "s/claims: not what a worker has made. Remove it")

    def test_table_is_not_written_to_a_pipe_that_nobody_reads(self):
        os.mkfifo(self.folder / "s/table.csv")
        self.refused(self.sweep("collect", "s", code=2), "s/table.csv: cannot be written (No such device")

    def test_case(self):
        os.mkfifo(self.folder / "pipe.toml")
        said = self.sweep("plan", "pipe.toml", "-o", "other", "--program", HDEM, "--vary", "load.push.force=1:3", code=2)
        self.refused(said, "pipe.toml: no such file. Give a case")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
