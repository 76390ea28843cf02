#!/usr/bin/python3
"""Studies with tools/sweep: designs, chains, statistics, and a stop when enough is known.

    sweep_study_test.py HDEM TOOLS    the program, and the folder of its scripts
"""
import json
import os
import subprocess
import sys
import unittest

from sweep_scratch import TOOLS, Scratch
import numpy as np
from sweep_parts import designs, estimates, plans, runs
from sweep_parts.common import SweepError
from sweep_parts.criterion import Criterion
from sweep_parts.work import Enough


class Numbers(unittest.TestCase):
    def test_interval_is_that_of_wilson(self):
        # z = 1.959964: (p + z^2/2n -+ z sqrt(p(1-p)/n + z^2/4n^2)) / (1 + z^2/n), by hand.
        for failed, count, low, high in ((0, 10, 0.0, 0.27753), (5, 10, 0.23659, 0.76341), (81, 263, 0.25529, 0.36621)):
            share = estimates.share_of(failed, count, 0.95)
            self.assertAlmostEqual(share.low, low, delta=1e-5)
            self.assertAlmostEqual(share.high, high, delta=1e-5)
        self.assertLess(estimates.share_of(5, 10, 0.9).width, share_width := estimates.share_of(5, 10, 0.95).width)
        self.assertLess(share_width, estimates.share_of(5, 10, 0.99).width)

    def test_quartiles(self):
        spread = estimates.spread_of([5.0, 1.0, 4.0, 2.0, 3.0])
        self.assertEqual([spread[name] for name in ("runs", "least", "lower_quartile", "median", "upper_quartile", "greatest", "mean")], [5, 1.0, 2.0, 3.0, 4.0, 5.0, 3.0])
        self.assertAlmostEqual(spread["standard_deviation"], 2.5**0.5)

    def test_histogram_counts_every_run_once(self):
        values = [0, 0, 1, 3, 3, 3]
        rows = estimates.histogram(values, [value > 0 for value in values])
        self.assertEqual([(row["from"], row["to"], row["runs"], row["failed"]) for row in rows], [(-0.5, 0.5, 2, 0), (0.5, 1.5, 1, 1), (1.5, 2.5, 0, 0), (2.5, 3.5, 3, 3)])
        spread = np.random.default_rng(1).normal(size=500)
        rows = estimates.histogram(list(spread), None)
        self.assertEqual(sum(row["runs"] for row in rows), 500)
        self.assertEqual((rows[0]["from"], rows[-1]["to"]), (spread.min(), spread.max()))

    def test_criterion(self):
        row = {"fallen": 3, "converged": False, "none": None, "energy.friction": 1e4, "title": "x"}
        for text, expected in (("fallen>2", True), ("fallen>3", False), ("fallen>=3", True), ("fallen<3", False), ("fallen=3", True), ("converged=false", True),
                               ("converged=true", False), ("energy.friction>9.9e3", True), ("none>1", None)):
            self.assertIs(Criterion([text]).fails(row), expected, text)
        self.assertIs(Criterion(["fallen>5", "converged=false"]).fails(row), True, "one is enough")
        self.assertIsNone(Criterion(["fallen>5", "none>1"]).fails(row))
        self.assertIs(Criterion(["fallen>2", "none>1"]).fails(row), True)
        for text in ("fallen", "fallen>x", "fallen>nan", ">2", "fallen>1>2"):
            with self.assertRaises(SweepError, msg=text):
                Criterion([text])
        with self.assertRaisesRegex(SweepError, "Did you mean fallen"):
            Criterion(["falen>2"]).check_names([row])
        with self.assertRaisesRegex(SweepError, "title: no run has such a number"):
            Criterion(["title=1"]).check_names([row])


class Designs(unittest.TestCase):
    def test_each_sixteenth_of_a_range_has_one_of_sixteen_runs(self):
        for kind in designs.DESIGNS:
            for seed in (1, 2):
                values = np.array(designs.sample(kind, [("a", "0:16"), ("b", "-8:8")], 16, seed), dtype=float)
                self.assertEqual(sorted(np.floor(values[:, 0])), list(range(16)), kind)
                self.assertEqual(sorted(np.floor(values[:, 1])), list(range(-8, 8)), kind)
        varied = [("a", "0:1")]
        self.assertEqual(designs.sample("sobol", varied, 8, 3), designs.sample("sobol", varied, 8, 3))
        self.assertNotEqual(designs.sample("sobol", varied, 8, 3), designs.sample("sobol", varied, 8, 4))

    def test_distributions_have_their_mean_and_deviation(self):
        for kind in designs.DESIGNS:
            values = np.array(designs.sample(kind, [("a", "normal:30:3"), ("b", "lognormal:10:4"), ("c", "whole:1:4")], 1024, 1), dtype=float)
            self.assertAlmostEqual(values[:, 0].mean(), 30.0, delta=0.01)
            self.assertAlmostEqual(values[:, 0].std(), 3.0, delta=0.03)
            self.assertAlmostEqual(values[:, 1].mean(), 10.0, delta=0.05)
            self.assertAlmostEqual(values[:, 1].std(), 4.0, delta=0.12)
            self.assertGreater(values[:, 1].min(), 0.0)
            self.assertEqual([(values[:, 2] == n).sum() for n in range(1, 5)], [256] * 4)

    def test_what_is_no_distribution_is_refused(self):
        for text in ("1,2,3", "1", "2:1", "normal:1", "normal:1:0", "lognormal:-1:2", "whole:1.5:3", "gamma:1:2", "nan:1", "whole:1:99999999999999999999999",
                     "whole:-1e300:1"):
            with self.assertRaisesRegex(SweepError, f"--vary a={text}: ", msg=text):
                designs.sample("latin", [("a", text)], 4, 1)
        with self.assertRaisesRegex(SweepError, "from -9007199254740992 to 9007199254740992"):
            designs.sample("latin", [("a", f"whole:0:{2**53 + 2}")], 4, 1)
        designs.sample("latin", [("a", f"whole:{-2**53}:{2**53}")], 4, 1)
        with self.assertRaisesRegex(SweepError, "Take 64 or 128"):
            designs.sample("sobol", [("a", "0:1")], 100, 1)


class Work(Scratch):
    def test_runs_all_and_leaves_alone_what_is_done(self):
        self.plan("--vary", "x=1:5")
        self.assertEqual(self.work(), "5 runs: 5 done; 0 without an outcome\n")
        self.assertEqual(len(self.calls()), 5)
        self.assertEqual(self.work(), "5 runs: 5 done; 0 without an outcome\n")
        self.assertEqual(len(self.calls()), 5)

    def test_grid_is_shuffled_and_a_design_is_not(self):
        grid = {"runs": [{}] * 50}
        self.assertNotEqual(plans.order_of(grid), list(range(1, 51)))
        self.assertEqual(sorted(plans.order_of(grid)), list(range(1, 51)))
        self.assertEqual(plans.order_of(grid), plans.order_of(grid))
        self.assertEqual(plans.order_of(grid | {"design": {}}), list(range(1, 51)))

    def test_stops_when_the_interval_is_narrow_enough(self):
        # All fail: the interval of n runs is z^2 / (n + z^2) wide, 0.2 from n = 15.4 on.
        self.plan("--vary", "x=30:99")
        said = self.work("--fails", "fallen>0", "--until-width", "0.2", "--at-least", "5")
        self.assertIn("enough is known: 16 of 16 failed, 1.000; 95 % interval 0.806 to 1.000, no wider than 0.2", said)
        self.assertEqual(len(self.calls()), 16)
        self.work("--fails", "fallen>0", "--until-width", "0.2", "--at-least", "5")
        self.assertEqual(len(self.calls()), 16, "the same line finds that enough is known")
        self.work("--fails", "fallen>0", "--until-width", "0.2", "--at-least", "30")
        self.assertEqual(len(self.calls()), 30)

    def test_a_run_that_is_still_missing_holds_up_all_behind_it(self):
        self.plan("--vary", "x=30:99")
        self.work()
        options = type("", (), {"until_width": 0.2, "at_least": 5, "level": 0.95, "fails": ["fallen>0"]})
        order = plans.order_of(plans.read(self.folder / "s"))
        plan = plans.read(self.folder / "s")

        def reached():
            return Enough(options, lambda number: runs.summary_of(self.folder / "s", plan, number)).reached(order)
        self.assertTrue(reached())
        (self.folder / f"s/run_{order[3]:06d}/summary.json").unlink()
        self.assertFalse(reached())

    def test_exit_code_is_that_of_the_worst(self):
        self.plan("--vary", "x=1:4")
        self.assertIn("3 done, 1 failed; 1 without", self.work(code=1, STOP="3", CODE="1").replace("1 failed, 3 done", "3 done, 1 failed").replace("2 done, 1 failed, 1 done", "3 done, 1 failed"))

    def test_factor_of_safety_is_awaited(self):
        self.plan("--vary", "x=10,30", "--command", "fos")
        self.work()
        self.assertEqual(self.sweep("collect", "s", code=1).split(":")[1].strip(), "0 of 2 runs done, 2 cut short", "its stages alone are not the search")
        self.work(FACTOR="1")
        self.assertEqual(len(self.calls()), 4)
        self.assertIn("1 of 2 failed", self.sweep("collect", "s", "--fails", "factor_of_safety.factor<1.2", "--of", "factor_of_safety.factor"))
        self.assertIn("cannot be bisected", self.sweep("plan", "case.toml", "-o", "t", "--command", "fos", *Chains.WORDS, code=2))

    def test_two_workers_share_a_plan(self):
        self.plan("--vary", "x=1:40")
        words = [TOOLS / "sweep", "work", "s", "--jobs", "2", "--program", self.program]
        workers = [subprocess.Popen(words, cwd=self.folder, stdout=subprocess.PIPE, text=True) for _ in range(2)]
        for worker in workers:
            worker.communicate()
            self.assertEqual(worker.returncode, 0)
        self.assertEqual(sorted(int(call.split()[0][4:]) for call in self.calls()), list(range(1, 41)), "each run once")

    def test_refuses(self):
        self.plan("--vary", "x=1:2")
        for words, reason in ((["--until-width", "0.1"], "needs --fails"), (["--until-width", "2", "--fails", "fallen>0"], "between 0 and 1"),
                              (["--fails", "falen>0", "--until-width", "0.5", "--at-least", "1"], "Did you mean fallen"), (["--jobs", "0"], "at least 1"),
                              (["--fails", "fallen>0", "--until-width", "0.5", "--at-least", "1", "--level", "2"], "between 0 and 1")):
            self.assertIn(reason, self.work(*words, code=2))


class Chains(Scratch):
    WORDS = ("--bisect", "x=0:100", "--tolerance", "0.5", "--fails", "fallen>0")

    def test_close_in_on_the_value_where_failing_begins(self):
        self.plan("--vary", "seed=0,5,70", *self.WORDS)
        self.assertEqual(self.work(), "3 runs: 3 done; 0 without an outcome\n")
        self.sweep("collect", "s", "--of", "critical")
        for row, expected in zip(self.rows("table.csv"), (23.7, 28.7, 93.7)):
            low, high = float(row["stands_at"]), float(row["fails_at"])
            self.assertTrue(low <= expected <= high and high - low <= 0.5, row)
            self.assertEqual(float(row["critical"]), 0.5 * (low + high))
        self.assertAlmostEqual(float(self.rows("statistics.csv")[0]["median"]), 28.7, delta=0.5)

    def test_count_runs_that_were_too_short(self):
        self.plan("--vary", "seed=0", *self.WORDS)
        self.work(SLOW="30")
        self.sweep("collect", "s")
        steps = [json.loads(path.read_text()) for path in sorted(self.folder.glob("s/run_000001/step_*/summary.json"))]
        slow = sum(not step["converged"] and not step["fallen"] for step in steps)
        self.assertGreater(slow, 0)
        self.assertEqual(int(self.rows("table.csv")[0]["not_converged"]), slow)

    def test_cut_short_goes_on_with_the_same_steps(self):
        self.plan("--vary", "seed=0", *self.WORDS)
        self.work()
        whole = self.calls()
        (self.folder / "calls").unlink()
        (self.folder / "s").rename(self.folder / "whole")
        self.plan("--vary", "seed=0", *self.WORDS)
        self.work(code=143, STOP="25", CODE="143")
        self.assertFalse((self.folder / "s/run_000001/summary.json").exists())
        broken = self.calls()
        self.work()
        self.assertEqual(broken[:-1] + self.calls()[len(broken):], whole)
        self.assertEqual(*((self.folder / name / "run_000001/summary.json").read_text() for name in ("s", "whole")))

    def test_without_a_bracket_is_said(self):
        self.plan("--vary", "seed=0,200", *self.WORDS[2:], "--bisect", "x=30:100")
        self.work(code=4)
        self.sweep("collect", "s")
        self.assertEqual([(row["bracket"], row["critical"]) for row in self.rows("table.csv")], [("fails at both ends", ""), ("stands at both ends", "")])
        self.assertEqual(len(self.calls()), 4)

    def test_refuses(self):
        for words, reason in (((*self.WORDS[:4],), "needs --fails"), ((*self.WORDS[2:], "--bisect", "x=9:1"), "LOW below HIGH"), (("--bisect", "x=0:1", "--fails", "fallen>0"), "--tolerance"),
                              (("--vary", "x=1", *self.WORDS), "varies twice"), (("--vary", "x=1", "--fails", "fallen>0"), "belong to --bisect"), (("--vary", "x=1", "--runs", "3"), "belongs to --design"),
                              (("--vary", "x=0:1", "--design", "latin"), "needs --runs"), (("--vary", "x=1", "--vary", "x=2"), "varies twice")):
            self.assertIn(reason, self.plan(*words, code=2))
        self.assertFalse((self.folder / "s").exists())


class Collect(Scratch):
    def setUp(self):
        super().setUp()
        self.plan("--vary", "seed=1:4", "--vary", "x=10,25.5,28")
        self.work()

    def test_share_that_failed_by_a_key(self):
        said = self.sweep("collect", "s", "--fails", "fallen>0", "--by", "x")
        self.assertIn("x = 25.5: 1 of 4 failed, 0.250; 95 % interval", said)
        self.assertEqual([(float(row["x"]), row["failed"], row["runs"]) for row in self.rows("fails.csv")], [(10.0, "0", "4"), (25.5, "1", "4"), (28.0, "4", "4")])
        self.assertTrue((self.folder / "s/fails.png").read_bytes().startswith(b"\x89PNG"))
        self.assertEqual([float(row["median"]) for row in self.rows("statistics.csv") if row["quantity"] == "moved"], [102.5, 257.5, 282.5])

    def test_histogram(self):
        self.assertIn("5 of 12 failed", self.sweep("collect", "s", "--fails", "fallen>0", "--histogram", "moved"))
        rows = self.rows("histogram_moved.csv")
        self.assertEqual((sum(int(row["runs"]) for row in rows), sum(int(row["failed"]) for row in rows)), (12, 5))
        self.assertEqual((float(rows[0]["from"]), float(rows[-1]["to"])), (101.0, 284.0))
        self.assertTrue((self.folder / "s/histogram_moved.png").read_bytes().startswith(b"\x89PNG"))

    def test_pictures_are_not_written_into_pipes(self):
        os.mkfifo(self.folder / "s/histogram_moved.png")
        self.assertIn("s/histogram_moved.png: no file, but a pipe or a device. Move away", self.sweep("collect", "s", "--histogram", "moved", code=2))

    def test_runs_without_the_number_are_told(self):
        file = self.folder / "s/run_000003/summary.json"
        file.write_text(json.dumps(json.loads(file.read_text()) | {"moved": None}))
        self.assertIn("of 11 failed", said := self.sweep("collect", "s", "--fails", "moved>200"))
        self.assertIn("1 runs have no such number", said)

    def test_refuses(self):
        for words, reason in ((["--fails", "moved>x"], "not a number"), (["--fails", "title=1"], "no run has such a number"), (["--by", "y"], "does not vary"), (["--of", "title"], "no run has such a number"),
                              (["--histogram", "nothing"], "no run has such a number"), (["--fails", "moved>1", "--level", "1.5"], "between 0 and 1")):
            self.assertIn(reason, self.sweep("collect", "s", *words, code=2))

    def test_without_scipy_it_is_said(self):
        bare = subprocess.run(["/usr/bin/python3", "-S", TOOLS / "sweep", "collect", "s", "--fails", "moved>1"], capture_output=True, text=True, check=False, cwd=self.folder)
        self.assertEqual((bare.returncode, bare.stderr.count("\n")), (2, 1), bare.stderr)
        self.assertRegex(bare.stderr, "needs the Python module.*scipy|needs the Python module numpy")
        self.assertIn("tools/setup", bare.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
