#!/usr/bin/python3
"""Bolts and linings in frames, pictures and searches. Skipped without numpy, h5py and matplotlib.

    bolts_test.py HDEM CASES TOOLS    the program, its cases, the folder of its scripts
"""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import h5py    # noqa: F401
    import matplotlib.image
    import numpy as np
except ImportError:
    sys.exit(77)

HDEM, CASES, TOOLS = (Path(argument).resolve() for argument in sys.argv[1:4])
sys.path.insert(0, str(TOOLS))
from hdem_io import open_run    # noqa: E402


def hdem(*arguments, code=0):
    done = subprocess.run([HDEM, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == code, f"{done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


class Frames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_bolts_")
        cls.folder = Path(cls.scratch.name) / "pull"
        hdem("run", CASES / "pull.toml", "-o", cls.folder, "--set", "output.frame_every=1000", "-q")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_have_the_force_of_their_moment(self):
        run, history = open_run(self.folder), open_run(self.folder).history("cable")
        self.assertEqual([frame.cycle for frame in run.frames], [0, 1000, 2000, 3000])
        self.assertEqual(len(run.bolts(0)["bolt"]), 0, "not installed before the first stage")
        for number in (1, 2, 3):
            bolts = run.bolts(number)
            self.assertEqual(list(bolts["name"]), ["cable"])
            self.assertAlmostEqual(bolts["axial_force"][0] / history["axial_force"][history["cycle"] == 1000 * number][0], 1.0, places=6)
            self.assertEqual(bolts["status"][0], 1 if number == 1 else 2, "the bond slips from 1.56 mm on")
        with h5py.File(self.folder / "results.h5") as results:
            self.assertEqual(results["frames/bolts/000003/CellData/axial_force"].shape, (1,))
        series = json.loads((self.folder / "bolts.hdf.series").read_text(encoding="utf-8"))
        self.assertEqual(len(series["files"]), 4)
        self.assertIn("frame of bolts", hdem("info", self.folder / "frames/bolts_000001.hdf"))

    def test_are_drawn_for_any_frame(self):
        pictures = []
        for frame in (1, 3):
            picture = Path(self.scratch.name) / f"bolts{frame}.png"
            hdem("plot", self.folder, "--bolts", "--colour", "none", "--frame", frame, "--title", "bolts", "-o", picture)
            pictures.append(matplotlib.image.imread(picture))
        self.assertTrue(pictures[0].shape != pictures[1].shape or np.any(pictures[0] != pictures[1]), "other forces, another picture")

    def test_a_case_without_bolts_says_so(self):
        case = Path(self.scratch.name) / "none.toml"
        case.write_text((CASES / "pull.toml").read_text(encoding="utf-8").split("[[bolt]]")[0] + "[[stage]]\ncycles = 10\n", encoding="utf-8")
        folder = Path(self.scratch.name) / "none"
        hdem("run", case, "-o", folder, "-q")
        self.assertFalse((folder / "bolts.hdf.series").exists())
        self.assertIn("has no bolts", hdem("plot", folder, "--bolts", code=2))

    def test_pull_out_figure(self):
        picture = Path(self.scratch.name) / "figure.png"
        done = subprocess.run([TOOLS / "pull_out_figure.py", self.folder, "-o", picture], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(matplotlib.image.imread(picture)[..., :3].std(), 0.01, "not a blank page")


class Linings(unittest.TestCase):
    """A ring of 3 m radius under a pressure of 0.2 MPa that grows over 1000 cycles: its thrust is pressure times radius."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_linings_")
        cls.folder = Path(cls.scratch.name) / "ring"
        hdem("run", CASES / "ring.toml", "-o", cls.folder, "--set", "output.frame_every=500", "-q")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_have_the_force_of_their_moment(self):
        run = open_run(self.folder)
        self.assertEqual([len(run.liners(number)["liner"]) for number in range(5)], [0, 72, 72, 72, 72], "not installed before the first stage")
        for number, pressure in ((1, 0.1e6), (4, 0.2e6)):
            liners = run.liners(number)
            self.assertEqual(set(liners["name"]), {"ring"})
            self.assertAlmostEqual(liners["thrust"].mean() / (3.0 * pressure), 1.0, delta=0.02)
            np.testing.assert_allclose(np.hypot(*liners["points"].reshape(-1, 2).T), 3.0, atol=2e-3)
        summary = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))["liners"][0]["segments"]
        np.testing.assert_allclose(run.liners()["thrust"], [piece["thrust"] for piece in summary], rtol=1e-6)
        for end, name in enumerate(("moment_from", "moment_to")):
            np.testing.assert_allclose(run.liners()[name], [piece["moment"][end] for piece in summary], rtol=1e-6, atol=1e-6)
        with h5py.File(self.folder / "results.h5") as results:
            self.assertEqual(results["frames/liners/000004/CellData/thrust"].shape, (72,))
        self.assertIn("frame of liners", hdem("info", self.folder / "frames/liners_000001.hdf"))

    def test_are_drawn_for_any_frame(self):
        pictures = {}
        for frame, kind in ((1, "thrust"), (4, "thrust"), (4, "moment")):
            picture = Path(self.scratch.name) / f"{kind}{frame}.png"
            hdem("plot", self.folder, "--liners", kind, "--colour", "none", "--frame", frame, "--title", "ring", "-o", picture)
            pictures[frame, kind] = matplotlib.image.imread(picture)
        self.assertTrue(pictures[1, "thrust"].shape != pictures[4, "thrust"].shape or np.any(pictures[1, "thrust"] != pictures[4, "thrust"]))
        self.assertTrue(np.any(pictures[4, "moment"] != pictures[4, "thrust"]))

    def test_a_case_without_linings_says_so(self):
        folder = Path(self.scratch.name) / "pull"
        hdem("run", CASES / "pull.toml", "-o", folder, "--set", "stage.pull.cycles=10", "-q")
        self.assertFalse((folder / "liners.hdf.series").exists())
        self.assertIn("has no linings", hdem("plot", folder, "--liners", "thrust", code=2))


class Searches(unittest.TestCase):
    def test_critical_counts_blocks_that_are_lost(self):
        with tempfile.TemporaryDirectory(prefix="hdem_bolts_") as folder:
            text = hdem("critical", CASES / "hung.toml", "--vary", "load[0].force[1]=-2e5:-5e4", "--fails", "detached>0", "--set", "bolt[0].yield=1.2e5",
                        "--set", "bolt[0].pretension=0", "--set", "stage[0].max_cycles=30000", "-o", folder)
            self.assertIn("number of detached blocks", text)
            found = json.loads((Path(folder) / "summary.json").read_text(encoding="utf-8"))
            self.assertAlmostEqual(found["critical"] / -1.2e5, 1.0, delta=0.01, msg="beyond the bolt's yield it falls")
            self.assertLess(found["fails_at"], found["stands_at"])
            for wrong in ("detached", "detached>", "detached>-1", "lost>0"):
                self.assertIn("detached>NUMBER", hdem("critical", CASES / "hung.toml", "--vary", "load[0].force[1]=-2e5:-5e4", "--fails", wrong, "-o", folder, code=2))
            self.assertIn("--tolerance 200000: (is not below the width of the range, 150000", hdem("critical", CASES / "hung.toml", "--vary", "load[0].force[1]=-2e5:-5e4", "--fails",
                                                                                                 "detached>0", "--tolerance", "2e5", "-o", folder, code=2))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
