#!/usr/bin/python3
"""The ensemble chooses, compares, resumes and reports; its runs are those of a stand-in for hdem that needs no time.

    ensemble_test.py HDEM TOOLS CASES    the program, the folder of its scripts, and that of the verification's cases
"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

HDEM, TOOLS, CASES = (Path(word).resolve() for word in sys.argv[1:4])
sys.path[:0] = [str(TOOLS), str(TOOLS / "ensemble_parts")]
try:
    import numpy as np
    import comparison
    import profiles
    import runs
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

# Copies the results of one real run, with a summary that follows from the settings. What it was told is kept in `calls`.
STAND_IN = '''#!/usr/bin/python3 -IS
import json, os, shutil, sys, time
from pathlib import Path
here = Path(__file__).resolve().parent
if sys.argv[1] == "--version":
    sys.exit(print("hdem 0.0.0 (stand-in)"))
words = sys.argv[2:]
folder = Path(words[words.index("-o") + 1])
told = dict(words[i + 1].split("=") for i, word in enumerate(words) if word == "--set")
kind = "force" if told.get("contact.method") == "force" else "matched" if "contact.restitution" in told else "hybrid"
with open(here / "calls", "a") as calls:
    calls.write(folder.parent.name + " " + folder.name + "\\n")
if kind == os.environ.get("FAIL"):
    sys.exit(print("error: it blew up", file=sys.stderr) or 1)
if kind == os.environ.get("HANG"):
    (here / "hangs").touch()
    time.sleep(60)
seed, limit = int(told["generator.seed"]), int(told["stage[1].max_cycles"])
shutil.copytree(here / "real", folder, dirs_exist_ok=True)
detached = {2: 0, 3: 20}.get(seed, seed)
if os.environ.get("NOTHING_FALLS"):
    detached = 0
cycles = {"force": 1000 * seed, "hybrid": 400 * seed, "matched": 600 * seed}[kind] if seed != 4 else limit
names = [f"none{i}" for i in range(detached - (kind == "hybrid" and seed == 5))]
summary = json.loads((folder / "summary.json").read_text()) | {
    "cycles_after_excavation": cycles, "converged": seed != 4, "detached_blocks": names, "max_displacement": 2e-3,
    "mean_displacement": 1e-3 + (kind != "force") * seed * 1e-6, "wall_seconds": {"force": 9.0, "hybrid": 3.0, "matched": 2.0}[kind],
    "stage_wall_seconds": [1.0, {"force": 8.0, "hybrid": 2.0, "matched": 1.0}[kind]]}
(folder / "summary.json").write_text(json.dumps(summary))
sys.exit(0 if summary["converged"] else 4)
'''


def real_run(scratch):
    """A few cycles of each kind of run: the program takes the case and all that is set in it."""
    for name, settings in runs.VARIANTS.items():
        settings = [*runs.Geometry(1, (25, 75, -55)).settings, *settings, "stage[0].cycles=20", "stage[1].max_cycles=20"]
        done = subprocess.run([HDEM, "run", CASES / "ensemble/tunnel.toml", "-o", scratch / name, "--quiet", "--threads", "1",
                               *(word for setting in settings for word in ("--set", setting))], capture_output=True, text=True, check=False)
        if done.returncode != runs.NOT_CONVERGED:
            raise AssertionError(f"{name}: {done.stderr}")
    (scratch / runs.REFERENCE).rename(scratch / "real")


class Ensemble(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_ensemble_test_")
        cls.folder = Path(cls.scratch.name)
        real_run(cls.folder)
        cls.program = cls.folder / "hdem"
        cls.program.write_text(STAND_IN, encoding="utf-8")
        cls.program.chmod(0o755)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def setUp(self):
        (self.folder / "calls").unlink(missing_ok=True)

    def words(self, *arguments):
        return [TOOLS / "ensemble", "-o", self.folder / self.id(), "--program", self.program, *map(str, arguments)]

    def ensemble(self, *arguments, **variables):
        """Exit code, what was printed, what was said on errors."""
        done = subprocess.run(self.words(*arguments), capture_output=True, text=True, check=False, cwd=self.folder, env=os.environ | variables)
        return done.returncode, done.stdout, done.stderr

    def found(self):
        return json.loads((self.folder / self.id() / "ensemble.json").read_text(encoding="utf-8"))

    def calls(self):
        file = self.folder / "calls"
        return file.read_text().split("\n")[:-1] if file.exists() else []

    def test_compares(self):
        code, printed, said = self.ensemble("--realisations", 5)
        self.assertEqual(code, 0, said)
        found = self.found()
        self.assertAlmostEqual(found["median_reduction_paper_pairing"], 0.6)
        self.assertAlmostEqual(found["worst_reduction_paper_pairing"], 0.6)
        self.assertAlmostEqual(found["median_reduction_matched_pairing"], 0.4)
        self.assertEqual(found["median_wall_speedup"], 4.0)
        self.assertEqual(found["median_whole_run_speedup"], 3.0)
        self.assertAlmostEqual(found["statistics"]["hybrid"]["displacement_difference_mm"]["worst"], 5e-3)
        self.assertAlmostEqual(found["median_displacement_difference_mm"], 1e-3)
        self.assertAlmostEqual(found["same_detached_fraction"], 4 / 5, msg="seed 5 lets another block fall")
        self.assertEqual(found["median_stress_difference"], 0.0)
        self.assertAlmostEqual(found["statistics"]["hybrid_standing"]["reduction"]["median"], 0.6, msg="beside force_standing")
        self.assertEqual({run["cycles_after_excavation"] for run in found["collapses"][0]["runs"].values()}, {3000, 1200, 1800})
        for words in ("5 realisations, hdem 0.0.0 (stand-in)", "60.0 (60.0 to 60.0) 60.0", "Discarded geometries: 3", "Collapses, to at most 60000"):
            self.assertIn(words, printed)
        self.assertIn("<svg", (self.folder / self.id() / "ensemble.svg").read_text(encoding="utf-8"))

    def test_chooses_the_same_whatever_runs_side_by_side(self):
        for jobs in (1, 4):
            self.assertEqual(self.ensemble("--realisations", 5, "--jobs", jobs, "-o", f"jobs_{jobs}", "--json", "found.json")[0], 0)
            found = json.loads((self.folder / "found.json").read_text(encoding="utf-8"))
            seeds = {key: [(row["seed"], row["dips_deg"][0]) for row in found[key]] for key in ("realisations", "discards", "collapses")}
            self.assertEqual(seeds, {"realisations": [(1, 20), (1, 25), (1, 30), (1, 35), (5, 25)], "discards": [(2, 25), (3, 25), (4, 25)],
                                     "collapses": [(3, 25), (4, 25)]})
            self.assertEqual([row["reason"] for row in found["discards"]],
                             ["no block detached", "20 blocks detached", "not converged within 300000 cycles"])

    def test_goes_on_with_what_is_missing(self):
        self.assertEqual(self.ensemble("--realisations", 1)[0], 0)
        self.assertEqual(len(self.calls()), 7 + 3 + 3, "a realisation, three geometries until one collapses, the collapse")
        self.setUp()
        self.assertEqual(self.ensemble("--realisations", 1)[0], 0)
        self.assertEqual(self.calls(), [])
        summary = self.folder / self.id() / "25_75_-55_seed_1/hybrid_300000/summary.json"
        for make in (lambda file: None, os.mkfifo, lambda file: file.write_text("[" * 200000)):
            self.setUp()
            summary.unlink()
            make(summary)
            self.assertEqual(self.ensemble("--realisations", 1)[0], 0)
            self.assertEqual(self.calls(), ["25_75_-55_seed_1 hybrid_300000"])
        self.setUp()
        other = self.folder / "other"
        other.write_text(STAND_IN + "# changed\n", encoding="utf-8")
        other.chmod(0o755)
        self.assertEqual(self.ensemble("--realisations", 1, "--program", other)[0], 0)
        self.assertEqual(len(self.calls()), 13, "another program")
        damaged = self.folder / self.id() / "25_75_-55_seed_1/hybrid_300000/results.h5"
        damaged.write_bytes(damaged.read_bytes()[:5000])
        code, _, said = self.ensemble("--realisations", 1, "--program", other)
        self.assertEqual((code, "Traceback" in said), (2, False), said)
        self.assertIn(f"error: ensemble: {damaged}: ", said)

    def test_goes_on_after_an_interruption(self):
        with subprocess.Popen(self.words("--realisations", 1), stderr=subprocess.PIPE, text=True, env=os.environ | {"HANG": "matched"}) as process:
            while not (self.folder / "hangs").exists() and process.poll() is None:
                time.sleep(0.02)
            process.send_signal(signal.SIGTERM)
            said = process.communicate(timeout=20)[1]
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("the same line goes on", said)
        self.assertNotIn("Traceback", said)
        self.setUp()
        self.assertEqual(self.ensemble("--realisations", 1)[0], 0)
        self.assertEqual(self.calls()[:2], ["25_75_-55_seed_1 hybrid_matched_300000", "25_75_-55_seed_1 hybrid_paper_300000"])

    def test_runs_that_fail_are_told(self):
        code, printed, said = self.ensemble("--realisations", 1, FAIL="matched")
        self.assertEqual(code, 1)
        self.assertIn("hybrid_matched: error: it blew up", said)
        self.assertIn("60.0", printed)
        self.assertIsNone(self.found()["median_reduction_matched_pairing"])

    def test_too_few_geometries(self):
        code, _, said = self.ensemble("--realisations", 1, NOTHING_FALLS="1")
        self.assertEqual(code, 1)
        self.assertIn("20 seeds do not give the 1 geometries", said)
        self.assertEqual(len(self.calls()), 20)

    def test_wrong_use_is_one_line(self):
        for arguments, words in ((["--realisations", "0"], "--realisations: 0 (must be"), (["--realisations", "x"], "invalid int"),
                                 (["--jobs", "0"], "--jobs: 0"), (["--nonsense"], "unrecognized"), (["--figure", "f.doc"], "must end in .svg"),
                                 (["--json", "nowhere/f.json"], "cannot be written"), (["--program", "nowhere"], "cannot be run"),
                                 (["--program", "/bin/true"], "not hdem")):
            code, printed, said = self.ensemble(*arguments)
            self.assertEqual((code, printed), (2, ""), said)
            self.assertIn(words, said)
            self.assertEqual(said.count("\n"), 1, said)
        self.assertEqual(self.calls(), [])


class Figures(unittest.TestCase):
    def test_profiles_meet_blocks_behind_the_boundary(self):
        """Squares of 1 m, some of them in the opening of 2.2 m x 2 m; the rays go through the middle of a row."""
        squares = [(x, y) for x in range(-14, 14) for y in range(-14, 14)]
        corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
        rings = [np.array(square) + corners for square in squares]
        edges = np.concatenate([np.stack([ring, np.roll(ring, -1, axis=0)], axis=1) for ring in rings])
        opening = corners * [2.2, 2.0] - [1.1, 0.5]    # middle (0, 0.5)
        blocks = {"edges": edges, "edge_block": np.repeat(np.arange(len(rings)), 4),
                  "outline": np.stack([opening, np.roll(opening, -1, axis=0)], axis=1)}
        self.assertEqual([squares[i] for i in profiles.blocks_along(blocks, 0.0)], [(x, 0) for x in range(1, 12)])
        self.assertEqual([squares[i] for i in profiles.blocks_along(blocks, 180.0)], [(x, 0) for x in range(-12, -1)])

    def test_major_stress(self):
        stress = {"stress_xx": np.array([3.0, 1.0]), "stress_yy": np.array([1.0, 1.0]), "stress_xy": np.array([0.0, 2.0])}
        np.testing.assert_allclose(profiles.major_stress(stress), [3.0, 3.0])

    def test_spread(self):
        self.assertEqual(comparison.spread("reduction", [0.1, 0.2, 0.3, 0.4, 0.9]), {"count": 5, "median": 0.3, "quartiles": [0.2, 0.4], "worst": 0.1})
        self.assertEqual(comparison.spread("stress_difference", [0.1, 0.2])["worst"], 0.2)
        self.assertEqual(comparison.spread("reduction", [0.5])["quartiles"], [0.5, 0.5])
        self.assertIsNone(comparison.spread("reduction", [])["median"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
