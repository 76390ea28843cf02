#!/usr/bin/python3
"""Frames of a small run as ParaView 5.11 or later reads them, and the picture of tools/paraview_view.py.

    paraview_test.py HDEM TOOLS [PICTURE.png]    the program, the folder of its scripts, and where to keep the picture

ParaView opens the series as by a double click and must find every field, number for number, that h5py finds. Exit code 77
(skipped) without ParaView: `tools/setup --paraview` installs it (1 GB, hence not by default).
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy as np
    import matplotlib.image
    import h5py
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
if not all(map(shutil.which, ("pvbatch", "Xvfb"))):
    print("skipped: no pvbatch or no Xvfb; tools/setup --paraview installs them")
    sys.exit(77)

HERE = Path(__file__).resolve().parent
HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
KEPT = Path(sys.argv[3]).resolve() if len(sys.argv) > 3 else None
sys.path[:0] = [str(TOOLS), str(HERE.parent / "unit/tools")]
import hdem_io       # noqa: E402
import small_case    # noqa: E402

# What a user of ParaView finds to colour by.
FIELDS = {"blocks": {"id", "displacement", "velocity", "rotation", "speed", "regime", "detached", "kinetic_energy", "stress_xx", "stress_yy", "stress_xy"},
          "contacts": {"blocks", "normal_force", "shear_force", "normal_stress", "shear_stress", "overlap", "slip", "regime"}}
POLYGON, LINE = 7, 3


class Screen:
    """One that is none. It must not begin anew when a window closes: the next window would find no screen for a moment."""

    def __init__(self, scratch):
        with open(f"{scratch}/screen.log", "w", encoding="utf-8") as log:
            ready, tell = os.pipe()
            self.server = subprocess.Popen(["Xvfb", "-displayfd", str(tell), "-screen", "0", "1600x1200x24", "-noreset", "-nolisten", "tcp"], pass_fds=[tell],
                                           stdout=log, stderr=log)
            os.close(tell)
        with os.fdopen(ready) as number:    # told once it takes connections
            self.display = ":" + number.readline().strip()

    def close(self):
        self.server.terminate()
        self.server.wait()


def pvbatch(screen, script, *arguments):
    """ParaView, with a folder of its own for MPI: in a shared one, another program's end may take it away."""
    with tempfile.TemporaryDirectory(prefix="pv") as own:
        environment = os.environ | {"LIBGL_ALWAYS_SOFTWARE": "1", "TMPDIR": own, "DISPLAY": screen.display}
        done = subprocess.run(["pvbatch", script, *map(str, arguments)], timeout=900, env=environment, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"pvbatch {script}: exit code {done.returncode}\n{done.stdout}{done.stderr}")


class Frames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_paraview_test_")
        cls.folder = small_case.run(HDEM, Path(cls.scratch.name))
        cls.screen = Screen(cls.scratch.name)
        cls.addClassCleanup(cls.screen.close)
        pvbatch(cls.screen, HERE / "dump_arrays.py", cls.folder, cls.folder / "seen.json")
        cls.seen = json.loads((cls.folder / "seen.json").read_text(encoding="utf-8"))
        cls.run_ = hdem_io.open_run(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_times_are_those_of_the_run(self):
        for kind in FIELDS:
            self.assertEqual([frame["time"] for frame in self.seen[kind]], [frame.time for frame in self.run_.frames], kind)

    def test_cells_are_polygons_and_lines(self):
        for kind, cell in (("blocks", POLYGON), ("contacts", LINE)):
            for frame in self.seen[kind]:
                self.assertEqual(frame["kinds"], [cell] if frame["cells"] else [])
        self.assertGreater(self.seen["contacts"][-1]["cells"], 0)

    def test_every_field_is_there_with_its_values(self):
        for kind, fields in FIELDS.items():
            for frame, seen in zip(self.run_.frames, self.seen[kind]):
                if not seen["cells"]:    # ParaView drops the arrays of a frame without cells
                    continue
                self.assertLessEqual(fields, set(seen["arrays"]), kind)
                with h5py.File(self.folder / "frames" / f"{kind}_{frame.number:06d}.hdf") as opened:
                    grid = opened["VTKHDF"]
                    self.assertEqual((seen["cells"], seen["points"]), (grid["NumberOfCells"][0], grid["NumberOfPoints"][0]))
                    self.assertEqual(set(seen["arrays"]), set(grid["CellData"]))
                    for name, data in grid["CellData"].items():
                        columns = data[...].reshape(len(data), -1)
                        expected = np.stack([columns.min(axis=0), columns.max(axis=0)], axis=1)
                        np.testing.assert_array_equal(np.float32(seen["arrays"][name]["ranges"]), np.float32(expected), f"{kind} {frame} {name}")

    def test_picture_shows_the_blocks(self):
        picture = KEPT or self.folder / "picture.png"
        pvbatch(self.screen, TOOLS / "paraview_view.py", self.folder, "-o", picture, "--contacts", "--size", "700", "500")
        pixels = matplotlib.image.imread(picture)[..., :3]
        self.assertEqual(pixels.shape[:2], (500, 700))
        share = np.mean(np.any(pixels < 0.95, axis=-1))
        self.assertTrue(0.1 < share < 0.9, f"{share:.2f} of the picture is not background")
        self.assertGreater(len(np.unique((pixels * 8).astype(int).reshape(-1, 3), axis=0)), 4, "several colours")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
