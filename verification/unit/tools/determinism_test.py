#!/usr/bin/python3
"""The state of a run does not depend on the number of threads, nor on what is written while it goes on.

    determinism_test.py HDEM CASES    the program, and verification/cases
"""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HDEM = Path(sys.argv[1]).resolve()
TUNNEL = Path(sys.argv[2]).resolve() / "paper_tunnel" / "tunnel.toml"
FALL = 20000  # cycles after the excavation, while blocks fall


def summary(*arguments):
    """summary.json of the tunnel, excavated, with blocks on their way down."""
    with tempfile.TemporaryDirectory(prefix="hdem_determinism_") as folder:
        done = subprocess.run([HDEM, "run", TUNNEL, "-o", folder, "--quiet", "--set", f"stage[1].max_cycles={FALL}", *arguments],
                              capture_output=True, text=True, check=False)
        assert done.returncode == 4, done.stderr  # not converged yet
        return json.loads((Path(folder) / "summary.json").read_text(encoding="utf-8"))


class Determinism(unittest.TestCase):
    def expect_same(self, method, thread_counts):
        one = summary("--method", method, "--threads", "1")
        self.assertGreater(len(one["detached_blocks"]), 0)
        for threads in thread_counts:
            many = summary("--method", method, "--threads", threads)
            self.assertEqual(many["state_hash"], one["state_hash"], f"{threads} threads")
            self.assertEqual(many["energy"], one["energy"], f"{threads} threads")
        written = summary("--method", method, "--threads", "2", "--set", "output.frame_every=500", "--set", "output.row_every=70")
        self.assertEqual(written["state_hash"], one["state_hash"], "with frames and rows")

    def test_force_based(self):
        self.expect_same("force", "3")

    def test_hybrid(self):
        self.expect_same("hybrid", "2348")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
