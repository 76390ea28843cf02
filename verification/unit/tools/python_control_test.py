#!/usr/bin/python3
"""The Python module hdem: callbacks, interrupts, other threads, and runs that fail, by pytest.

    python_control_test.py HDEM CASES EXAMPLE    with the package on PYTHONPATH; exit code 77: it was not built, or there is no pytest
"""
import json
import os
import signal
import threading
import time

from python_common import SHORT, TUNNEL, pile, program, run_tests, tunnel    # noqa: F401

import numpy as np
import pytest

import hdem


def test_callback_may_steer():
    """A callback that stops the highest block again and again keeps it from falling."""
    case = hdem.Case(pile(), set={"stage[0].cycles": 2000})
    simulation = hdem.Simulation(case, threads=1)
    p = simulation.positions
    p[3, 1] += 3.0
    simulation.positions = p

    def stop(s):
        v = s.velocities
        v[3] = 0.0
        s.velocities = v
    simulation.run(stages=1, callback=stop, every=10)
    free_fall = 0.5 * 9.81 * simulation.time**2
    assert 0 < p[3, 1] - simulation.positions[3, 1] < 0.02 * free_fall
    assert abs(simulation.energies["residual"]) < 1e-5 * simulation.energies["gravity_work"]


def test_callback_ends_a_run_and_its_errors_arrive():
    simulation = hdem.Simulation(hdem.Case(pile()), threads=1)
    simulation.run(callback=lambda s: s.cycle < 100, every=10)
    assert simulation.cycle == 100

    def fail(s):
        raise KeyError("mine")
    with pytest.raises(KeyError, match="mine"):
        simulation.run(callback=fail, every=50)
    assert simulation.cycle == 150
    with pytest.raises(RuntimeError, match="callback"):
        simulation.run(callback=lambda s: s.run(), every=50)
    simulation.run()
    whole = hdem.Simulation(hdem.Case(pile()), threads=1)
    whole.run()
    assert simulation.state_hash == whole.state_hash and simulation.is_done


def test_ctrl_c_ends_a_run_between_cycles(tunnel):
    simulation = hdem.Simulation(hdem.Case(TUNNEL, set=["stage[0].cycles=400", "stage[1].max_cycles=300000"]), threads=2)
    threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        simulation.run()
    assert time.monotonic() - begin < 30 and 0 < simulation.cycle
    again = hdem.Simulation(hdem.Case(TUNNEL, set=["stage[0].cycles=400", "stage[1].max_cycles=300000"]), threads=1)
    again.run(cycles=simulation.cycle)
    assert again.state_hash == simulation.state_hash
    simulation.run(cycles=10)


def test_interrupted_run_leaves_a_checkpoint(tmp_path, tunnel):
    def interrupt(s):
        raise KeyboardInterrupt
    simulation = hdem.Simulation(hdem.Case(TUNNEL, set=SHORT), folder=tmp_path / "run", threads=1)
    with pytest.raises(KeyboardInterrupt):
        simulation.run(callback=interrupt, every=450)
    assert simulation.cycle == 450
    del simulation
    code, said = program("run", "--restart", tmp_path / "run", "--quiet")
    assert code in (0, 4), said
    summary = json.loads((tmp_path / "run/summary.json").read_text())
    assert (summary["state_hash"], summary["cycles"]) == (tunnel["state_hash"], 1200)


def test_others_may_not_look_while_cycles_run():
    simulation = hdem.Simulation(hdem.Case(TUNNEL, set=SHORT), threads=1)
    worker = threading.Thread(target=simulation.run)
    worker.start()
    refused = 0
    while worker.is_alive():
        try:
            assert simulation.cycle in (0, 1200)
        except RuntimeError as error:
            assert "another thread" in str(error)
            refused += 1
        time.sleep(0.005)
    assert refused > 0 and simulation.is_done


def test_run_that_fails_says_so_and_stays_to_be_looked_at():
    simulation = hdem.Simulation(hdem.Case(pile(contact={"method": "force", "overlap_limit": 1e-7})), threads=1)
    with pytest.raises(hdem.RunError, match="overlap"):
        simulation.run()
    assert np.isfinite(simulation.positions).all()
    with pytest.raises(hdem.RunError, match="failed before"):
        simulation.run()


if __name__ == "__main__":
    run_tests(__file__)
