#!/usr/bin/python3
"""How exact the numbers in a page of `hdem view` are, and what tools/view/README.md promises.

    view_coding_test.py TOOLS    the folder of the scripts

Exit code 77 (skipped) without numpy.
"""
import re
import sys
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

TOOLS = Path(sys.argv[1]).resolve()
sys.path.insert(0, str(TOOLS / "view"))
from coding import groomed, half_floats    # noqa: E402


class Accuracy(unittest.TestCase):
    """The greatest errors that numbers of any size can have, and what README.md says of them."""

    def promised(self, quantity, pattern):
        row = next(line for line in (TOOLS / "view/README.md").read_text(encoding="utf-8").splitlines() if line.startswith(f"| {quantity}"))
        return float(re.search(pattern, row)[1])

    def test_of_displacements(self):
        values = np.linspace(1.0, 2.0, 100001, dtype=np.float32)[1:-1]
        error = np.max(np.abs(groomed(values, 0.0078125) / values - 1.0))    # steps of 2^-7 are enough, so the twelve digits decide
        self.assertTrue(0.97 < 100.0 * error / self.promised("displacement", r"([\d.]+) %") <= 1.0, error)

    def test_of_other_fields(self):
        values = np.append(np.geomspace(1e-13, 1.0, 200001), 1.0)
        halves, scale = half_floats(values)
        error = np.abs(halves.astype(float) * scale - values)
        smallest = self.promised("other fields", r"above ([\de.-]+) of the greatest")
        exact = values >= smallest
        self.assertTrue(0.95 < 100.0 * np.max(error[exact] / values[exact]) / self.promised("other fields", r"([\d.]+) %") <= 1.0)
        self.assertTrue(0.4 < np.max(error[~exact]) / self.promised("other fields", r"smaller values: ([\de.-]+) of the greatest") <= 1.0, np.max(error[~exact]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
