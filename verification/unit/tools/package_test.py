#!/usr/bin/python3
"""The Debian package: cpack makes it of the build folder; unpacked somewhere, it has every part and each of them works.

    package_test.py HDEM SOURCES CPACK    the program of the build folder, the sources, the program cpack

A build that must not be packed is seen to be refused, and the rest is skipped. verification/package/in_clean_debian installs the package.
"""
import gzip
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HDEM, SOURCES, CPACK = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3]
BUILD = HDEM.parent.parent
VERSION = re.search(r"^\s+VERSION ([0-9.]+)", (SOURCES / "CMakeLists.txt").read_text(encoding="utf-8"), re.MULTILINE)[1]
TUNNEL = "verification/cases/paper_tunnel/tunnel.toml"
SHORT = ["--set", "stage[0].cycles=100", "--set", 'stage[1].until=["converged", "cycles > 200"]', "--threads", "1", "--quiet"]


def said(*words, **options):
    """What a program prints; it must succeed."""
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, f"{words}: exit code {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


def cpack(folder, *words):
    return subprocess.run([CPACK, "-G", "DEB", "-B", str(folder), "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", "--config", str(BUILD / "CPackConfig.cmake"), *words], cwd=BUILD, capture_output=True, text=True, check=False)


def known_problems():
    """Those that CMake has seen, as cpack is told of them."""
    found = re.search(r'^set\(CPACK_HDEM_PROBLEMS "(.*)"\)$', (BUILD / "CPackConfig.cmake").read_text(encoding="utf-8"), re.MULTILINE)[1]
    return [problem for problem in found.split(";") if problem] + ([] if (BUILD / "share/hdem/view/viewer.html").exists() else ["the page of hdem view is not built"])


class Refused(unittest.TestCase):
    def refused(self, *words):
        with tempfile.TemporaryDirectory(prefix="hdem_package_") as scratch:
            done = cpack(scratch, *words)
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(list(Path(scratch).rglob("*.deb")), [])
        text = " ".join((done.stdout + done.stderr).split())
        self.assertIn("cmake --preset package", text)
        return text

    def test_what_cmake_knows_is_said(self):
        for problem in known_problems():
            self.assertIn(problem, self.refused())

    def test_a_problem_is_enough(self):
        self.assertIn("- tuned to this machine", self.refused("-D", "CPACK_HDEM_PROBLEMS=tuned to this machine"))

    def test_without_the_page_of_the_viewer(self):
        self.assertIn("the page of hdem view is not built", self.refused("-D", "CPACK_HDEM_BUILD=/nowhere"))


class Versions(unittest.TestCase):
    def test_are_the_same_everywhere(self):
        self.assertRegex((SOURCES / "CITATION.cff").read_text(encoding="utf-8"), rf"(?m)^version: {re.escape(VERSION)}$")
        self.assertTrue(said(HDEM, "--version").startswith(f"hdem {VERSION} "))

    def test_the_changelog_dates_its_releases(self):
        headings = re.findall(r"^## \[(.+?)\](.*)$", (SOURCES / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
        for version, rest in headings:
            if version != "Unreleased":
                self.assertRegex(rest, r"^ - \d{4}-\d\d-\d\d$", version)
                self.assertLessEqual([int(part) for part in version.split(".")], [int(part) for part in VERSION.split(".")])


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="hdem_package_")
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = Path(scratch.name)
        umask = os.umask(0o077)    # the package must not follow that of who makes it
        done = cpack(cls.folder / "made")
        os.umask(umask)
        assert done.returncode == 0, done.stdout + done.stderr
        cls.machine = said("dpkg", "--print-architecture").strip()
        cls.deb = cls.folder / "made" / f"hdem_{VERSION}_{cls.machine}.deb"
        cls.listing = [line.split(maxsplit=5) for line in said("dpkg-deb", "-c", cls.deb).splitlines()]
        cls.names = {row[5].split(" -> ")[0].removeprefix(".").rstrip("/") for row in cls.listing}
        said("dpkg-deb", "-x", cls.deb, cls.folder / "root")
        said("dpkg-deb", "-e", cls.deb, cls.folder / "control")
        cls.usr = cls.folder / "root/usr"
        cls.documents = cls.usr / "share/doc/hdem"
        cls.program = cls.usr / "bin/hdem"
        cls.result = cls.folder / "run"
        said(cls.program, "run", cls.documents / "examples" / TUNNEL, "-o", cls.result, *SHORT)
        cls.hash = json.loads((cls.result / "summary.json").read_text(encoding="utf-8"))["state_hash"]

    def field(self, name):
        return said("dpkg-deb", "-f", self.deb, name).strip()

    def test_says_what_it_is_and_needs(self):
        self.assertEqual((self.field("Package"), self.field("Version"), self.field("Architecture"), self.field("Section")), ("hdem", VERSION, self.machine, "science"))
        self.assertRegex(self.field("Maintainer"), r"^.+ <.+@.+>$")
        needs = self.field("Depends")
        for package in ("libc6 (", "libgeos", "libgomp1", "libhdf5-", "libssl", "libfmt", "coinor-libclp1", "python3-h5py", "python3-matplotlib", "python3-numpy"):
            self.assertIn(package, needs)
        minor = re.search(r"cpython-3(\d+)", " ".join(self.names))[1]    # one build of the module is for one version
        self.assertIn(f"python3 (>= 3.{minor}), python3 (<< 3.{int(minor) + 1})", needs)

    def test_holds_every_part_and_no_other(self):
        for name in ("bin/hdem", "bin/hdem-sweep", "share/man/man1/hdem.1.gz", "share/man/man1/hdem-sweep.1.gz", "share/bash-completion/completions/hdem", "share/hdem/view/viewer.html",
                     "share/doc/hdem/copyright", "share/doc/hdem/changelog.gz", "share/doc/hdem/CHANGELOG.md.gz", "share/doc/hdem/CITATION.cff",
                     "lib/python3/dist-packages/hdem/__init__.py", "include/hdem/core/joint/hdem_joint_law.h", "share/doc/hdem/hdf5_format.md"):
            self.assertIn(f"/usr/{name}", self.names)
        folders = {"/usr", *(f"/usr/{name}" for name in ("bin", "include", "lib", "share")), "/usr/lib/python3", "/usr/lib/python3/dist-packages", "/usr/share/man",
                   "/usr/share/man/man1", "/usr/share/doc", "/usr/share/lintian", "/usr/share/lintian/overrides", "/usr/share/bash-completion", "/usr/share/bash-completion/completions", ""}
        ours = ("/usr/bin/hdem", "/usr/include/hdem", "/usr/lib/python3/dist-packages/hdem", "/usr/share/hdem", "/usr/share/doc/hdem", "/usr/share/man/man1/hdem.1.gz",
                "/usr/share/man/man1/hdem-sweep.1.gz", "/usr/share/lintian/overrides/hdem", "/usr/share/bash-completion/completions/hdem")
        self.assertEqual({name for name in self.names if name not in folders and not name.startswith(ours)}, set())
        self.assertEqual([name for name in self.names if name.endswith((".a", ".pyc", "__pycache__", ".cpp"))], [])

    def test_belongs_to_root_and_all_may_read_it(self):
        for mode, owner, _, _, _, name in self.listing:
            self.assertEqual(owner, "root/root", name)
            self.assertIn(mode, ("drwxr-xr-x", "-rwxr-xr-x", "-rw-r--r--", "lrwxrwxrwx"), name)

    def test_has_all_examples(self):
        for folder in ("verification/cases", "tools/guide/cases"):
            wanted = {file.relative_to(SOURCES) for file in (SOURCES / folder).rglob("*") if file.is_file()}
            self.assertEqual({file.relative_to(self.documents / "examples") for file in (self.documents / "examples" / folder).rglob("*") if file.is_file()}, wanted)

    def test_program_computes_what_that_of_the_build_folder_does(self):
        self.assertTrue(said(self.program, "--version").startswith(f"hdem {VERSION} "))
        said(HDEM, "run", SOURCES / TUNNEL, "-o", self.folder / "other", *SHORT)
        self.assertEqual(json.loads((self.folder / "other/summary.json").read_text(encoding="utf-8"))["state_hash"], self.hash)

    def test_pictures_and_pages_are_made_by_the_installed_scripts(self):
        said(self.program, "plot", self.result, "-o", self.folder / "run.png")
        self.assertTrue((self.folder / "run.png").read_bytes().startswith(b"\x89PNG"))
        said(self.program, "report", self.result)
        said(self.program, "view", self.result)
        for page in ("report.html", "view.html"):
            self.assertIn("</html>", (self.result / page).read_text(encoding="utf-8"), page)

    def test_every_script_begins_at_its_place(self):
        programs = [file for file in (self.usr / "share/hdem").iterdir() if file.is_file() and os.access(file, os.X_OK) and "main(sys.argv[1:])" in file.read_text(encoding="utf-8")]
        self.assertGreaterEqual({file.name for file in programs}, {"plot.py", "run_report.py", "run_view.py", "sweep", "own_figure.py"})
        for file in programs:
            if file.name != "import_dxf.py" or importlib.util.find_spec("ezdxf"):
                self.assertIn("usage:", said(file, "--help"), file)

    def test_a_missing_module_is_named_as_debian_calls_it(self):
        done = subprocess.run(["/usr/bin/python3", "-S", self.usr / "share/hdem/run_view.py", "--help"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (2, "error: needs the Python modules h5py, numpy: install python3-h5py python3-numpy, or use /usr/bin/python3\n"))

    def test_sweep_finds_the_program_beside_it(self):
        sweep, plan = self.usr / "bin/hdem-sweep", self.folder / "plan"
        without = {key: value for key, value in os.environ.items() if key != "HDEM"}
        said(sweep, "plan", self.documents / "examples" / TUNNEL, "-o", plan, "--vary", "generator.seed=1:2", env=without)
        said(sweep, "run", plan, "1", "--", *SHORT, env=without)
        summary = json.loads((plan / "run_000001/summary.json").read_text(encoding="utf-8"))
        self.assertIn("state_hash", summary)

    def test_module_computes_the_same(self):
        modules = self.usr / "lib/python3/dist-packages"
        code = ("import hdem, sys\n"
                "simulation = hdem.Simulation(hdem.Case(sys.argv[1], set={'stage[0].cycles': 100, 'stage[1].until': ['converged', 'cycles > 200']}), threads=1)\n"
                "simulation.run()\n"
                "print(hdem.__file__, simulation.state_hash)\n")
        file, state = said("/usr/bin/python3", "-B", "-c", code, self.documents / "examples" / TUNNEL, env=os.environ | {"PYTHONPATH": str(modules)}).split()
        self.assertTrue(Path(file).is_relative_to(modules), file)
        self.assertEqual(state, self.hash)

    def test_a_law_of_ones_own_finds_its_header(self):
        if not shutil.which("cc"):
            self.skipTest("no C compiler")
        said("cc", "-fsyntax-only", "-I", self.usr / "include/hdem/core/joint", self.documents / "examples/verification/cases/joint/weakening_law.c")

    def test_man_page_completion_and_guide(self):
        page = gzip.decompress((self.usr / "share/man/man1/hdem.1.gz").read_bytes()).decode()
        self.assertIn(f'"hdem {VERSION}', page)
        self.assertIn("hdem\\-sweep collect", gzip.decompress((self.usr / "share/man/man1/hdem-sweep.1.gz").read_bytes()).decode())
        words = said("bash", "-c", f". {self.usr}/share/bash-completion/completions/hdem; COMP_WORDS=(hdem cri); COMP_CWORD=1; _hdem; echo ${{COMPREPLY[*]}}")
        self.assertEqual(words.strip(), "critical")
        guide = self.documents / "guide"
        pages = {file.stem for file in (SOURCES / "tools/guide/docs").glob("*.md")}
        is_site = (guide / "index.html").exists()
        self.assertEqual(pages - {file.stem for file in guide.glob("*.html" if is_site else "*.md")}, set())
        for file in guide.glob("*.md"):
            self.assertNotIn("--8<--", file.read_text(encoding="utf-8"), file.name)
        self.assertIn("joint_set", (guide / ("case_format.html" if is_site else "case_format.md")).read_text(encoding="utf-8"))

    def test_licences_of_what_is_compiled_in_are_there(self):
        text = (self.documents / "copyright").read_text(encoding="utf-8")
        for words in ("Apache-2.0", "University of Cincinnati", "Yann Collet", "Victor Zverovich", "Niels Lohmann", "Mark Gillard", "Wenzel Jakob", "Boost", "Eigen"):
            self.assertIn(words, text)

    def test_scripts_of_the_package_are_whole(self):
        for name in ("postinst", "prerm"):
            self.assertTrue(os.access(self.folder / "control" / name, os.X_OK), name)
            said("sh", "-n", self.folder / "control" / name)

    def test_log_has_the_version_and_a_day(self):
        log = gzip.decompress((self.documents / "changelog.gz").read_bytes()).decode()
        self.assertRegex(log, rf"^hdem \({re.escape(VERSION)}\) (unstable|UNRELEASED); urgency=medium\n")
        dated = re.search(rf"## \[{re.escape(VERSION)}\] - (\S+)", (SOURCES / "CHANGELOG.md").read_text(encoding="utf-8"))
        self.assertEqual("unstable" in log, dated is not None)
        if dated:
            day = said("date", "--utc", "--rfc-email", f"--date={dated[1]}", env=os.environ | {"LC_ALL": "C"}).strip()
            self.assertIn(f">  {day}\n", log)


if __name__ == "__main__":
    if not shutil.which("dpkg-deb") or not shutil.which("dpkg-shlibdeps"):
        print("skipped: no dpkg-deb or dpkg-shlibdeps (tools/setup installs dpkg-dev)")
        sys.exit(77)
    if known_problems():
        refusal = unittest.main(argv=[sys.argv[0], "Refused", "Versions"], exit=False)
        print("skipped: this build must not be packed, and cpack says so")
        sys.exit(77 if refusal.result.wasSuccessful() else 1)
    unittest.main(argv=sys.argv[:1])
