#!/usr/bin/python3
"""What `hdem view` writes: pages, films, and messages; and the page of a run that goes on. No browser is needed: that is view_browser_test.py.

    view_test.py HDEM TOOLS    the program, and the folder of its scripts (not used)

Exit code 77 (skipped) without h5py or matplotlib, or when hdem was built without the viewer.
"""
import json
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
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

HDEM = Path(sys.argv[1]).resolve()
SHARE = HDEM.parent.parent / "share/hdem"
CASES = Path(__file__).resolve().parents[2] / "cases"
PATIENCE = 300.0    # s for what a run or its page does by itself: a busy machine takes a few
if not (SHARE / "view/viewer.html").exists():
    print("skipped: hdem was built without the viewer (no Node.js, or its packages could not be fetched)")
    sys.exit(77)
sys.path.insert(0, str(SHARE))
from hdem_io import open_run    # noqa: E402
from view_page import ViewPage    # noqa: E402


def view(*arguments, program=(HDEM, "view")):
    """Exit code, what it printed, and what it complained of."""
    done = subprocess.run([*program, *map(str, arguments)], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout.strip(), done.stderr.strip()


class PageOfASmallRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_view_test_")
        cls.root = Path(cls.scratch.name)
        case = cls.root / "small.toml"
        case.write_text(small_case.CASE.replace("row_every = 100", "row_every = 100\nframe_every = 50"), encoding="utf-8")
        cls.folder = cls.root / "out"
        subprocess.run([HDEM, "run", case, "-o", cls.folder, "--quiet"], check=True)
        code, out, errors = view(cls.folder)
        if (code, out, errors) != (0, str(cls.folder / "view.html"), ""):
            raise RuntimeError(f"{code} {out} {errors}")
        cls.page = ViewPage(cls.folder / "view.html")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def frame(self, number, kind="blocks"):
        with h5py.File(self.folder / f"frames/{kind}_{number:06d}.hdf") as opened:
            cells = {name: data[()] for name, data in opened["VTKHDF/CellData"].items()}
            cells["points"], cells["offsets"] = opened["VTKHDF/Points"][()][:, :2], opened["VTKHDF/Offsets"][()]
            if kind == "blocks":
                cells["position"], cells["block_id"] = opened["hdem/block_position"][()], opened["hdem/block_id"][()]
            return cells

    def copy(self, name):
        folder = self.root / name
        shutil.copytree(self.folder, folder)
        return folder

    def test_asks_the_network_for_nothing(self):
        """The only address is the name of SVG, which nobody opens; and the page itself forbids all others."""
        self.assertEqual(set(re.findall(r"\w+://[^\s\"'`)<>]*", self.page.text)), {"http://www.w3.org/2000/svg"})
        self.assertIsNone(re.search(r"<link|<iframe|<img|@import", self.page.text))
        self.assertIn("default-src 'none'", self.page.text)

    def test_names_the_licences_of_what_it_holds(self):
        for name in ("twgl.js", "uplot", "d3-scale-chromatic", "d3-color", "d3-interpolate"):
            self.assertRegex(self.page.text, rf"(?m)^{re.escape(name)} \d+\.\d+\.\d+ \((MIT|ISC|BSD-3-Clause)\)$")

    def test_has_all_frames(self):
        run = self.page.runs[0]
        self.assertEqual(len(run["frames"]), 35)
        self.assertEqual([frame["cycle"] for frame in run["frames"]], [*range(0, 1701, 50)])
        self.assertEqual((run["state"], run["title"], run["blocks"], self.page.facts["live"]), ("done", "Small run", 4, None))

    def test_blocks_stand_where_the_frames_have_them(self):
        shapes = self.page.shapes()
        for number in (0, 3, 4, 5, 20, 34):
            frame, (slots, poses) = self.frame(number), self.page.poses(number)
            self.assertEqual(sorted(shapes["id"][slots]), list(frame["block_id"]))
            for slot, (x, y, angle) in zip(slots, poses):
                wanted = np.concatenate([frame["points"][begin:end] for id_, begin, end in zip(frame["id"], frame["offsets"], frame["offsets"][1:])
                                         if id_ == shapes["id"][slot]])
                vertices = np.repeat(shapes["part_block"], shapes["part_size"]) == slot
                u, v = shapes["local_x"][vertices], shapes["local_y"][vertices]
                made = np.stack([x + np.cos(angle) * u - np.sin(angle) * v, y + np.sin(angle) * u + np.cos(angle) * v], axis=1)
                np.testing.assert_allclose(made, wanted, atol=3e-5 * shapes["radius"][slot])    # what README.md promises

    def test_fields_are_as_exact_as_promised(self):
        shapes = self.page.shapes()
        for number in (3, 20, 34):
            frame, arrays = self.frame(number), self.page.arrays(self.page.runs[0]["frames"][number]["chunk"])
            first = {id_: i for i, id_ in reversed(list(enumerate(frame["id"])))}
            places = [first[id_] for id_ in shapes["id"][self.page.poses(number)[0]]]
            wanted = {"displacement_x": frame["displacement"][:, 0], "displacement_y": frame["displacement"][:, 1], "velocity_y": frame["velocity"][:, 1],
                      **{name: frame[name] for name in ("rotation", "stress_xx", "stress_yy", "stress_xy", "kinetic_energy", "angular_velocity")}}
            for name, values in wanted.items():
                values = values[places].astype(float)
                relative = 2.0**-12 if name in ("displacement_x", "displacement_y", "rotation") else 5e-4
                np.testing.assert_allclose(arrays[name], values, rtol=relative, atol=1e-12 * np.abs(values).max(), err_msg=f"{name} of frame {number}")
            flags = frame["regime"] | frame["fixed"] << 2 | frame["detached"] << 3 | frame["next_to_excavation"] << 4
            np.testing.assert_array_equal(arrays["flags"], flags[places])

    def test_contacts_are_where_and_what_they_were(self):
        run, shapes = self.page.runs[0], self.page.shapes()
        rows = self.page.arrays(run["rows"])
        for number, contacts in ((2, 2), (34, 1)):    # of the concave block and the prop; of the concave block
            frame, arrays = self.frame(number, "contacts"), self.page.arrays(run["frames"][number]["contacts"])
            slots, poses = self.page.poses(number)
            pose = dict(zip(slots, poses))
            made = []
            for i, row in enumerate(arrays["row"]):
                a, b = rows["first"][row], rows["second"][row]
                (x, y, angle), r = pose[a], shapes["radius"][a]
                ends = []
                for end in "01":
                    u, v = rows[f"x{end}"][row] * r, rows[f"y{end}"][row] * r
                    ends += [x + np.cos(angle) * u - np.sin(angle) * v, y + np.sin(angle) * u + np.cos(angle) * v]
                made.append((shapes["id"][a], shapes["id"][b], *ends, arrays["normal_force"][i], arrays["shear_force"][i], arrays["slip"][i]))
            wanted = [(*blocks, *points.ravel(), normal, shear, slip) for blocks, points, normal, shear, slip in
                      zip(frame["blocks"], frame["points"].reshape(-1, 2, 2), frame["normal_force"], frame["shear_force"], frame["slip"])]
            self.assertEqual(len(made), len(wanted))
            self.assertEqual(len(made), contacts)
            made, wanted = np.array(sorted(made)), np.array(sorted(wanted))
            np.testing.assert_array_equal(made[:, :2], wanted[:, :2])
            np.testing.assert_allclose(made[:, 2:6], wanted[:, 2:6], atol=1.1 / 500.0 * shapes["radius"].max())
            np.testing.assert_allclose(made[:, 6:], wanted[:, 6:], rtol=5e-4, atol=1e-12)

    def test_histories_are_those_of_the_run(self):
        run = self.page.runs[0]
        self.assertEqual([table["name"] for table in run["tables"]], ["ball", "rest", "energies"])
        arrays = self.page.arrays(run["tables_chunk"])
        with h5py.File(self.folder / "results.h5") as results:
            np.testing.assert_array_equal(arrays["0/time"], results["history/ball/time"])
            np.testing.assert_allclose(arrays["0/speed"], results["history/ball/speed"], rtol=1e-6)

    def test_a_history_named_energies_hides_nothing(self):
        case = self.root / "named.toml"
        case.write_text(small_case.CASE.replace('name = "rest"', 'name = "energies"'), encoding="utf-8")
        subprocess.run([HDEM, "run", case, "-o", self.root / "named", "--quiet"], check=True)
        self.assertEqual(view(self.root / "named")[0], 0)
        tables = ViewPage(self.root / "named/view.html").runs[0]["tables"]
        self.assertEqual([table["name"] for table in tables], ["ball", "energies", "energies of the run"])

    def test_ranges_are_those_of_blocks_that_stay(self):
        """In the last frame the ball is detached: the ground and the L decide."""
        frame, ranges = self.frame(34), self.page.runs[0]["frames"][34]["ranges"]
        stays = frame["detached"] == 0
        self.assertAlmostEqual(ranges["displacement"][1], np.hypot(*frame["displacement"][stays, :2].T).max(), delta=1e-9)
        self.assertAlmostEqual(ranges["stress_yy"][1], frame["stress_yy"].max(), delta=1.0)

    def test_of_two_runs_holds_both(self):
        code, out, errors = view(self.folder, self.folder, "-o", self.root / "two.html")
        self.assertEqual((code, errors), (0, ""), errors)
        self.assertEqual([len(run["frames"]) for run in ViewPage(Path(out)).runs], [35, 35])

    def test_contacts_can_be_left_out(self):
        for how, wanted in (("none", 0), ("ends", 2), ("all", 35)):
            view(self.folder, "--contacts", how, "-o", self.root / "some.html")
            frames = ViewPage(self.root / "some.html").runs[0]["frames"]
            self.assertEqual(sum(frame["contacts"] is not None for frame in frames), wanted, how)

    def test_bolts_of_each_frame_are_drawn(self):
        cases = Path(__file__).resolve().parents[2] / "cases/support/pull.toml"
        folder = self.root / "pull"
        subprocess.run([HDEM, "run", cases, "-o", folder, "--set", "output.frame_every=1000", "-q"], check=True)
        self.assertEqual(view(folder)[0], 0)
        page, run = ViewPage(folder / "view.html").runs[0], open_run(folder)
        self.assertEqual(page["frames"][0]["bolts"]["ends"], [], "not installed yet")
        for number in (1, 2, 3):
            shown, bolts = page["frames"][number]["bolts"], run.bolts(number)
            np.testing.assert_allclose(np.array(shown["ends"][0]) + page["origin"] * 2, bolts["points"][0].ravel(), atol=1e-4)
            self.assertAlmostEqual(shown["force"][0] / bolts["axial_force"][0], 1.0, delta=1e-3)
        self.assertGreater(page["frames"][3]["bolts"]["force"][0], page["frames"][1]["bolts"]["force"][0])

    def test_linings_of_each_frame_are_in_it(self):
        folder = self.root / "ring"
        subprocess.run([HDEM, "run", CASES / "support/ring.toml", "-o", folder, "--set", "output.frame_every=500", "-q"], check=True)
        self.assertEqual(view(folder)[0], 0)
        page, run = ViewPage(folder / "view.html"), open_run(folder)
        frames = page.runs[0]["frames"]
        self.assertEqual(len(page.arrays(frames[0]["chunk"])["liner_thrust"]), 0, "not installed yet")
        for number in (1, 4):
            arrays, liners = page.arrays(frames[number]["chunk"]), run.liners(number)
            np.testing.assert_allclose(arrays["liner_ends"].reshape(-1, 2, 2) + page.runs[0]["origin"], liners["points"], atol=1e-5)
            for name in ("thrust", "moment_from", "moment_to"):
                np.testing.assert_array_equal(arrays[f"liner_{name}"], liners[name])
            self.assertAlmostEqual(frames[number]["liners"]["thrust"] / np.abs(liners["thrust"]).max(), 1.0, delta=1e-4)
        np.testing.assert_allclose(np.array(page.runs[0]["lined"]) + page.runs[0]["origin"] * 2, [-3.0, -3.0, 3.0, 3.0], atol=0.01)

    def test_water_table_is_in_it(self):
        folder = self.root / "dam"
        subprocess.run([HDEM, "run", CASES / "water/dam.toml", "-o", folder, "--set", "stage.fill.max_cycles=10", "-q"], check=False)
        self.assertEqual(view(folder)[0], 0)
        page = ViewPage(folder / "view.html").runs[0]
        table = np.array(page["waters"][page["frames"][-1]["water"]]).reshape(-1, 2) + page["origin"]
        np.testing.assert_allclose(table, open_run(folder).blocks("last")["water_table"], atol=1e-4)
        self.assertEqual(table[0][1], 10.0, "before the dam")
        self.assertNotIn("water", self.page.runs[0]["frames"][-1], "of a case without water")

    def test_what_is_missing_or_damaged_is_told(self):
        empty = self.copy("empty")
        for file in (empty / "frames").iterdir():
            file.unlink()
        cut = self.copy("cut")
        frame = cut / "frames/blocks_000003.hdf"
        frame.write_bytes(frame.read_bytes()[:3000])
        strange = self.root / "strange.h5"
        strange.write_bytes(b"not HDF5")
        nothing = self.root / "folder"
        nothing.mkdir()
        for what, words in (("nowhere", "no such file or folder"), (empty, "blocks_000000.hdf: no such file"), (cut, "blocks_000003.hdf: cannot be read"),
                            (strange, "cannot be read"), (nothing, "Give the folder of a run"), (frame, "not the results of a run")):
            with self.subTest(what):
                code, out, errors = view(what)
                self.assertEqual((code, out, errors.count("\n")), (2, "", 0), errors)
                self.assertTrue(errors.startswith("error: hdem view: "), errors)
                self.assertIn(words, errors)
        self.assertEqual(list(cut.glob("*.tmp")), [])

    def test_wrong_words_are_told(self):
        for words, said in ((("--movie", "film.mp4", "--fps", "0"), "0.1 to 120"), (("--movie", "film.avi"), ".mp4 or .gif"), (("a", "b"), "one run, or two"),
                            (("--contacts", "some"), "invalid choice"), (("--colour", "stress"), "argument --colour: of films only. Leave it out, or give --movie FILE."),
                            (("--fps", "5"), "argument --fps: of films only"), (("--width", "400"), "argument --width: of films only"),
                            (("--window", "0", "0", "1", "1"), "argument --window: of films only"),
                            (("--movie", "film.mp4", "--contacts", "all"), "argument --contacts: of pages only. Leave it out, or leave out --movie.")):
            code, _, errors = view(self.folder, *words)
            self.assertEqual((code, errors.count("\n")), (2, 0), errors)
            self.assertIn(said, errors)

    def test_without_the_viewer_says_how_to_get_it(self):
        share = self.root / "prefix/share/hdem"
        shutil.copytree(SHARE, share)
        (share / "view/viewer.html").unlink()
        code, _, errors = view(self.folder, program=("/usr/bin/python3", share / "run_view.py"))
        self.assertEqual((code, errors.count("\n")), (2, 0), errors)
        for words in ("the viewer is not part of this hdem", "tools/setup", "Node.js"):
            self.assertIn(words, errors)
        (self.root / "prefix/bin").mkdir()
        program = shutil.copy(HDEM, self.root / "prefix/bin/hdem")
        done = subprocess.run([program, "run", self.root / "small.toml", "-o", self.root / "never", "--live"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("tools/setup", done.stderr)
        self.assertFalse((self.root / "never").exists())

    def test_film_has_every_frame(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("no ffmpeg")
        for ending in ("mp4", "gif"):
            film = self.root / f"film.{ending}"
            code, out, errors = view(self.folder, "--movie", film, "--width", "400", "--fps", "5")
            self.assertEqual((code, out), (0, str(film)), errors)
            asked = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames,width,avg_frame_rate", "-of", "json", film],
                                   capture_output=True, text=True, check=True)
            stream = json.loads(asked.stdout)["streams"][0]
            self.assertEqual((stream["nb_read_frames"], stream["width"], stream["avg_frame_rate"]), ("35", 400, "5/1"))
        last = self.root / "last.png"
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-sseof", "-1", "-i", self.root / "film.mp4", "-update", "1", last], check=True)
        self.assertGreater(np.ptp(matplotlib.image.imread(last)[:, :, :3]), 0.5)


class PageOfARunThatGoesOn(unittest.TestCase):
    def start(self, folder):
        case = folder / "long.toml"
        case.write_text(small_case.CASE.replace("row_every = 100", "row_every = 1000000\nframe_every = 400000").replace("cycles = 1500", "cycles = 2000000000")
                        .replace("every = 10\n", "every = 1000000\n"), encoding="utf-8")
        process = subprocess.Popen([HDEM, "run", case, "-o", folder / "out", "--quiet", "--live", "--threads", "1"], stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def whole_pages(self, file, seconds, wanted):
        """Numbers of frames of the pages that were there; every page that can be read is whole."""
        seen, end = [], time.monotonic() + seconds
        while time.monotonic() < end and len(seen) < wanted:
            if file.exists():
                page = ViewPage(file)
                self.assertTrue(page.text.endswith("</html>\n"))
                self.assertIsNotNone(page.facts["live"])
                for run in page.runs:
                    for frame in run["frames"]:
                        self.assertIn(frame["chunk"]["id"], page.chunks)
                if not seen or len(page.runs[0]["frames"]) > seen[-1]:
                    seen.append(len(page.runs[0]["frames"]))
            time.sleep(0.1)
        return seen

    def test_follows_it_and_ends_with_it(self):
        for how, state in ((signal.SIGINT, "interrupted"), (signal.SIGKILL, "interrupted")):
            with self.subTest(how):
                folder = Path(tempfile.mkdtemp(prefix="hdem_live_test_"))
                self.addCleanup(shutil.rmtree, folder)    # after the run was killed
                process, page = self.start(folder), folder / "out/view.html"
                seen = self.whole_pages(page, PATIENCE, 3)
                self.assertEqual(len(seen), 3, seen)
                process.send_signal(how)
                process.communicate(timeout=PATIENCE)
                self.assertEqual(process.returncode, 130 if how == signal.SIGINT else -9)
                end = time.monotonic() + PATIENCE
                while ViewPage(page).facts["live"] and time.monotonic() < end:    # after SIGKILL nobody waits for it
                    time.sleep(0.1)
                last = ViewPage(page)
                self.assertIsNone(last.facts["live"])
                self.assertEqual(last.runs[0]["state"], state)
                self.assertGreaterEqual(len(last.runs[0]["frames"]), seen[-1])
                self.assertEqual(list((folder / "out").glob("view.html.*")), [])


class PageOfTheTunnel(unittest.TestCase):
    def test_of_500_blocks_and_200_frames_is_below_10_mb(self):
        with tempfile.TemporaryDirectory(prefix="hdem_view_test_") as scratch:
            folder = Path(scratch) / "tunnel"
            subprocess.run([HDEM, "run", CASES / "paper_tunnel/tunnel.toml", "-o", folder, "--quiet", "--set", "output.frame_every=10", "--set", "stage[0].cycles=990",
                            "--set", "stage[1].max_cycles=1000"], check=False)
            code, out, errors = view(folder)
            self.assertEqual((code, errors), (0, ""))
            page = ViewPage(Path(out))
            megabytes = Path(out).stat().st_size / 1e6
            print(f"{page.runs[0]['blocks']} blocks, {len(page.runs[0]['frames'])} frames: {megabytes:.2f} MB")
            self.assertGreaterEqual(page.runs[0]["blocks"], 500)
            self.assertGreaterEqual(len(page.runs[0]["frames"]), 200)
            self.assertTrue(all(frame["contacts"] for frame in page.runs[0]["frames"]))
            self.assertLess(megabytes, 10.0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
