#!/usr/bin/python3
"""The Python module hdem in notebooks and in many processes, by pytest: debuggers, forks, other folders, cases from Windows, values laid over a case.

    python_sessions_test.py CASE    any case of some blocks, with the package on PYTHONPATH; exit code 77: it was not built, or there is no pytest
"""
import copy
import enum
import os
import pickle
import subprocess
import sys
import threading
import time
from pathlib import Path

try:
    import numpy as np
    import pytest

    import hdem
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

CASE = sys.argv[1] if __name__ == "__main__" else os.environ["HDEM_TEST_CASE"]
COLUMN = {"block": [{"name": "floor", "polygon": [[-2, -1], [3, -1], [3, 0], [-2, 0]], "fixed": True},
                    *({"name": f"b{i}", "polygon": [[0, i], [1, i], [1, i + 1], [0, i + 1]]} for i in range(3))],
          "material": {"rock": {"density": 2000.0}},
          "joint": {"default": {"normal_stiffness": 1e9, "shear_stiffness": 1e9, "friction_angle_deg": 30.0}},
          "stage": [{"cycles": 100}, {"cycles": 200}]}


def column(folder=None, over=(), **keys):
    return hdem.Simulation(hdem.Case(COLUMN | keys, set=over), threads=1, folder=folder)


def in_child(act, longest=30):
    """Exit code of a forked process: 0, or 1 where `act` raised; None where it did not end."""
    child = os.fork()
    if child == 0:
        try:
            act()
            os._exit(0)
        finally:
            os._exit(1)
    end = time.monotonic() + longest
    while time.monotonic() < end:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.01)
    os.kill(child, 9)
    os.waitpid(child, 0)
    return None


def never_made():
    case, run = hdem.Case.__new__(hdem.Case), hdem.Simulation.__new__(hdem.Simulation)
    failed = None
    try:
        hdem.Case({"no": "section"})
    except hdem.CaseError as error:    # what a debugger shows afterwards
        frame = error.__traceback__
        while frame:
            failed = frame.tb_frame.f_locals.get("self", failed)
            frame = frame.tb_next
    return [case, run, failed]


def test_what_was_never_made_says_so():
    for made in never_made():
        assert "could not" in repr(made)
        for name in ("names", "positions", "polygons", "joint_names"):
            with pytest.raises(RuntimeError, match="never made"):
                getattr(made, name)
    case, run, _ = never_made()
    for act in (run.run, run.contacts, lambda: run.cycle, lambda: run.is_over, lambda: run.motion_view, lambda: hdem.Simulation(case), lambda: case.title):
        with pytest.raises(RuntimeError, match="never made"):
            act()


@pytest.mark.parametrize("answer", [False, np.False_, np.all([False])])
def test_every_false_ends_a_run(answer):
    run = column()
    run.run(callback=lambda _: answer, every=10)
    assert run.cycle == 10


@pytest.mark.parametrize("answer", [None, True, np.True_, 0, "", np.zeros(3)])
def test_nothing_else_ends_it(answer):
    run = column()
    run.run(callback=lambda _: answer, every=10)
    assert run.is_done


def test_a_run_stays_in_its_folder_when_the_script_goes_elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "elsewhere").mkdir()
    run = column(folder="run")
    run.run(cycles=10)
    monkeypatch.chdir(tmp_path / "elsewhere")
    run.run()
    del run
    assert sorted(file.name for file in tmp_path.iterdir()) == ["elsewhere", "run"] and not any((tmp_path / "elsewhere").iterdir())
    assert (tmp_path / "run/summary.json").exists() and not (tmp_path / "run/.lock").exists()


def test_frames_are_there_when_cycles_have_run(tmp_path):
    run = column(folder=tmp_path / "run", output={"frame_every": 1})
    for cycle in range(1, 80):
        run.run(cycles=1)
        assert (tmp_path / f"run/frames/blocks_{cycle:06d}.hdf").exists()


def test_a_finished_run_that_is_only_looked_at_keeps_its_summary(tmp_path):
    column(folder=tmp_path / "run").run()
    before = (tmp_path / "run/summary.json").read_bytes()
    run = hdem.Simulation.restart(tmp_path / "run", threads=1)
    assert run.cycle == 300 and run.is_done
    run.add_stage(cycles=20)
    assert (tmp_path / "run/summary.json").read_bytes() == before
    run.run(cycles=10)
    assert not (tmp_path / "run/summary.json").exists()
    run.run()
    assert run.summary["cycles"] == 320 and (tmp_path / "run/summary.json").exists()


def test_a_checkpoint_in_its_own_folder_has_the_rows_before_it(tmp_path):
    history = {"name": "top", "block": "b2", "every": 7, "quantities": ["displacement_y"]}

    def killed():
        run = column(folder=tmp_path / "run", history=[history], output={"row_every": 10})
        run.run(cycles=155)
        run.write_checkpoint(tmp_path / "run")
    assert in_child(killed) == 0
    run = hdem.Simulation.restart(tmp_path / "run", threads=1)
    assert run.cycle == 155
    run.run()
    plain = column(folder=tmp_path / "plain", history=[history], output={"row_every": 10})
    plain.run()
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "run/results.h5") as ours, h5py.File(tmp_path / "plain/results.h5") as theirs:
        for column_of in ("history/top/cycle", "history/top/displacement_y", "energy/cycle"):
            np.testing.assert_array_equal(ours[column_of][()], theirs[column_of][()])


def test_a_checkpoint_is_not_written_into_the_folder_of_another_run(tmp_path):
    other, run = column(folder=tmp_path / "run"), column()
    other.run(cycles=10)
    run.run(cycles=20)
    with pytest.raises(hdem.CaseError, match="another run is in this folder"):
        run.write_checkpoint(tmp_path / "run")
    run.write_checkpoint(tmp_path / "new/deep")
    assert sorted(file.name for file in (tmp_path / "new/deep").iterdir()) == ["checkpoint.h5"]
    assert hdem.Simulation.from_checkpoint(tmp_path / "new/deep/checkpoint.h5").cycle == 20


def test_a_checkpoint_of_a_run_that_is_done_is_done(tmp_path):
    run = column()
    run.run()
    run.write_checkpoint(tmp_path / "done")
    again = hdem.Simulation.from_checkpoint(tmp_path / "done/checkpoint.h5", threads=1)
    assert again.is_done and again.is_over and again.state_hash == run.state_hash
    again.add_stage(cycles=20)
    assert again.is_over and not again.is_done
    again.run()
    assert again.is_done and [stage["cycles"] for stage in again.results] == [100, 200, 20]


def test_a_forked_process_does_not_end_the_run_of_its_parent(tmp_path):
    run = [column(folder=tmp_path / "run")]
    run[0].run(cycles=10)
    assert in_child(run.clear) == 0
    assert (tmp_path / "run/.lock").exists()
    with pytest.raises(hdem.CaseError, match="another run is in this folder.*which is this one.*Delete that simulation first"):
        column(folder=tmp_path / "run")    # as a cell of a notebook that is run once more
    run[0].run()
    assert run[0].summary["cycles"] == 300


def test_forked_processes_write_files_while_the_parent_does(tmp_path):
    """A fork in the middle of a frame would leave the lock of the library for files closed in the child."""
    run = column(folder=tmp_path / "run", output={"frame_every": 1}, stage=[{"cycles": 100_000_000}])
    thread = threading.Thread(target=lambda: run.run(callback=lambda _: not ended.is_set(), every=1))
    ended = threading.Event()
    thread.start()

    def work():
        column(folder=tmp_path / f"child{os.getpid()}").run(cycles=3)
    try:
        assert [in_child(work, longest=20) for _ in range(12)] == [0] * 12
    finally:
        ended.set()
        thread.join()


def test_a_case_from_windows_can_be_changed(tmp_path):
    file = tmp_path / "case.toml"
    file.write_bytes(b"\xef\xbb\xbf" + hdem.to_toml(COLUMN).replace("\n", "\r\n").encode())
    case = hdem.Case(file)
    assert case.data["stage"] == COLUMN["stage"]
    run = hdem.Simulation(case, threads=1)
    run.add_stage(cycles=5)
    assert len(run.case["stage"]) == 3 and not run.applied_forces.any()


OVER = [{"stage": COLUMN["stage"]}, ["stage[1]={cycles=200}"], {"stage[1].cycles": 200}, ["stage.stage2.cycles=200"], {"stage[1].set": ["joint.default.cohesion = 0"]},
        ["stage[1].name=second", "stage.second.cycles = 200"], {"load": [{"blocks": ["b0"], "force": [0.0, 0.0]}]}, {"generator.seed": 4}]


@pytest.mark.parametrize("over", OVER)
def test_changes_are_not_covered_by_what_is_laid_over_the_case(over):
    def changed(over):
        run = column(over=over)
        run.run(stages=1)
        run.set("joint.default.friction_angle_deg", 1.0)
        run.applied_forces = [[0, 0], [0, 0], [0, 0], [9e3, 0]]
        run.run(cycles=50)
        run.end_stage()
        run.add_stage(cycles=20)
        run.run()
        again = hdem.Simulation(hdem.Case(run.case, set=run.case_overrides), threads=1)
        again.run()
        assert again.state_hash == run.state_hash and run.applied_forces[3, 0] == 9e3
        return run
    plain, laid = changed(()), changed(over)
    assert [stage["cycles"] for stage in laid.results] == [100, 50, 20]
    np.testing.assert_array_equal(laid.positions, plain.positions)
    assert laid.displacements[3, 0] > 1e-4


def test_a_case_is_the_same_in_another_process_whatever_has_become_of_its_files(tmp_path, monkeypatch):
    keys = {key: value for key, value in COLUMN.items() if key != "block"} | {"blocks_file": "ä.csv"}
    (tmp_path / "case.toml").write_text(hdem.to_toml(keys), encoding="utf-8")
    rows = [f"{block['name']},{x},{y},," + ("fixed" if "fixed" in block else "") for block in COLUMN["block"] for x, y in block["polygon"]]
    (tmp_path / "ä.csv").write_text("\n".join(rows), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    case = hdem.Case("case.toml")
    sent = pickle.dumps(case)
    (tmp_path / "ä.csv").unlink()
    monkeypatch.chdir("/")
    for again in (pickle.loads(sent), copy.deepcopy(case)):
        np.testing.assert_array_equal(again.positions, case.positions)
        assert again.file == "case.toml" and hdem.Simulation(again, threads=1).state_hash == hdem.Simulation(case, threads=1).state_hash


def test_a_stage_that_does_not_reach_its_end_is_warned_of_once(recwarn):
    run = column(stage=[{"name": "rest", "until": "converged", "max_cycles": 20}, {"cycles": 10}])
    with pytest.warns(RuntimeWarning, match="stage 'rest' ended after 20 cycles without the end"):
        run.run(stages=1)
    recwarn.clear()
    run.run()
    run.run()
    assert not recwarn.list


@pytest.mark.parametrize("stage_first", [True, False])
def test_forces_on_rock_at_rest_are_in_the_case_with_their_stage(tmp_path, stage_first):
    """A stage that looks for rest would wait for a load of which only the cycle is known."""
    run = column(stage=[{"name": "rest", "until": "converged", "max_cycles": 5000}])
    run.run()
    force = np.zeros((4, 2))
    force[3, 0] = 9e3
    if stage_first:
        run.add_stage(cycles=150)
    run.applied_forces = 0.5 * force
    run.applied_forces = force
    if not stage_first:
        run.add_stage(cycles=150)
    run.run(cycles=100)
    run.write_checkpoint(tmp_path)
    again = hdem.Simulation.from_checkpoint(tmp_path / "checkpoint.h5", threads=1)
    for same in (run, again):
        np.testing.assert_array_equal(same.applied_forces, force)
        same.add_stage(cycles=60)
        same.run(cycles=70)
        same.applied_forces = 0.0 * force    # in a later stage than it began
        same.run()
    told = hdem.Simulation(hdem.Case(run.case, set=run.case_overrides), threads=1)
    told.run()
    assert [stage["cycles"] for stage in told.results] == [stage["cycles"] for stage in run.results] == [run.results[0]["cycles"], 150, 60]
    assert told.state_hash == run.state_hash == again.state_hash and run.displacements[3, 0] > 1e-5
    assert [(load["since"], load["from_cycle"], load["force"][0]) for load in run.case["load"]] == [("stage2", 0, 9e3), ("stage3", 20, -9e3)]


def test_forces_that_change_after_a_stage_that_looks_for_rest_do_not_make_it_wait():
    run = column(stage=[{"name": "rest", "until": "converged", "max_cycles": 5000}, {"cycles": 150}])
    force = np.zeros((4, 2))
    force[3, 0] = 9e3
    run.applied_forces = force
    run.run(stages=1)
    run.applied_forces = 0.5 * force    # between two stages
    run.run(cycles=50)
    run.applied_forces = 0.0 * force    # in a stage
    run.run()
    told = hdem.Simulation(hdem.Case(run.case, set=run.case_overrides), threads=1)
    told.run()
    assert [stage["cycles"] for stage in told.results] == [stage["cycles"] for stage in run.results]
    assert told.state_hash == run.state_hash


def test_numbers_of_classes_of_their_own():
    class Seed(enum.IntEnum):
        three = 3
    assert hdem.Case(CASE, set={"generator.seed": Seed.three}).overrides == ["generator.seed=3"]


def test_a_run_in_another_thread_has_a_name_and_no_numbers():
    run = column(stage=[{"cycles": 100_000_000}])
    begun, ended = threading.Event(), threading.Event()

    def tell(_):
        begun.set()
        return not ended.is_set()
    thread = threading.Thread(target=lambda: run.run(callback=tell, every=200_000))
    thread.start()
    begun.wait()
    asked = {}
    while "is_over" not in asked:
        assert "hdem.Simulation" in repr(run)
        for name in ("cycle", "results", "is_done", "is_over", "summary"):
            try:
                getattr(run, name)
            except RuntimeError as error:
                asked[name] = str(error)
    ended.set()
    thread.join()
    assert all("in another thread" in text for text in asked.values())


def test_a_factor_of_safety_at_the_end_of_python():
    """F = tan 30 deg / tan 20 deg."""
    slab = COLUMN | {"block": [COLUMN["block"][0], {"name": "slab", "polygon": [[-1, 0], [2, 0], [2, 1], [-1, 1]]}], "gravity": {"tilt_deg": 20.0},
                     "stage": [{"until": "converged"}], "factor_of_safety": {"check_stiffness": 1, "peak": False}}
    script = f"""
import atexit

def last():
    import hdem
    seen = []
    print(hdem.fos(hdem.Case({slab!r}), threads=1, callback=seen.append).factor, len(seen) > 0)

atexit.register(last)
import hdem
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
    factor, told = done.stdout.split()
    assert abs(float(factor) - 1.586) < 0.01 and told == "True", done.stderr


if __name__ == "__main__":
    os.environ["HDEM_TEST_CASE"] = CASE
    sys.exit(pytest.main([__file__, "-q", "-p", "no:cacheprovider"]))
