#!/usr/bin/python3
"""Files of earlier versions of their formats: results and frames are read, checkpoints are refused with a message.

    versions_test.py HDEM TOOLS    the program, and the folder of hdem_io.py

samples/results_1_0.tar.gz is the folder of a small run of the first hdem 0.1.0: results.h5 of version 1.0, frames of version 1.0. A new minor version
of a format comes with a sample of the one before.
"""
import subprocess
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path

import small_case

HDEM = Path(sys.argv[1]).resolve()
sys.path.insert(0, sys.argv[2])
try:
    import h5py
    import hdem_io
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

SAMPLES = Path(__file__).resolve().parent / "samples"


class OlderVersions(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.root = Path(self.scratch.name)

    def tearDown(self):
        self.scratch.cleanup()

    def test_results_and_frames_are_read(self):
        for sample in sorted(SAMPLES.glob("results_*.tar.gz")):
            with tarfile.open(sample) as archive:
                archive.extractall(self.root, filter="data") if hasattr(tarfile, "data_filter") else archive.extractall(self.root)
            folder = self.root / sample.name.removesuffix(".tar.gz")
            run = hdem_io.open_run(folder)
            self.assertEqual([(frame.number, frame.cycle, frame.stage) for frame in run.frames], [(0, 0, "fall"), (1, 1500, "fall")])
            self.assertEqual(list(run.blocks("last")["name"]), ["ground", "l", "ball"])
            self.assertAlmostEqual(run.contacts("last")["normal_force"].sum(), 3 * 2700 * 9.81, delta=30)    # of the l, which rests
            self.assertAlmostEqual(run.history("rest")["normal_force"][-1], 3 * 2700 * 9.81, delta=30)
            self.assertEqual(len(run.energy()["kinetic_energy"]), 3)
            self.assertEqual(run.provenance()["hdem_version"], "0.1.0")
            for command in (["info", folder], ["info", folder / "frames/blocks_000001.hdf"], ["info", folder / "frames/contacts_000001.hdf"],
                            ["plot", folder, "-o", folder / "picture.png"], ["report", folder, "-o", folder / "page.html"]):
                done = subprocess.run([HDEM, *map(str, command)], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, f"{command}: {done.stderr}")
            self.assertIn("format 1.0", subprocess.run([HDEM, "info", folder], capture_output=True, text=True, check=True).stdout)

    def test_checkpoints_of_another_version_are_refused_and_stay_as_they_are(self):
        folder = small_case.run(HDEM, self.root)
        for version in ([1, 0], [2, 0], [2, 7], [2, 9], [3, 0]):
            for name in ("checkpoint.h5", "checkpoint.previous.h5"):
                if (folder / name).exists():
                    with h5py.File(folder / name, "r+") as opened:
                        opened.attrs["version"] = version
            before = {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()}
            refused = subprocess.run([HDEM, "run", "--restart", folder], capture_output=True, text=True, check=False)
            self.assertEqual(refused.returncode, 2)
            self.assertRegex(refused.stderr, rf"checkpoint.h5: version = {version[0]}\.{version[1]} \(this hdem \S+ reads version 2\.8\)\. "
                                             r"Go on with the hdem that wrote it: \S+, commit \w+\.\n$")
            self.assertEqual({file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()}, before)
            again = subprocess.run([HDEM, "run", self.root / "small.toml", "-o", folder, "--quiet"], capture_output=True, text=True, check=False)
            self.assertEqual(again.returncode, 2, "it may be worth something")
            self.assertIn("--overwrite", again.stderr)

    def test_results_of_another_major_version_are_refused(self):
        folder = small_case.run(HDEM, self.root)
        with h5py.File(folder / "results.h5", "r+") as opened:
            opened.attrs["version"] = [9, 0]
        with self.assertRaisesRegex(hdem_io.ResultError, "written in version 9 of its format"):
            hdem_io.open_run(folder)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
