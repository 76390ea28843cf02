#!/usr/bin/python3
"""Blocks and traces of a map come into hdem from a shapefile, by the command that hdem itself gives.

    shapefile_test.py HDEM    the program

The shapefiles are made of samples/*.geojson by ogr2ogr. Exit code 77 (skipped) without it; tools/setup installs its package, gdal-bin.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import small_case

HDEM = Path(sys.argv[1]).resolve()
SAMPLES = Path(__file__).resolve().parent / "samples"
if not shutil.which("ogr2ogr"):
    print("skipped: ogr2ogr is missing (Debian package gdal-bin). Run tools/setup.")
    sys.exit(77)

END = small_case.ROCK + "[material.hard]\ndensity = 3000.0\n[[stage]]\ncycles = 10\n"
BLOCKS = "blocks_file = 'blocks.{}'\n" + END
TRACES = "[domain]\nwidth = 10.0\nheight = 8.0\nfixed = ['bottom']\ntraces_file = 'traces.{}'\n" + END


def outline(ring):
    """Points of a closed ring, wherever it begins and whichever way it runs. ogr2ogr writes 15 digits of a number, not all."""
    points = [tuple(round(number, 12) for number in point) for point in ring[:-1]]
    first = points.index(min(points))
    points = points[first:] + points[:first]
    return tuple(points if points[1] < points[-1] else [points[0], *reversed(points[1:])])


class Shapefile(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(prefix="hdem_shapefile_test_")
        self.folder = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def to_shapefile(self, name):
        subprocess.run(["ogr2ogr", self.folder / f"{name}.shp", SAMPLES / f"{name}.geojson"], check=True)
        self.assertEqual((self.folder / f"{name}.shp").read_bytes()[:4], b"\x00\x00\x27\x0a", "this is no shapefile")

    def check(self, text, *words):
        (self.folder / "case.toml").write_text(text, encoding="utf-8")
        return subprocess.run([HDEM, "check", "case.toml", *words], cwd=self.folder, capture_output=True, text=True, check=False)

    def blocks_of(self, text):
        """Outline, material and what is fixed of each block, by name."""
        done = self.check(text, "--write-blocks", "all.geojson")
        self.assertEqual(done.returncode, 0, done.stderr)
        features = json.loads((self.folder / "all.geojson").read_text(encoding="utf-8"))["features"]
        return {f["properties"]["name"]: (outline(f["geometry"]["coordinates"][0]), f["properties"]["material"], f["properties"]["fixed"]) for f in features}

    def convert_as_told(self, text):
        """Gives the shapefile to hdem, and runs the command that its message has."""
        done = self.check(text.format("shp"))
        self.assertEqual(done.returncode, 2)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        command = re.search(r"ogr2ogr -f GeoJSON \S+ \S+", done.stderr)
        self.assertTrue(command, done.stderr)
        self.assertIn("gdal-bin", done.stderr)
        subprocess.run(command.group().split(), cwd=self.folder, check=True)

    def test_blocks_come_with_name_material_and_what_is_fixed(self):
        self.to_shapefile("blocks")
        self.convert_as_told(BLOCKS)
        found = self.blocks_of(BLOCKS.format("geojson"))
        drawn = json.loads((SAMPLES / "blocks.geojson").read_text(encoding="utf-8"))["features"]
        self.assertEqual(set(found), {"ground", "corner", "roller"})
        for feature in drawn:
            points, material, fixed = found[feature["properties"]["name"]]
            self.assertEqual(points, outline(feature["geometry"]["coordinates"][0]))
            self.assertEqual(material, feature["properties"]["material"])
            self.assertEqual(fixed or None, feature["properties"]["fixed"])

    def test_traces_cut_the_same_blocks(self):
        self.to_shapefile("traces")
        self.convert_as_told(TRACES)
        found = self.blocks_of(TRACES.format("geojson"))
        shutil.copy(SAMPLES / "traces.geojson", self.folder / "drawn.geojson")
        self.assertEqual(len(found), 7)
        self.assertEqual({block[0] for block in found.values()}, {block[0] for block in self.blocks_of(TRACES.replace("traces.{}", "drawn.geojson")).values()})

    def test_blocks_that_hdem_wrote_go_through_a_shapefile(self):
        shutil.copy(SAMPLES / "traces.geojson", self.folder)
        cut = self.blocks_of(TRACES.format("geojson"))
        subprocess.run(["ogr2ogr", self.folder / "blocks.shp", self.folder / "all.geojson"], check=True, stderr=subprocess.DEVNULL)  # long names are cut
        self.convert_as_told(BLOCKS)
        self.assertEqual(self.blocks_of(BLOCKS.format("geojson")), cut)

    def test_a_drawing_and_other_maps_have_their_command_too(self):
        for name, command in (("map.DXF", "tools/import_dxf.py map.DXF --blocks map.wkt"), ("map.gpkg", "ogr2ogr -f GeoJSON map.geojson map.gpkg")):
            done = self.check(BLOCKS.replace("blocks.{}", name))
            self.assertEqual(done.returncode, 2)
            self.assertIn(command, done.stderr)
        self.assertIn("is there", self.check(BLOCKS.replace("blocks.{}", "is there.wkt")).stderr, "other names are read as they were")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
