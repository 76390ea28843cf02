#!/usr/bin/python3
"""Damaged results and frames are refused in one line, and soon, and without reading anything but the file.

    damaged_files_test.py HDEM TOOLS    the program, and the folder of its scripts

Exit code 77 (skipped) without h5py or matplotlib. verification/fuzz/damaged_results.py tries many more.
"""
import fcntl
import json
import mmap
import os
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock
from pathlib import Path

try:
    import h5py
    import matplotlib    # noqa: F401
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import small_case

HDEM, TOOLS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
FUZZ = Path(__file__).resolve().parents[2] / "fuzz"
sys.path.insert(0, str(TOOLS))
import hdem_io    # noqa: E402

PATIENCE = 300.0    # s, of what should never wait
FRAME = "frames/blocks_000002.hdf"


class DamagedFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="hdem_damaged_test_")
        cls.whole = small_case.run(HDEM, Path(cls.scratch.name))
        (cls.whole / "secret").write_bytes(b"\x01" * 4096)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def setUp(self):
        self.folder = Path(self.scratch.name) / "copy"
        shutil.copytree(self.whole, self.folder)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def changed(self, file, change):
        """The file with a change made by h5py."""
        with h5py.File(self.folder / file, "r+") as opened:
            change(opened)
        return self.folder / file

    def refused(self, read, *words):
        with self.assertRaises(hdem_io.ResultError) as caught:
            read()
        said = str(caught.exception)
        self.assertNotIn("\n", said)
        for word in words:
            self.assertIn(word, said)

    def replaced(self, name, *arguments, **how):
        def change(opened):
            del opened[name]
            opened.create_dataset(name, *arguments, **how)
        return change

    def linked(self, name, link):
        def change(opened):
            del opened[name]
            opened[name] = link
        return change

    def test_small_file_that_claims_much_takes_no_memory(self):
        for how in ({"chunks": (1 << 16,)}, {"chunks": (1 << 16,), "compression": 1}, {}):
            file = self.changed(FRAME, self.replaced("hdem/block_area", (1 << 29,), "f8", **how))
            self.assertLess(file.stat().st_size, 1 << 16)
            reads = f"import sys; sys.path.insert(0, {str(TOOLS)!r}); import hdem_frames; hdem_frames.read_blocks({str(file)!r})"
            done = subprocess.run([sys.executable, "-c", reads], capture_output=True, text=True, check=False,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (1 << 30, 1 << 30)))
            self.assertRegex(done.stderr.splitlines()[-1], "ResultError: .*block_area: shape ")
            shutil.copy(self.whole / FRAME, file)
        file = self.changed(FRAME, self.replaced("hdem/names", (3,), "S2000000000", chunks=(1,)))
        self.refused(lambda: hdem_io.read_blocks(file), "hdem/names", "too large")

    def test_texts_that_pack_well_take_no_memory(self):
        file = self.changed("results.h5", self.replaced("provenance/case_text", (1 << 20,), "S1564", chunks=(128,), compression=1,
                                                        data=np.zeros(1 << 20, "S1564")))
        reads = f"import sys; sys.path.insert(0, {str(TOOLS)!r}); import hdem_io; hdem_io.open_run({str(file)!r}).provenance()"
        done = subprocess.run([sys.executable, "-c", reads], capture_output=True, text=True, check=False,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (1 << 30, 1 << 30)))
        self.assertRegex(done.stderr.splitlines()[-1], "ResultError: .*case_text: .*too large")

    def test_chunk_that_claims_more_than_the_file_is_not_asked_for(self):
        with h5py.File(self.whole / FRAME) as opened:
            areas = opened["hdem/block_area"][...]
        file = self.changed(FRAME, self.replaced("hdem/block_area", data=areas, chunks=areas.shape, fletcher32=True))
        with h5py.File(file) as opened:
            chunk = opened["hdem/block_area"].id.get_chunk_info(0)
        content = bytearray(file.read_bytes())
        # In the index of chunks: its size in 32 bits, mask, offset in two extents, address.
        at = content.index(struct.pack("<IIQQQ", chunk.size, 0, 0, 0, chunk.byte_offset))
        content[at:at + 4] = struct.pack("<I", 0x7FFFFFFF)
        file.write_bytes(content)
        self.refused(lambda: hdem_io.read_blocks(file), "hdem/block_area", "2147483647 stored bytes")

    def test_packed_elements_may_not_be_out_of_proportion(self):
        for name in ("lzf", "gzip"):
            file = self.changed(FRAME, self.replaced("hdem/block_area", data=np.zeros(1 << 20), chunks=True, compression=name))
            self.refused(lambda: hdem_io.read_blocks(file), "hdem/block_area")    # noqa: B023
            shutil.copy(self.whole / FRAME, file)

    def test_nothing_is_read_but_the_file_itself(self):
        layout = h5py.VirtualLayout((3,), "f8")
        layout[...] = h5py.VirtualSource(str(self.folder / "frames/blocks_000000.hdf"), "hdem/block_area", (3,))
        for what, change in (("external link", self.linked("hdem/block_area", h5py.ExternalLink("blocks_000000.hdf", "/hdem/block_area"))),
                             ("soft link", self.linked("hdem/block_area", h5py.SoftLink("/hdem/block_mass"))),
                             ("external group", self.linked("hdem", h5py.ExternalLink("blocks_000000.hdf", "/hdem"))),
                             ("virtual", lambda opened: (opened.__delitem__("hdem/block_area"), opened.create_virtual_dataset("hdem/block_area", layout))),
                             ("elsewhere", self.replaced("hdem/block_area", (3,), "f8", external=[(str(self.folder / "secret"), 0, h5py.h5f.UNLIMITED)]))):
            with self.subTest(what):
                file = self.changed(FRAME, change)
                self.refused(lambda: hdem_io.read_blocks(file), str(file))    # noqa: B023
                shutil.copy(self.whole / FRAME, file)
        self.changed("results.h5", self.linked("history", h5py.ExternalLink(str(self.whole / "results.h5"), "/history")))
        self.assertEqual(hdem_io.open_run(self.folder).histories, [], "those of another file")

    def test_every_wrong_object_of_a_frame_is_named(self):
        with h5py.File(self.whole / FRAME) as opened:
            ids, points, names = opened["VTKHDF/CellData/id"][...], opened["VTKHDF/Points"][...], len(opened["hdem/names"])
            offsets = opened["VTKHDF/Offsets"][...]
        far, lost = points.copy(), points.copy()
        far[0, 0], lost[1, 1] = 1e300, np.nan
        for name, values in (("hdem/names", np.zeros(2, "S1")), ("VTKHDF/CellData/id", np.where(ids == ids[-1], names, ids)), ("VTKHDF/CellData/id", ids[::-1].copy()),
                             ("VTKHDF/CellData/material", ids + 1), ("VTKHDF/CellData/regime", np.full(len(ids), 9, "u1")), ("VTKHDF/Points", far),
                             ("VTKHDF/Points", lost), ("VTKHDF/Points", points[:, :2]), ("VTKHDF/Offsets", offsets + 1), ("VTKHDF/Offsets", offsets[:-1]),
                             ("VTKHDF/CellData/stress_xx", np.zeros(len(ids))), ("hdem/block_position", np.zeros((1, 2))), ("hdem/outline_segments", np.zeros((2, 2, 3))),
                             ("hdem/outline_excavation", np.full(4, 7, "i4")), ("hdem/outer_edge", np.zeros(len(points), "u1"))):
            with self.subTest(name):
                file = self.changed(FRAME, self.replaced(name, data=values))
                self.refused(lambda: hdem_io.read_blocks(file), str(file), name if name != "hdem/names" else "id")    # noqa: B023
                shutil.copy(self.whole / FRAME, file)

    def test_wrong_attributes_are_named(self):
        for name, value in (("cycle", 1.5), ("time", np.nan), ("title", "of variable length"), ("detached_distance", None), ("stage", np.zeros(3)), ("version", 1)):
            def change(opened):
                del opened["hdem"].attrs[name]    # noqa: B023
                if value is not None:    # noqa: B023
                    opened["hdem"].attrs[name] = value    # noqa: B023
            file = self.changed(FRAME, change)
            self.refused(lambda: hdem_io.read_blocks(file), f"hdem@{name}")    # noqa: B023
            shutil.copy(self.whole / FRAME, file)

    def test_programs_end_with_2_and_one_line(self):
        cut = (self.whole / "results.h5").read_bytes()
        frame = (self.whole / FRAME).read_bytes()
        foreign = (self.whole / "frames/contacts_000000.hdf").read_bytes()
        for file, content in (("results.h5", cut[:len(cut) // 2]), ("results.h5", b""), (FRAME, frame[:5000]), (FRAME, foreign), ("summary.json", b"[]"),
                              ("summary.json", b"{\"stages\": 3}"), ("summary.json", b"[" * 100000), ("summary.json", None)):
            with self.subTest(file):
                (self.folder / file).write_bytes(content if content is not None else json.dumps(
                    json.loads((self.whole / file).read_text()) | {"wall_seconds": float("nan")}).encode())
                for command in ("report",) if file == "summary.json" else ("plot", "report"):
                    done = subprocess.run([HDEM, command, self.folder], capture_output=True, text=True, check=False)
                    self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
                    self.assertTrue(done.stderr.startswith(f"error: hdem {command}: "), done.stderr)
                    self.assertIn(file.split("/")[-1], done.stderr)
                shutil.copy(self.whole / file, self.folder / file)

    def test_nothing_but_files_is_read_and_none_that_is_too_large(self):
        def of_cycles(file):
            whole = json.loads((self.whole / file.name).read_text())
            file.write_text(json.dumps(whole | {"cycles": 10 ** 400}))
        for name, make, words in (("summary.json", os.mkfifo, "a pipe"), ("summary.json", os.mkdir, "Is a directory"), ("summary.json", lambda file: file.symlink_to("/dev/zero"), "a device"),
                                  ("summary.json", lambda file: file.write_text("[" + 2000000 * "0," + "0]"), "2000000 values"), ("summary.json", of_cycles, "401 digits"),
                                  ("run.log", os.mkfifo, "a pipe"), ("run.log", os.mkdir, "Is a directory"), ("report.html", os.mkfifo, "No such device")):
            with self.subTest(name, words=words):
                file = self.folder / name
                file.unlink(missing_ok=True)
                make(file)
                done = subprocess.run([HDEM, "report", self.folder], capture_output=True, text=True, check=False, timeout=PATIENCE)
                self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1 if name == "report.html" else 2, "", 1), done.stderr)
                self.assertIn(f"{file}: ", done.stderr)
                self.assertIn(words, done.stderr)
                file.rmdir() if file.is_dir() else file.unlink()
                if name != "report.html":
                    shutil.copy(self.whole / name, file)
        (self.folder / "picture.png").unlink(missing_ok=True)
        os.mkfifo(self.folder / "picture.png")
        done = subprocess.run([HDEM, "plot", self.folder, "-o", self.folder / "picture.png"], capture_output=True, text=True, check=False, timeout=PATIENCE)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("picture.png: no file, but a pipe or a device. Give", done.stderr)

    def test_values_of_a_run_that_blew_up_are_drawn_as_far_as_they_go(self):
        for value in (1e308, -1e308, np.inf, np.nan):
            def change(opened):
                for name in ("kinetic_energy", "slip_points", "friction"):
                    opened["energy"][name][-1] = value    # noqa: B023
                opened["energy/impulse_points"][...] = value    # noqa: B023
            self.changed("results.h5", change)
            for words in (["plot", self.folder, "--history", "energy"], ["report", self.folder]):
                done = subprocess.run([HDEM, *words], capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.changed("results.h5", lambda opened: opened["energy/time"].__setitem__(-1, 1e308))
        self.refused(lambda: hdem_io.open_run(self.folder).energy(), "energy/time")

    def test_contacts_of_other_blocks_are_refused(self):
        shutil.copy(self.whole / "frames/blocks_000002.hdf", self.folder / "frames/blocks_000001.hdf")    # without the prop
        done = subprocess.run([HDEM, "plot", self.folder, "--frame", "1", "--contacts"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("blocks that this frame does not have", done.stderr)

    def test_frame_that_went_away_is_told_from_one_that_was_removed(self):
        frame = self.folder / "frames/blocks_000001.hdf"
        frame.unlink()
        for run_goes_on, words in ((False, f"{frame}: no such file, but the results name it: it was removed. Run the case again"),
                                   (True, f"{frame}: is not there any more: it went away while it was read, as when the run is begun anew. Try again.")):
            with open(self.folder / ".lock", "wb") as lock:
                if run_goes_on:
                    fcntl.flock(lock, fcntl.LOCK_EX)
                done = subprocess.run([HDEM, "plot", self.folder, "--frame", "1"], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
            self.assertIn(words, done.stderr)
        run = hdem_io.open_run(self.folder)
        os.replace(shutil.copy(self.whole / "results.h5", self.folder / "anew"), self.folder / "results.h5")
        self.refused(lambda: run.blocks(1), "Try again")
        (self.folder / "results.h5").unlink()
        self.refused(run.energy, "results.h5: is not there any more")

    def test_many_damaged_files(self):
        done = subprocess.run([FUZZ / "damaged_results.py", HDEM, TOOLS, "--results", "150", "--frames", "400", "--draw-every", "40"], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        counts = {kind: tuple(map(int, row)) for kind, *row in re.findall(r"(?m)^(\w+): (\d+) files, (\d+) refused, (\d+) read$", done.stdout)}
        of_runs = counts["results"][0] + counts["summary"][0]
        self.assertEqual((of_runs, sum(row[0] for row in counts.values()) - of_runs), (150, 400), counts)
        for kind, (files, refused, read) in counts.items():
            if files >= 100:
                self.assertGreater(min(refused, read), 10, kind)

    def test_slow_files_are_told_from_a_machine_that_is_busy(self):
        sys.path.insert(0, str(FUZZ))
        import damaged_results

        def judged(slowest, hangs, work):
            shared = mmap.mmap(-1, 16)
            process = os.fork()
            if process == 0:
                shared[:16] = struct.pack("<qd", 1, time.process_time() + 1e-9)
                work()
                os._exit(0)
            with unittest.mock.patch.multiple(damaged_results, SLOWEST=slowest, HANGS=hangs):
                return damaged_results.watched(process, shared)

        def spin():
            while time.process_time() < 30.0:
                pass
        self.assertEqual(judged(0.3, 1e3, spin), damaged_results.SLOW)
        self.assertEqual(judged(0.3, 1e3, lambda: time.sleep(1.0)), "")
        self.assertEqual(judged(0.3, 0.5, lambda: time.sleep(60.0)), damaged_results.HUNG)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
