#!/usr/bin/python3
"""Names and titles are texts in pictures, pages, file names and on the screen, whatever characters they have. Outputs take the place of nothing else.

    hostile_texts_test.py HDEM TOOLS    the program, and the folder of its scripts

Exit code 77 (skipped) without h5py or matplotlib.
"""
import html
import json
import os
import resource
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

try:
    import h5py    # noqa: F401
    import matplotlib    # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import page_checks
import small_case

HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.path.insert(0, str(TOOLS))
import plain_text    # noqa: E402

VIEWER = HDEM.parent.parent / "share/hdem/view/viewer.html"
COMMANDS = {"report": "page.html", "plot": "picture.svg"} | ({"view": "view.html"} if VIEWER.exists() else {})    # and the name of an output

# Templates of re.sub, formulas of matplotlib, tags and entities of HTML, formats, words of a shell, other alphabets.
TEXTS = [r"\g<1> \q \1 {} {0} %s", "$x^{$ a_b^c", "$$", "<script>alert(1) &amp &", "-o $(touch x) `y` \"q\" 'q'", "Grüße 岩"]
MATERIAL = "_rock"    # letters, digits, _ and -; a label of matplotlib that begins with _ is hidden


def case_of(text):
    quoted = json.dumps(text)
    return f'title = {quoted}' + small_case.ROCK.replace("material.rock", f"material.{MATERIAL}") + f"""
[time]
step = 1e-4
[[block]]
name = "ground"
material = "{MATERIAL}"
polygon = [[-1, -1], [9, -1], [9, 0], [-1, 0]]
fixed = true
[[block]]
name = {quoted}
material = "{MATERIAL}"
polygon = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[stage]]
name = "first"
cycles = 10
[[stage]]
name = {quoted}
cycles = 10
[output]
row_every = 10
[[history]]
name = {quoted}
block = {quoted}
quantities = ["displacement"]
every = 5
"""


def lines_of(picture):
    """Texts of a picture; blanks at ends of lines are not told apart."""
    return {"".join(element.itertext()).strip() for element in xml.etree.ElementTree.parse(picture).iter("{http://www.w3.org/2000/svg}text")}


class HostileTexts(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(prefix="hdem_texts_test_")
        self.folder = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def hdem(self, *arguments):
        """What was said; ends with 0 and without a word on the screen's other channel."""
        done = subprocess.run([HDEM, *map(str, arguments)], capture_output=True, text=True, check=False, cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        return done.stdout

    def run_of(self, text):
        (self.folder / "case.toml").write_text(case_of(text), encoding="utf-8")
        self.hdem("run", "case.toml", "-o", "out", "--overwrite", "--quiet")
        return self.folder / "out"

    def test_are_texts_in_pictures_and_pages(self):
        for text in TEXTS:
            with self.subTest(text=text):
                out = self.run_of(text)
                self.hdem("plot", "out", "-o", "a.svg", "--colour", "material")
                lines = lines_of(self.folder / "a.svg")
                self.assertIn(text, lines)
                self.assertIn(f"{MATERIAL} (2 blocks)", lines)
                self.assertTrue(any(line.startswith(f'stage "{text}", cycle 20') for line in lines), lines)
                self.hdem("plot", "out", f"--history={text}")
                self.assertTrue((out / f"{text}.png").exists(), list(out.iterdir()))
                self.hdem("plot", "out", f"--history={text}", "-o", "h.svg")
                self.assertIn(text, lines_of(self.folder / "h.svg"))
                self.hdem("report", "out")
                page = (out / "report.html").read_text(encoding="utf-8")
                page_checks.links_lead_somewhere(self, page)
                page_checks.asks_for_nothing(self, page)
                quoted = html.escape(text)
                for words in (f"<h1>{quoted}</h1>", f"<td>{quoted}</td>", f'<b>History "{quoted}".</b>', f'aria-label="history {quoted}"',
                              html.escape(f'stage "{text}" begins')):
                    self.assertIn(words, page)
                page_checks.curves_of(self, page)

    def test_two_histories_have_places_of_their_own(self):
        case = case_of("岩") + '[[history]]\nname = "石"\nblock = "岩"\nquantities = ["speed"]\nevery = 5\n'
        (self.folder / "case.toml").write_text(case, encoding="utf-8")
        self.hdem("run", "case.toml", "-o", "out", "--quiet")
        self.hdem("report", "out")
        page_checks.links_lead_somewhere(self, (self.folder / "out/report.html").read_text(encoding="utf-8"))

    def test_are_texts_on_the_screen(self):
        self.run_of("-o {}")
        self.assertIn("-o {}", self.hdem("info", "out/frames/blocks_000000.hdf"))
        done = subprocess.run([HDEM, "plot", "out", "--history", "\x1b[31m{}"], capture_output=True, text=True, check=False, cwd=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertNotIn("\x1b", done.stderr)

    def test_long_title_is_cut(self):
        (self.folder / "case.toml").write_text(case_of("name").replace('title = "name"', f'title = "{"long " * 6000}"'), encoding="utf-8")
        self.hdem("run", "case.toml", "-o", "out", "--quiet")
        self.hdem("plot", "out", "-o", "a.png")
        self.hdem("plot", "out", "-o", "a.svg")
        self.assertTrue(any(line.startswith("long long") and line.endswith("…") for line in lines_of(self.folder / "a.svg")))
        self.hdem("report", "out")

    def test_folder_may_be_called_like_an_option(self):
        self.run_of("x").rename(self.folder / "-x")
        self.hdem("report", "./-x")
        self.assertTrue((self.folder / "-x/report.html").exists())


class FileNames(unittest.TestCase):
    def test_stay_in_their_folder(self):
        for text, expected in (("../up", "_._up"), ("a/b", "a_b"), (".hidden", "_hidden"), ("", "_"), ("a b\\g", "a b\\g"), ("x\ny", "x\ufffdy")):
            self.assertEqual(plain_text.as_file_name(text), expected)
        self.assertLessEqual(len(plain_text.as_file_name("岩" * 200).encode()), 200)


class Outputs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_outputs_test_")
        cls.root = Path(cls.scratch.name)
        cls.results = small_case.run(HDEM, cls.root)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def said(self, code, command, *arguments, **more):
        """On both channels; errors are one line."""
        done = subprocess.run([HDEM, command, *arguments], capture_output=True, check=False, cwd=self.root, **more)
        self.assertEqual((done.returncode, done.stderr.count(b"\n")), (code, 1 if code else 0), done.stderr)
        self.assertEqual(list(self.root.rglob("*.tmp")), [])
        return done.stdout + done.stderr

    def test_take_the_place_of_no_file_of_hdem(self):
        names = [file.relative_to(self.root) for file in self.results.rglob("*") if file.suffix in (".json", ".h5", ".log", ".series") or file.name == "blocks_000000.hdf"]
        self.assertGreater(len(names), 6)
        before = {name: (self.root / name).read_bytes() for name in names}
        for command in COMMANDS:
            for name in [*names, "elsewhere/plan.json"]:
                self.assertIn(b": hdem itself writes files of this name, for runs and sweeps. Give ", self.said(2, command, "out", "-o", name))
        self.assertEqual({name: (self.root / name).read_bytes() for name in names}, before)
        self.assertFalse((self.root / "elsewhere").exists())

    def test_take_the_place_of_nothing_that_was_read(self):
        frame = self.root / "picture.png"    # under a name of its own
        os.link(self.results / "results.h5", frame)
        for command in COMMANDS:
            self.assertIn(b"picture.png: was read, and would be lost. Give ", self.said(2, command, "out", "-o", "picture.png"))
        frame.unlink()

    def test_earlier_ones_stay_where_space_is_short(self):
        limit = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1024, 1024))}
        if subprocess.run([HDEM, "--version"], check=False, capture_output=True, **limit).returncode == 66:
            self.skipTest("the thread sanitizer itself needs larger files")
        for command, name in COMMANDS.items():
            (self.root / name).write_text("before", encoding="utf-8")
            said = self.said(1, command, "out", "-o", name, **limit)
            self.assertIn(f"error: hdem {command}: {name}: cannot be written (File too large). Free space, or give ".encode(), said)
            self.assertEqual((self.root / name).read_text(encoding="utf-8"), "before")

    def test_links_are_replaced_and_not_what_they_lead_to(self):
        precious = self.root / "precious"
        precious.write_text("kept", encoding="utf-8")
        for command, name in COMMANDS.items():
            link = self.root / name
            link.unlink(missing_ok=True)
            link.symlink_to("precious")
            self.said(0, command, "out", "-o", name)
            self.assertFalse(link.is_symlink())
            self.assertGreater(len(link.read_bytes()), 1000)
            self.assertEqual(precious.read_text(encoding="utf-8"), "kept")

    def test_of_a_pipe_is_the_page_alone(self):
        self.assertRegex(self.said(0, "report", "out", "-o", "/dev/stdout"), rb"(?s)^<!DOCTYPE html>.*</html>\n?$")
        reader, writer = os.pipe()
        os.close(reader)
        self.assertIn(b": cannot be written (Broken pipe). Give", self.said(1, "report", "out", "-o", f"/dev/fd/{writer}", pass_fds=(writer,)))
        os.close(writer)
        self.assertIn(b"/dev/full: cannot be written (No space left on device). Free space, or give another place with -o.", self.said(1, "report", "out", "-o", "/dev/full"))
        self.assertTrue(os.path.exists("/dev/full"))

    def test_names_of_any_bytes_are_read_and_shown_without_steering_the_screen(self):
        for name in (b"n\xff\xfe", b"red\x1b[31m", b"two\nlines"):
            folder = os.path.join(os.fsencode(self.root), name)
            os.rename(self.results, folder)
            for command in COMMANDS:
                said = self.said(0, command, name)
                self.assertEqual(said.count(b"\n"), 1, said)
                self.assertNotIn(b"\x1b", said)
            os.rename(folder, self.results)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
