#!/usr/bin/python3
"""The page of `hdem view` in a real browser: keys, clicks, and what is on the screen, by counting pixels.

    view_browser_test.py HDEM TOOLS MODULES [--speed]    the program, the folder of its scripts (not used), the node_modules that its build fetched
        --speed    instead: a page of 10^5 blocks and 20 frames, how long it takes to open and how many pictures a second it makes

Exit code 77 (skipped) without h5py or matplotlib, Chromium, Node.js or the viewer.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import h5py
    import matplotlib.image    # noqa: F401
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import small_case
from view_page import ViewPage, count, covered, middle, pixels

HDEM, MODULES = Path(sys.argv[1]).resolve(), Path(sys.argv[3]).resolve()
SPEED = "--speed" in sys.argv
NODE, CHROMIUM = (next(filter(None, map(shutil.which, names)), None) for names in (("node", "nodejs"), ("chromium", "chromium-headless-shell")))
for what, there in (("no Node.js", NODE), ("no Chromium: tools/setup installs it", CHROMIUM), ("playwright-core was not fetched when hdem was built", (MODULES / "playwright-core").is_dir()),
                    ("hdem was built without the viewer", (HDEM.parent.parent / "share/hdem/view/viewer.html").exists())):
    if not there:
        print(f"skipped: {what}")
        sys.exit(77)

STONE, ORANGE, FALLEN, DARK, RED, GROUND, NIGHT, BLUE = (227, 216, 189), (213, 94, 0), (247, 207, 174), (22, 25, 29), (204, 51, 17), (238, 240, 243), (15, 18, 20), (0, 114, 178)
CASES = Path(__file__).resolve().parents[2] / "cases"
ROCK = """
title = "Many blocks"
[domain]
width = {size}
height = {size}
fixed = ["left", "right", "bottom"]
[[joint_set]]
dip_deg = 25.0
spacing = 1.0
deviation_deg = 2.0
[[joint_set]]
dip_deg = 110.0
spacing = 0.98
deviation_deg = 2.0
[generator]
smallest_block_area = 0.02
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 15.0
[[excavation]]
name = "tunnel"
shape = "horseshoe"
position = [{middle}, {middle}]
width = 30.0
height = 25.0
[output]
frame_every = 1
[[stage]]
cycles = {first}
[[stage]]
excavate = ["tunnel"]
cycles = {second}
"""


class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_view_browser_test_")
        cls.root = Path(cls.scratch.name)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def run_of(self, name, text):
        """Its folder."""
        case, folder = self.root / f"{name}.toml", self.root / name
        case.write_text(text, encoding="utf-8")
        subprocess.run([HDEM, "run", case, "-o", folder, "--quiet"], check=True)
        return folder

    def page_of(self, *runs, name="page"):
        done = subprocess.run([HDEM, "view", *runs, "-o", self.root / f"{name}.html"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.root / f"{name}.html"

    def browse(self, what, page):
        """What the browser saw. Nothing went wrong in it, and it opened this file only."""
        done = subprocess.run([NODE, Path(__file__).with_name("view_browser.mjs"), MODULES, CHROMIUM, self.root, what, page], capture_output=True, text=True, check=False, timeout=400)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        said = json.loads(done.stdout)
        self.assertEqual(said["problems"], [])
        self.assertEqual(set(said["requests"]), {f"file://{page}"})
        return said

    def picture(self, name):
        """Without the lines around it."""
        return pixels(self.root / f"{name}.png")[2:-2, 2:-2]


def small_text(gravity=""):
    return small_case.CASE.replace("row_every = 100", "row_every = 100\nframe_every = 50") + gravity


class SmallPages(Browser):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = cls.run_of(cls, "out", small_text())
        cls.file = cls.page_of(cls(), cls.folder)

    def area(self, picture, scale, *colours):
        """m² of these colours"""
        return sum(count(picture, colour) for colour in colours) / scale**2

    def test_keys_change_what_is_seen(self):
        said = self.browse("keys", self.file)
        self.assertEqual((said["begin"]["counter"], said["begin"]["field"], said["home"]["counter"]), ("35 / 35", "displacement", "1 / 35"))
        self.assertEqual([said[name]["place"] for name in ("home", "right", "left", "end")], [0, 2, 1, 34])
        self.assertIn("settle · cycle 0 ", said["home"]["caption"])
        self.assertIn("fall · cycle 1\u202f700 · 0.17 s", said["end"]["caption"])
        scale = said["begin"]["scale"]
        # Ground 10 m², L 3 m², prop and ball 1 m²; the prop goes.
        first, last = self.picture("first"), self.picture("last")
        self.assertAlmostEqual(covered(first, STONE, GROUND) / scale**2, 15.0, delta=0.03)
        self.assertAlmostEqual(covered(last, STONE, GROUND) / scale**2, 14.0, delta=0.03)
        self.assertGreater(count(first, GROUND), 0.5 * first.shape[0] * first.shape[1])
        # The ball is detached: orange where the frame has it.
        states = self.picture("states")
        self.assertAlmostEqual(self.area(states, scale, ORANGE), 1.0, delta=0.03)
        with h5py.File(self.folder / "frames/blocks_000034.hdf") as frame:
            x, y = frame["hdem/block_position"][-1]
        column, row = middle(states, ORANGE)
        self.assertAlmostEqual((column - 0.5 * states.shape[1]) / scale + 4.0, x, delta=0.02)    # the model's middle: x 4, y 0.5
        self.assertAlmostEqual((0.5 * states.shape[0] - row) / scale + 0.5, y, delta=0.02)
        hatched = self.picture("hatched")
        stripes, between = (self.area(hatched, scale, colour) for colour in (ORANGE, FALLEN))
        self.assertAlmostEqual(stripes + between, 1.0, delta=0.1)
        self.assertTrue(0.2 < stripes < 0.5, stripes)
        self.assertIn("Detached: moved more than 50 mm", said["begin"]["legend"])
        # Layers add and take away what they should.
        self.assertEqual(said["second"]["field"], "displacement_x")
        self.assertGreater(count(self.picture("forces"), DARK), count(last, DARK) + 200)
        self.assertIn("Widest: normal force", said["forces"]["legend"])
        self.assertGreater(count(self.picture("crosses"), DARK, 40), count(last, DARK, 40) + 50)
        self.assertIn("principal stress", said["crosses"]["legend"])
        self.assertEqual(said["joints"]["joint"], "slip")
        self.assertGreater(count(self.picture("joints"), RED), 20)
        # The outline of the prop: 4 m, 2.2 pixels wide.
        self.assertAlmostEqual(count(self.picture("outlined"), DARK, 60), 4.0 * scale * 2.2, delta=0.35 * 4.0 * scale * 2.2)
        self.assertTrue(said["playing"]["playing"])
        self.assertFalse(said["stopped"]["playing"])
        self.assertEqual(said["theme"], "dark")
        dark = self.picture("dark")
        self.assertGreater(count(dark, NIGHT), 0.5 * dark.shape[0] * dark.shape[1])
        self.assertEqual(count(dark, GROUND), 0)

    def test_positions_that_change_little_are_drawn_from_their_first_value(self):
        """Else two places of a block that moves by micrometres are two straight lines."""
        history = '[[history]]\nname = "a place"\nblock = "l"\nquantities = ["position_x", "position_y"]\nevery = 10\n[[history]]\nname = "rest"'
        folder = self.run_of("places", small_text().replace('[[history]]\nname = "rest"', history, 1))
        said = self.browse("positions", self.page_of(folder, name="places"))
        self.assertEqual([label for label in said["labels"] if "position" in label], ["position x from 0.833333 m", "position y from 0.833333 m"])
        self.assertEqual(said["units"], ["[µm]"])

    def test_pointer_finds_moves_and_keeps(self):
        said = self.browse("pointer", self.file)
        self.assertTrue(said["tip"].startswith("ball"), said["tip"])
        self.assertIn("140 mm", said["tip"])    # it falls for 0.15 s: 0.14 m
        self.assertIn("from l", said["groundTip"])    # the greatest force on the ground
        self.assertEqual(said["pinned"]["pinned"], said["stillPinned"])
        for words in ("ball", "detached", "139.9 mm", "1.668 m/s"):
            self.assertIn(words, said["pinned"]["block"])
        before, after = said["zoom"]
        self.assertAlmostEqual(after / before, np.exp(0.64), delta=0.01)
        (x0, y0), (x1, y1) = said["moved"]
        self.assertLess(x1, x0)
        self.assertAlmostEqual(said["fitted"]["scale"], before, delta=1e-6)
        self.assertEqual((said["escaped"]["pinned"], said["escaped"]["block"]), (-1, ""))
        # A click in the middle of the history: half of the time; the mark goes there.
        self.assertAlmostEqual(said["atHalf"]["time"], 0.085, delta=0.004)
        self.assertLess(said["atHalf"]["mark"], said["markAtEnd"] - 50)
        self.assertEqual(said["charts"], 2)
        poses, half = said["magnified"], [17, 0.085]
        with h5py.File(self.folder / f"frames/blocks_{half[0]:06d}.hdf") as frame:
            position, moved = frame["hdem/block_position"][-1], frame["VTKHDF/CellData/displacement"][-1]
        slot = next(i for i in range(4) if poses[4 * i] is not None and abs(poses[4 * i] + 4.0 - 4.5) < 1e-3)
        self.assertAlmostEqual(poses[4 * slot + 1] + 0.5, position[1] + 9.0 * moved[1], delta=1e-3)
        self.assertIn("500", said["manual"])

    def test_linings_have_their_diagram(self):
        """A ring of 3 m radius, without bending: thrust is a circle inside it, by 0.12 of its size; moments are nothing beside those of other cases."""
        ring = (CASES / "support/ring.toml").read_text(encoding="utf-8")
        said = self.browse("support", self.page_of(self.run_of("ring", ring), name="ring"))
        scale, drawn, line, without = said["drawn"]["scale"], *(self.picture(name) for name in ("drawn", "line", "without"))
        self.assertAlmostEqual(float(re.search(r"thrust up to (\d+) kN", said["drawn"]["legend"])[1]), 600.0, delta=3.0)    # pressure times radius
        self.assertIn("moment up to", said["moment"]["legend"])
        self.assertNotIn("Linings", said["line"]["legend"])
        around, inner = 2.0 * np.pi * 3.0 * scale, 2.0 * np.pi * (3.0 - 0.12 * 6.0) * scale
        self.assertAlmostEqual(count(line, DARK, 60) / (3.0 * around), 1.0, delta=0.35)
        self.assertGreater(count(drawn, ORANGE, 60), 1.2 * inner)
        self.assertEqual((count(line, ORANGE, 60), count(without, DARK, 60)), (0, 0))
        rows, columns = np.nonzero(np.all(np.abs(drawn - np.array(ORANGE)) <= 60, axis=2))
        away = np.hypot(columns - columns.mean(), rows - rows.mean()) / scale
        self.assertAlmostEqual(away.min(), 3.0 - 0.12 * 6.0, delta=0.05)
        self.assertTrue(2.8 < away.max() < 3.0, away.max())    # the last of it is under the ring

    def test_picture_fits_what_is_beside_blocks(self):
        """A lining and water that reach farther than the blocks: all of it is seen, and the picture is no larger than it needs."""
        said = self.browse("extent", self.page_of(self.run_of("beside", small_case.BESIDE), name="beside"))
        off = 0.12 * 13.0    # the diagram of the lining stands off it
        wanted = [-1.0, -5.0, 9.0 + off, 12.0 + off]
        np.testing.assert_allclose(said["box"], wanted, atol=0.02)
        x0, y0, x1, y1 = said["seen"]
        self.assertTrue(x0 < said["box"][0] and y0 < said["box"][1] and x1 > said["box"][2] and y1 > said["box"][3], said["seen"])

    def test_frame_without_blocks_says_so(self):
        gone = small_text().replace("[output]", '[[stage]]\nname = "all goes"\ncycles = 50\nexcavate = ["ground", "l", "ball"]\n[output]', 1)
        said = self.browse("emptied", self.page_of(self.run_of("gone", gone), name="gone"))
        self.assertIn("no blocks are left", said["last"]["caption"])
        self.assertNotIn("no blocks are left", said["first"]["caption"])
        self.assertIn("has been removed", said["pinned"]["block"])
        last, first = self.picture("emptied_last"), self.picture("emptied_first")
        self.assertEqual(count(last, STONE), 0)
        self.assertAlmostEqual(covered(first, STONE, GROUND) / said["first"]["scale"]**2, 15.0, delta=0.03)

    def test_water_table_is_drawn(self):
        dam = (CASES / "water/dam.toml").read_text(encoding="utf-8").replace('until = "converged"\nmax_cycles = 100000', "cycles = 10")
        said = self.browse("support", self.page_of(self.run_of("dam", dam), name="dam"))
        drawn, without = self.picture("drawn"), self.picture("without")
        self.assertIn("Water table", said["drawn"]["legend"])
        length = (20.0 + 10.0 + 40.0) * said["drawn"]["scale"]
        self.assertAlmostEqual(count(drawn, BLUE, 60) / (0.5 * 2.4 * length), 1.0, delta=0.35)    # every second dash
        self.assertEqual(count(without, BLUE, 60), 0)

    def test_values_of_round_off_have_an_axis(self):
        """A dam at rest: energies of 1e-24 J beside 700 J, a ratio of 1e-14. uPlot counts ticks without end there."""
        dam = (CASES / "water/dam.toml").read_text(encoding="utf-8").replace('until = "converged"', 'until = ["converged", "cycles > 199"]')
        said = self.browse("positions", self.page_of(self.run_of("still", dam), name="still"))
        self.assertGreater(len(said["labels"]), 5)

    def test_compares_two_runs(self):
        moon = self.run_of("moon", small_text("[gravity]\nvector = [0.0, -1.62]\n"))
        said = self.browse("compare", self.page_of(self.folder, moon, name="two"))
        self.assertEqual([words.split("fall")[0] for words in said["panes"]], ["out", "moon"])
        self.assertEqual(said["scales"][0], said["scales"][1])
        for i in (0, 1):
            self.assertAlmostEqual(covered(self.picture(f"compare{i}"), STONE, GROUND) / said["scales"][i]**2, 14.0, delta=0.06)
        self.assertAlmostEqual(*said["times"], delta=1e-9)
        np.testing.assert_allclose(said["cameras"][0], said["cameras"][1], rtol=1e-9)
        self.assertTrue(any("moon" in name for name in said["series"]) and any("out" in name for name in said["series"]), said["series"])

    def test_materials_of_two_runs_are_told_by_their_names(self):
        """The second case has one more, before the others: the numbers of clay and rock differ between the runs, their colours do not."""
        case = ('[[block]]\nname = "f"\npolygon = [[-5, -1], [5, -1], [5, 0], [-5, 0]]\nfixed = true\n[[block]]\nname = "m"\npolygon = [[0, 0], [2, 0], [2, 1], [0, 1]]\n'
                'material = "clay"\n[material.clay]\ndensity = 1000\n[stage_]' + small_case.ROCK + '[convergence]\ndetached_distance = {}\n[[stage]]\ncycles = 10\n'
                '[[block]]\nname = "falls"\npolygon = [[-4, 1], [-3, 1], [-3, 2], [-4, 2]]\nmaterial = "rock"\nvelocity = [0, -100]\n')
        one, two = self.run_of("clay", case.replace("[stage_]", "").format(0.01)), self.run_of("more", case.replace("[stage_]", "[material.aaa]\ndensity = 1\n").format(0.02))
        said = self.browse("materials", self.page_of(one, two, name="materials"))
        colours = {"clay": "rgb(232, 217, 181)", "rock": "rgb(86, 180, 233)", "aaa": "rgb(0, 158, 115)"}
        self.assertEqual(dict(said["entries"]), colours)
        self.assertIn("Detached: moved more than 10 mm | 20 mm", said["first"]["legend"])
        self.assertIn("Materialclay", said["tip"])
        for i, scale in enumerate(said["scales"]):
            clay, rock, aaa = (count(self.picture(f"materials{i}"), tuple(map(int, re.findall(r"\d+", colour)))) / scale**2 for colour in colours.values())
            self.assertAlmostEqual(clay, 2.0, delta=0.2)
            self.assertAlmostEqual(rock, 11.0, delta=0.6)    # without its edges, which are smoothed
            self.assertEqual(aaa, 0.0)

    def test_live_page_loads_itself_and_stays_as_it_was(self):
        page = ViewPage(self.file)
        live = self.root / "live.html"
        live.write_text(page.text.replace('"live":null', '"live":{"every":1.0}', 1), encoding="utf-8")
        said = self.browse("live", live)
        self.assertIn("Live", said["sign"])
        self.assertEqual((said["again"]["field"], said["again"]["place"]), ("speed", 0))


def unlike(one, other):
    return np.any(np.abs(one - other) > 8, axis=2)


class ManyBlocks(Browser):
    def test_sheet_shows_what_blocks_show(self):
        """Above 20 000 blocks a picture is made in another way; it is the same, but for pixels on edges."""
        folder = self.run_of("many", ROCK.format(size=150.0, middle=75.0, first=1, second=1))
        said = self.browse("many", self.page_of(folder))
        self.assertGreater(said["blocks"], 20000)
        self.assertTrue(said["hasSheet"])
        self.assertGreater(said["moved"], 1000)
        self.assertEqual(said["stillMoved"], said["moved"])
        for sheet, exact in (("sheet", "exact"), ("sheet_zoomed", "exact_zoomed"), ("sheet_first", "exact_first"), ("sheet_moved", "exact_moved")):
            one, other = self.picture(sheet), self.picture(exact)
            self.assertGreater(np.ptp(one), 100)
            # Graphics processors put corners on sixteenths of a pixel or so: pixels on edges may belong to the neighbour.
            self.assertLess(np.mean(unlike(one, other)), 0.025, sheet)
            self.assertLess(np.mean(np.all([unlike(one, np.roll(other, (y - 1, x - 1), (0, 1))) for y, x in np.ndindex(3, 3)], axis=0)), 0.002, sheet)
        self.assertGreater(np.mean(np.any(self.picture("sheet") != self.picture("sheet_zoomed"), axis=2)), 0.2)


class Speed(Browser):
    def test_opens_in_5_s_and_moves_30_times_a_second(self):
        folder = self.run_of("large", ROCK.format(size=320.0, middle=160.0, first=10, second=9))
        file = self.page_of(folder)
        said = self.browse("speed", file)
        print(f"{said['blocks']} blocks, {said['frames']} frames, {file.stat().st_size / 1e6:.1f} MB: opens in {said['opened']:.2f} s; pictures a second: "
              f"{said['pan']:.0f} moved, {said['zoom']:.0f} zoomed, {said['play']:.0f} played")
        self.assertGreaterEqual(said["blocks"], 100000)
        self.assertGreaterEqual(said["frames"], 20)
        self.assertLess(said["opened"], 5.0)
        for how in ("pan", "zoom", "play"):
            self.assertGreaterEqual(said[how], 30.0, how)


if __name__ == "__main__":
    suite = unittest.TestSuite(unittest.defaultTestLoader.loadTestsFromTestCase(case) for case in ([Speed] if SPEED else [SmallPages, ManyBlocks]))
    sys.exit(0 if unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful() else 1)
