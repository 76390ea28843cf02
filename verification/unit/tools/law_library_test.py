#!/usr/bin/python3
"""A joint law of a shared library: its strength, the same bits on any threads and after a restart, and what is told when it is wrong.

    law_library_test.py HDEM LIBRARY CASE    the program, the built example, a direct shear test
"""
import math
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HDEM, LIBRARY, CASE = (Path(argument).resolve() for argument in sys.argv[1:4])
try:
    import h5py
except ImportError:
    print("skipped: no h5py")
    sys.exit(77)

PEAK, RESIDUAL, DISTANCE = 0.8, 0.5, 1e-3


class LawLibrary(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="hdem_law_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.library = self.folder / "law.so"
        shutil.copy(LIBRARY, self.library)
        joint = (f'[joint.default]\nlaw = "law.so"\nparameters = [{PEAK}, {RESIDUAL}, {DISTANCE}]\n'
                 "normal_stiffness = 1e10\nshear_stiffness = 1e9\nfriction_angle_deg = 26.0\n\n[contact]")
        text = re.sub(r"\[joint\.default\].*?\[contact\]", joint, CASE.read_text(encoding="utf-8"), flags=re.S)
        self.case = self.folder / "case.toml"
        self.case.write_text(text, encoding="utf-8")

    def hdem(self, *arguments):
        return subprocess.run([HDEM, *arguments], capture_output=True, text=True, check=False, cwd=self.folder)

    def hash_of(self, *arguments):
        done = self.hdem("run", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return re.search(r"state hash (\w+)", done.stdout).group(1)

    def test_strength_falls_with_slip(self):
        self.hash_of("case.toml", "-o", "out")
        with h5py.File(self.folder / "out/results.h5") as results:
            way = results["history/block/displacement_x"][()]
            shear = abs(results["history/joint/shear_force"][()])
            normal = results["history/joint/normal_force"][()]
        for slip in (2e-3, 4e-3, 8e-3):
            near = abs(way - shear / 1e9 - slip) < 2e-5
            law = RESIDUAL + (PEAK - RESIDUAL) * math.exp(-slip / DISTANCE)
            self.assertLess(abs(shear[near].sum() / normal[near].sum() / law - 1.0), 2e-3)

    def test_same_bits_on_threads_and_after_a_restart(self):
        whole = self.hash_of("case.toml", "-o", "one", "--threads", "1")
        self.assertEqual(self.hash_of("case.toml", "-o", "three", "--threads", "3"), whole)
        cycles = "output.checkpoint_every=3000"
        self.hash_of("case.toml", "-o", "kept", "--set", cycles)
        self.assertEqual(self.hash_of("--restart", "kept"), whole)

    def test_a_restart_wants_the_same_library(self):
        self.hash_of("case.toml", "-o", "kept", "--set", "output.checkpoint_every=3000")
        with self.library.open("ab") as library:
            library.write(b"changed")
        done = self.hdem("run", "--restart", "kept")
        self.assertEqual(done.returncode, 2)
        self.assertIn("is not the one that the run began with", done.stderr)

    def test_errors_name_what_is_wrong(self):
        self.library.write_bytes(b"no library")
        done = self.hdem("check", "case.toml")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r'case.toml:\d+:\d+: joint "default": law = "law.so" \(cannot be loaded')
        self.library.unlink()
        self.assertIn("cannot be read", self.hdem("check", "case.toml").stderr)
        for source, says in (("int nothing;", "has no function hdem_joint_law_version"),
                             ("int hdem_joint_law_version(void){return 1;}", "has no function hdem_joint_law)"),
                             ("int hdem_joint_law_version(void){return 99;} void hdem_joint_law(const void* p){(void)p;}",
                              "is for version 99")):
            (self.folder / "law.c").write_text(source, encoding="utf-8")
            subprocess.run(["cc", "-shared", "-fPIC", "law.c", "-o", "law.so"], cwd=self.folder, check=True)
            self.assertIn(says, self.hdem("check", "case.toml").stderr)
        shutil.copy(LIBRARY, self.library)
        self.assertIn("cannot be computed by impulses", self.hdem("check", "case.toml", "--set", "contact.method=impulse").stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
