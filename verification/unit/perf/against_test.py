#!/usr/bin/python3
"""perf/against with stand-ins for hdem_perf: ratios, intervals, verdicts, exit codes. Nothing is built.

    against_test.py PERF    the folder of against
"""
import importlib.util
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import stand_in

PERF = Path(sys.argv[1]).resolve()
if importlib.util.find_spec("scipy") is None:
    print("skipped: no scipy")
    sys.exit(77)
sys.path.insert(0, str(PERF / "track"))
import pairs    # noqa: E402

CASE = "cycle/wall/1000/hybrid/1"


def row(name, operations, state_hash=7.0):
    return stand_in.row(name, cpu_operations_per_point=operations, ns_per_contact_point=0.02 * operations, state_hash=state_hash)


class Against(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def program(self, name, *rows, **context):
        return stand_in.write(self.folder / name, list(rows), **context)

    def against(self, *arguments):
        done = subprocess.run([PERF / "against", *arguments], capture_output=True, text=True, check=False)
        self.assertNotIn("Traceback", done.stderr)
        return done.returncode, done.stdout, done.stderr

    def compared(self, now, then, *arguments, hashes=(7.0, 7.0)):
        new, old = self.program("now", row(CASE, now, hashes[0])), self.program("then", row(CASE, then, hashes[1]))
        return self.against(old, "--program", new, "--pairs", "7", "--json", self.folder / "out.json", *arguments)

    def test_what_is_slower_is_found(self):
        code, said, _ = self.compared(440.0, 400.0)
        self.assertEqual(code, 3, said)
        self.assertRegex(said, r"1\.100 \[1\.100, 1\.100\].* slower \(same answers\)")
        found = json.loads((self.folder / "out.json").read_text())["cases"][0]
        self.assertAlmostEqual(found["intervals"]["wall"]["middle"], 1.1)
        self.assertEqual(len(found["ratios"]["operations"]), 7)

    def test_a_small_loss_may_be_allowed(self):
        self.assertEqual(self.compared(440.0, 400.0, "--allow", "12")[0], 0)
        self.assertIn("slower, as allowed", self.compared(408.0, 400.0)[1])

    def test_same_and_faster_are_no_alarm(self):
        code, said, _ = self.compared(400.0, 400.0)
        self.assertEqual((code, "same (same answers)" in said), (0, True), said)
        code, said, _ = self.compared(300.0, 400.0)
        self.assertEqual((code, "faster" in said), (0, True), said)

    def test_other_answers_are_said(self):
        self.assertIn("different answers", self.compared(400.0, 400.0, hashes=(7.0, 8.0))[1])

    def test_intervals_hold_what_is_between_the_outermost_pairs(self):
        found = pairs.interval([1.0, 1.3, 0.9, 1.1, 1.05, 0.95, 2.0, 1.02, 0.4])
        self.assertEqual(found, (0.9, 1.02, 1.3), "nine pairs leave out one at either end")
        self.assertEqual(pairs.verdict(found, 0.03), "cannot tell")

    def test_bars_are_for_the_plain_yardstick(self):
        for plain, packed, code, verdict in ((360.0, 250.0, 0, "met"), (330.0, 400.0, 3, "missed")):
            program = self.program("both", row("cycle/wall/10000/hybrid/1", 400.0), row("yardstick/plain_loop/wall/10000/1", plain),
                                   row("yardstick/force_loop/wall/10000/1", packed))
            done, said, _ = self.against("--yardstick", "--blocks", "10000", "--program", program, "--pairs", "7")
            self.assertEqual(done, code, said)
            self.assertRegex(said, rf"plain_loop/wall/10000/1 +{plain / 400.0:.3f} .*bar 0.85: {verdict}\n")
            self.assertRegex(said, rf"force_loop/wall/10000/1 +{packed / 400.0:.3f} .*no bar\n")

    def test_what_cannot_be_used_is_said(self):
        self.assertEqual(self.compared(1.0, 1.0, "--pairs", "3")[0], 2)
        program = self.program("now", row(CASE, 400.0))
        code, _, error = self.against("no-such-commit", "--program", program)
        self.assertEqual((code, "is neither a commit" in error), (1, True), error)
        code, _, error = self.against(program, "--program", program, "--cases", "^nothing/")
        self.assertEqual((code, "has no benchmark" in error), (1, True), error)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
