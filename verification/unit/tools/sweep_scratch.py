"""What the tests of tools/sweep share: the program and its tools, a program that stands in for hdem, and a folder that is gone afterwards."""
import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.path.insert(0, str(TOOLS))
try:
    import numpy    # noqa: F401
    import scipy.stats    # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

# In place of hdem. A run is told x and seed; its summary says so again, and how much has fallen. `calls` has a line a run. Ends as CODE says at the x that STOP says.
STAND_IN = '''#!/usr/bin/python3 -IS
import json, os, sys, time
from pathlib import Path
words = sys.argv[2:]
told = dict(words[i + 1].split("=") for i, word in enumerate(words) if word == "--set")
x, seed = float(told.get("x", 0)), int(told.get("seed", 0))
folder = Path(words[words.index("-o") + 1])
folder.mkdir(parents=True, exist_ok=True)
with open(Path(__file__).resolve().parent / "calls", "a") as calls:
    calls.write(f"{folder.name} {x:g} {seed}\\n")
if os.environ.get("STOP") == f"{x:g}":
    sys.exit(int(os.environ["CODE"]))
more = {"factor_of_safety": {"factor": x / 10, "trials": []}} if sys.argv[1] == "fos" and "FACTOR" in os.environ else {}
slow = 20.0 < x <= float(os.environ.get("SLOW", 0))
(folder / "summary.json").write_text(json.dumps(more | {"converged": not slow, "fallen": ["b"] * int(x > 23.7 + seed), "moved": 10.0 * x + seed, "title": "none", "nothing": None}))
sys.exit(4 if slow else 0)
'''


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="hdem_study_test_")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.program = self.folder / "stand_in"
        self.program.write_text(STAND_IN, encoding="utf-8")
        self.program.chmod(0o755)
        (self.folder / "case.toml").touch()

    def sweep(self, *arguments, code=0, **variables):
        if arguments[0] == "plan":
            arguments += ("--program", "nowhere")    # hdem would refuse this case
        done = subprocess.run([TOOLS / "sweep", *map(str, arguments)], capture_output=True, text=True, check=False, cwd=self.folder, env=os.environ | variables)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        return done.stdout + done.stderr

    def plan(self, *words, **more):
        return self.sweep("plan", "case.toml", "-o", "s", *words, **more)

    def work(self, *words, **more):
        return self.sweep("work", "s", "--jobs", "1", "--program", self.program, *words, **more)

    def calls(self):
        file = self.folder / "calls"
        return file.read_text(encoding="utf-8").splitlines() if file.exists() else []

    def rows(self, name):
        with open(self.folder / "s" / name, encoding="utf-8") as file:
            return list(csv.DictReader(file))
