#!/usr/bin/python3
"""A drawing becomes blocks and traces that hdem reads.

    import_dxf_test.py HDEM TOOLS    the program, and the folder of its scripts

Exit code 77 (skipped) without ezdxf.
"""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import ezdxf
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import small_case

HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
REST = small_case.ROCK + """
[[stage]]
cycles = 10
"""


class Drawing(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(prefix="hdem_dxf_test_")
        self.folder = Path(self.scratch.name)
        drawing = ezdxf.new()
        space = drawing.modelspace()
        joints = {"layer": "JOINTS"}
        space.add_line((0, 5000), (10000, 5000), dxfattribs=joints)
        space.add_lwpolyline([(4000, 0), (4000, 3000), (5000, 6000)], dxfattribs=joints)
        block = drawing.blocks.new("REPEATED")
        block.add_line((0, 0), (0, 5000), dxfattribs=joints)
        space.add_blockref("REPEATED", (7000, 5000), dxfattribs=joints)
        space.add_lwpolyline([(0, 0), (2000, 0), (2000, 1000), (0, 1000)], close=True, dxfattribs={"layer": "BLOCKS"})
        space.add_circle((5000, 5000), 1000, dxfattribs={"layer": "BLOCKS"})
        space.add_text("north", dxfattribs=joints)
        drawing.saveas(self.folder / "map.dxf")

    def tearDown(self):
        self.scratch.cleanup()

    def convert(self, *arguments):
        done = subprocess.run([TOOLS / "import_dxf.py", self.folder / "map.dxf", *map(str, arguments)], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def check(self, text):
        (self.folder / "case.toml").write_text(text + REST, encoding="utf-8")
        return subprocess.run([HDEM, "check", self.folder / "case.toml"], capture_output=True, text=True, check=True).stdout

    def test_lines_cut_a_domain(self):
        code, said = self.convert("--traces", self.folder / "t.wkt", "--layer", "joints", "--scale", "0.001")
        self.assertEqual(code, 0, said)
        self.assertIn("3 traces", said)
        self.assertIn("left out: 1 TEXT", said)
        said = self.check('[domain]\nwidth = 10.0\nheight = 10.0\ntraces_file = "t.wkt"\n')
        self.assertRegex(said, r"blocks +4 ")
        self.assertIn("3 traces, 1 dead ends dropped", said)

    def test_closed_lines_are_blocks(self):
        code, said = self.convert("--blocks", self.folder / "b.wkt", "--scale", "0.001", "--arc", "0.01")
        self.assertEqual(code, 0, said)
        lines = (self.folder / "b.wkt").read_text().splitlines()[1:]
        self.assertEqual(lines[0], "POLYGON((0 0, 2 0, 2 1, 0 1, 0 0))")
        self.assertGreater(lines[1].count(","), 16, "a circle of 1 m within 10 mm")
        self.assertRegex(self.check('blocks_file = "b.wkt"\n'), r"blocks +2 ")

    def test_errors_say_what_is_wrong(self):
        for arguments, expected, words in (([], 2, "give --blocks or --traces"), (["--traces", "t", "--scale", "0"], 2, "must be positive"),
                                           (["--traces", self.folder / "t", "--layer", "none"], 1, "no traces found")):
            code, said = self.convert(*arguments)
            self.assertEqual(code, expected, said)
            self.assertIn(words, said)
        (self.folder / "map.dxf").write_text("not a drawing")
        code, said = self.convert("--traces", self.folder / "t")
        self.assertEqual(code, 1)
        self.assertIn("cannot be read", said)
        self.assertNotIn("Traceback", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
