#!/usr/bin/python3
"""A drawing becomes blocks and traces that hdem reads.

    import_dxf_test.py HDEM TOOLS    the program, and the folder of its scripts

Exit code 77 (skipped) without ezdxf or h5py.
"""
import math
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import ezdxf
    import h5py    # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import small_case

HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.path.insert(0, str(TOOLS))
import hdem_io    # noqa: E402

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
        done = subprocess.run([TOOLS / "import_dxf.py", self.folder / "map.dxf", *map(str, arguments)], capture_output=True, text=True, check=False, timeout=600.0)
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
        self.assertEqual(lines[0], "POLYGON((0 0, 2 0, 2 1, 0 1, 0 0)); BLOCKS_1")
        self.assertGreater(lines[1].count(","), 16, "a circle of 1 m within 10 mm")
        self.assertRegex(self.check('blocks_file = "b.wkt"\n'), r"blocks +2 ")

    def test_hidden_layers_are_left_out_and_units_told(self):
        drawing = ezdxf.readfile(self.folder / "map.dxf")
        drawing.header["$INSUNITS"] = 4
        drawing.layers.add("JOINTS").off()
        drawing.layers.add("BLOCKS").freeze()
        drawing.modelspace().add_line((0, 0), (1000, 1000), dxfattribs={"layer": "SEEN"})
        drawing.saveas(self.folder / "map.dxf")
        code, said = self.convert("--traces", self.folder / "t.wkt")
        self.assertEqual(code, 0, said)
        self.assertIn("t.wkt: 1 traces", said)
        self.assertIn("left out: 6 on layers that are off or frozen", said)
        self.assertIn("note: the drawing says that its unit is mm: --scale 0.001", said)
        code, said = self.convert("--traces", self.folder / "t.wkt", "--layer", "joints", "--scale", "0.001")
        self.assertIn("t.wkt: 3 traces", said)
        self.assertNotIn("note:", said)

    def save(self, drawing, unseen="UNSEEN"):
        """What lies on this layer gets the mark of invisible entities, which older ezdxf does not write."""
        drawing.saveas(self.folder / "map.dxf")
        text = (self.folder / "map.dxf").read_text()
        (self.folder / "map.dxf").write_text(text.replace(f"  8\n{unseen}\n", f"  8\n{unseen}\n 60\n1\n"))

    def lines_of(self, *arguments):
        """What was said, and x of the first point of each line."""
        code, said = self.convert("--traces", self.folder / "t.wkt", *arguments)
        self.assertEqual(code, 0, said)
        return said, [float(line.split("(")[1].split()[0]) for line in (self.folder / "t.wkt").read_text().splitlines()[1:]]

    def test_references_on_hidden_layers_show_what_a_drawing_shows(self):
        drawing = ezdxf.new()
        drawing.layers.add("FROZEN").freeze()
        drawing.layers.add("OFF").off()
        space, inner, block = drawing.modelspace(), drawing.blocks.new("INNER"), drawing.blocks.new("BLOCK")
        inner.add_line((0, 0), (0, 1), dxfattribs={"layer": "SEEN"})
        block.add_line((1, 0), (1, 1))
        block.add_line((2, 0), (2, 1), dxfattribs={"layer": "SEEN"})
        block.add_blockref("INNER", (3, 0), dxfattribs={"layer": "SEEN"})
        for x, layer in ((0, "SEEN"), (10, "FROZEN"), (20, "OFF")):
            space.add_blockref("BLOCK", (x, 0), dxfattribs={"layer": layer})
        self.save(drawing)
        said, lines = self.lines_of()
        self.assertEqual(lines, [1, 2, 3, 22, 23], "a reference on a frozen layer is not drawn; of one whose layer is off, what lies on other layers")
        self.assertIn("left out: 3 in block references on frozen layers (name these by --layer)\nleft out: 1 on layers that are off or frozen", said)
        self.assertEqual(self.lines_of("--layer", "Frozen", "--layer", "Seen")[1], [1, 2, 3, 11, 12, 13, 22, 23])

    def test_invisible_entities_are_left_out(self):
        drawing = ezdxf.new()
        space, block = drawing.modelspace(), drawing.blocks.new("BLOCK")
        block.add_line((0, 0), (0, 1), dxfattribs={"layer": "SEEN"})
        block.add_line((1, 0), (1, 1), dxfattribs={"layer": "UNSEEN"})
        space.add_line((2, 0), (2, 1), dxfattribs={"layer": "UNSEEN"})
        space.add_blockref("BLOCK", (3, 0))
        space.add_blockref("BLOCK", (6, 0), dxfattribs={"layer": "UNSEEN"})
        self.save(drawing)
        said, lines = self.lines_of()
        self.assertEqual(lines, [3])
        self.assertIn("left out: 4 invisible", said)

    def test_all_units_are_known(self):
        for number, name, metres in ((1, "inches", "0.0254"), (3, "miles", "1609.344"), (6, "metres", "1"), (10, "yards", "0.9144"), (16, "hectometres", "100"),
                                     (21, "US survey feet", "0.3048006096"), (22, "US survey inches", "0.0254000508"), (24, "US survey miles", "1609.347219")):
            drawing = ezdxf.new()
            drawing.header["$INSUNITS"] = number
            drawing.modelspace().add_line((0, 0), (1, 1))
            self.save(drawing)
            self.assertIn(f"note: the drawing says that its unit is {name}: --scale {metres}, not 2\n", self.lines_of("--scale", "2")[0])
            self.assertNotIn("note", self.lines_of("--scale", metres)[0])
        drawing.header["$INSUNITS"] = 0
        self.save(drawing)
        self.assertNotIn("note", self.lines_of("--scale", "2")[0])

    def test_polylines_fitted_by_a_spline_have_the_fitted_points_alone(self):
        drawing = ezdxf.new("R12")
        line = drawing.modelspace().add_polyline2d([(0, 1), (3, 2)])
        line.dxf.flags |= 4
        for vertex in line.vertices:
            vertex.dxf.flags |= 16
        for point in ((0, 1), (1, 5), (2, 4), (3, 2)):
            line.append_vertex(point, dxfattribs={"flags": 8})
        self.save(drawing)
        self.assertEqual(self.lines_of()[1], [0])
        self.assertEqual((self.folder / "t.wkt").read_text().splitlines()[1], "LINESTRING(0 1, 1 5, 2 4, 3 2)")

    def test_arcs_in_references_of_unequal_scale_stay_one_line(self):
        drawing = ezdxf.new()
        space, block, outer = drawing.modelspace(), drawing.blocks.new("ARCH"), drawing.blocks.new("OUTER")
        block.add_lwpolyline([(0, 0, 0), (4, 0, 1), (4, 2, 0), (0, 2, 0)], format="xyb", close=True)    # a square of 4 x 2 with half a circle
        block.add_circle((-2, 1), 1)
        outer.add_blockref("ARCH", (0, 0), dxfattribs={"rotation": 90})
        space.add_blockref("ARCH", (20, 0), dxfattribs={"xscale": 2, "yscale": 1})
        space.add_blockref("OUTER", (0, 0), dxfattribs={"xscale": -1, "yscale": 3, "rotation": 30})
        self.save(drawing)
        code, said = self.convert("--blocks", self.folder / "b.wkt", "--arc", "1e-4")
        self.assertEqual(code, 0, said)
        self.assertIn("4 blocks", said)
        self.assertNotIn("left out", said)
        areas = []
        for line in (self.folder / "b.wkt").read_text().splitlines()[1:]:
            points = [tuple(map(float, point.split())) for point in line.split("((")[1].split("))")[0].split(",")]
            areas.append(abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, points[1:]))) / 2)
        for area, expected in zip(areas, (2 * (8 + math.pi / 2), 2 * math.pi, 3 * (8 + math.pi / 2), 3 * math.pi)):
            self.assertAlmostEqual(area, expected, delta=2e-3 * expected, msg=areas)
        self.check('blocks_file = "b.wkt"\n')

    def test_blocks_that_refer_to_themselves(self):
        drawing = ezdxf.new()
        block = drawing.blocks.new("RING")
        block.add_line((0, 0), (1, 0))
        block.add_blockref("RING", (1, 1))
        drawing.modelspace().add_blockref("RING", (0, 0))
        drawing.saveas(self.folder / "map.dxf")
        code, said = self.convert("--traces", self.folder / "t.wkt")
        self.assertEqual((code, said.count("\n")), (2, 1), said)
        self.assertIn("or to themselves", said)

    def test_endings_decide_what_is_written(self):
        for ending in ("wkt", "csv"):
            code, said = self.convert("--blocks", self.folder / f"b.{ending}", "--traces", self.folder / f"t.{ending}", "--scale", "0.001")
            self.assertEqual(code, 0, said)
            self.assertRegex(self.check(f'blocks_file = "b.{ending}"\n'), r"blocks +2 ")
            said = self.check(f'[domain]\nwidth = 10.0\nheight = 10.0\ntraces_file = "t.{ending}"\n')
            self.assertIn("3 traces, 1 dead ends dropped", said)

    def test_layers_become_names_materials_and_what_is_fixed(self):
        drawing = ezdxf.readfile(self.folder / "map.dxf")
        space, block = drawing.modelspace(), drawing.blocks.new("STONE")
        block.add_lwpolyline([(0, 0), (1000, 0), (1000, 1000), (0, 1000)], close=True, dxfattribs={"layer": "0"})
        for x in (0, 2000):
            space.add_blockref("STONE", (x, 8000), dxfattribs={"layer": "Sand, wet 1"})
        drawing.saveas(self.folder / "map.dxf")
        for ending in ("wkt", "csv"):
            (self.folder / "case.toml").write_text(f'blocks_file = "b.{ending}"\n' + REST.replace("[joint", "[material.sand]\ndensity = 1000.0\n[joint")
                                                   + '[[block]]\npolygon = [[20, 0], [21, 0], [21, 1]]\nmaterial = "rock"\n', encoding="utf-8")
            code, said = self.convert("--blocks", self.folder / f"b.{ending}", "--scale", "0.001", "--material", "Sand, wet 1=sand", "--material", "blocks=rock",
                                      "--fixed", "BLOCKS")
            self.assertEqual(code, 0, said)
            subprocess.run([HDEM, "run", self.folder / "case.toml", "-o", self.folder / "out", "--overwrite", "--quiet"], check=True)
            blocks = hdem_io.open_run(self.folder / "out").blocks("last")
            materials = [blocks["material_names"][number] for number in blocks["material"]]
            self.assertEqual(list(zip(blocks["name"], materials, blocks["fixed"]))[1:],
                             [("BLOCKS_1", "rock", 1), ("BLOCKS_2", "rock", 1), ("Sand_ wet 1_1", "sand", 0), ("Sand_ wet 1_2", "sand", 0)])

    def test_arrays_of_block_references_are_all_there(self):
        drawing = ezdxf.new()
        drawing.blocks.new("STONE").add_lwpolyline([(0, 0), (1, 0), (1, 1), (0, 1)], close=True)
        drawing.modelspace().add_blockref("STONE", (0, 0), dxfattribs={"row_count": 2, "column_count": 3, "row_spacing": 2.0, "column_spacing": 3.0})
        drawing.saveas(self.folder / "map.dxf")
        code, said = self.convert("--blocks", self.folder / "b.wkt")
        self.assertEqual(code, 0, said)
        self.assertIn("6 blocks", said)
        self.assertIn("POLYGON((6 2, 7 2, 7 3, 6 3, 6 2))", (self.folder / "b.wkt").read_text())

    def test_ends_of_arcs_meet_but_for_round_off(self):
        drawing = ezdxf.new()
        drawing.modelspace().add_lwpolyline([(50.0, 0.0, 1.0), (52.0, 0.0, 1.0)], format="xyb", close=True)
        drawing.saveas(self.folder / "map.dxf")
        code, said = self.convert("--blocks", self.folder / "b.wkt", "--arc", "0.001")
        self.assertEqual(code, 0, said)
        self.assertIn("blocks            1 (1 free)", self.check('blocks_file = "b.wkt"\n'))

    def test_errors_say_what_is_wrong(self):
        blocks, traces = self.folder / "b.csv", self.folder / "t.wkt"
        for arguments, expected, words in (([], 2, "give --blocks or --traces"), (["--traces", traces, "--scale", "0"], 2, "must be positive"),
                                           (["--traces", traces, "--layer", "none"], 2, "no traces found"),
                                           (["--traces", self.folder / "t.txt"], 2, "neither .wkt nor .csv"), (["--blocks", "B.CSV"], 2, "neither .wkt nor .csv"),
                                           (["--blocks", blocks, "--material", "BLOCKS"], 2, "not LAYER=NAME"),
                                           (["--blocks", blocks, "--material", "BLOCKS=a b"], 2, "not LAYER=NAME"),
                                           (["--blocks", blocks, "--fixed", "JOINTS"], 2, "Layers with blocks are blocks"),
                                           (["--traces", traces, "--fixed", "BLOCKS"], 2, "give --blocks too"),
                                           (["--traces", self.folder / "none/t.wkt"], 1, "No such file")):
            code, said = self.convert(*arguments)
            self.assertEqual(code, expected, said)
            self.assertIn(words, said)
            self.assertFalse(blocks.exists())
        (self.folder / "map.dxf").write_text("not a drawing")
        code, said = self.convert("--traces", traces)
        self.assertEqual(code, 2)
        self.assertIn("cannot be read", said)
        self.assertNotIn("Traceback", said)

    def refused_within(self, name, limit):
        """Exit code and error with a lower limit than the program's, which takes a minute to come to."""
        program = f"import sys; sys.path.insert(0, {str(TOOLS)!r}); import import_dxf; import_dxf.{name} = {limit}; sys.exit(import_dxf.main(sys.argv[1:]))"
        done = subprocess.run([sys.executable, "-c", program, self.folder / "map.dxf", "--traces", self.folder / "t.wkt"], capture_output=True, text=True, check=False)
        self.assertEqual((done.stdout, done.stderr.count("\n")), ("", 1), done.stderr)
        return done.returncode, done.stderr

    def test_nothing_but_a_drawing_is_read_and_none_that_is_too_large(self):
        traces = self.folder / "t.wkt"
        for make, code, words in ((os.mkfifo, 2, "a pipe"), (lambda file: file.symlink_to("/dev/zero"), 2, "a device"), (os.mkdir, 2, "Is a directory"),
                                  (lambda file: (file.touch(), os.truncate(file, 1500 << 20)), 2, "1572864000 bytes, more than 67108864")):
            file = self.folder / "map.dxf"
            file.rmdir() if file.is_dir() else file.unlink()
            make(file)
            found, said = self.convert("--traces", traces)
            self.assertEqual((found, said.count("\n")), (code, 1), said)
            self.assertRegex(said, rf"^error: import_dxf: {file}: .*{words}.*\. Give ")

    def test_memory_is_limited(self):
        """Tiny entities take 70 bytes of memory for each of theirs."""
        (self.folder / "map.dxf").write_text("0\nSECTION\n2\nENTITIES\n" + 700000 * "0\nLINE\n" + "0\nENDSEC\n0\nEOF\n")
        code, said = self.refused_within("MOST_MEMORY", 300 << 20)
        self.assertEqual(code, 1)
        self.assertIn("map.dxf: takes more than 314572800 bytes of memory. Save the layers", said)

    def test_references_that_multiply_are_refused(self):
        drawing = ezdxf.new()
        for depth in range(6):
            block = drawing.blocks.new(f"B{depth}")
            for i in range(10 if depth else 0):
                block.add_blockref(f"B{depth - 1}", (i, 0))
        drawing.modelspace().add_blockref("B5", (0, 0))
        drawing.saveas(self.folder / "map.dxf")
        code, said = self.refused_within("MOST_PIECES", 20000)
        self.assertEqual(code, 2)
        self.assertIn("has more than 20000 entities, with those of block references. Save the layers", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
