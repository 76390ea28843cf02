#!/usr/bin/python3
"""The guide: each of its commands runs, no link is dead, its pages can be built.

    guide_test.py HDEM TOOLS PAGE...    commands of these pages; the program, and the folder of the scripts
    guide_test.py HDEM TOOLS            all but the commands

Pages are built and their equations drawn where mkdocs and chromium are there (tools/setup --guide).
"""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HDEM, TOOLS, PAGES = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3:]
GUIDE, ROOT = TOOLS / "guide", TOOLS.parent
if importlib.util.find_spec("h5py") is None or importlib.util.find_spec("scipy") is None:
    print("skipped: no h5py or scipy")
    sys.exit(77)
sys.path[:0] = [str(GUIDE)]
import commands    # noqa: E402
import links    # noqa: E402

# What a test cannot run: these and no others.
NOT_RUN = {("installation", "installs packages and builds"), ("installation", "builds, and takes minutes"), ("installation", "builds a package and installs it"), ("studies", "needs SLURM"), ("gallery", "it runs this page")}
LONGEST = 60000    # bytes of all pictures but those of the README's size
KNOWN_LARGE = {"cavern.png", "cavern_supported.png", "slope.png", "bolted.png"}


def pages():
    return sorted((GUIDE / "docs").glob("*.md"))


def blocks(page):
    return [block for block in commands.blocks_of(page.read_text(encoding="utf-8"), page.name) if block.kind != "text"]


class Commands(unittest.TestCase):
    """Of the pages that are named."""

    def test_run(self):
        for name in PAGES:
            with self.subTest(name), tempfile.TemporaryDirectory(prefix="hdem_guide_") as scratch:
                said = []
                failed = commands.run_page(GUIDE / "docs" / f"{name}.md", Path(scratch), HDEM, is_long=False, say=said.append)
                self.assertEqual(failed, 0, "\n".join(said))


class Pages(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="hdem_guide_")
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def test_each_page_with_commands_is_one_of_a_test(self):
        listed = set(" ".join(re.findall(r"GUIDE_PAGES ([^)$]+)\)", (ROOT / "verification/CMakeLists.txt").read_text(encoding="utf-8"))).split())
        self.assertEqual(listed, {page.stem for page in pages() if any(not (block.reason or block.is_long) for block in blocks(page))})

    def test_what_is_not_run_is_known(self):
        self.assertEqual({(page.stem, block.reason) for page in pages() for block in blocks(page) if block.reason}, NOT_RUN)

    def test_what_installation_exports_is_enough(self):
        """A reader has nothing else: with it the program is found, and by Debian's Python what the pages import."""
        lines = re.findall(r"^export .*$", (GUIDE / "docs/installation.md").read_text(encoding="utf-8").split("## As a Debian package")[0], re.MULTILINE)
        self.assertEqual(len(lines), 2)
        script = "\n".join(lines).replace("$PWD/build/release", str(HDEM.parent.parent)) + "\nhdem --version >/dev/null && exec /usr/bin/python3 -c 'import hdem_io; print(hdem_io.__file__)"
        has_module = (HDEM.parent.parent / "python").is_dir()
        plain = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "HDEM")}
        done = subprocess.run(["bash", "-euc", script + ("; import hdem'" if has_module else "'")], cwd=ROOT, env=plain, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(Path(done.stdout.strip()).parent, TOOLS)

    def test_every_block_of_commands_is_found(self):
        for page in pages():
            fences = re.findall(r"^```(\w+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
            self.assertEqual(len(blocks(page)), sum(kind in ("sh", "python") for kind in fences), page.name)
            self.assertLessEqual(set(fences), {"sh", "python", "text", "toml"}, page.name)

    def test_pieces_of_cases_are_toml(self):
        import tomllib
        for page in pages():
            for text in re.findall(r"^```toml\n(.*?)^```$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL):
                if not text.startswith("--8<--"):
                    tomllib.loads(text)

    def test_titles_of_cases_are_words(self):
        """They stand in pictures and pages; which check uses a case is a comment in it."""
        import tomllib
        for file in [*(ROOT / "verification/cases").rglob("*.toml"), *(GUIDE / "cases").rglob("*.toml")]:
            title = tomllib.loads(file.read_text(encoding="utf-8")).get("title", "")
            self.assertNotRegex(title, r"\([^)]*([A-Z]\d|rest\.|robust\.|closed form|sect\.)", file.name)

    def test_failing_commands_and_wrong_outputs_are_noticed(self):
        for text, failures in (("```sh\nexit 3\n```\n", 1), ("```sh\necho one   two\n```\n\n<!-- output -->\n```text\none two\n```\n", 0), ("```sh\necho one\n```\n\n```text\ntwo\n```\n", 1),
                               ("<!-- long -->\n```sh\nexit 3\n```\n", 0), ("<!-- not run: why -->\n```sh\nexit 3\n```\n", 0), ("```sh\nfalse\ntrue\n```\n", 1), ("```python\nraise SystemExit(1)\n```\n", 1),
                               ("<!-- short: --set a=1 -->\n```sh\nhdem() { test \"$*\" = 'run case -o x --set a=1'; }\nhdem run case -o x      # a comment\n```\n", 0)):
            page = self.folder / "page.md"
            page.write_text(text, encoding="utf-8")
            self.assertEqual(commands.run_page(page, self.folder, HDEM, is_long=False, say=lambda said: None), failures, text)
        with self.assertRaises(ValueError):
            commands.blocks_of("<!-- shrt: x -->\n```sh\ntrue\n```\n", "page")

    def test_no_link_is_dead(self):
        dead = [(str(file), *found) for file in links.markdown_files() for found in links.dead_in_markdown(file)]
        self.assertEqual(dead, [])

    def test_dead_links_are_noticed(self):
        (self.folder / "other.md").write_text("# Some heading: (a) b\n\n```\n# none\n```\n")
        page = self.folder / "page.md"
        page.write_text("# Here\n[a](other.md) [b](other.md#some-heading-a-b) [c](#here) [d](https://no.where) ![p](no.png)\n[e](none.md) [f](other.md#none) [g](#there)\n```\n[h](no)\n```\n")
        self.assertEqual([link for link, _ in links.dead_in_markdown(page)], ["no.png", "none.md", "other.md#none", "#there"])

    def test_pictures_are_small_and_shown(self):
        shown = {name for page in pages() for name in re.findall(r"\(pictures/([^)]+)\)", page.read_text(encoding="utf-8"))}
        files = {file.name: file.stat().st_size for file in (GUIDE / "docs/pictures").iterdir()}
        self.assertEqual(set(files), shown)
        self.assertEqual({name for name, size in files.items() if size > LONGEST and name not in KNOWN_LARGE}, set())
        self.assertLess(sum(files.values()), 1e6)

    def test_pages_are_built_with_their_equations(self):
        if not shutil.which("mkdocs") or not Path("/usr/share/javascript/katex").exists():
            self.skipTest("no mkdocs or KaTeX: tools/setup --guide installs them")
        site = self.folder / "site"
        done = subprocess.run([GUIDE / "build", site], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual({page.stem for page in pages()} - {page.stem for page in site.glob("*.html")}, set())
        format_page = (site / "case_format.html").read_text(encoding="utf-8")
        self.assertIn('id="ends-of-a-stage"', format_page)
        self.assertNotIn("--8&lt;--", "".join(page.read_text(encoding="utf-8") for page in site.glob("*.html")))
        for page in site.glob("*.html"):    # nothing is loaded from the network
            self.assertEqual(re.findall(r'(?:src|rel="stylesheet" href)="https?:', page.read_text(encoding="utf-8")), [], page.name)
        self.draw_equations(site)

    def draw_equations(self, site):
        if not shutil.which("chromium"):
            return
        words = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=20000", f"--user-data-dir={self.folder / 'browser'}", "--dump-dom", (site / "theory.html").as_uri()]
        drawn = subprocess.run(words, capture_output=True, text=True, check=True, timeout=200, env=os.environ | {"HOME": str(self.folder)}).stdout
        wanted = (site / "theory.html").read_text(encoding="utf-8").count('class="arithmatex"')
        self.assertGreater(wanted, 40)
        self.assertEqual(drawn.count('class="katex"'), wanted)
        self.assertNotIn("katex-error", drawn)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "Commands" if PAGES else "Pages"])
