#!/usr/bin/python3
"""The page that `hdem report` makes of a small run.

    run_report_test.py HDEM TOOLS    the program, and the folder of its scripts

Exit code 77 (skipped) without h5py or matplotlib.
"""
import base64
import fcntl
import html
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

try:
    import numpy as np
    import matplotlib    # noqa: F401
    import h5py
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import page_checks
import small_case

HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.path[:0] = [str(TOOLS), str(TOOLS / "report")]
import run_figures    # noqa: E402
import run_page       # noqa: E402

SECTIONS = ["Summary", "Model", "Displacement-and-stress", "Histories", "Energy-ledger", "Timing", "Provenance"]
PICTURE = re.compile(r'src="data:image/svg\+xml;base64,([^"]+)"')


def report(*arguments):
    """Exit code, and all that was said."""
    done = subprocess.run([HDEM, "report", *map(str, arguments)], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class PageOfARun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_report_test_")
        cls.folder = small_case.run(HDEM, Path(cls.scratch.name))
        code, said = report(cls.folder)
        if (code, said.strip()) != (0, str(cls.folder / "report.html")):
            raise RuntimeError(said)
        cls.page = (cls.folder / "report.html").read_text(encoding="utf-8")
        cls.summary = json.loads((cls.folder / "summary.json").read_text(encoding="utf-8"))

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def page_of(self, folder):
        code, said = report(folder, "-o", folder / "page.html")
        self.assertEqual(code, 0, said)
        return (folder / "page.html").read_text(encoding="utf-8")

    def copy(self, name):
        folder = Path(self.scratch.name) / name
        shutil.copytree(self.folder, folder)
        return folder

    def test_is_one_file_without_broken_links(self):
        page_checks.asks_for_nothing(self, self.page)
        page_checks.links_lead_somewhere(self, self.page)

    def test_every_section_is_there(self):
        self.assertEqual(re.findall(r'<section id="([^"]+)"', self.page), SECTIONS)

    def test_says_what_the_summary_says(self):
        for words in (self.summary["title"], self.summary["state_hash"], *self.summary["detached_blocks"], self.summary["git_commit"]):
            self.assertIn(html.escape(words), self.page)
        for stage in self.summary["stages"]:
            self.assertIn(f'<td>{stage["name"]}</td><td class="n">{stage["cycles"]}</td>', self.page)

    def test_pictures_and_curves_are_drawn(self):
        pictures = PICTURE.findall(self.page)
        self.assertEqual(len(pictures), 5)    # model, displacement twice, stress, regime
        for picture in pictures:
            xml.etree.ElementTree.fromstring(base64.b64decode(picture))
        self.assertEqual(len(page_checks.curves_of(self, self.page)), 4)    # the run, two histories, energies
        self.assertEqual(self.page, self.page_of(self.folder), "the same run gives the same page")

    def test_ledger_adds_up(self):
        table = self.page[self.page.index('id="Energy-ledger"'):]
        rows = re.findall(r'<tr><td>([^<]*)</td><td class="what">[^<]*</td><td class="n">(.*?)</td>', table)
        sums = {}
        for kind, energy in rows:
            sums[kind] = sums.get(kind, 0.0) + float(energy.replace("−", "-").replace(" × 10<sup>", "e").replace("</sup>", ""))
        self.assertEqual(list(sums), ["put in", "taken out", "stored at the end", "left over"])
        self.assertAlmostEqual(sums["put in"], sums["taken out"] + sums["stored at the end"], delta=1e-3 * sums["put in"])

    def test_ledger_has_every_term(self):
        energy = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))["energy"]
        self.assertEqual(set(energy) - {"residual", "relative_residual", "kinetic"}, set(run_page.LEDGER) - {"kinetic_energy", "driven_kinetic"})

    def test_case_text_and_log_are_there(self):
        self.assertIn(html.escape(small_case.CASE), self.page)
        self.assertIn(html.escape((self.folder / "run.log").read_text(encoding="utf-8")), self.page)

    def test_run_without_summary_is_said_to_be_open(self):
        folder = self.copy("killed")
        (folder / "summary.json").unlink()
        (folder / "run.log").unlink()
        page = self.page_of(folder)
        self.assertIn("has not ended", page)
        self.assertNotIn("wall time", page)

    def test_interrupted_run_is_said_to_be_so(self):
        folder = self.copy("interrupted")
        (folder / "summary.json").unlink()
        with h5py.File(folder / "results.h5", "r+") as opened:
            opened["provenance"].attrs["end"] = np.bytes_("")
        self.assertIn("was interrupted", self.page_of(folder))
        (folder / ".lock").touch()
        with open(folder / ".lock", "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            page = self.page_of(folder)
        self.assertIn("goes on", page)
        self.assertNotIn("was interrupted", page)

    def test_cards_show_the_displacements_that_they_name(self):
        """The ball moves 0.14 m in the last stage; next to the excavation is the fixed ground alone."""
        near, all_ = (self.summary[key] for key in ("max_displacement", "max_displacement_all"))
        self.assertGreater(all_, near + 0.1)
        self.assertEqual(dict(reversed(found) for found in re.findall(r'<div class="card "><b>([^<]*)</b>(greatest displacement [^<]*)</div>', self.page)),
                         {"greatest displacement next to the excavation, without detached blocks": run_page.metres(near), "greatest displacement of all free blocks": run_page.metres(all_)})

    def test_run_that_missed_its_end_is_not_done(self):
        case, folder = Path(self.scratch.name) / "missed.toml", Path(self.scratch.name) / "missed"
        case.write_text(small_case.CASE.replace("cycles = 1500\nexcavate = [\"prop\"]", 'until = ["speed < 1e-9"]\nmax_cycles = 50'), encoding="utf-8")
        self.assertEqual(subprocess.run([HDEM, "run", case, "-o", folder, "--quiet"], check=False).returncode, 4)
        page = self.page_of(folder)
        self.assertIn('<div class="card missed"><b>end not reached</b>stage "fall" came to max_cycles first</div>', html.unescape(page))
        self.assertIn("<td>max_cycles</td><td>no</td>", page)
        self.assertNotIn("next to the excavation", page, "nothing was excavated")

    def test_run_without_contact_frames_has_a_page(self):
        folder = self.copy("no_contacts")
        for file in (folder / "frames").glob("contacts_*"):
            file.unlink()
        self.assertEqual(len(PICTURE.findall(self.page_of(folder))), 5)

    def test_errors_say_what_is_wrong(self):
        broken = self.copy("broken")
        (broken / "summary.json").write_text("{")
        empty = Path(self.scratch.name) / "empty"
        empty.mkdir()
        for arguments, expected, words in ((["nowhere"], 2, "no such file"), ([broken], 2, "summary.json: not JSON"), ([empty], 2, "results.h5: no such file"),
                                           ([], 2, "required")):
            code, said = report(*arguments)
            self.assertEqual(code, expected, said)
            self.assertIn(words, said)
            self.assertNotIn("Traceback", said)


class OutcomeCard(unittest.TestCase):
    def card(self, converged, *stages):
        keys = ("name", "ended_by", "until_converged", "converged")
        return run_page.outcome_card({"converged": converged, "stages": [dict(zip(keys, stage)) for stage in stages]}, "done")

    def test_says_how_the_stages_ended(self):
        settled = ("settle", "cycles", False, False)
        for converged, stages, kind, words in (
                (True, [settled], "met", "done every stage ran as long as asked for"),
                (True, [settled, ("fall", "speed < 1e-9", False, False)], "met", "done every stage reached its end"),
                (True, [settled, ("rest", "converged", True, True)], "met", "converged every stage that should"),
                (False, [settled, ("rest", "max_cycles", True, False)], "missed", "not converged within its limit of cycles"),
                (False, [("rest", "converged", True, True), ("fall", "max_cycles", False, False)], "missed", 'end not reached stage "fall" came to max_cycles first')):
            found = self.card(converged, *stages)
            self.assertIn(f'class="card {kind}"', found)
            self.assertEqual(html.unescape(re.sub("<[^>]*>", " ", found)).strip().replace("  ", " "), words)


class Thinned(unittest.TestCase):
    def test_keeps_peaks_and_ends_of_a_long_curve(self):
        x = np.arange(100001.0)
        y = np.sin(x / 5000.0)
        y[70003] = 9.0
        kept_x, kept_y = run_figures.thinned(x, y)
        self.assertLessEqual(len(kept_x), run_figures.MOST_POINTS + 2)
        self.assertEqual((kept_x[0], kept_x[-1], kept_y.max(), kept_y.min()), (0.0, 100000.0, 9.0, y.min()))
        self.assertTrue(np.all(np.diff(kept_x) > 0.0))

    def test_leaves_a_short_curve_alone(self):
        x = np.arange(10.0)
        self.assertIs(run_figures.thinned(x, x)[0], x)


class Duration(unittest.TestCase):
    def test_reads_well(self):
        self.assertEqual([run_page.duration(s) for s in (4.24, 61.8, 7262.0)], ["4.2 s", "1 min 02 s", "2 h 01 min"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
