#!/usr/bin/python3
"""Quick checks of perf/nightly: its rules on synthetic nights, and the command with a stand-in for hdem_perf.

    nightly_test.py PERF [--year]    the folder of nightly; --year: twenty times as many synthetic nights

Exit code 77 (skipped) without scipy or numpy.
"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PERF = Path(sys.argv[1]).resolve()
sys.path.insert(0, str(PERF / "track"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))
try:
    import numpy
    import history
    from judge import judge, judge_night
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import page_checks
import stand_in

MORE = 20 if "--year" in sys.argv else 1
CASES = [f"cycle/{scene}/10000/hybrid" for scene in ("wall", "voronoi", "joints", "pile")]
YEAR = 365


def record(day, case, metric, value, **other):
    return {"date": f"2024-{day:05d}", "commit": "abc", "machine": "m", "case": case, "threads": 1, "metric": metric, "unit": "", "value": float(value), "n": 5,
            "spread": 0.0, "build": "b"} | other


def series(metric, values, case="c"):
    return history.series_of([record(day, case, metric, value) for day, value in enumerate(values)])[0]


def nights(random, count):
    """Operations in the time of a point, case after case. What slows the machine in a night slows both the laws and what they are measured by; 1.2 % of its
    own remain to each case, and one night in twenty is off by up to a sixth."""
    machine = numpy.exp(0.2 * random.standard_normal(count))
    ratios = []
    for _ in CASES:
        own = numpy.exp(0.012 * random.standard_normal(count))
        off = numpy.where(random.random(count) < 0.05, numpy.exp(random.uniform(-0.05, 0.15, count)), 1.0)
        ns, flops = 10.0 * machine * own * off, 40.0 / machine
        ratios.append(ns * flops)
    return ratios


def alarms(ratios, first, last):
    """Nights from `first` to before `last` with an alarm."""
    def judged(day):
        return judge_night([series("cpu_operations_per_point", values[:day + 1], case) for case, values in zip(CASES, ratios)])
    return [day for day in range(first, last) if any(verdict.is_alarm for _, verdict in judged(day))]


class Rules(unittest.TestCase):
    def test_a_year_without_a_change_raises_no_alarm(self):
        random = numpy.random.default_rng(1)
        found = sum(len(alarms(nights(random, YEAR), 1, YEAR)) for _ in range(MORE))
        self.assertEqual(found, 0, f"in {MORE} years of {len(CASES)} cases")

    def test_losses_are_found_within_five_nights(self):
        random = numpy.random.default_rng(2)
        for loss in (0.05, 0.10):
            missed = 0
            for _ in range(10 * MORE):
                planted = [values * numpy.where(numpy.arange(40) >= 33, 1.0 + loss, 1.0) for values in nights(random, 40)]
                missed += not alarms(planted, 33, 38)
            self.assertEqual(missed, 0, f"of {10 * MORE} losses of {loss:.0%}")

    def test_one_timing_alone_must_be_surer_than_two(self):
        before, after = [1.0 + 0.001 * night for night in range(28)], [1.0275, 1.06, 1.061, 1.062, 1.063]
        still, slower = (series("cpu_operations_per_point", values) for values in (before + before[:5], [v + 0.02 for v in before[:4]] + before[4:] + after))
        statuses = [judge(slower).status] + [judge_night([slower] + [still] * count)[0][1].status for count in (0, 200)]
        self.assertEqual(statuses, ["worse", "worse", "suspect"])
        self.assertEqual([verdict.status for _, verdict in judge_night([slower, slower] + [still] * 200)[:2]], ["worse", "worse"])

    def test_a_gain_is_no_alarm(self):
        values = nights(numpy.random.default_rng(3), 40)[0]
        values[33:] *= 0.9
        self.assertEqual(judge(series("cpu_operations_per_point", values)).status, "better")

    def test_sure_figures_count_at_once(self):
        self.assertFalse(judge(series("instructions", [1e9, 1.009e9])).is_alarm)
        self.assertTrue(judge(series("instructions", [1e9, 1.011e9])).is_alarm)
        self.assertTrue(judge(series("cycles", [96550, 96551])).is_alarm)
        self.assertEqual(judge(series("cycles", [96550, 96540])).status, "better")
        self.assertFalse(judge(series("instructions", [1e9, 1.1e9, 1.1e9])).is_alarm, "only in its first night")

    def test_a_slow_drift_of_instructions_is_found(self):
        drifting = [1e9 * 1.004**night for night in range(33)]
        self.assertTrue(judge(series("instructions", drifting)).is_alarm)

    def test_plain_speeds_are_not_judged(self):
        self.assertEqual(judge(series("ns_per_contact_point", [10.0] * 33 + [20.0] * 5)).status, "shown")

    def test_machines_and_builds_are_not_mixed(self):
        records = [record(day, "c", "instructions", value, machine=machine, build=build) for day, value, machine, build in
                   ((1, 1e9, "m", "b"), (2, 2e9, "other", "b"), (3, 3e9, "m", "new flags"))]
        [last] = history.series_of(records)
        self.assertEqual(last.values, [3e9])
        self.assertEqual(judge(last).status, "short")


class Command(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def program(self, cycles=605.0, **other):
        rows = [stand_in.row("converge/static/force/1", cycles=cycles, state_hash=1.0),
                stand_in.row("cycle/wall/1000/force/1", **{"cpu_operations_per_point": 300.0, "ns_per_contact_point": 10.0, "state_hash": 2.0} | other)]
        stand_in.write(self.folder / "hdem_perf", rows)

    def nightly(self, *arguments):
        environment = {"PATH": "/nowhere"}    # without valgrind
        done = subprocess.run(["/usr/bin/python3", PERF / "nightly", "--program", self.folder / "hdem_perf", "--set", "short", "--processes", "2", "--machine", "m",
                               "--history", self.folder / "h", *arguments], capture_output=True, text=True, check=False, env=environment)
        self.assertNotIn("Traceback", done.stderr)
        return done.returncode, done.stdout + done.stderr

    def lines(self):
        return [json.loads(line) for line in (self.folder / "h/m.jsonl").read_text().splitlines()]

    def test_two_nights_of_one_commit_raise_no_alarm_a_change_does_until_accepted(self):
        self.program()
        for _ in range(2):
            code, said = self.nightly()
            self.assertEqual(code, 0, said)
        self.program(cycles=700.0)
        code, said = self.nightly()
        self.assertEqual(code, 3, said)
        self.assertIn("WORSE: converge/static/force/1, cycles +15.70 %", said)
        self.assertEqual(self.nightly("--no-measure")[0], 3)
        self.assertEqual(self.nightly("--accept", "converge/static/force")[0], 2, "without a reason")
        code, said = self.nightly("--accept", "converge/static/force", "--reason", "another law")
        self.assertEqual(code, 0, said)
        self.assertEqual(self.lines()[-1]["accepted"], "another law")

    def test_lines_have_all_keys(self):
        self.program()
        self.nightly()
        for line in self.lines():
            self.assertEqual(tuple(line), history.KEYS)
        self.assertEqual({line["metric"] for line in self.lines()}, {"cycles", "cpu_operations_per_point", "ns_per_contact_point"})
        self.assertEqual({line["n"] for line in self.lines() if line["case"].startswith("cycle/")}, {2})

    def test_page_and_exports(self):
        self.program()
        for _ in range(3):
            self.nightly()
        page = (self.folder / "h/m.html").read_text(encoding="utf-8")
        page_checks.asks_for_nothing(self, page)
        page_checks.links_lead_somewhere(self, page)
        self.assertEqual(page.count('<svg class="nights"'), 3)
        self.assertEqual(page.count("<circle"), 9)
        rows = json.loads((self.folder / "h/export/m/action_benchmark.json").read_text())
        self.assertEqual({row["name"] for row in rows}, {"converge/static/force/1 cycles", "cycle/wall/1000/force/1 cpu_operations_per_point"})
        table = (self.folder / "h/export/m/otava.csv").read_text().splitlines()
        config = json.loads((self.folder / "h/export/m/otava.yaml").read_text())["tests"]["hdem"]
        self.assertEqual(len(table), 4)
        self.assertEqual(table[0].split(","), ["time", "commit", *config["metrics"]])
        self.assertTrue(re.match(r"\d{4}-\d\d-\d\dT", table[1]))

    def test_a_speed_without_its_state_is_not_kept(self):
        self.program(state_hash=3.0)
        rows = [stand_in.row(f"cycle/wall/1000/force/{threads}", cpu_operations_per_point=1.0, state_hash=float(threads)) for threads in (1, 2)]
        stand_in.write(self.folder / "hdem_perf", [row | {"name": row["name"].replace("force/2", "force/1")} for row in rows])
        code, said = self.nightly()
        self.assertEqual(code, 1)
        self.assertIn("2 different states", said)
        self.assertFalse((self.folder / "h/m.jsonl").exists())

    def test_errors_say_what_is_wrong(self):
        self.program()
        self.assertIn("holds no night yet", self.nightly("--no-measure")[1])
        self.assertIn("must be at least 1", self.nightly("--processes", "0")[1])
        self.nightly()
        with (self.folder / "h/m.jsonl").open("a") as file:
            file.write("{\n")
        code, said = self.nightly("--no-measure")
        self.assertEqual(code, 1)
        self.assertIn("m.jsonl:4: not a JSON line", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
