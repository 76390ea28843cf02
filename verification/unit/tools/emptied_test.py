#!/usr/bin/python3
"""A run whose last stage removes every block: plot, report, view and film show what there was, and say that nothing is left.

    emptied_test.py HDEM TOOLS    the program, and the folder of its scripts (not used)

Exit code 77 (skipped) without h5py or matplotlib.
"""
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import h5py    # noqa: F401
    import matplotlib.image
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import small_case
from view_page import ViewPage

HDEM = Path(sys.argv[1]).resolve()
VIEWER = HDEM.parent.parent / "share/hdem/view/viewer.html"
LAST_STAGE = '[[stage]]\nname = "all goes"\ncycles = 100\nexcavate = ["ground", "l", "ball"]\n[output]'


class EmptiedRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_emptied_test_")
        cls.folder = small_case.run(HDEM, Path(cls.scratch.name), small_case.CASE.replace("[output]", LAST_STAGE, 1))

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def made(self, command, *arguments):
        """The file that it made."""
        done = subprocess.run([HDEM, command, self.folder, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return Path(done.stdout.strip())

    def test_picture_is_as_large_as_before_and_says_that_all_is_gone(self):
        sizes = []
        for frame in ("0", "last"):
            picture = self.made("plot", "--frame", frame, "-o", self.folder / "one.svg").read_text()
            sizes.append(re.search(r'viewBox="([^"]*)"', picture)[1])
            self.assertEqual("no blocks are left" in picture, frame == "last")
        self.assertEqual(*sizes)

    def test_each_kind_of_picture_can_be_drawn(self):
        for arguments in (["--contacts"], ["--crosses"], ["--joints", "slip"], ["--excavation"], ["--colour", "material"], ["--colour", "rotation"]):
            with self.subTest(arguments):
                self.made("plot", *arguments, "-o", self.folder / "other.png", "--dpi", "60")

    def test_single_frame_can_be_drawn(self):
        frame = sorted((self.folder / "frames").glob("blocks_*.hdf"))[-1]
        done = subprocess.run([HDEM, "plot", frame, "-o", self.folder / "single.png"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_report_has_its_sections(self):
        text = self.made("report").read_text(encoding="utf-8")
        for words in ("Displacement and stress", "Energy ledger", "data:image/svg+xml"):
            self.assertIn(words, text)

    @unittest.skipUnless(VIEWER.exists(), "hdem was built without the viewer")
    def test_page_has_all_frames_and_the_last_one_is_empty(self):
        page = ViewPage(self.made("view"))
        blocks = [len(page.poses(number)[0]) for number in range(len(page.runs[0]["frames"]))]
        self.assertEqual(blocks, [4, 4, 3, 0])
        self.assertEqual(page.runs[0]["blocks"], 4)

    @unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
    def test_film_has_all_frames(self):
        film = self.made("view", "--movie", self.folder / "film.gif", "--width", "320")
        asked = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames", "-of", "csv=p=0", film],
                               capture_output=True, text=True, check=True)
        self.assertEqual(asked.stdout.strip(), "4")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
