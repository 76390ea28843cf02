#!/usr/bin/python3
"""The Python module hdem: stages that are changed, added and ended between runs, by pytest.

    python_stages_test.py HDEM CASES EXAMPLE    with the package on PYTHONPATH; exit code 77: it was not built, or there is no pytest
"""
from python_common import pile, program_hash, run_tests

import numpy as np
import pytest

import hdem


def test_stage_set_as_in_the_case(tmp_path):
    """Properties changed between runs have the bits of a case that says so from the beginning."""
    changes = {"joint.default.friction_angle_deg": 5.0, "material.rock.density": 3000.0}
    texts = [f"{key} = {value}" for key, value in changes.items()]
    tilted = pile(gravity={"vector": [3.0, -9.81]})
    from_file = tmp_path / "case.toml"
    from_file.write_text(hdem.to_toml({**tilted, "stage": [tilted["stage"][0], {**tilted["stage"][1], "set": texts}]}))
    expected = program_hash(tmp_path, from_file, "--threads", 1)["state_hash"]

    simulation = hdem.Simulation(hdem.Case(tilted), threads=1)
    simulation.run(stages=1)
    unchanged = hdem.Simulation(hdem.Case(tilted), threads=1)
    unchanged.run()
    for key, value in changes.items():
        simulation.set(key, value)
    simulation.run()
    assert simulation.state_hash == expected != unchanged.state_hash
    assert simulation.masses[1] == pytest.approx(3000.0)

    added = hdem.Simulation(hdem.Case({**tilted, "stage": tilted["stage"][:1]}), threads=1)
    added.run()
    assert added.is_done
    with pytest.raises(ValueError, match="no stage is left"):
        added.set("joint.default.cohesion", 0.0)
    added.add_stage(name="second", cycles=300, set=changes)
    added.run()
    assert added.state_hash == expected and [r["name"] for r in added.results] == ["first", "second"]
    with pytest.raises(hdem.CaseError, match="no joint has this name"):
        added.add_stage(cycles=1, set={"joint.none.cohesion": 1.0})
    assert added.state_hash == expected and added.is_done


def test_stage_set_beside_walls_and_several_joints(tmp_path):
    """A stage that changes joints gives them, and what comes behind them, other numbers in memory."""
    rock = {"domain": {"width": 6.0, "height": 5.0, "fixed": ["bottom"]},
            "joint_set": [{"dip_deg": 23.0, "spacing": 1.1, "joint": "bedding"}, {"dip_deg": -60.0, "spacing": 1.3}],
            "boundary": [{"side": side, "kind": "roller"} for side in ("left", "right")],
            "excavation": [{"name": "hole", "shape": "circle", "position": [3.0, 2.5], "diameter": 1.6}],
            "material": {"rock": {"density": 2600.0}},
            "joint": {"default": {"normal_stiffness": 1e9, "shear_stiffness": 5e8, "friction_angle_deg": 30.0},
                      "bedding": {"normal_stiffness": 2e9, "shear_stiffness": 5e8, "friction_angle_deg": 25.0, "cohesion": 2e3}},
            "stage": [{"cycles": 600}, {"excavate": ["hole"], "cycles": 1500}, {"name": "weak", "cycles": 800}]}
    texts = ["joint.default.friction_angle_deg = 8.0", "joint.bedding.cohesion = 0.0", "joint.bedding.normal_stiffness = 1.5e9"]
    file = tmp_path / "case.toml"
    file.write_text(hdem.to_toml({**rock, "stage": [*rock["stage"][:2], {**rock["stage"][2], "set": texts}]}))
    simulation = hdem.Simulation(hdem.Case(rock), threads=2)
    simulation.run(stages=2)
    assert (simulation.contacts()["joint"] == -1).any() and simulation.walls.sum() == 2
    simulation.set("joint.default.friction_angle_deg", 8.0)
    simulation.set("joint.bedding.cohesion", 0.0)
    simulation.set("joint.bedding.normal_stiffness", 1.5e9)
    simulation.run()
    assert simulation.state_hash == program_hash(tmp_path, file, "--threads", 1)["state_hash"]
    walls = simulation.contacts()[simulation.contacts()["joint"] == -1]
    assert np.abs(walls["shear_force"]).max() == 0.0


def test_cohesion_given_later_needs_contacts_that_are_told_apart():
    simulation = hdem.Simulation(hdem.Case(pile()), threads=1)
    simulation.run(stages=1)
    h = simulation.state_hash
    with pytest.raises(hdem.CaseError, match='joint "default": cohesion = 0 Pa in the case'):
        simulation.set("joint.default.cohesion", 1e5)
    assert simulation.state_hash == h and "set" not in simulation.case["stage"][1]
    joint = {"default": {**pile()["joint"]["default"], "cohesion": 1.0}}
    simulation = hdem.Simulation(hdem.Case(pile(joint=joint)), threads=1)
    simulation.run(stages=1)
    simulation.set("joint.default.cohesion", 1e5)
    simulation.run()
    assert simulation.is_done


def test_stiffness_set_later_keeps_what_contacts_bear():
    simulation = hdem.Simulation(hdem.Case(pile(damping={"preset": "default"}, time={"step": 1e-4})), threads=1)
    simulation.run(stages=1)
    before = simulation.contacts()
    simulation.set("joint.default.normal_stiffness", 4e8)
    simulation.run(cycles=1)
    after = simulation.contacts()
    assert np.allclose(after["normal_force"], before["normal_force"], rtol=1e-2, atol=1.0)
    assert np.allclose(after["closure"], 2.5 * before["closure"], rtol=1e-2, atol=1e-9)
    simulation.run()
    with pytest.raises(hdem.CaseError, match="stable limit"):
        simulation.add_stage(cycles=10, set={"joint.default.normal_stiffness": 1e15})
    assert simulation.is_done and len(simulation.case["stage"]) == 2


@pytest.mark.parametrize("key, value", [("material.rock.density", 600.0), ("joint.default.normal_stiffness", 4e9)])
def test_a_change_before_the_first_cycle_has_the_programs_bits(tmp_path, key, value):
    """Either one makes the step smaller, from the first half step on."""
    simulation = hdem.Simulation(hdem.Case(pile()), threads=1)
    step = simulation.time_step
    simulation.set(key, value)
    simulation.run()
    file = tmp_path / "changed.toml"
    file.write_text(simulation.case_text)
    sets = [word for text in simulation.case_overrides for word in ("--set", text)]
    assert simulation.time_step < step
    assert program_hash(tmp_path, file, *sets, "--threads", 1)["state_hash"] == simulation.state_hash


@pytest.mark.parametrize("seconds", [
    {"load": [{"blocks": ["high"], "force": [100.0, 0.0], "from_time": 0.05}]},
    {"load": [{"blocks": ["high"], "force": [100.0, 0.0], "table": [[0.0, 0.0], [0.05, 1.0]], "table_by": "time"}]},
    {"stage": [{"name": "first", "duration": 0.05}, {"name": "second", "cycles": 300}]}])
def test_a_smaller_step_is_refused_where_seconds_are_counted(seconds):
    simulation = hdem.Simulation(hdem.Case(pile(**seconds)), threads=1)
    simulation.run(cycles=20)
    with pytest.raises(hdem.CaseError, match="time.step = "):
        simulation.set("material.rock.density", 600.0)
    simulation.set("material.rock.density", 2600.0)    # the step stays as it is


def test_ended_stage_is_a_case_for_the_program(tmp_path):
    simulation = hdem.Simulation(hdem.Case(pile(), set={"stage[0].cycles": 5000}), threads=1)
    simulation.run(cycles=77)
    simulation.write_checkpoint(str(tmp_path))
    simulation = hdem.Simulation.from_checkpoint(tmp_path / "checkpoint.h5", threads=1)
    simulation.end_stage()
    simulation.run()
    assert [r["cycles"] for r in simulation.results] == [77, 300]
    file = tmp_path / "again.toml"
    file.write_text(simulation.case_text)
    assert simulation.case_overrides == []
    assert program_hash(tmp_path, file, "--threads", 1)["state_hash"] == simulation.state_hash


if __name__ == "__main__":
    run_tests(__file__)
