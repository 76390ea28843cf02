#!/usr/bin/python3
"""A sweep is planned, run, restarted where it was cut short, and collected.

    sweep_test.py HDEM TOOLS    the program, and the folder of its scripts
"""
import csv
import errno
import fcntl
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock
from pathlib import Path

import small_case

HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.path.insert(0, str(TOOLS))
import run_lock    # noqa: E402


class Sweep(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(prefix="hdem_sweep_test_")
        self.folder = Path(self.scratch.name)
        (self.folder / "small.toml").write_text(small_case.CASE, encoding="utf-8")

    def tearDown(self):
        self.scratch.cleanup()

    def sweep(self, *arguments):
        """Exit code, and all that was said."""
        done = subprocess.run([TOOLS / "sweep", *map(str, arguments)], capture_output=True, text=True, check=False, cwd=self.folder)
        return done.returncode, done.stdout + done.stderr

    def plan(self, *varied):
        code, said = self.sweep("plan", "small.toml", "-o", "s", *[word for text in varied for word in ("--vary", text)])
        self.assertEqual(code, 0, said)
        return json.loads((self.folder / "s/plan.json").read_text())["runs"]

    def table(self):
        with open(self.folder / "s/table.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def recorder(self):
        """A program that keeps the words it was called with, and does nothing."""
        program = self.folder / "recorder"
        program.write_text(f'#!/bin/bash\nprintf "%s\\n" "$@" > "{self.folder}/words"\nexit "${{CODE:-0}}"\n')
        program.chmod(0o755)
        return program

    def words(self):
        return (self.folder / "words").read_text().split()

    def test_plans_all_combinations(self):
        runs = self.plan("generator.seed=1:3", "joint.default.friction_angle_deg=0.1:0.3:0.1")
        self.assertEqual(len(runs), 9)
        self.assertEqual(runs[1], {"generator.seed": "1", "joint.default.friction_angle_deg": "0.2"})
        self.assertEqual(runs[-1], {"generator.seed": "3", "joint.default.friction_angle_deg": "0.3"})

    def test_outcomes_are_collected(self):
        self.plan("joint.default.friction_angle_deg=5,30")
        self.assertEqual(self.sweep("run", "s", 2, "--program", HDEM, "--", "--quiet"), (0, "run 2: done\n"))
        (self.folder / "s/run_000001").mkdir()
        code, said = self.sweep("collect", "s")
        self.assertEqual((code, said.strip()), (1, "s/table.csv: 1 of 2 runs done, 1 cut short"))
        first, second = self.table()
        self.assertEqual((first["state"], second["state"]), ("cut short", "done"))
        self.assertEqual(second["joint.default.friction_angle_deg"], "30")
        summary = json.loads((self.folder / "s/run_000002/summary.json").read_text())
        self.assertEqual(second["state_hash"], summary["state_hash"])
        self.assertEqual(float(second["energy.friction"]), summary["energy"]["friction"])
        self.assertEqual(second["detached_blocks"], "1")
        self.sweep("run", "s", 1, "--program", HDEM, "--", "--quiet")
        self.assertEqual(self.sweep("collect", "s")[0], 0)
        self.assertNotEqual(self.table()[0]["state_hash"], second["state_hash"], "the setting reached the run")

    def test_goes_on_where_it_was_cut_short_and_leaves_alone_what_is_done(self):
        self.plan("generator.seed=1:2")
        program = self.recorder()
        self.sweep("run", "s", 1, "--program", program, "--", "--threads", "3")
        self.assertEqual(self.words(), ["run", str(self.folder / "small.toml"), "-o", "s/run_000001", "--set", "generator.seed=1", "--threads", "3"])
        (self.folder / "s/run_000001").mkdir()
        (self.folder / "s/run_000001/checkpoint.h5").touch()
        self.sweep("run", "s", 1, "--program", program)
        self.assertEqual(self.words(), ["run", "--restart", "s/run_000001"])
        (self.folder / "words").unlink()
        (self.folder / "s/run_000001/summary.json").write_text("{}")
        self.assertEqual(self.sweep("run", "s", 1, "--program", program)[0], 0)
        self.assertFalse((self.folder / "words").exists())

    def test_exit_code_says_how_the_run_ended(self):
        self.plan("generator.seed=1")
        program = self.recorder()
        for code, words in ((0, "done"), (1, "failed"), (2, "failed"), (4, "not converged"), (5, "interrupted"), (143, "interrupted")):
            program.write_text(f"#!/bin/bash\nexit {code}\n")
            self.assertEqual(self.sweep("run", "s", 1, "--program", program), (code, f"run 1: {words}\n"))

    def test_of_several_runs_the_worst_counts(self):
        self.plan("generator.seed=1:4")
        program = self.recorder()
        program.write_text('#!/bin/bash\ncase "$*" in *seed=1*) exit 4;; *seed=2*) exit 0;; *seed=3*) exit "${CODE:-0}";; esac\n')
        self.assertEqual(self.sweep("run", "s", 1, 2, 3, 4, "--program", program), (4, "4 runs: 1 not converged, 3 done\n"))
        for code, words in ((1, "1 not converged, 2 done, 1 failed"), (143, "1 not converged, 1 done, 1 interrupted, 1 not begun")):
            program.write_text(program.read_text().replace('"${CODE:-0}"', str(code)).replace("exit 1;;", f"exit {code};;"))
            self.assertEqual(self.sweep("run", "s", 1, 2, 3, 4, "--program", program), (code, f"4 runs: {words}\n"))

    def test_signals_end_runs_and_are_told(self):
        self.plan("generator.seed=1:3")
        slow = self.folder / "slow"
        slow.write_text(f'#!/bin/bash\nfor s in HUP INT TERM; do trap "kill \\$! 2> /dev/null; exit $((128 + $(kill -l $s)))" $s; done\necho >> "{self.folder}/begun"\nsleep 30 & wait $!\n')
        slow.chmod(0o755)
        for command, number, words in ((["run", "s", "1", "2"], signal.SIGINT, "2 runs: 1 interrupted, 1 not begun"), (["run", "s", "3"], signal.SIGHUP, "run 3: interrupted"),
                                       (["work", "s", "--jobs", "1"], signal.SIGHUP, "3 runs: 1 interrupted; 3 without an outcome"),
                                       (["work", "s", "--jobs", "1"], signal.SIGTERM, "3 runs: 1 interrupted; 3 without an outcome")):
            (self.folder / "begun").unlink(missing_ok=True)
            process = subprocess.Popen([TOOLS / "sweep", *command, "--program", slow], cwd=self.folder, start_new_session=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                       text=True)
            while not (self.folder / "begun").exists():
                time.sleep(0.02)
            os.killpg(process.pid, number)    # as a terminal does
            said, _ = process.communicate(timeout=20)
            self.assertEqual((process.returncode, said.strip()), (128 + number, words))

    def test_not_converged_is_said_of_a_run_that_was_done_before(self):
        case = small_case.CASE.replace("cycles = 1500", 'until = "converged"\nmax_cycles = 100')
        (self.folder / "small.toml").write_text(case, encoding="utf-8")
        self.plan("joint.default.friction_angle_deg=30")
        for _ in range(2):
            self.assertEqual(self.sweep("run", "s", 1, "--program", HDEM, "--", "--quiet")[0], 4)
        self.assertEqual(self.sweep("collect", "s"), (0, "s/table.csv: 1 of 1 runs done, 1 of them not converged\n"))
        self.assertEqual((self.table()[0]["state"], self.table()[0]["converged"]), ("done", "False"))

    def test_running_is_told_from_cut_short(self):
        self.plan("generator.seed=1:4")
        for number in (1, 2):
            (self.folder / f"s/run_00000{number}").mkdir()
            (self.folder / f"s/run_00000{number}/.lock").write_text("{}")
        (self.folder / "s/run_000003").mkdir()
        (self.folder / "s/run_000003/results.h5").touch()
        with open(self.folder / "s/run_000001/.lock", "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            code, said = self.sweep("collect", "s")
        self.assertEqual((code, said), (1, "s/table.csv: 0 of 4 runs done, 1 running, 2 cut short, 1 missing\n"))
        self.assertEqual([row["state"] for row in self.table()], ["running", "cut short", "cut short", "missing"])
        self.sweep("collect", "s")
        self.assertEqual(self.table()[0]["state"], "cut short", "nobody holds the lock any more")

    def test_file_says_it_where_the_file_system_has_no_locks(self):
        lock = self.folder / ".lock"
        gone = subprocess.Popen(["true"])
        gone.wait()
        with unittest.mock.patch.object(run_lock.fcntl, "flock", side_effect=OSError(errno.ENOLCK, "no locks")):
            for text, expected in ((json.dumps({"host": "elsewhere", "process": gone.pid}), True), (json.dumps({"host": socket.gethostname(), "process": os.getpid()}), True),
                                   (json.dumps({"host": socket.gethostname(), "process": gone.pid}), False), ("", False), ("[]", False), ("[" * 4000, False)):
                lock.write_text(text)
                self.assertIs(run_lock.is_running(self.folder), expected, text)
        lock.unlink()
        self.assertFalse(run_lock.is_running(self.folder))
        os.mkfifo(lock)
        self.assertFalse(run_lock.is_running(self.folder), "and does not wait for it")

    def test_plan_tries_its_first_run(self):
        for varied in (("--vary", "generator.sed=1:3"), ("--vary", "generator.seed=1:2", "--bisect", "joint.default.cohesion=-5:5", "--tolerance", "1", "--fails", "detached_blocks>0")):
            code, said = self.sweep("plan", "small.toml", "-o", "t", *varied, "--program", HDEM)
            self.assertEqual(code, 2, said)
            self.assertIn("hdem refuses run 1:\nerror: --set ", said)
            self.assertFalse((self.folder / "t").exists())
        code, said = self.sweep("plan", "small.toml", "-o", "t", "--vary", "joint.default.cohesion=3,2,-1,4", "--program", HDEM)
        self.assertEqual(code, 2, "the least of the values: " + said)
        self.assertIn("hdem refuses run 3:\nerror: --set joint.default.cohesion=-1", said)
        for varied, wrong in (("joint.default.cohesion=0,abc,1e4", "cohesion=abc"), ("contact.method=force,hybird,hybrid", "method=hybird")):
            code, said = self.sweep("plan", "small.toml", "-o", "t", "--vary", varied, "--program", HDEM)
            self.assertEqual(code, 2, "each text once: " + said)
            self.assertRegex(said, f"hdem refuses run 2:\nerror: --set [a-z.]*{wrong}")
        code, said = self.sweep("plan", "small.toml", "-o", "t", "--vary", "generator.sed=1:3", "--program", "nowhere")
        self.assertEqual(code, 0, "planned where hdem is not: " + said)

    def test_runs_of_another_plan_do_not_count(self):
        self.plan("generator.seed=1:2")
        (self.folder / "s/run_000001").mkdir()
        (self.folder / "s/plan.json").unlink()
        code, said = self.sweep("plan", "small.toml", "-o", "s", "--vary", "joint.default.friction_angle_deg=1:2")
        self.assertEqual(code, 2)
        self.assertIn("s/run_000001: is a run of another plan", said)
        self.assertFalse((self.folder / "s/plan.json").exists())

    def test_runs_of_a_case_that_has_changed_are_refused(self):
        self.plan("generator.seed=1:2")
        program = self.recorder()
        self.assertEqual(self.sweep("run", "s", "1", "--program", program)[0], 0)
        (self.folder / "small.toml").write_text(small_case.CASE + "# changed\n", encoding="utf-8")
        (self.folder / "words").unlink()
        for command in (["run", "s", "2"], ["work", "s"]):
            code, said = self.sweep(*command, "--program", program)
            self.assertEqual(code, 2)
            self.assertIn("small.toml: has changed since the plan was made", said)
        self.assertFalse((self.folder / "words").exists())
        (self.folder / "small.toml").write_text(small_case.CASE, encoding="utf-8")
        self.assertEqual(self.sweep("run", "s", "2", "--program", program)[0], 0)

    def test_values_are_compared_as_values(self):
        for varied, words in (("a=1,1.0", "--vary a: 1.0 is the same value as 1, and would count twice"), ("a=x,'x'", "'x' is the same value as x"), ("a=1,01", "01 is no number in TOML"),
                              ("a=.5,1", ".5 is no number in TOML"), ("a=[0,1],[0,1]", "[0,1] is given twice"), ("a=[0,1],[0", "brackets or quotes do not match"),
                              ("a=1]", "--vary a=1]: brackets or quotes do not match")):
            code, said = self.sweep("plan", "small.toml", "-o", "t", "--vary", varied, "--program", "nowhere")
            self.assertEqual((code, said.count("\n")), (2, 1), said)
            self.assertIn(words, said)
        self.assertEqual([list(run.values()) for run in self.plan("gravity.vector=[0,-9.81],[0,-5]", "contact.method='force',hybrid")],
                         [["[0,-9.81]", "'force'"], ["[0,-9.81]", "hybrid"], ["[0,-5]", "'force'"], ["[0,-5]", "hybrid"]])

    def test_runs_with_other_values_than_the_plan_do_not_count(self):
        varied = ("--vary", "joint.default.friction_angle_deg=5,30")
        self.plan(varied[1])
        self.assertEqual(self.sweep("run", "s", 1, 2, "--program", HDEM, "--", "--quiet")[0], 0)
        self.assertEqual(self.sweep("collect", "s")[0], 0)
        first, second = self.folder / "s/run_000001", self.folder / "s/run_000002"
        first.rename(self.folder / "s/other")
        second.rename(first)
        words = "error: sweep: s/run_000001: is no run of this plan: {} has joint.default.friction_angle_deg = 30, the plan 5. Move the folder away, and run this again.\n"
        self.assertEqual(self.sweep("collect", "s"), (1, "s/table.csv: 0 of 2 runs done, 1 foreign, 1 missing\n" + words.format("results.h5")))
        self.assertEqual((self.table()[0]["state"], "cycles" in self.table()[0]), ("foreign", False))
        for file in ("results.h5", "checkpoint.h5"):
            for command in (["run", "s", 1], ["work", "s", "--jobs", "1"]):
                self.assertEqual(self.sweep(*command, "--program", self.recorder()), (2, words.format(file)))
            (first / "summary.json").unlink(missing_ok=True)
            (first / "results.h5").unlink(missing_ok=True)    # the checkpoint says it, too
        self.assertNotIn("s/run_000001", self.words())    # the other one was missing, and was run

    def test_outputs_take_the_place_of_no_file_of_the_sweep(self):
        self.plan("generator.seed=1:2")
        before = (self.folder / "s/plan.json").read_bytes()
        for name, words in (("s/plan.json", "hdem itself writes files of this name"), ("s/run_000001", "hdem itself"), ("small.toml", "was read, and would be lost"), ("s", "a folder")):
            code, said = self.sweep("collect", "s", "-o", name)
            self.assertEqual((code, said.count("\n")), (2, 1), said)
            self.assertIn(f"error: sweep: {name}: {words}", said)
        self.assertEqual((self.folder / "s/plan.json").read_bytes(), before)
        self.assertEqual((self.folder / "small.toml").read_text(encoding="utf-8"), small_case.CASE)
        (self.folder / "s/table.csv").symlink_to("plan.json")
        self.assertEqual(self.sweep("collect", "s")[0], 1)
        self.assertEqual((self.folder / "s/plan.json").read_bytes(), before)

    def test_texts_of_the_user_do_not_steer_the_screen(self):
        for code, words in ((0, ["plan", "small.toml", "-o", "\x1b[31m", "--vary", "generator.seed=1"]), (1, ["collect", "\x1b[31m"]), (2, ["plan", "\x1b[31m", "-o", "t", "--vary", "a=1"]),
                            (2, ["collect", "s", "--\x1b[31m"]), (2, ["plan", "small.toml", "-o", "t", "--vary", "generator.seed=1", "--bisect", "\x1b[31m"])):
            found, said = self.sweep(*words)
            self.assertEqual(found, code, said)
            self.assertNotIn("\x1b", said)
            self.assertEqual(said.count("\n"), 1, said)

    def test_errors_say_what_is_wrong(self):
        self.assertEqual(self.sweep("plan", "small.toml", "-o", "u/t", "--vary", "generator.seed=1")[0], 0)
        self.plan("generator.seed=1")
        (self.folder / "broken").mkdir()
        (self.folder / "broken/plan.json").write_text("[1]")
        (self.folder / "s/run_000001").mkdir()
        (self.folder / "s/run_000001/summary.json").write_text("{")
        for arguments, words in ((["collect", "broken"], "cannot be read"), (["run", "s", "1"], "summary.json: damaged"), (["plan", "small.toml", "-o", "s", "--vary", "a=1"], "there is a plan already"),
                                 (["plan", "small.toml", "-o", "t"], "nothing varies"), (["plan", "none.toml", "-o", "t", "--vary", "a=1"], "no such file"),
                                 (["plan", "small.toml", "-o", "t", "--vary", "a=1:x"], "not a range"),
                                 (["plan", "small.toml", "-o", "t", "--vary", "a=1,1,2"], "a: 1 is given twice"),
                                 (["plan", "small.toml", "-o", "t", "--vary", "a=1:2:0"], "not a range"),
                                 (["plan", "small.toml", "-o", "small.toml", "--vary", "generator.seed=1"], "-o small.toml: is a file. Give the name of a folder."),
                                 (["plan", "small.toml", "-o", "t", "--vary", "a=1:2", "--design", "latin", "--runs", "2", "--design-seed", "-1"], "--design-seed -1: must be 0 or greater"),
                                 (["plan", "small.toml", "-o", "t", "--vary", "a=3:2.5"], "not a range"),
                                 (["plan", "small.toml", "-o", "t", "--vary", "a=1:2:-3"], "not a range"),
                                 (["run", "s", "2"], "not in the plan"), (["collect", "u"], "cannot be read"),
                                 (["run", "u/t", "1", "--", "--set", "generator.seed=3"], "--set generator.seed: the plan varies it"),
                                 (["work", "u/t", "--", "--set=generator.seed = 3"], "--set generator.seed: the plan varies it"),
                                 (["run", "u/t", "1", "--program", "nowhere"], "cannot be run")):
            code, said = self.sweep(*arguments)
            self.assertEqual(code, 2, said)
            self.assertIn(words, said)
            self.assertNotIn("Traceback", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
