#!/usr/bin/python3
"""The Python module hdem in clumsy hands, by pytest: wrong types, misspelt names, forks, an end while cycles run.

    python_misuse_test.py CASE    any case of some blocks, with the package on PYTHONPATH; exit code 77: it was not built, or there is no pytest
"""
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

try:
    import numpy as np
    import pytest

    import hdem
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

CASE = sys.argv[1] if __name__ == "__main__" else os.environ["HDEM_TEST_CASE"]
ENDLESS = {"stage[0].cycles": 50_000_000}


def simulation(**how):
    return hdem.Simulation(hdem.Case(CASE), threads=1, **how)


@pytest.mark.parametrize("make, words", [
    (lambda: hdem.Case(None), "a file name or a dict is needed, not None"),
    (lambda: hdem.Case(7), "a file name or a dict is needed, not 7"),
    (lambda: hdem.Simulation(None), "an hdem.Case is needed, not None"),
    (lambda: hdem.Simulation("case.toml"), "hdem.Case(file or dict) makes one"),
    (lambda: hdem.Simulation(hdem.Case(CASE), threads="two"), "threads = 'two': a whole number is needed"),
    (lambda: hdem.fos(None), "an hdem.Case is needed, not None"),
    (lambda: hdem.fos(hdem.Case(CASE), callback=3), "callback must be a function"),
    (lambda: simulation().run(cycles=1.5), "cycles = 1.5: a whole number is needed"),
    (lambda: simulation().run(stages="all"), "stages = 'all': a whole number is needed"),
    (lambda: simulation().run(every=None), "every = None: a whole number is needed"),
    (lambda: simulation().run(cycles=5, callback=3), "callback must be a function"),
    (lambda: setattr(simulation(), "positions", "left"), "positions: an array of numbers is needed, not 'left'"),
    (lambda: setattr(simulation(), "velocities", simulation().velocities.astype(complex)), "velocities: an array of numbers is needed")])
def test_wrong_types_are_named(make, words):
    with pytest.raises(TypeError) as told:
        make()
    assert words in str(told.value)


@pytest.mark.parametrize("make, words", [
    (lambda: hdem.Simulation(hdem.Case(CASE), threads=5000), "threads = 5000 (must be 1 to 4096)"),
    (lambda: hdem.Simulation(hdem.Case(CASE), threads=10**12), "threads = 1e+12: too great"),
    (lambda: hdem.fos(hdem.Case(CASE), threads=0), "threads = 0 (must be 1 to 4096)"),
    (lambda: hdem.fos(hdem.Case(CASE), threads=-1), "threads = -1 (must be 1 to 4096)"),
    (lambda: hdem.fos(hdem.Case(CASE), threads=100000), "threads = 100000 (must be 1 to 4096)"),
    (lambda: simulation().run(cycles=10**30), "cycles = 1e+30: too great"),
    (lambda: simulation().run(cycles=-10**400), "too great"),
    (lambda: simulation().run(cycles=-1), "must not be negative"),
    (lambda: setattr(simulation(), "velocities", np.ma.masked_greater(simulation().velocities + [[0.0, 1.0]], 0.5)),
     "elements are masked; filled(...) gives them values")])
def test_wrong_numbers_are_named(make, words):
    with pytest.raises(ValueError) as told:
        make()
    assert words in str(told.value)


def test_a_case_that_holds_itself():
    case = {}
    case["domain"] = case
    with pytest.raises(ValueError, match="holds itself"):
        hdem.Case(case)


@pytest.mark.parametrize("value", [np.nan, np.inf, 1.1e8, -1e300])
def test_places_where_nothing_can_be(value):
    run = simulation()
    free = [i for i, fixed in enumerate(hdem.Case(CASE).fixed) if not np.any(fixed)][0]
    before = run.positions
    wrong = before.copy()
    wrong[free, 1] = value
    with pytest.raises(ValueError, match=run.names[free]):
        run.positions = wrong
    np.testing.assert_array_equal(run.positions, before)


def test_misspelt_names_are_not_swallowed():
    run = simulation()
    with pytest.raises(AttributeError, match="no 'velocity'.*positions, velocities"):
        run.velocity = run.velocities

    class Mine(hdem.Simulation):
        pass
    mine = Mine(hdem.Case(CASE), threads=1)
    mine.log = []    # a class of one's own may have more
    assert mine.log == []


def test_numbers_of_other_kinds_are_taken():
    run = simulation()
    run.run(cycles=np.int64(3))
    assert run.cycle == 3
    run.velocities = run.velocities.tolist()
    run.velocities = np.asfortranarray(run.velocities)
    run.velocities = run.velocities.astype(object)
    assert run.cycle == 3


@pytest.mark.parametrize("file, words", [
    (None, "has no compiled part (_core*.so)"),
    ("_core.cpython-39-x86_64-linux-gnu.so", f"no compiled part for this Python {sys.version_info.major}.{sys.version_info.minor}, only _core.cpython-39-x86_64-linux-gnu.so"),
    ("_core.so", "cannot be loaded: ")])
def test_a_package_without_its_compiled_part_says_how_to_get_it(tmp_path, file, words):
    package = Path(hdem.__file__).parent
    shutil.copytree(package, tmp_path / "hdem", ignore=shutil.ignore_patterns("_core*.so", "__pycache__"))
    if file:
        (tmp_path / "hdem" / file).write_bytes(b"not a library")
    done = subprocess.run([sys.executable, "-B", "-c", "import hdem"], capture_output=True, text=True, env=os.environ | {"PYTHONPATH": str(tmp_path)})
    assert done.returncode == 1
    told = done.stderr[done.stderr.index("\nImportError: "):]
    for part in ("ImportError: hdem: ", words, "tools/setup", "PYTHONPATH=build/release/python", "Debian package"):
        assert part in told, done.stderr
    assert "circular" not in done.stderr


def test_a_forked_process_leaves_the_folder_alone(tmp_path):
    run = simulation(folder=tmp_path / "run")
    run.run(cycles=10)
    child = os.fork()
    if child == 0:
        try:
            run.run(cycles=10)
            os._exit(1)
        except RuntimeError as error:
            os._exit(0 if "belongs to the process that began the run" in str(error) else 2)
        except BaseException:
            os._exit(3)
    assert os.waitpid(child, 0)[1] == 0
    run.run(cycles=10)
    assert run.cycle == 20


@pytest.mark.parametrize("callback", ["None", "lambda s: None"])
def test_python_ends_while_cycles_run(callback):
    """A daemon's cycles end with the process: without an error, and soon."""
    script = f"""if True:
        import sys, threading, time, hdem
        run = hdem.Simulation(hdem.Case(sys.argv[1], set={ENDLESS!r}), threads=1)
        threading.Thread(target=lambda: run.run(callback={callback}, every=1), daemon=True).start()
        time.sleep(0.3)
        print("end", flush=True)
    """
    for _ in range(5):
        done = subprocess.run([sys.executable, "-c", script, CASE], capture_output=True, text=True, timeout=60)
        assert (done.returncode, done.stdout, done.stderr) == (0, "end\n", "")


def test_simulations_are_made_in_many_threads_at_once(tmp_path):
    """From cases and from checkpoints; in a process of its own: where they disturb each other, Python itself dies."""
    script = """if True:
        import sys, hdem
        from concurrent.futures import ThreadPoolExecutor
        case = hdem.Case({"domain": {"width": 1.0, "height": 1.0, "fixed": ["bottom"]}, "joint_set": [{"dip_deg": 0.0, "spacing": 0.5}],
                          "material": {"rock": {"density": 2700.0}}, "stage": [{"cycles": 3}],
                          "joint": {"default": {"normal_stiffness": 2e9, "shear_stiffness": 1e9, "friction_angle_deg": 32.0}}})
        begun = hdem.Simulation(case, threads=1)
        begun.run(cycles=1)
        begun.write_checkpoint(sys.argv[1])

        def make(number):
            kept = [hdem.Simulation(case, threads=1) for _ in range(10)]
            kept.append(hdem.Simulation.from_checkpoint(sys.argv[1] + "/checkpoint.h5", threads=1) if number % 10 == 0 else hdem.Simulation(hdem.Case(case.data), threads=1))
            kept[-1].run()
            return kept[-1].state_hash
        with ThreadPoolExecutor(4) as pool:
            print(len(set(pool.map(make, range(800)))))
    """
    done = subprocess.run([sys.executable, "-c", script, tmp_path], capture_output=True, text=True, timeout=300)
    assert (done.returncode, done.stdout, done.stderr) == (0, "1\n", ""), done.stderr


def test_a_handler_of_a_signal_may_raise():
    class Enough(Exception):
        pass

    def enough(*_):
        raise Enough
    before = signal.signal(signal.SIGALRM, enough)
    run = hdem.Simulation(hdem.Case(CASE, set=ENDLESS), threads=1)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with pytest.raises(Enough):
            run.run()
    finally:
        signal.signal(signal.SIGALRM, before)
    at = run.cycle
    run.run(cycles=5)
    assert run.cycle == at + 5


if __name__ == "__main__":
    os.environ["HDEM_TEST_CASE"] = CASE
    sys.exit(pytest.main([__file__, "-q", "-p", "no:cacheprovider"]))
