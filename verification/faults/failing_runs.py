#!/usr/bin/python3
"""Disks that fill up, folders that may not be written, and models that blow up: exit code 1, a message that helps, and nothing lost.

    failing_runs.py HDEM    the program

The full disk is a small tmpfs; without the right to mount one that test says so and is skipped.
"""
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

try:
    import run_folder
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

HDEM = Path(sys.argv[1]).resolve()


class Disk:
    """A tmpfs of some size at `folder`, as long as a `with` block lasts."""

    def __init__(self, folder, size):
        self.folder, self.size = folder, size

    def __enter__(self):
        self.folder.mkdir()
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={self.size}", "tmpfs", self.folder], capture_output=True, text=True, check=False)
        if mount.returncode != 0:
            raise unittest.SkipTest(f"a tmpfs cannot be mounted ({mount.stderr.strip()}): run this test as root")
        return self

    def grow(self, size):
        subprocess.run(["mount", "-o", f"remount,size={size}", self.folder], check=True)

    def __exit__(self, *_):
        subprocess.run(["umount", self.folder], check=True)


class Faults(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = Path(scratch.name)
        self.root.chmod(0o755)
        self.case = run_folder.write_case(self.root)

    def expect_the_whole_run(self, folder):
        self.assertEqual(run_folder.run(HDEM, self.case, "-o", self.root / "whole").returncode, 0)
        done = run_folder.run(HDEM, "--restart", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(run_folder.summary(folder)["state_hash"], run_folder.summary(self.root / "whole")["state_hash"])
        self.assertEqual(run_folder.differing_results(folder, self.root / "whole"), [])

    def test_full_disk_ends_the_run_and_keeps_its_last_checkpoint(self):
        with Disk(self.root / "disk", "600k") as disk:
            folder = disk.folder / "out"
            failed = run_folder.run(HDEM, self.case, "-o", folder)
            self.assertEqual(failed.returncode, 1, failed.stdout)
            self.assertRegex(failed.stderr, r"error: .*: cannot be written \(No space left on device\)\. The disk or the quota is full")
            self.assertGreater(run_folder.checkpoint_cycle(folder), 0)
            self.assertEqual(run_folder.broken_files(folder), [])
            self.assertEqual(list(folder.rglob("*.tmp")), [], "what could not be finished is removed")
            disk.grow("100m")
            self.expect_the_whole_run(folder)

    def test_folder_that_may_not_be_written_any_more_ends_the_run(self):
        # root may write everywhere, so another user runs the program.
        user = {"user": "nobody"} if os.geteuid() == 0 else {}
        program = shutil.copy(HDEM, self.root / "hdem")
        folder = self.root / "out"
        folder.mkdir(mode=0o777)
        folder.chmod(0o777)
        with subprocess.Popen([program, "run", self.case, "-o", folder], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **user) as run:
            while not (folder / "checkpoint.h5").exists() and run.poll() is None:
                time.sleep(0.005)
            folder.chmod(0o555)
            _, message = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 1, message)
        self.assertRegex(message, r"error: .*: cannot be written \(Permission denied\)\. Give a folder that may be written: with -o")
        self.assertEqual(run_folder.broken_files(folder), [])
        again = subprocess.run([program, "run", "--restart", folder], capture_output=True, text=True, check=False, **user)
        self.assertEqual(again.returncode, 1, again.stdout)
        self.assertIn(str(folder), again.stderr)
        folder.chmod(0o777)
        self.expect_the_whole_run(folder)

    def expect_a_stop_with_a_frame_of_the_moment(self, message, *settings):
        folder = self.root / "stopped"
        failed = run_folder.run(HDEM, self.case, "-o", folder, *settings)
        self.assertEqual(failed.returncode, 1, failed.stdout)
        self.assertRegex(failed.stderr, message)
        for said in (failed.stdout + failed.stderr, (folder / "run.log").read_text(encoding="utf-8")):
            self.assertEqual(said.count("error: "), 1, "once on the screen, once in the log")
        with run_folder.h5py.File(folder / "results.h5") as results:
            last = int(results["frames/cycle"][-1])
            self.assertEqual(last, int(results["energy/cycle"][-1]))
        self.assertIn(f"cycle {last},", failed.stderr, "the last frame is that of the moment")
        self.assertEqual(run_folder.broken_files(folder), [])
        return folder

    def test_overlap_above_its_limit_stops_with_a_frame_of_the_moment(self):
        self.expect_a_stop_with_a_frame_of_the_moment(
            r'error: cycle \d+, time \S+ s: blocks "[\w.]+" and "[\w.]+", contact \d+ at \(\S+, \S+\) m: overlap = .*contact\.overlap_limit.*time\.step',
            "--set", "contact.overlap_limit=1e-7")

    def test_state_that_is_not_finite_stops_with_a_frame_of_the_moment(self):
        with self.case.open("a", encoding="utf-8") as file:
            file.write('[[load]]\nblocks = ["b60"]\nforce = [1e18, 0.0]\n')
        weightless = ("time.step=1e-4", "material.rock.density=1e-300", 'contact.method="impulse"')    # 1e318 m/s2
        folder = self.expect_a_stop_with_a_frame_of_the_moment(
            r'error: cycle \d+, time \S+ s: block "\w+": position or velocity is not a finite number.*time\.step',
            *(word for setting in weightless for word in ("--set", setting)))
        self.assertEqual(run_folder.checkpoint_cycle(folder), -1, "a state that blew up is not kept")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
