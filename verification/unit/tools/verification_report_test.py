#!/usr/bin/python3
"""Quick checks of hdem_verify as a page of tools/verification_report.

    verification_report_test.py HDEM_VERIFY TOOLS    the program, and the folder of verification_report

Exit code 77 (skipped) without matplotlib.
"""
import html
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import matplotlib    # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import page_checks

VERIFY, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
CHECKS = ["paper.table2", "paper.fig5", "paper.table4", "paper.transition", "closed_form.A18"]
FIGURES = ["fig3", "fig4", "fig5", "fig7", "fig8", "fig9", "ledger_incline", "ledger_bounce"]


def make_page(*arguments):
    """Exit code, and all that was said."""
    done = subprocess.run([TOOLS / "verification_report", *map(str, arguments)], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        cls.rows_file, cls.curves_file = cls.folder / "rows.json", cls.folder / "curves.json"
        done = subprocess.run([VERIFY, *CHECKS, "--json", cls.rows_file, "--curves", cls.curves_file], capture_output=True, text=True, check=False)
        if done.returncode not in (0, 3):
            raise RuntimeError(done.stdout + done.stderr)
        cls.rows, cls.curves = json.loads(cls.rows_file.read_text()), json.loads(cls.curves_file.read_text())
        cls.page = cls.build(cls.rows, cls.curves)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def build(cls, rows, curves):
        rows_file, curves_file, page = cls.folder / "r.json", cls.folder / "c.json", cls.folder / "page.html"
        rows_file.write_text(json.dumps(rows))
        curves_file.write_text(json.dumps(curves))
        code, said = make_page("-o", page, "--json", rows_file, "--curves", curves_file)
        if code != 0:
            raise RuntimeError(said)
        return page.read_text(encoding="utf-8")

    def test_every_check_and_row_is_there(self):
        self.assertEqual({row["case"] for row in self.rows}, set(CHECKS))
        for check in self.curves["checks"]:
            self.assertIn(f">{check['name']}</h3>", self.page)
        for row in self.rows:
            self.assertIn(html.escape(row["quantity"]), self.page)
        self.assertEqual(self.page.count('<td class="verdict">'), len(self.rows) + sum(row["pass"] is False for row in self.rows))

    def test_every_figure_has_the_paper_or_a_closed_form_beside_ours(self):
        self.assertEqual([figure["id"] for figure in self.curves["figures"]], FIGURES)
        for figure in self.curves["figures"]:
            self.assertIn(f'<figure id="{re.sub("_", "-", figure["id"])}">', self.page)
            self.assertIn(html.escape(figure["title"]), self.page)
            drawn = [drawn for panel in figure["panels"] for drawn in panel["series"] + panel["marks"]]
            self.assertTrue({"ours"} < {one["origin"] for one in drawn}, figure["id"])
            for series in (one for panel in figure["panels"] for one in panel["series"]):
                self.assertLessEqual(len(series["x"]), 1000)
                self.assertEqual(len(series["x"]), len(series["y"]))

    def test_asks_the_network_for_nothing(self):
        page_checks.asks_for_nothing(self, self.page)

    def test_links_lead_somewhere_and_ids_are_unique(self):
        page_checks.links_lead_somewhere(self, self.page)

    def test_every_figure_is_drawn(self):
        self.assertEqual(len(page_checks.curves_of(self, self.page)), len(FIGURES))

    def test_a_missed_bar_is_marked(self):
        rows = [dict(row) for row in self.rows]
        before = self.page.count('<tr class="missed">')
        met = next(row for row in rows if row["pass"])
        met["pass"] = False
        page = self.build(rows, self.curves)
        self.assertEqual(page.count('<tr class="missed">'), before + 2, "in the summary and in its table")
        self.assertIn("Bars that are missed", page)

    def test_maps_and_missing_numbers(self):
        square = [[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]]
        fields = [{"title": "displacement [mm]", "has_both_signs": True, "values": [1.0, -2.0]}]
        one = {"title": "force", "parts": [square, square], "detached": [0, 1], "fields": fields}
        figure = {"id": "map", "check": "paper.fig5", "title": "Map", "source": "-", "note": "", "columns": 1, "panels": [], "maps": [one, one]}
        row = {"case": "paper.fig5", "quantity": "runs to its end", "source": "it did <not>", "pass": False}
        page = self.build([row], {"figures": [figure]})
        self.assertEqual(page.count('<svg class="map"'), 2)
        self.assertEqual(page.count('class="gone"'), 2)
        self.assertIn("it did &lt;not&gt;", page)

    def test_rows_alone_make_a_page(self):
        page = self.folder / "alone.html"
        code, said = make_page("-o", page, "--json", self.rows_file)
        self.assertEqual(code, 0, said)
        self.assertNotIn("<figure", page.read_text())

    def test_runs_the_program_itself(self):
        page = self.folder / "run.html"
        code, said = make_page("-o", page, "--program", VERIFY, "paper.fig5")
        self.assertEqual(code, 0, said)
        self.assertIn(">paper.fig5</h3>", page.read_text())

    def test_errors_say_what_is_wrong(self):
        pipe = self.folder / "pipe.json"
        os.mkfifo(pipe)
        for arguments, expected, words in ((["--json", "nowhere.json"], 1, "nowhere.json: cannot be read"), (["--json", pipe], 1, "pipe.json: cannot be read as JSON (is a pipe"), (["--curves", "c.json"], 2, "give --json too"),
                                           (["--json", "r.json", "paper"], 2, "nothing is run"), (["--program", "nowhere"], 1, "nowhere: no such program"),
                                           (["--program", VERIFY, "paper.table9"], 1, "exit code 2")):
            code, said = make_page("-o", self.folder / "none.html", *arguments)
            self.assertEqual(code, expected, said)
            self.assertIn(words, said)
            self.assertNotIn("Traceback", said)
        self.assertFalse((self.folder / "none.html").exists())


class LongRun(unittest.TestCase):
    def test_what_is_done_is_shown_while_others_still_run(self):
        with subprocess.Popen([VERIFY, "closed_form.A1", "recycling.tunnel", "--jobs", "1"], stdout=subprocess.PIPE, text=True) as run:
            try:
                shown = [run.stdout.readline() for _ in range(3)]
                self.assertIsNone(run.poll())
            finally:
                run.kill()
        self.assertIn("closed_form.A1:", "".join(shown))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
