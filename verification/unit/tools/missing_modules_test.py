#!/usr/bin/python3
"""A script that is started by a Python without its modules says so in one line; so does one that is interrupted while it imports them.

    missing_modules_test.py HDEM TOOLS    the program, and the folder of its scripts
"""
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
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


# The module at which each script is interrupted, and the words for it.
SLOW = {"plot.py": "matplotlib", "run_report.py": "h5py", "run_view.py": "numpy", "own_figure.py": "matplotlib", "import_dxf.py": "ezdxf", "ensemble": "h5py", "sweep": "numpy"}
WORDS = {"sweep": ["plan", "case.toml", "-o", "s", "--design", "latin", "--runs", "3", "--vary", "a=1:2"]}


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


class Interrupts(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="hdem_interrupts_test_")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def interrupted(self, name, module):
        """Exit code and what was said by a script that got SIGINT while it imported a module."""
        begun = self.folder / f"{name}_begun"
        (self.folder / f"{module}.py").write_text(f"import time\nopen({str(begun)!r}, 'w').close()\ntime.sleep(60)\n", encoding="utf-8")
        process = subprocess.Popen(["/usr/bin/python3", TOOLS / name, *WORDS.get(name, ["nowhere"])], env=os.environ | {"PYTHONPATH": str(self.folder)}, cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        while not begun.exists() and process.poll() is None:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=100)
        (self.folder / f"{module}.py").unlink()
        return process.returncode, out

    def test_end_in_one_line(self):
        for name, module in SLOW.items():
            with self.subTest(name):
                code, out = self.interrupted(name, module)
                self.assertEqual((code, out.count("\n")), (130, 1), out)
                self.assertTrue(out.endswith(": interrupted\n"), out)

    def test_wait_while_python_begins(self):
        for command in ("plot", "report", "view"):
            with self.subTest(command), subprocess.Popen([HDEM, command, "nowhere"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as process:
                while "python" not in os.readlink(f"/proc/{process.pid}/exe"):
                    pass
                process.send_signal(signal.SIGINT)
                self.assertEqual((process.communicate(timeout=100)[0], process.returncode), (f"hdem {command}: interrupted\n", 130))

    def test_leave_no_file_that_is_not_whole(self):
        program = f"""import sys, time
sys.path.insert(0, {str(TOOLS)!r})
import needed_modules, output_file
needed_modules.end_in_one_line("here")
def parts():
    yield "half"
    print("begun", flush=True)
    time.sleep(60)
output_file.write_output("page.html", parts())
"""
        (self.folder / "page.html").write_text("before", encoding="utf-8")
        process = subprocess.Popen(["/usr/bin/python3", "-c", program], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual(process.stdout.readline(), "begun\n")
        self.assertEqual(len(list(self.folder.glob("page.html.*.tmp"))), 1)
        process.send_signal(signal.SIGINT)
        self.assertEqual((process.communicate()[1], process.returncode), ("here: interrupted\n", 130))
        self.assertEqual([file.name for file in self.folder.iterdir()], ["page.html"])
        self.assertEqual((self.folder / "page.html").read_text(encoding="utf-8"), "before")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
