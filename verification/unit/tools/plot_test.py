#!/usr/bin/python3
"""A small run of the program, read by hdem_io.py and drawn by `hdem plot`.

    plot_test.py HDEM TOOLS    the program, and the folder of hdem_io.py and plot.py

Exit code 77 (skipped) without h5py or matplotlib.
"""
import fcntl
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree
from pathlib import Path

try:
    import numpy as np
    import matplotlib.image
    import h5py
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.path[:0] = [str(TOOLS), str(TOOLS / "view")]
import hdem_io    # noqa: E402
import movie      # noqa: E402
import plot       # noqa: E402
import small_case    # noqa: E402


def area(polygon):
    x, y = np.asarray(polygon).T
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


class SmallRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_plot_test_")
        cls.folder = small_case.run(HDEM, Path(cls.scratch.name))
        cls.run_ = hdem_io.open_run(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def plot(self, *arguments):
        """Exit code and what was said."""
        done = subprocess.run([HDEM, "plot", *map(str, arguments)], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_says_which_file_it_has_written(self):
        self.assertEqual(self.plot(self.folder, "-o", self.folder / "shown"), (0, f"{self.folder / 'shown.png'}\n"))
        self.assertTrue((self.folder / "shown.png").exists())
        code, said = self.plot(self.folder, "-o", self.folder)
        self.assertEqual(code, 2)
        self.assertIn("a folder. Give the name of a picture with -o.", said)
        self.assertEqual(self.plot(self.folder, "-o", "/proc/x.png"), (1, "error: hdem plot: /proc/x.png: cannot be written (No such file or directory). Give the name of a picture with -o.\n"))

    def test_frames_are_those_of_the_ends_of_stages(self):
        self.assertEqual([(frame.cycle, frame.stage) for frame in self.run_.frames if frame.cycle > 0], [(200, "settle"), (1700, "fall")])
        self.assertEqual(hdem_io.open_run(self.folder / "results.h5").frames, self.run_.frames)

    def test_polygons_are_the_blocks(self):
        blocks = self.run_.blocks(0)
        self.assertEqual(list(blocks["name"]), ["ground", "l", "prop", "ball"])
        for polygon, expected in zip(blocks["polygon"], blocks["area"]):
            self.assertAlmostEqual(area(polygon), expected, places=9)
        self.assertAlmostEqual(area(blocks["polygon"][1]), 3.0, places=9)
        self.assertGreater(np.count_nonzero(blocks["part_block"] == 1), 1, "a concave block has several parts")
        lengths = np.linalg.norm(blocks["edges"][:, 1] - blocks["edges"][:, 0], axis=1)
        self.assertAlmostEqual(lengths[blocks["edge_block"] == 1].sum(), 8.0, places=9)
        self.assertEqual(blocks["displacement"].shape, (4, 2))

    def test_excavated_block_is_gone_and_fallen_one_detached(self):
        blocks = self.run_.blocks("last")
        self.assertEqual(list(blocks["name"]), ["ground", "l", "ball"])
        self.assertEqual(list(blocks["detached"]), [0, 0, 1])
        self.assertEqual(list(blocks["fixed"]), [1, 0, 0])
        self.assertAlmostEqual(np.linalg.norm(blocks["outline"][:, 1] - blocks["outline"][:, 0], axis=1).sum(), 4.0, places=9)
        self.assertEqual(blocks["info"]["title"], "Small run")

    def test_contacts_carry_the_weight(self):
        contacts = self.run_.contacts("last")
        blocks = self.run_.blocks("last")
        on_l = np.any(blocks["name"][np.searchsorted(blocks["id"], contacts["blocks"])] == "l", axis=1)
        self.assertAlmostEqual(contacts["normal_force"][on_l].sum() / (3.0 * 2700.0 * 9.81), 1.0, places=2)
        self.assertEqual(contacts["points"].shape[1:], (2, 2))

    def test_histories_have_units_and_end_with_the_run(self):
        rest = self.run_.history("rest")
        self.assertEqual(rest.unit["normal_force"], "N")
        self.assertEqual(rest["cycle"][-1], 1700)
        self.assertAlmostEqual(rest["normal_force"][-1] / (3.0 * 2700.0 * 9.81), 1.0, places=2)
        self.assertEqual(sorted(self.run_.history("ball")), ["cycle", "displacement_x", "displacement_y", "speed", "time"])
        self.assertIn("kinetic_energy", self.run_.energy())
        self.assertEqual(self.run_.provenance()["case_text"], small_case.CASE)
        with self.assertRaisesRegex(hdem_io.ResultError, "ball, rest"):
            self.run_.history("nothing")

    def test_every_colour_gives_a_picture(self):
        for colour in [*plot.FIELDS, *plot.CLASSES]:
            picture = self.folder / f"{colour}.png"
            code, said = self.plot(self.folder, "-o", picture, "--colour", colour, "--dpi", "80")
            self.assertEqual((code, said.strip()), (0, str(picture)))
            self.assertGreater(matplotlib.image.imread(picture)[..., :3].std(), 0.01, "not a blank page")

    def test_range_of_rotations_is_in_rad_as_that_of_a_film(self):
        for low, high, arguments in ((-0.01, 0.02, ["--range", "-0.01", "0.02"]), (-0.02, 0.02, [])):
            options = plot.parse([str(self.folder), "--colour", "rotation", *arguments])
            options.range = options.range or movie.scaled(-0.01, 0.02, "rotation")
            figure = plot.draw_frame(self.run_, options)
            np.testing.assert_allclose(figure.axes[0].collections[0].get_clim(), np.degrees([low, high]), rtol=1e-12)
            self.assertEqual(figure.axes[1].get_ylabel(), "rotation [deg]")
            plot.plt.close(figure)

    def test_contacts_that_were_not_written_are_told_with_their_key(self):
        folder = Path(self.scratch.name) / "without_contacts"
        shutil.copytree(self.folder, folder)
        for file in (folder / "frames").glob("contacts_*"):
            file.unlink()
        for arguments in (["--contacts"], ["--joints", "slip"]):
            code, said = self.plot(folder, *arguments)
            self.assertEqual((code, said), (2, f"error: hdem plot: {folder}: holds no contacts of frame 2: output.contacts of the case is false, or the file was removed. Set "
                                               "output.contacts = true, and run the case again.\n"))

    def test_other_pictures(self):
        for arguments in (["--contacts"], ["--excavation"], ["--frame", "0"], ["--window", "0", "0", "2", "2"], ["--history", "energy"], ["--energy"],
                          ["--history", "ball"], ["--range", "0", "1e-3"]):
            picture = self.folder / "other.png"
            code, said = self.plot(self.folder / "results.h5", "-o", picture, "--dpi", "80", *arguments)
            self.assertEqual(code, 0, said)
            picture.unlink()

    def test_vector_pictures_are_the_same_each_time(self):
        for name in ("one.svg", "two.svg"):
            self.assertEqual(self.plot(self.folder, "-o", self.folder / name)[0], 0)
        self.assertEqual((self.folder / "one.svg").read_text(), (self.folder / "two.svg").read_text())
        xml.etree.ElementTree.parse(self.folder / "one.svg")

    def test_errors_say_what_is_wrong(self):
        for arguments, expected, words in ((["nowhere"], 2, "no such file"), ([self.folder, "--frame", "77"], 2, "has no frame 77"),
                                           ([self.folder, "--colour", "pink"], 2, "invalid choice"), ([self.folder / "run.log"], 2, "cannot be read"), ([self.folder / "frames"], 2, "results.h5: no such file"),
                                           ([self.folder, "--history", "x"], 2, "histories are ball, rest"),
                                           ([self.folder, "--window", "900", "900", "950", "950"], 2, "--window: nothing is drawn there. What there is spans ("),
                                           ([self.folder, "--range", "5", "3"], 2, "--range 5 3: no range"), ([self.folder, "--range", "nan", "3"], 2, "no range"),
                                           ([self.folder, "-o", self.folder / "a.xyz"], 2, "xyz"), ([self.folder, "-o", self.folder / "run.log/a.png"], 1, "run.log")):
            code, said = self.plot(*arguments)
            self.assertEqual(code, expected, said)
            self.assertIn(words, said)
            self.assertNotIn("Traceback", said)


class Surroundings(unittest.TestCase):
    def test_picture_fits_linings_and_water_beside_the_blocks(self):
        with tempfile.TemporaryDirectory(prefix="hdem_plot_test_") as scratch:
            run = hdem_io.open_run(small_case.run(HDEM, Path(scratch), small_case.BESIDE))
            for arguments, box in (([], (-1.0, -5.0, 9.0, 2.0)), (["--liners", "moment"], (-1.0, -5.0, 9.0, 12.0))):
                figure = plot.draw_frame(run, plot.parse([str(run.folder), *arguments]))
                (x0, x1), (y0, y1) = figure.axes[0].get_xlim(), figure.axes[0].get_ylim()
                self.assertTrue(x0 < box[0] and y0 < box[1] and x1 > box[2] and y1 > box[3], (arguments, x0, y0, x1, y1))
                self.assertTrue(x0 > box[0] - 3.0 and y0 > box[1] - 3.0 and x1 < box[2] + 3.0 and y1 < box[3] + 3.0, (arguments, x0, y0, x1, y1))
                diagrams = [c.get_paths() for c in figure.axes[0].collections if isinstance(c, plot.PolyCollection) and c.get_alpha()]
                for path in sum(diagrams, []):
                    self.assertTrue(np.all((path.vertices > (x0, y0)) & (path.vertices < (x1, y1))), "the diagram of the lining is cut off")
                plot.plt.close(figure)


class Holes(unittest.TestCase):
    def test_polygon_is_the_outer_ring_and_holes_are_apart(self):
        """Rock around two tunnels that are not excavated yet: what is inside them is a block, and the rock has holes there."""
        tunnel = '[[excavation]]\nname = "{}"\nshape = "rectangle"\nposition = [{}, 2]\nwidth = 1.0\nheight = {}\ninside = "one_block"\n'
        case = '[domain]\nwidth = 8\nheight = 4\n[[joint_set]]\ndip_deg = 0\nspacing = 9\norigin = [0, 9]\n' + tunnel.format("a", 2, 1.5) + tunnel.format("b", 5, 0.5)
        with tempfile.TemporaryDirectory(prefix="hdem_plot_test_") as scratch:
            folder = small_case.run(HDEM, Path(scratch), case + small_case.ROCK + '[[stage]]\ncycles = 1\n')
            blocks = hdem_io.open_run(folder).blocks(0)
        self.assertEqual(len(blocks["id"]), 3)
        for name, polygon, holes, wanted in zip(blocks["name"], blocks["polygon"], blocks["holes"], blocks["area"]):
            self.assertAlmostEqual(area(polygon) - sum(map(area, holes)), wanted, places=9, msg=name)
        rock = int(np.argmax(blocks["area"]))
        self.assertAlmostEqual(area(blocks["polygon"][rock]), 32.0, places=9)
        self.assertEqual([round(area(hole), 9) for hole in blocks["holes"][rock]], [0.5, 1.5])
        self.assertEqual(sorted(map(len, blocks["holes"])), [0, 0, 2])


class InterruptedRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_plot_test_")
        case, cls.folder = Path(cls.scratch.name, "long.toml"), Path(cls.scratch.name, "out")
        case.write_text(small_case.CASE.replace("cycles = 1500", "cycles = 100000000"), encoding="utf-8")
        process = subprocess.Popen([HDEM, "run", case, "-o", cls.folder, "--quiet"])
        limit = time.monotonic() + 60.0
        while not (cls.folder / "frames/blocks_000001.hdf").exists() and time.monotonic() < limit:
            time.sleep(0.05)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        if process.wait(60) != 130:
            raise RuntimeError("the run was not interrupted")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def drawn(self, *arguments):
        """Texts of the picture, and what was said besides its name."""
        picture = self.folder / "a.svg"
        done = subprocess.run([HDEM, "plot", self.folder, "-o", picture, *arguments], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.strip(), str(picture))
        return ["".join(text.itertext()) for text in xml.etree.ElementTree.parse(picture).iter("{http://www.w3.org/2000/svg}text")], done.stderr

    def test_picture_is_of_the_interruption_and_says_so(self):
        run = hdem_io.open_run(self.folder)
        last = run.frames[-1]
        self.assertEqual(run.state(), "interrupted")
        self.assertGreater(last.cycle, 200)
        moment = f'stage "fall", cycle {last.cycle}, {last.time:.6g} s, interrupted'
        texts, said = self.drawn()
        self.assertIn(moment, texts)
        self.assertEqual(said, f"the picture shows {moment}\n")
        texts, said = self.drawn("--frame", "1")
        self.assertIn('stage "settle", cycle 200, 0.02 s', texts)
        texts, said = self.drawn("--history", "ball")
        self.assertTrue(any(text.startswith("to cycle ") and text.endswith(", interrupted") for text in texts), texts)

    def test_running_is_told_from_interrupted(self):
        with open(self.folder / ".lock", "a+b") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            texts, said = self.drawn()
        self.assertTrue(said.endswith(" s, the run goes on\n"), said)
        self.assertEqual(hdem_io.open_run(self.folder).state(), "interrupted")

    def test_frames_that_the_results_do_not_know_yet_are_shown(self):
        folder = Path(self.scratch.name, "killed")
        shutil.copytree(self.folder, folder)
        frames = hdem_io.open_run(folder).frames
        with h5py.File(folder / "results.h5", "r+") as opened:
            for name in ("number", "cycle", "time", "stage"):
                kept = opened["frames"][name][:1]
                del opened["frames"][name]
                opened["frames"][name] = kept
        self.assertEqual(hdem_io.open_run(folder).frames, frames)
        last = folder / f"frames/blocks_{frames[-1].number:06d}.hdf"
        last.write_bytes(last.read_bytes()[:1000])    # the power failed
        self.assertEqual(hdem_io.open_run(folder).frames, frames[:-1])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
