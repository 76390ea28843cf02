#!/usr/bin/python3
"""Interrupted runs: signals, --max-wall, --restart, and what becomes of results.

    restart_test.py HDEM FAULTS    the program, and verification/faults
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

HDEM = Path(sys.argv[1]).resolve()
sys.path.insert(0, sys.argv[2])
try:
    import run_folder
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

# A stopped program hands signals to any thread, and the thread sanitizer keeps those of a thread that waits. tools/sanitize sets this.
KEPT_SIGNALS = ["--threads", "1"] if "TSAN_OPTIONS" in os.environ else []


class Restart(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.root = Path(cls.scratch.name)
        cls.case = run_folder.write_case(cls.root)
        cls.whole = cls.root / "whole"
        done = run_folder.run(HDEM, cls.case, "-o", cls.whole)
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def begin(self, name, *arguments):
        """A run that has written its first checkpoint."""
        folder = self.root / name
        # pylint: disable=consider-using-with
        program = subprocess.Popen([HDEM, "run", self.case, "-o", folder, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        until = time.monotonic() + 60.0
        while not (folder / "checkpoint.h5").exists() and program.poll() is None and time.monotonic() < until:
            time.sleep(0.005)
        return folder, program

    def expect_the_whole_run(self, folder, *arguments):
        done = run_folder.run(HDEM, "--restart", folder, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(run_folder.summary(folder)["state_hash"], run_folder.summary(self.whole)["state_hash"])
        self.assertEqual(run_folder.summary(folder)["stages"], run_folder.summary(self.whole)["stages"])
        self.assertEqual(run_folder.differing_results(folder, self.whole), [])
        self.assertEqual(run_folder.broken_files(folder), [])

    def test_signals_stop_with_a_checkpoint_and_a_restart_gives_the_unbroken_run(self):
        for number, code, threads in ((signal.SIGINT, 130, "1"), (signal.SIGTERM, 143, "3"), (signal.SIGHUP, 129, "2")):
            folder, program = self.begin(f"signal{number}")
            sent = time.monotonic()
            program.send_signal(number)
            screen, _ = program.communicate(timeout=60)
            self.assertEqual(program.returncode, code, screen)
            self.assertLess(time.monotonic() - sent, 5.0, "a fifth of a second and a checkpoint, on a busy machine")
            self.assertIn(f"Go on with: hdem run --restart {folder}", screen)
            self.assertFalse((folder / "summary.json").exists(), "that is for runs which came to their end")
            self.expect_the_whole_run(folder, "--threads", threads)

    def test_second_signal_leaves_at_once(self):
        # The stopped program cannot act on the first signal before it gets the second one.
        _, program = self.begin("twice", *KEPT_SIGNALS)
        program.send_signal(signal.SIGSTOP)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGCONT):
            program.send_signal(number)
        screen, _ = program.communicate(timeout=60)
        self.assertIn(program.returncode, (130, 143))
        self.assertNotIn("stopped after cycle", screen)

    def test_hangup_after_another_signal_does_not_hurry(self):
        folder, program = self.begin("logout", *KEPT_SIGNALS)
        program.send_signal(signal.SIGSTOP)
        for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGCONT):
            program.send_signal(number)
        screen, _ = program.communicate(timeout=60)
        self.assertIn(program.returncode, (129, 143), screen)
        self.assertIn("stopped after cycle", screen)
        self.expect_the_whole_run(folder)

    def test_nohup_goes_on(self):
        folder = self.root / "nohup"
        # pylint: disable=consider-using-with
        program = subprocess.Popen(["nohup", HDEM, "run", self.case, "-o", folder], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        while not (folder / "results.h5").exists():
            time.sleep(0.005)
        program.send_signal(signal.SIGHUP)
        program.communicate(timeout=60)
        self.assertEqual(program.returncode, 0)

    def test_usr1_checkpoints_and_goes_on(self):
        folder = self.root / "usr1"
        # pylint: disable=consider-using-with
        program = subprocess.Popen([HDEM, "run", self.case, "-o", folder, "--set", "output.checkpoint_every=0"], stdout=subprocess.PIPE, text=True)
        while not (folder / "results.h5").exists():
            time.sleep(0.005)
        program.send_signal(signal.SIGUSR1)
        screen, _ = program.communicate(timeout=60)
        self.assertEqual(program.returncode, 0)
        self.assertIn("SIGUSR1: checkpoint at cycle", screen)
        self.assertTrue((folder / "checkpoint.previous.h5").exists(), "the one that was asked for, and the one at the end")

    def test_max_wall_stops_in_time(self):
        folder = self.root / "late"
        done = run_folder.run(HDEM, self.case, "-o", folder, "--max-wall", "0.1s")
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("--max-wall: stopped after cycle", done.stdout)
        self.expect_the_whole_run(folder)

    def test_max_wall_is_a_time_above_zero(self):
        for text, said in (("-5", "give a time above zero"), ("0h", "give a time above zero"), ("soon", "unit not recognized")):
            done = run_folder.run(HDEM, self.case, "-o", self.root / "never", f"--max-wall={text}")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(said, done.stderr)

    def test_a_run_cut_short_is_not_overwritten_by_mistake(self):
        folder = self.root / "again"
        run_folder.run(HDEM, self.case, "-o", folder, "--max-wall", "0.1s")
        before = run_folder.checkpoint_cycle(folder)
        refused = run_folder.run(HDEM, self.case, "-o", folder)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--overwrite", refused.stderr)
        self.assertEqual(run_folder.checkpoint_cycle(folder), before)
        self.assertEqual(run_folder.run(HDEM, self.case, "-o", folder, "--overwrite").returncode, 0)
        self.assertEqual(run_folder.run(HDEM, self.case, "-o", folder).returncode, 0, "a finished one may be replaced")

    def test_in_a_folder_of_another_run_the_log_begins_anew(self):
        cut, other = self.root / "cut", self.root / "other"
        run_folder.run(HDEM, self.case, "-o", cut, "--max-wall", "0.1s")
        run_folder.run(HDEM, self.case, "-o", other, "--set", "stage[1].cycles=7")
        done = run_folder.run(HDEM, "--restart", cut / "checkpoint.h5", "-o", other)
        self.assertEqual(done.returncode, 0, done.stderr)
        log = (other / "run.log").read_text(encoding="utf-8")
        self.assertNotIn("stage[1].cycles=7", log)
        self.assertEqual(log.count("state hash"), 1, log)

    def test_advice_names_a_checkpoint_that_is_there(self):
        alone = self.root / "alone"
        alone.mkdir()
        (alone / "checkpoint.h5").write_bytes(b"no checkpoint")
        said = run_folder.run(HDEM, "--restart", alone / "checkpoint.h5", "-o", self.root / "never").stderr
        self.assertIn("Give another checkpoint, or begin the run anew.", said)
        (alone / "checkpoint.previous.h5").write_bytes(b"nor this")
        said = run_folder.run(HDEM, "--restart", alone / "checkpoint.h5", "-o", self.root / "never").stderr
        self.assertIn(f"Give another checkpoint: {alone / 'checkpoint.previous.h5'}.", said)

    def test_a_damaged_checkpoint_gives_way_to_the_one_before(self):
        folder, program = self.begin("damaged", "--set", "output.checkpoint_every=100", "--quiet")
        while not (folder / "checkpoint.previous.h5").exists():
            time.sleep(0.005)
        program.kill()
        program.communicate()
        (folder / "checkpoint.h5").write_bytes((folder / "checkpoint.h5").read_bytes()[:1000])
        refused = run_folder.run(HDEM, "--restart", folder / "checkpoint.h5")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("checkpoint.previous.h5", refused.stderr)
        self.expect_the_whole_run(folder)

    def test_results_that_are_not_there_are_told(self):
        folder = self.root / "without"
        run_folder.run(HDEM, self.case, "-o", folder, "--set", "stage[1].cycles=100")
        self.assertNotIn("is not there", run_folder.run(HDEM, "--restart", folder, "--set", "stage[1].cycles=150").stdout)
        (folder / "results.h5").unlink()
        again = run_folder.run(HDEM, "--restart", folder, "--set", "stage[1].cycles=200")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertRegex(again.stdout, r"warning: .*results\.h5 is not there: histories and energies begin at cycle \d+")

    def test_frames_of_before_stay_named_when_contacts_are_written_no_more(self):
        folder = self.root / "fewer"
        run_folder.run(HDEM, self.case, "-o", folder, "--set", "output.frame_every=300", "--set", "stage[1].cycles=100")
        before = {file.name for file in (folder / "frames").iterdir()}
        done = run_folder.run(HDEM, "--restart", folder, "--set", "output.contacts=false", "--set", "stage[1].cycles=900")
        self.assertEqual(done.returncode, 0, done.stderr)
        there = {file.name for file in (folder / "frames").iterdir()}
        named = {kind: {Path(each["name"]).name for each in json.loads((folder / f"{kind}.hdf.series").read_text(encoding="utf-8"))["files"]}
                 for kind in ("blocks", "contacts")}
        for kind, names in named.items():
            self.assertEqual(names, {name for name in there if name.startswith(kind)})
        self.assertTrue(named["contacts"] & before)
        self.assertGreater(len(named["blocks"]), len(named["contacts"]))
        self.assertEqual(run_folder.broken_files(folder), [])

    def test_only_the_same_physics_goes_on(self):
        folder = self.root / "other"
        run_folder.run(HDEM, self.case, "-o", folder, "--max-wall", "0.1s")
        for arguments, words in ((["--set", "joint.default.cohesion=1e3"], "keeps its blocks, joints and laws"),
                                 (["--method", "force"], "keeps its blocks, joints and laws"),
                                 ([self.root / "nothing.toml"], "does not exist")):
            refused = run_folder.run(HDEM, *arguments, "--restart", folder)
            self.assertEqual(refused.returncode, 2, refused.stdout)
            self.assertIn(words, refused.stderr)
        changed = self.root / "changed.toml"
        changed.write_text(run_folder.CASE.replace("7e9", "8e9"), encoding="utf-8")
        self.assertIn("is not the one", run_folder.run(HDEM, changed, "--restart", folder).stderr)
        done = run_folder.run(HDEM, self.case, "--restart", folder, "--set", "stage[1].cycles=2300", "--set", "output.row_every=100")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(run_folder.summary(folder)["cycles"], 3100)
        for setting, words in (("stage[0].cycles=900", " is over: the run is in stage "), ("stage[1].cycles=2000", " has lasted 2300 cycles already")):
            refused = run_folder.run(HDEM, "--restart", folder, "--set", setting)
            self.assertEqual(refused.returncode, 2, refused.stdout)
            self.assertIn(words, refused.stderr)
        self.assertIn("holds no checkpoint", run_folder.run(HDEM, "--restart", self.root).stderr)
        self.assertIn("does not exist", run_folder.run(HDEM, "--restart", self.root / "nowhere").stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
