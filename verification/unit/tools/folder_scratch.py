"""A small run and the folder of its results, for tests of what a folder may lose."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HDEM, CASES = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
SLAB = """
[domain]
width = 4
height = 2
fixed = ["bottom"]
[[joint_set]]
dip_deg = 0.0
spacing = 1.0
[[joint_set]]
dip_deg = 90.0
spacing = 1.0
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 35.0
[[stage]]
name = "one"
cycles = 200
[[stage]]
name = "two"
cycles = 200
[output]
row_every = 50
frame_every = 100
"""
FINISHED, REFUSED, OUT_OF_TIME = 0, 2, 5


def content(folder):
    """Names and times of all files: what was written anew differs."""
    return {file.relative_to(folder): file.stat().st_mtime_ns for file in folder.rglob("*") if file.is_file() and file.name != ".lock"}


class FolderTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="hdem_folders_")
        self.addCleanup(scratch.cleanup)
        self.root = Path(scratch.name)
        self.folder = self.root / "out"
        self.case = self.write("slab.toml", SLAB)
        self.other = self.write("wider.toml", SLAB.replace("width = 4", "width = 6"))

    def write(self, name, text):
        (self.root / name).write_text(text, encoding="utf-8")
        return self.root / name

    def hdem(self, *arguments, code=FINISHED):
        done = subprocess.run([HDEM, *map(str, arguments)], capture_output=True, text=True, check=False, cwd=self.root, timeout=120)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def run_case(self, *arguments, code=FINISHED):
        return self.hdem("run", self.case, "-o", self.folder, "-q", *arguments, code=code)

    def expect_untouched(self, message, *command):
        """The command is refused, and all is as it was."""
        before = content(self.folder)
        self.assertRegex(self.hdem(*command, code=REFUSED), message)
        self.assertEqual(content(self.folder), before)
