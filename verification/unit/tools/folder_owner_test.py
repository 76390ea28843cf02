#!/usr/bin/python3
"""Whose a folder is: runs whose folder goes, files that are not hdem's, checkpoints of other moments and of other runs.

    folder_owner_test.py HDEM CASES    the program, and the folder of the cases

Exit code 77 (skipped) without h5py.
"""
import os
import resource
import shutil
import subprocess
import sys
import time
import unittest
import unittest.mock

try:
    import h5py
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
from folder_scratch import CASES, HDEM, OUT_OF_TIME, REFUSED, FolderTest, content

RUN_FAILED, TERMINATED, OUT_OF_CPU = 1, 143, 152


def wait_until(happens):
    for _ in range(3000):
        if happens():
            return
        time.sleep(0.01)
    raise AssertionError("does not happen")


def wait_for(file):
    wait_until(file.exists)


def wait_for_another(file):
    before = file.stat().st_mtime_ns
    wait_until(lambda: file.stat().st_mtime_ns != before)


def cycles_of(folder):
    with h5py.File(folder / "results.h5") as results:
        return list(results["energy/cycle"])


class FolderOwner(FolderTest):
    def begin(self, case, folder, *settings):
        """A run in its second stage, which has no end; killed when the test is over."""
        words = [word for text in ("stage[1].cycles=1000000000", *settings) for word in ("--set", text)]
        run = subprocess.Popen([HDEM, "run", case, "-o", folder, "-q", *words], stderr=subprocess.PIPE, text=True)    # pylint: disable=consider-using-with
        self.addCleanup(run.communicate)
        self.addCleanup(run.kill)
        return run

    def test_a_run_whose_folder_is_moved_ends(self):
        for take_away in (lambda: self.folder.rename(self.root / "moved"), lambda: shutil.rmtree(self.folder)):
            first = self.begin(self.case, self.folder, "output.row_every=1000", "output.frame_every=1000000000")
            wait_for(self.folder / "frames/blocks_000001.hdf")
            take_away()
            self.run_case()
            self.assertIn("moved or removed", first.communicate(timeout=60)[1])
            self.assertEqual(first.returncode, RUN_FAILED)
            alone = self.root / "alone"
            self.hdem("run", self.case, "-o", alone, "-q")
            self.assertEqual(sorted(content(self.folder)), sorted(content(alone)))
            self.assertEqual(cycles_of(self.folder), cycles_of(alone))
            shutil.rmtree(self.folder)

    def test_files_that_are_not_of_hdem_stay(self):
        self.folder.mkdir()
        (self.folder / "frames").mkdir()
        for name in ("results.h5", "summary.json", "view.html", "run.log", "frames/blocks_000000.hdf"):
            (self.folder / name).write_text("mine", encoding="utf-8")
            self.expect_untouched(name, "run", self.case, "-o", self.folder, "-q")
            self.expect_untouched(f"{name}|holds a run", "critical", CASES / "fos/slab.toml", "--vary", "gravity.tilt_deg=0:1", "--fails", "detached>0", "-o", self.folder)
            (self.folder / name).unlink()
        mine = [self.folder / name for name in ("failure/notes.txt", "before_last_stage/photo.jpg", "frames/film.mp4", "thesis.0123456789ab.tmp")]
        for file in mine:
            file.parent.mkdir(exist_ok=True)
            file.write_text("mine", encoding="utf-8")
        for more in ((), (), ("--overwrite",)):
            self.run_case(*more)
            self.assertEqual([file.read_text(encoding="utf-8") for file in mine], ["mine"] * len(mine))

    def test_a_run_inside_a_folder_stays(self):
        self.run_case()
        inside = self.folder / "failure"
        run = self.begin(self.other, inside)
        wait_for(inside / "frames/blocks_000001.hdf")
        self.assertIn("another run is in this folder", self.hdem("run", self.case, "-o", self.folder, "-q", code=REFUSED))
        self.assertTrue((inside / "frames/blocks_000000.hdf").exists())
        run.terminate()
        self.assertEqual(run.wait(60), TERMINATED)

    def test_younger_checkpoints_are_put_aside(self):
        kept, last = self.folder / "kept.h5", self.folder / "checkpoint.h5"
        run = self.begin(self.case, self.folder, "output.checkpoint_every=1000")
        wait_for(last)
        shutil.copy(last, kept)
        for _ in range(2):
            wait_for_another(last)
        run.terminate()
        self.assertEqual(run.wait(60), TERMINATED)
        self.hdem("run", "--restart", kept, "-q", "--set", "output.checkpoint_every=1000000000", "--max-wall", "0.3s", code=OUT_OF_TIME)
        for name in ("checkpoint.h5", "checkpoint.previous.h5"):
            self.assertTrue((self.folder / f"{name}.younger").exists(), name)

    def test_a_checkpoint_of_the_same_second_with_other_values_is_refused(self):
        with unittest.mock.patch.dict(os.environ, SOURCE_DATE_EPOCH="1000000000"):
            self.run_case("--set", "material.rock.density=2000")
            self.hdem("run", self.case, "-o", self.root / "heavy", "-q", "--set", "material.rock.density=3000")
            shutil.copy(self.root / "heavy/checkpoint.h5", self.folder)
            self.expect_untouched("of another one", "run", "--restart", self.folder, "-q", "--set", "stage[1].cycles=700")

    def test_a_number_of_a_stage_under_two_names(self):
        for text in ("stage.two.cycles=100000000", "stage[1].cycles=300000000"):
            self.run_case("--set", text, "--max-wall", "0.1s", *(["--restart", self.folder] if self.folder.exists() else []), code=OUT_OF_TIME)
        self.run_case("--restart", self.folder, "--set", "stage.two.cycles=100000000", "--max-wall", "0.1s", code=OUT_OF_TIME)
        said = self.hdem("info", self.folder / "checkpoint.h5")
        self.assertLess(said.rindex("300000000"), said.rindex("stage.two.cycles=100000000"), said)

    def test_a_factor_of_safety_is_not_lost_without_a_word(self):
        slab = CASES / "fos/slab.toml"
        self.hdem("fos", slab, "-o", self.folder, "-q")
        self.expect_untouched("holds the factor of safety", "run", "--restart", self.folder, "-q")
        self.hdem("fos", slab, "-o", self.folder, "-q")
        self.assertIn("the factor of safety in this folder is replaced", self.hdem("run", slab, "-o", self.folder))
        self.assertIn("are replaced", self.hdem("run", slab, "-o", self.folder, "--set", "joint.default.cohesion=1e6"))

    def test_logs_begin_with_the_program(self):
        """By it a folder is known, also that of a run that was killed before it had results."""
        self.run_case()
        self.hdem("run", self.other, "-o", self.folder, "-q")
        log = (self.folder / "run.log").read_text(encoding="utf-8")
        self.assertTrue(log.startswith("hdem "), log[:100])
        self.assertIn("are replaced", log)
        for file in self.folder.iterdir():
            if file.is_file() and file.name not in ("run.log", "summary.json"):
                file.unlink()
        self.run_case()

    def test_words_that_mean_nothing_are_refused(self):
        self.run_case()
        for words in (["--threads", "0x10"], ["--threads", "1e2"], ["--threads", "-1"], ["--max-wall", "1e400"], ["--max-wall", "nan"], ["--restart", ""]):
            self.expect_untouched(words[0], "run", self.case, "-q", "-o", self.folder, *words)
        self.assertIn("-o", self.hdem("run", self.case, "-q", "-o", "", code=REFUSED))

    def test_a_limit_on_processor_time_leaves_a_checkpoint(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (1, 60))
        done = subprocess.run([HDEM, "run", self.case, "-q", "-o", self.folder, "--threads", "1", "--set", "stage[1].cycles=1000000000"],
                              preexec_fn=limit, capture_output=True, text=True, check=False, timeout=120)
        self.assertEqual(done.returncode, OUT_OF_CPU, done.stderr)
        self.assertIn("SIGXCPU: stopped after cycle", (self.folder / "run.log").read_text(encoding="utf-8"))
        self.hdem("run", "--restart", self.folder, "-q", "--max-wall", "0.1s", code=OUT_OF_TIME)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
