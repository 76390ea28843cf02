#!/usr/bin/python3
"""The Python module hdem beside the program: the same bits, folders, checkpoints and factors of safety, by pytest.

    python_program_test.py HDEM CASES EXAMPLE    with the package on PYTHONPATH; exit code 77: it was not built, or there is no pytest
"""
import json
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

from python_common import CASES, SHORT, TUNNEL, pile, program, program_hash, run_tests, run_tunnel, tunnel    # noqa: F401

import numpy as np
import pytest

import hdem


@pytest.mark.parametrize("threads", [1, 2, None])
def test_tunnel_has_the_programs_bits(tunnel, threads):
    simulation = run_tunnel(threads)
    assert simulation.state_hash == tunnel["state_hash"]
    assert (simulation.cycle, simulation.time) == (tunnel["cycles"], tunnel["time"])


def test_pieces_callbacks_and_views_change_no_bit(tunnel):
    simulation = hdem.Simulation(hdem.Case(TUNNEL, set=SHORT), threads=2)
    seen = []
    simulation.run(cycles=137, callback=lambda s: seen.append(s.cycle), every=50)
    assert seen == [50, 100] and simulation.cycle == 137
    assert [(r["cycles"], r["is_over"], r["met_end"]) for r in simulation.results] == [(137, False, False)]
    simulation.run(stages=1)
    assert (simulation.cycle, simulation.stage, simulation.is_over, simulation.is_done) == (400, 0, True, False)
    simulation.run(callback=lambda s: seen.append(float(s.motion_view["x"][0])), every=100)
    assert simulation.is_done and len(seen) == 2 + 8 and simulation.state_hash == tunnel["state_hash"]
    assert simulation.run() == simulation.results and [r["cycles"] for r in simulation.results] == [400, 800]


def test_dict_is_the_same_case_as_its_file(tunnel):
    case = hdem.Case(hdem.Case(TUNNEL).data, set={"stage[0].cycles": np.int64(400), "stage[1].max_cycles": 800})
    simulation = hdem.Simulation(case, threads=1)
    simulation.run()
    assert simulation.state_hash == tunnel["state_hash"]


def test_folder_is_that_of_the_program(tmp_path):
    h5py = pytest.importorskip("h5py")
    file = tmp_path / "case.toml"
    file.write_text(hdem.to_toml(pile(output={"row_every": 50, "frame_every": 100}, history=[{"name": "top", "block": "high", "every": 20,
                                                                                                "quantities": ["displacement"]}])))
    expected = program_hash(tmp_path, file, "--threads", 1)
    simulation = hdem.Simulation(hdem.Case(file), folder=tmp_path / "by_python", threads=1)
    with pytest.raises(hdem.CaseError):
        hdem.Simulation(hdem.Case(file), folder=tmp_path / "by_python")    # one run at a time
    simulation.run(cycles=130)
    simulation.run()
    theirs, ours = tmp_path / "by_program", tmp_path / "by_python"
    timed = {"wall_seconds", "stage_wall_seconds", "timing", "contact_point_updates_per_second", "stages", "thread_use"}
    summary = json.loads((ours / "summary.json").read_text())
    assert summary == simulation.summary
    assert {k: v for k, v in summary.items() if k not in timed} == {k: v for k, v in expected.items() if k not in timed}
    names = lambda folder: sorted(str(f.relative_to(folder)) for f in folder.rglob("*") if "lock" not in f.name)
    assert names(ours) == names(theirs)
    with h5py.File(ours / "results.h5") as a, h5py.File(theirs / "results.h5") as b:
        for table in ("history/top", "energy"):
            assert sorted(a[table]) == sorted(b[table])
            for column in a[table]:
                assert np.array_equal(a[table][column][()], b[table][column][()]), (table, column)
    with h5py.File(ours / "frames/blocks_000003.hdf") as a, h5py.File(theirs / "frames/blocks_000003.hdf") as b:
        assert np.array_equal(a["VTKHDF/CellData/displacement"], b["VTKHDF/CellData/displacement"])

    simulation.add_stage(name="more", cycles=100)    # a run that was done goes on
    assert simulation.summary == summary
    simulation.run()
    del simulation
    code, said = program("run", "--restart", ours, "--quiet", "--threads", 1)
    assert code == 0, said
    assert json.loads((ours / "summary.json").read_text())["cycles"] == 700


def test_checkpoints_go_both_ways(tmp_path, tunnel):
    simulation = hdem.Simulation(hdem.Case(TUNNEL, set=SHORT), threads=1)
    with pytest.raises(hdem.CaseError, match="no stage has begun"):
        simulation.write_checkpoint(str(tmp_path / "c"))
    simulation.run(cycles=500)
    with pytest.raises(hdem.RunError, match="cannot be made"):
        simulation.write_checkpoint("/proc/none")
    simulation.write_checkpoint(str(tmp_path / "c"))
    code, said = program("run", "--restart", tmp_path / "c", "--quiet")
    assert code in (0, 4), said
    assert json.loads((tmp_path / "c/summary.json").read_text())["state_hash"] == tunnel["state_hash"]
    simulation.write_checkpoint(str(tmp_path / "d"))
    loaded = hdem.Simulation.from_checkpoint(tmp_path / "d/checkpoint.h5", threads=2)
    assert loaded.cycle == 500 and loaded.state_hash == simulation.state_hash
    loaded.run()
    assert loaded.state_hash == tunnel["state_hash"] and loaded.folder == ""
    again = hdem.Simulation.restart(tmp_path / "d", threads=1)
    again.run()
    assert again.summary["state_hash"] == tunnel["state_hash"]
    with pytest.raises(hdem.CaseError, match="none.h5"):
        hdem.Simulation.from_checkpoint(tmp_path / "none.h5")
    simulation.write_frame(tmp_path / "one.hdf")
    simulation.write_frame(str(tmp_path / "two.hdf"), kind="contacts")
    assert (tmp_path / "one.hdf").stat().st_size > 1000 and (tmp_path / "two.hdf").stat().st_size > 1000


def test_factor_of_safety_is_the_programs(tmp_path):
    case = Path(CASES) / "fos/slab.toml"
    code, said = program("fos", case, "-o", tmp_path / "fos", "--quiet", "--threads", 1)
    assert code == 0, said
    expected = json.loads((tmp_path / "fos/summary.json").read_text())["factor_of_safety"]
    seen = []
    answer = hdem.fos(hdem.Case(case), threads=2, callback=seen.append)
    assert answer.data == expected and answer.factor == expected["factor"] and answer.stable_at < answer.factor < answer.failed_at
    assert seen == answer.trials and answer.failing_blocks == expected["failing_blocks"]
    with pytest.raises(KeyError):
        hdem.fos(hdem.Case(case), callback=lambda trial: {}["no"])


def fork_and_run(threads):
    return run_tunnel(threads).state_hash


def test_sweeps_in_threads_and_in_processes(tunnel):
    with ThreadPoolExecutor(2) as pool:
        assert set(pool.map(fork_and_run, [1, 1])) == {tunnel["state_hash"]}
    fork_and_run(2)    # its threads are not there in a process that is forked off
    with ProcessPoolExecutor(2, mp_context=get_context("fork")) as pool:
        assert [f.result(timeout=120) for f in [pool.submit(fork_and_run, 2), pool.submit(fork_and_run, 1)]] == [tunnel["state_hash"]] * 2


if __name__ == "__main__":
    run_tests(__file__)
