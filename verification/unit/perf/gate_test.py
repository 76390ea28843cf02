#!/usr/bin/python3
"""Quick checks of perf/gate with a stand-in for hdem_perf; cycles only, so that no valgrind is needed.

    gate_test.py PERF    the folder of gate
"""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import stand_in

PERF = Path(sys.argv[1]).resolve()
NAME = "converge/static/force"


class Gate(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.store = self.folder / "gate.json"
        self.program(605)

    def program(self, cycles, **context):
        stand_in.write(self.folder / "hdem_perf", [stand_in.row(NAME + "/1", cycles=float(cycles))], **context)

    def gate(self, *arguments):
        done = subprocess.run([PERF / "gate", "--program", self.folder / "hdem_perf", "--store", self.store, *arguments],
                              capture_output=True, text=True, check=False)
        self.assertNotIn("Traceback", done.stderr)
        return done.returncode, done.stdout + done.stderr

    def accept(self, reason="a first value"):
        code, said = self.gate("--accept", NAME, "--reason", reason)
        self.assertEqual(code, 0, said)

    def test_accepted_value_is_kept_with_reason_and_date(self):
        self.accept()
        self.program(600)
        self.accept("fewer by a better law")
        first, last = json.loads(self.store.read_text())
        self.assertEqual((first["value"], first["reason"]), (605, "a first value"))
        self.assertEqual((last["name"], last["value"], last["build"], last["reason"]), (NAME, 600, "GNU 12.2.0", "fewer by a better law"))
        self.assertRegex(last["date"], r"^\d{4}-\d\d-\d\d$")
        self.assertEqual(self.gate(NAME)[0], 0, "the last one counts")

    def test_same_value_passes_another_fails_and_says_how_to_accept(self):
        self.accept()
        self.assertEqual(self.gate(NAME)[0], 0)
        self.program(606)
        code, said = self.gate(NAME)
        self.assertEqual(code, 3)
        self.assertIn("OFF", said)
        self.assertIn(f"--accept {NAME} --reason", said)

    def test_a_reason_is_needed(self):
        for reason in ([], ["--reason", ""], ["--reason", "  "]):
            code, said = self.gate("--accept", NAME, *reason)
            self.assertEqual(code, 2)
            self.assertIn("needs a reason", said)
        self.assertFalse(self.store.exists())

    def test_another_compiler_is_skipped(self):
        self.accept()
        self.program(606, hdem_compiler="GNU 13.1.0")
        code, said = self.gate(NAME)
        self.assertEqual(code, 77, said)
        self.assertIn('no value is stored for "GNU 13.1.0"', said)

    def test_errors_say_what_is_wrong(self):
        self.assertIn('no value "wall"', self.gate("wall")[1])
        self.store.write_text("[1")
        self.assertIn("cannot be read as a list of stored values", self.gate(NAME)[1])
        self.store.unlink()
        stand_in.write(self.folder / "hdem_perf", [stand_in.row(NAME + "/1", error_occurred=True, error_message="its state differs")])
        code, said = self.gate(NAME)
        self.assertEqual(code, 1)
        self.assertIn("its state differs", said)
        (self.folder / "hdem_perf").unlink()
        self.assertIn("no such program", self.gate(NAME)[1])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
