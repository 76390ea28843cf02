#!/usr/bin/python3
"""The small commands: `hdem info`, `--version`, bash completion, and the example of a figure of one's own.

    commands_test.py HDEM TOOLS    the program, and the folder of its scripts

Exit code 77 (skipped) without h5py or matplotlib.
"""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import h5py
    import matplotlib.image
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import small_case

HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()


def hdem(*arguments):
    """Exit code, and all that was said."""
    done = subprocess.run([HDEM, *map(str, arguments)], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class Info(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_commands_test_")
        cls.folder = small_case.run(HDEM, Path(cls.scratch.name))

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def info(self, file):
        """Rows as a dict; of several with one name, the last."""
        code, said = hdem("info", file)
        self.assertEqual(code, 0, said)
        return {line[:16].strip(): line[17:] for line in said.splitlines()}

    def test_of_results_says_where_they_come_from(self):
        for file in (self.folder, self.folder / "results.h5"):
            rows = self.info(file)
            self.assertEqual(rows["file"], "results of a run, format 1.2")
            self.assertIn("small.toml (SHA-256 ", rows["case"])
            self.assertRegex(rows["frames"], r"^\d+, the last at cycle 1700, 0\.17 s$")
            self.assertIn("kinetic_energy", rows["energy"])
            self.assertRegex(rows["history rest"], r"^171 rows: cycle, normal_force, overlap, time$")
            self.assertRegex(rows["end"], r"^\d{4}-")

    def test_of_frames_says_what_they_show(self):
        rows = self.info(self.folder / "frames/blocks_000000.hdf")
        self.assertEqual((rows["file"], rows["title"], rows["cycle"]), ("frame of blocks, format 1.3", "Small run", "0"))
        self.assertEqual(rows["blocks"], "4 (5 convex parts)")
        last = sorted((self.folder / "frames").glob("contacts_*"))[-1]
        rows = self.info(last)
        with h5py.File(last) as opened:
            self.assertEqual(rows["contacts"], str(opened["VTKHDF/NumberOfCells"][0]))
            self.assertEqual(rows["fields"].split(", "), sorted(opened["VTKHDF/CellData"]))

    def test_of_a_checkpoint_says_where_a_run_would_go_on(self):
        rows = self.info(self.folder / "checkpoint.h5")
        self.assertTrue(rows["file"].startswith("checkpoint, format "))
        self.assertEqual((rows["cycle"], rows["time"], rows["blocks"]), ("1700", "0.17 s", "4"))
        self.assertEqual(rows["stage"], "number 2, begun at cycle 200")
        self.assertIn("finished", rows["run"])

    def test_of_a_case_says_what_it_asks_for(self):
        code, said = hdem("info", self.folder.parent / "small.toml")
        self.assertEqual(code, 0, said)
        for words in ("Small run", "settle: 200 cycles", "fall: 1500 cycles, excavates prop", "rest: normal_force, overlap"):
            self.assertIn(words, said)

    def test_refuses_what_is_not_hdems(self):
        foreign, cut = self.folder / "foreign.h5", self.folder / "cut.h5"
        with h5py.File(foreign, "w") as opened:
            opened["x"] = [1.0]
        cut.write_bytes((self.folder / "results.h5").read_bytes()[:3000])
        for file, expected, words in ((foreign, 2, "none of hdem's"), ("nowhere.h5", 2, "no such file"), (cut, 2, "cut.h5"),
                                      (self.folder / "run.log", 2, "run.log:")):
            code, said = hdem("info", file)
            self.assertEqual(code, expected, said)
            self.assertIn(words, said)

    def test_example_draws_a_figure(self):
        picture = self.folder / "own.png"
        done = subprocess.run([TOOLS / "own_figure.py", self.folder, "-o", picture], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(matplotlib.image.imread(picture)[..., :3].std(), 0.01, "not a blank page")
        empty = Path(self.scratch.name) / "empty"
        empty.mkdir()
        done = subprocess.run([TOOLS / "own_figure.py", empty], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)


class Check(unittest.TestCase):
    def test_says_how_large_the_model_is(self):
        with tempfile.TemporaryDirectory(prefix="hdem_commands_test_") as scratch:
            case = Path(scratch) / "small.toml"
            case.write_text(small_case.CASE)
            code, said = hdem("check", case)
            self.assertEqual(code, 0, said)
            self.assertIn("extent            x -1 to 9 m, y -1 to 2 m; a block has 3.75 m2 on average", said)


    def test_tells_of_corners_that_touch_in_a_point(self):
        sets = "".join(f"[[joint_set]]\ndip_deg = {dip}\nspacing = 1.0\n{origin}" for dip, origin in ((0, ""), (60, ""), (-60, "ORIGIN\n")))
        rock = small_case.ROCK + "[domain]\nwidth = 6\nheight = 6\nfixed = [\"bottom\"]\n[[stage]]\ncycles = 1\n" + sets
        with tempfile.TemporaryDirectory(prefix="hdem_commands_test_") as scratch:
            case = Path(scratch) / "rock.toml"
            for origin, is_told in (("", True), ("origin = [3.2, 3.0]", False)):
                case.write_text(rock.replace("ORIGIN", origin))
                code, said = hdem("check", case)
                self.assertEqual(code, 0, said)
                self.assertEqual("pairs of blocks touch in a corner alone" in said, is_told, said)


class FolderOfAnotherCase(unittest.TestCase):
    def test_is_named_when_its_results_go(self):
        with tempfile.TemporaryDirectory(prefix="hdem_commands_test_") as scratch:
            first, second, out = (Path(scratch) / name for name in ("first.toml", "second.toml", "out"))
            first.write_text(small_case.CASE)
            second.write_text(small_case.CASE + "# another\n")
            for case, is_told in ((first, False), (first, False), (second, True), (second, False)):
                code, said = hdem("run", case, "-o", out)
                self.assertEqual(code, 0, said)
                self.assertEqual("note      the results of " in said, is_told, said)
                if is_told:
                    self.assertIn(f"the results of {first} in this folder, begun at 2", said)
                    self.assertIn("note      the results of ", (out / "run.log").read_text())


class Version(unittest.TestCase):
    def test_has_the_facts_of_the_build(self):
        code, said = hdem("--version")
        self.assertEqual(code, 0)
        self.assertRegex(said, r"^hdem \d+\.\d+\.\d+ \(")
        for fact in ("commit", "compiler", "flags", "HDF5", "threads"):
            self.assertRegex(said, rf"(?m)^{fact} +\S")


class FullDisk(unittest.TestCase):
    def test_what_could_not_be_printed_is_an_error(self):
        with tempfile.TemporaryDirectory(prefix="hdem_commands_test_") as scratch, open("/dev/full", "w", encoding="utf-8") as full:
            small_case.run(HDEM, Path(scratch))
            case = Path(scratch) / "small.toml"
            for arguments in (("check", case), ("check", case, "--blocks"), ("info", case), ("schema",), ("schema", "--markdown")):
                done = subprocess.run([HDEM, *arguments], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual(done.returncode, 1, arguments)
                self.assertIn("No space left on device", done.stderr)


class Completion(unittest.TestCase):
    def complete(self, *words):
        """What Tab offers behind these words."""
        script = (f'source "{TOOLS}/completion/hdem.bash"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _hdem; printf "%s\\n" "${{COMPREPLY[@]}}"')
        done = subprocess.run(["bash", "-c", script, "bash", "hdem", *words], capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        return set(done.stdout.split())

    def options_of(self, *command):
        """Those of its help; aliases of the same option are left out of the completion."""
        said = hdem(*command, "--help")[1]
        return set(re.findall(r"(?m)^  (?:-\w,? ?)?(?:\w+, )?(--[\w-]+)", said)) | set(re.findall(r"(?m)^  -\w[^-\n]*(--[\w-]+)", said))

    def test_knows_every_command(self):
        said = hdem("--help")[1]
        commands = re.findall(r"(?m)^  (\w+) ", said[said.index("Subcommands:"):])
        self.assertGreater(len(commands), 5)
        self.assertEqual({word for word in self.complete("") if not word.startswith("-")}, set(commands))

    def test_knows_every_option(self):
        for command in ("run", "check", "info", "schema", "plot", "report"):
            offered = {word for word in self.complete(command, "--")}
            self.assertEqual(offered - {"--help"}, self.options_of(command) - {"--help", "--help-all"}, command)

    def test_knows_values_and_files(self):
        self.assertEqual(self.complete("run", "--method", ""), {"force", "impulse", "hybrid"})
        self.assertIn(f"{TOOLS}/plot.py", self.complete("report", f"{TOOLS}/plo"))
        self.assertNotIn(f"{TOOLS}/plot.py", self.complete("run", f"{TOOLS}/plo"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
