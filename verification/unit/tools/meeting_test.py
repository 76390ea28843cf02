#!/usr/bin/python3
"""Runs that meet in one folder, and what others have put there: links, pipes, limits, closed outputs, control characters.

    meeting_test.py HDEM FAULTS    the program, and verification/faults
"""
import json
import math
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

HDEM = Path(sys.argv[1]).resolve()
sys.path.insert(0, sys.argv[2])
try:
    import run_folder
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

import small_case    # pylint: disable=wrong-import-position

REFUSED = "another run is in this folder: process"


class InAFolder(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.root = Path(self.scratch.name)
        self.case = run_folder.write_case(self.root)

    def tearDown(self):
        self.scratch.cleanup()

    def start(self, *arguments):
        return subprocess.Popen([HDEM, "run", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def begin(self, name, *arguments):
        """A run that has written its first checkpoint."""
        folder = self.root / name
        program = self.start(self.case, "-o", folder, *arguments)
        until = time.monotonic() + 60.0
        while not (folder / "checkpoint.h5").exists() and program.poll() is None and time.monotonic() < until:
            time.sleep(0.005)
        return folder, program

    def cut_short(self, name):
        folder, program = self.begin(name)
        program.kill()
        program.communicate()
        return folder


class RunsThatMeet(InAFolder):
    def test_of_ten_at_once_one_runs_and_the_others_say_who_is_there(self):
        whole = self.root / "whole"
        self.assertEqual(run_folder.run(HDEM, self.case, "-o", whole).returncode, 0)
        folder = self.root / "a" / "b"
        programs = [self.start(self.case, "-o", folder, "--threads", 1, *(["--overwrite"] if i % 2 else [])) for i in range(10)]
        outcomes = [(program.communicate(timeout=120), program.returncode) for program in programs]
        self.assertEqual(sorted(code for _, code in outcomes), [0] + 9 * [2])
        for (_, said), code in outcomes:
            if code == 2:
                self.assertRegex(said, rf"(?m)^error: .*b: \({REFUSED} \d+ on \S+ since .*Wait for its end, or write to another folder with -o\.$")
        self.assertEqual(run_folder.summary(folder)["state_hash"], run_folder.summary(whole)["state_hash"])
        self.assertEqual(run_folder.differing_results(folder, whole), [])
        self.assertEqual(run_folder.broken_files(folder), [])
        self.assertFalse((folder / ".lock").exists())

    def test_runs_killed_at_random_in_one_folder_leave_one_result(self):
        chance = random.Random(7)
        folder = self.root / "shared"
        for _ in range(4):
            programs = [self.start(self.case, "-o", folder, "--overwrite", "--threads", 1) for _ in range(3)]
            time.sleep(chance.uniform(0.0, 0.4))
            for program in programs:
                program.kill()
                program.communicate()
        self.assertEqual(run_folder.run(HDEM, self.case, "-o", folder, "--overwrite").returncode, 0)
        self.assertEqual(run_folder.broken_files(folder), [])
        self.assertEqual([str(file) for file in folder.rglob("*.tmp")] + [str(file) for file in folder.rglob(".lock")], [])

    def test_a_live_run_is_neither_overwritten_nor_restarted(self):
        folder, program = self.begin("live", "--set", "stage[1].cycles=4000000")
        before = json.loads((folder / ".lock").read_text(encoding="utf-8"))
        self.assertEqual(before["process"], program.pid)
        for arguments in ([self.case, "-o", folder, "--overwrite"], ["--restart", folder], ["--restart", folder / "checkpoint.h5"]):
            refused = run_folder.run(HDEM, *arguments)
            self.assertEqual(refused.returncode, 2, refused.stdout)
            self.assertIn(f"{REFUSED} {program.pid} on {before['host']} since {before['start']}", refused.stderr)
        self.assertIsNone(program.poll(), "it goes on")
        elsewhere = run_folder.run(HDEM, "--restart", folder, "-o", self.root / "branch", "--max-wall", "0.1s")
        self.assertEqual(elsewhere.returncode, 5, "its last checkpoint may be read")
        program.kill()
        program.communicate()
        self.assertTrue((folder / ".lock").exists(), "nobody was left to remove it")
        self.assertEqual(run_folder.run(HDEM, "--restart", folder, "--set", "stage[1].cycles=300").returncode, 0, "it locks nobody out")

    def test_a_restart_elsewhere_does_not_take_the_place_of_a_run_cut_short(self):
        one, other = self.cut_short("one"), self.cut_short("other")
        before = (other / "checkpoint.h5").read_bytes()
        refused = run_folder.run(HDEM, "--restart", one, "-o", other)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--overwrite", refused.stderr)
        self.assertEqual((other / "checkpoint.h5").read_bytes(), before)
        self.assertEqual(run_folder.run(HDEM, "--restart", one, "-o", other, "--overwrite").returncode, 0)
        with run_folder.h5py.File(other / "results.h5", "r") as results:
            self.assertGreaterEqual(results["frames/cycle"][0], run_folder.checkpoint_cycle(one), "no frame of the other run stays")

    def test_a_refused_case_leaves_no_folder(self):
        self.case.write_text("stage = 3", encoding="utf-8")
        self.assertEqual(run_folder.run(HDEM, self.case, "-o", self.root / "x" / "y").returncode, 2)
        self.assertFalse((self.root / "x").exists())


class WhatOthersPutThere(InAFolder):
    def setUp(self):
        super().setUp()
        self.folder = self.root / "out"
        self.folder.mkdir()
        self.precious = self.root / "precious"
        self.precious.write_text("precious", encoding="utf-8")
        self.quick = [self.case, "-o", self.folder, "--set", "stage[0].cycles=10", "--set", "stage[1].cycles=10"]

    def test_links_and_pipes_under_the_names_of_files_are_not_written_to(self):
        for name in ("results.h5.tmp", "summary.json.tmp", "run.log", "results.h5", "summary.json", "checkpoint.previous.h5.tmp"):
            (self.folder / name).symlink_to(self.precious)
        done = run_folder.run(HDEM, *self.quick)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.precious.read_text(encoding="utf-8"), "precious")
        self.assertFalse((self.folder / "run.log").is_symlink())
        for name in ("summary.json.tmp", "run.log", "results.h5.tmp"):
            (self.folder / name).unlink()
            os.mkfifo(self.folder / name)
        done = run_folder.run(HDEM, *self.quick, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_lock_that_is_a_link_or_a_pipe_is_refused(self):
        (self.folder / ".lock").symlink_to(self.precious)
        refused = run_folder.run(HDEM, *self.quick)
        self.assertEqual(refused.returncode, 1)
        self.assertIn(".lock: cannot be written (a link, a pipe or a device)", refused.stderr)
        (self.folder / ".lock").unlink()
        os.mkfifo(self.folder / ".lock")
        self.assertEqual(run_folder.run(HDEM, *self.quick, timeout=60).returncode, 1)
        self.assertEqual(self.precious.read_text(encoding="utf-8"), "precious")

    def test_a_limit_on_file_sizes_is_a_message(self):
        limit = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))}
        if subprocess.run([HDEM, "--version"], check=False, capture_output=True, **limit).returncode == 66:
            self.skipTest("the thread sanitizer itself needs larger files")
        failed = run_folder.run(HDEM, *self.quick, **limit)
        self.assertEqual(failed.returncode, 1, failed.stderr)
        self.assertIn("ulimit -f", failed.stderr)

    def test_closed_outputs_do_not_end_up_in_files(self):
        command = f"exec '{HDEM}' run '{self.case}' -o '{self.folder}' --set 'stage[0].cycles=10' --set 'stage[1].cycles=10'"
        subprocess.run(["sh", "-c", command], check=True, stdout=subprocess.DEVNULL)
        once = (self.folder / "run.log").read_text(encoding="utf-8").count("time step")
        self.assertGreater(once, 0)
        for closed in (">&-", "<&- >&- 2>&-"):
            subprocess.run(["sh", "-c", f"{command} {closed}"], check=True)
            self.assertEqual((self.folder / "run.log").read_text(encoding="utf-8").count("time step"), once, closed)
            self.assertEqual(run_folder.broken_files(self.folder), [])

    def test_control_characters_of_a_case_are_told_by_their_codes(self):
        text = run_folder.CASE.replace('"A run that is cut short"', '"\\u001B[2J\\u009B1A\\u202Ered\\u0007"')
        self.case.write_text(text, encoding="utf-8")
        done = run_folder.run(HDEM, *self.quick)
        self.assertEqual(done.returncode, 0, done.stderr)
        log = (self.folder / "run.log").read_text(encoding="utf-8")
        for said in (done.stdout, log):
            self.assertIn("\\x1b[2J\\x9b1A\\u202ered\\x07", said)
            self.assertFalse(set(said) & set("\x1b\x07\x9b\u202e"), said)
        for command in (["info", self.case], ["info", self.folder], ["check", self.case, "--blocks"]):
            said = subprocess.run([HDEM, *command], capture_output=True, text=True, check=True)
            self.assertFalse(set(said.stdout + said.stderr) & set("\x1b\x07\x9b\u202e"), said.stdout)
        refused = run_folder.run(HDEM, *self.quick, "--set", "stage[1].excavate=[\"\x1b[31m\"]")
        self.assertEqual(refused.returncode, 2)
        self.assertNotIn("\x1b", refused.stderr)


class WithinAStaticSolution(InAFolder):
    """A stage whose static solution takes seconds is left, and restarted, where that began."""

    def test_signals_and_times_end_it_and_a_restart_gives_the_unbroken_run(self):
        text = run_folder.CASE.replace("width = 12.0\nheight = 12.0", "width = 40.0\nheight = 40.0").replace("= 15.0", "= 35.0\ncohesion = 1e5")
        text = text.replace("[[stage]]\ncycles = 800\n", "").replace("cycles = 2200", 'until = "converged"\nsolver = "static"\nmax_cycles = 20')
        text = text[:text.index("[[history]]")]
        self.case.write_text(text, encoding="utf-8")
        whole = self.root / "whole"
        begun = time.monotonic()
        done = run_folder.run(HDEM, self.case, "-o", whole)
        took = time.monotonic() - begun
        self.assertIn(done.returncode, (0, 4), done.stderr)
        self.assertIn("note: static solution", done.stdout)
        for number in (signal.SIGTERM, signal.SIGINT):
            folder = self.root / f"signal{number}"
            program = self.start(self.case, "-o", folder)
            while not (folder / "results.h5").exists() and program.poll() is None:
                time.sleep(0.002)
            time.sleep(0.1)
            sent = time.monotonic()
            program.send_signal(number)
            said, _ = program.communicate(timeout=60)
            self.assertEqual(program.returncode, 128 + number, said)
            self.assertNotIn("note: static solution", said, "it was not at its end")
            self.assertLess(time.monotonic() - sent, max(1.0, 0.5 * took))
            self.assertIn(run_folder.run(HDEM, "--restart", folder, "--max-wall", "0.01s").returncode, (5,))
            self.assertEqual(run_folder.run(HDEM, "--restart", folder, "--threads", 1).returncode, done.returncode)
            self.assertEqual(run_folder.summary(folder)["state_hash"], run_folder.summary(whole)["state_hash"])
            self.assertEqual(run_folder.differing_results(folder, whole), [])


class WhileAModelIsBuilt(InAFolder):
    """Blocks that take long to cut and to look after: a star of 25 000 vertices, whose parts all lie near each other."""

    def setUp(self):
        super().setUp()
        points = []
        for i in range(25000):
            radius = 4.0 if i % 2 else 10.0
            points.append(f"{radius * math.cos(math.pi * i / 12500):.9f} {radius * math.sin(math.pi * i / 12500):.9f}")
        for number in range(8):
            shifted = ", ".join(f"{float(p.split()[0]) + 40 * number:.9f} {p.split()[1]}" for p in points + points[:1])
            with open(self.root / "stars.wkt", "a", encoding="utf-8") as file:
                file.write(f"POLYGON(({shifted}))\n")
        self.case.write_text('blocks_file = "stars.wkt"' + small_case.ROCK + "[[stage]]\ncycles = 1", encoding="utf-8")

    def test_the_time_on_the_wall_holds_and_a_terminal_sees_how_long_it_takes(self):
        screen, terminal = os.openpty()
        begun = time.monotonic()
        with subprocess.Popen([HDEM, "run", self.case, "--max-wall", "2s"], cwd=self.root, stderr=terminal) as program:
            code = program.wait(timeout=60)
        self.assertEqual(code, 5)
        self.assertLess(time.monotonic() - begun, 8.0)
        os.close(terminal)
        said = os.read(screen, 100000).decode()
        os.close(screen)
        self.assertIn("the case is read and its model built: 2 s", said)
        self.assertIn("--max-wall: the time was over while the case is read", said)

    def test_check_says_on_a_terminal_how_long_it_takes(self):
        screen, terminal = os.openpty()
        with subprocess.Popen([HDEM, "check", self.case], cwd=self.root, stdout=subprocess.DEVNULL, stderr=terminal) as program:
            time.sleep(4)
            program.kill()
        os.close(terminal)
        said = os.read(screen, 100000).decode()
        os.close(screen)
        self.assertIn("the case is read and its model built: 2 s", said)

    def test_a_signal_ends_it(self):
        program = self.start(self.case, "-o", self.root / "out")
        time.sleep(0.5)
        program.send_signal(signal.SIGTERM)
        program.communicate(timeout=5)
        self.assertEqual(program.returncode, -signal.SIGTERM)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
