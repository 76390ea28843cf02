#!/usr/bin/python3
"""A script that is started by a Python without its modules says so in one line.

    missing_modules_test.py HDEM TOOLS    the program is not used; the folder of its scripts
"""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(sys.argv[2]).resolve()
# -S: without the folders of installed packages, so with no module but Python's own.
BARE = ["/usr/bin/python3", "-S"]
NEEDS = {"plot.py": "modules h5py, matplotlib, numpy", "run_report.py": "modules h5py, matplotlib, numpy", "own_figure.py": "modules h5py, matplotlib, numpy", "pull_out_figure.py": "modules h5py, matplotlib, numpy",
         "run_view.py": "modules h5py, numpy", "import_dxf.py": "module ezdxf", "verification_report": "modules matplotlib, numpy", "ensemble": "modules h5py, matplotlib, numpy",
         "paraview_view.py": "module numpy"}
NEEDS_NOTHING = {"sweep"}


def scripts():
    """Names of all programs in Python, by what they do at their end."""
    return {file.name for file in TOOLS.iterdir() if file.is_file() and file.suffix in ("", ".py")
            and "main(sys.argv[1:])" in file.read_text(encoding="utf-8")}


def said(python, name, environment=None):
    done = subprocess.run([*python, TOOLS / name, "--help"], capture_output=True, text=True, check=False, env=environment)
    return done.returncode, done.stdout, done.stderr


class MissingModules(unittest.TestCase):
    def test_are_named_with_the_remedy(self):
        for name, modules in NEEDS.items():
            with self.subTest(name):
                code, out, errors = said(BARE, name)
                self.assertEqual((code, out), (2, ""))
                self.assertTrue(errors.startswith(f"error: needs the Python {modules}: "), errors)
                self.assertIn("tools/setup", errors)
                self.assertEqual(errors.count("\n"), 1, errors)

    def test_of_a_module_for_another_python_is_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "h5py.py").write_text("raise ImportError('built for another Python')\n", encoding="utf-8")
            code, _, errors = said(["/usr/bin/python3"], "plot.py", os.environ | {"PYTHONPATH": folder})
            self.assertEqual((code, errors), (2, "error: needs the Python module h5py: run tools/setup, or use /usr/bin/python3\n"))

    def test_is_asked_of_every_script(self):
        self.assertEqual(scripts(), set(NEEDS) | NEEDS_NOTHING)
        for name in NEEDS_NOTHING:
            self.assertEqual(said(BARE, name)[0], 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
