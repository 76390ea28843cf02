#!/usr/bin/python3
"""Quick checks of perf/scaling, perf/peers and perf/beside_others with a stand-in for their program, and of hdem_scene.

    studies_test.py PERF HDEM_SCENE    the folder of the scripts, the program

Exit code 77 (skipped) without matplotlib.
"""
import csv
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import matplotlib    # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import stand_in

PERF, SCENE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()


def cycle(blocks, threads, speed, flops):
    return stand_in.row(f"cycle/wall/{blocks}/hybrid/{threads}", state_hash=float(blocks), contact_point_updates_per_second=speed, flops_per_second=flops,
                        blocks=float(blocks), roofline_share=0.4, ns_per_contact_point=1e9 / speed)


class Studies(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def run_script(self, name, *arguments):
        done = subprocess.run([PERF / name, "--program", self.folder / "hdem_perf", *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertNotIn("Traceback", done.stderr)
        return done.returncode, done.stdout + done.stderr

    def table(self, name):
        with (self.folder / name).open() as lines:
            return list(csv.DictReader(lines))

    def test_scaling_tables_and_figures(self):
        stand_in.write(self.folder / "hdem_perf", [cycle(10000, 1, 50e6, 40e9), cycle(10000, 2, 90e6, 76e9), cycle(20000, 2, 80e6, 76e9), cycle(40000, 2, 1.0, 1.0)])
        code, said = self.run_script("scaling", "-o", self.folder / "out", "--sizes", 10000, "--processes", 2)
        self.assertEqual(code, 0, said)
        strong, weak, size = (self.table(f"out/{name}.csv") for name in ("strong", "weak", "size"))
        self.assertEqual([(row["threads"], row["speedup"], row["efficiency"], row["machine_speedup"]) for row in strong], [("1", "1", "1", "1"), ("2", "1.8", "0.9", "1.9")])
        self.assertEqual([(row["threads"], row["efficiency"]) for row in weak], [("1", "1"), ("2", "0.8")])
        self.assertEqual([row["updates_per_second"] for row in size], ["5e+07", "9e+07"])
        for name in ("strong", "weak", "size"):
            self.assertIn("<svg", (self.folder / f"out/{name}.svg").read_text())

    def test_scaling_refuses_states_that_differ(self):
        stand_in.write(self.folder / "hdem_perf", [cycle(10000, 1, 50e6, 40e9), cycle(10000, 2, 90e6, 76e9) | {"state_hash": 1.0}])
        code, said = self.run_script("scaling", "-o", self.folder / "out", "--sizes", 10000, "--processes", 1)
        self.assertEqual(code, 1)
        self.assertIn("2 different states", said)
        self.assertFalse((self.folder / "out").exists())

    def test_peers_prints_ratios(self):
        rows = [stand_in.row(f"cycle/wall/1000/{method}/1", state_hash=1.0, ns_per_contact_point=10.0) for method in ("force", "hybrid")]
        stand_in.write(self.folder / "hdem_perf", rows + [stand_in.row("box2d/wall/1000", ns_per_contact_point=900.0)])
        code, said = self.run_script("peers", "--scenes", "wall", "--blocks", 1000, "-o", self.folder / "peers.csv")
        self.assertEqual(code, 0, said)
        self.assertEqual([(row["method"], row["n"], row["ratio"]) for row in self.table("peers.csv")], [("force", "5", "90.0"), ("hybrid", "5", "90.0")])
        self.assertEqual(self.run_script("peers", "--processes", 4)[0], 2, "a median of four")
        v3 = [stand_in.row(f"box2d_v3_{substeps}/wall/1000", ns_per_contact_point=ns) for substeps, ns in ((4, 30.0), (16, 15.0))]
        stand_in.write(self.folder / "hdem_perf", rows + [stand_in.row("box2d/wall/1000", ns_per_contact_point=900.0)] + v3)
        code, said = self.run_script("peers", "--scenes", "wall", "--blocks", 1000, "--box2d-v3", self.folder, "-o", self.folder / "peers.csv")
        self.assertEqual(code, 0, said)
        self.assertEqual([row["ratio"] for row in self.table("peers.csv") if row["method"] == "hybrid"], ["90.0", "3.0", "1.5"])
        stand_in.write(self.folder / "hdem_perf", rows)
        self.assertIn("has no Box2D", self.run_script("peers", "--scenes", "wall", "--blocks", 1000)[1])

    def test_peers_refuses_a_folder_without_box2d_v3(self):
        done = subprocess.run([PERF / "peers", "--box2d-v3", self.folder], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("no include/box2d/id.h below it", done.stderr)

    def beside(self, hash_of_auto):
        """perf/beside_others with a stand-in for hdem that takes 3 s, and 2 s with threads that adapt."""
        program = self.folder / "hdem_perf"
        program.write_text("#!/usr/bin/python3\n"
                           "import json, pathlib, sys\n"
                           "auto = sys.argv[sys.argv.index('--threads') + 1] == 'auto'\n"
                           "folder = pathlib.Path(sys.argv[sys.argv.index('-o') + 1])\n"
                           "folder.mkdir()\n"
                           f"summary = {{'timing': {{'force': {{'mean': 2.0 if auto else 3.0}}}}, 'state_hash': {hash_of_auto!r} if auto else 'a'}}\n"
                           "(folder / 'summary.json').write_text(json.dumps(summary))\n", encoding="utf-8")
        program.chmod(0o755)
        return self.run_script("beside_others", "two", "busy_1", "alone", "--rounds", 1, "--blocks", 541, 10000)

    def test_beside_others_prints_ratios_of_rounds(self):
        code, said = self.beside("a")
        self.assertEqual(code, 0, said)
        self.assertRegex(said, r"(?s)two runs at once: 1 rounds.*auto / 1 +0\.667 ")
        self.assertRegex(said, r"(?s)one run beside 1 busy.*auto beside / 1 beside +0\.667 ")
        self.assertEqual(said.count("auto / best fixed"), 2)

    def test_beside_others_refuses_states_that_differ(self):
        code, said = self.beside("b")
        self.assertEqual(code, 1)
        self.assertIn("states differ: ['a', 'b']", said)

    def test_scene_for_other_programs(self):
        file = self.folder / "wall.json"
        subprocess.run([SCENE, "wall", "100", file], check=True)
        scene = json.loads(file.read_text())
        self.assertEqual(scene["scene"], "wall")
        free = [block for block in scene["blocks"] if not block["fixed"]]
        self.assertEqual(len(free), 100)
        self.assertGreater(scene["contact_points"], 500)
        for block in free:
            self.assertAlmostEqual(block["mass"], 2700.0 * block["area"], delta=1e-6)
            [part] = block["parts"]
            area = 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(part, part[1:] + part[:1]))
            self.assertAlmostEqual(area, block["area"], delta=1e-9, msg="anticlockwise, and all of it")
        for arguments in (["hill", "100"], ["wall", "12x"], ["wall"]):
            self.assertEqual(subprocess.run([SCENE, *arguments], capture_output=True, check=False).returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
