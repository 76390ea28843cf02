#!/usr/bin/python3
"""The Python module hdem: the arrays of a run, shown and assigned, by pytest.

    python_state_test.py HDEM CASES EXAMPLE    with the package on PYTHONPATH; exit code 77: it was not built, or there is no pytest
"""
from pathlib import Path

from python_common import CASES, TUNNEL, pile, program_hash, run_tests, run_tunnel

import numpy as np
import pytest

import hdem


def test_removed_blocks_keep_their_numbers():
    simulation = run_tunnel(cycles=401)
    gone = ~simulation.present
    assert gone.sum() == 1 and simulation.names[np.flatnonzero(gone)[0]] == hdem.Case(TUNNEL).names[np.flatnonzero(gone)[0]]
    assert len(simulation.positions) == 542 and set(simulation.slots) == set(range(542))
    assert simulation.contacts()["blocks"].max() < 542 and not np.isin(np.flatnonzero(gone), simulation.contacts()["blocks"]).any()


def test_forces_of_contacts_are_those_of_blocks():
    simulation = run_tunnel(cycles=400)
    c = simulation.contacts()
    along = np.stack([-c["normal"][:, 1], c["normal"][:, 0]], axis=1)
    on_second = c["normal_force"][:, None] * c["normal"] + (c["shear_force"] + c["tilt_force"])[:, None] * along
    total = np.zeros((542, 2))
    np.add.at(total, c["blocks"][:, 1], on_second)
    np.add.at(total, c["blocks"][:, 0], -on_second)
    total[:, 1] -= 9.81 * simulation.masses
    free = ~simulation.fixed
    assert np.allclose(total[free], simulation.forces[free], atol=1e-3 * 9.81 * simulation.masses.max())
    size = np.sqrt(simulation.areas)[c["blocks"]].min(axis=1)    # of the smaller block: contacts close down to a gap of 1e-9 of it
    assert set(c["regime"]) <= {1, 2, 3} and (c["normal_force"] >= 0).all() and (c["closure"] > -1e-9 * size).all()
    near = simulation.contacts(also_open=True)
    assert near.size > c.size and simulation.joint_names == ["default"] and near["gap"].min() > -1e-3    # not of faces beside each other
    assert (c["closure"] < -c["gap"] + 1e-5).all()    # no preload; less where a corner had an overlap as it began to bear
    assert np.mean(np.isclose(c["closure"], -c["gap"], atol=1e-5)) > 0.95


def test_a_restart_shows_the_same_points_slipping(tmp_path):
    """Evaluates all contacts once, also those between blocks that rest and are left out."""
    def run_to(simulation, cycle):
        simulation.run(cycles=cycle - simulation.cycle)
        return simulation
    case = hdem.Case(Path(CASES).parent / "faults/slip_at_rest.toml")
    begun = run_to(hdem.Simulation(case, threads=1), 150)
    begun.write_checkpoint(tmp_path)
    again = hdem.Simulation.from_checkpoint(tmp_path / "checkpoint.h5", threads=1)
    for cycle in range(155, 200, 5):
        whole, restarted = run_to(begun, cycle).contacts(), run_to(again, cycle).contacts()
        assert whole.size > 400 and (whole == restarted).all(), cycle


def test_broken_and_plastic_slip_of_a_law_with_memory():
    joint = {"default": {"normal_stiffness": 1e9, "shear_stiffness": 5e8, "friction_angle_deg": 30.0, "cohesion": 1e4, "tension": 1e3,
                         "residual_cohesion": 0.0}}
    case = pile(joint=joint, load=[{"blocks": ["high"], "force": [60e3, 0.0]}], stage=[{"cycles": 60}])
    simulation = hdem.Simulation(hdem.Case(case), threads=1)
    simulation.run()
    c = simulation.contacts()
    top = c[(c["blocks"] == [2, 3]).all(axis=1) | (c["blocks"] == [3, 2]).all(axis=1)]
    assert top.size and (top["broken"] == 1).any() and np.abs(top["plastic_slip"]).max() > 1e-4
    floor = c[np.isin(c["blocks"], [0, 1]).all(axis=1)]
    assert floor.size and (floor["broken"] == 0).all()


def test_assigned_velocity_is_flown_and_booked():
    case = hdem.Case(pile())
    simulation = hdem.Simulation(case, threads=1)
    simulation.run(cycles=10)
    before, start, t0 = simulation.energies, simulation.positions, simulation.time
    v = simulation.velocities
    v[3] = 1.0, 6.0
    simulation.velocities = v
    assert (simulation.velocities[3] == v[3]).all()
    gain = simulation.energies["kinetic"] - before["kinetic"]
    assert gain == pytest.approx(0.5 * 2500 * 37, rel=1e-3)
    assert simulation.energies["load_work"] == pytest.approx(gain, rel=1e-2)
    simulation.run(cycles=200)
    t = simulation.time - t0
    flown = simulation.positions[3] - start[3]
    assert flown == pytest.approx([t, 6 * t - 0.5 * 9.81 * t * t], rel=1e-2)
    assert abs(simulation.energies["residual"]) < 1e-5 * gain


def test_assigned_positions_and_rotations():
    simulation = hdem.Simulation(hdem.Case(pile()), threads=1)
    simulation.run(cycles=10)
    h = simulation.state_hash
    simulation.positions = simulation.positions    # nothing changes
    simulation.velocities = simulation.velocities.tolist()
    assert simulation.state_hash == h
    p, r = simulation.positions, simulation.rotations
    p[3] += [0.0, 2.0]
    r[3] = np.radians(23.0)
    simulation.positions = p
    simulation.rotations = r
    corner = simulation.polygons[3] - p[3]
    assert np.allclose(np.hypot(*corner.T), np.sqrt(0.5)) and np.allclose(simulation.positions, p, atol=1e-12)
    assert np.isclose(np.arctan2(*(corner[1] - corner[0])[::-1]) % (np.pi / 2), np.radians(23.0))
    assert not np.isin(3, simulation.contacts()["blocks"])
    simulation.run(cycles=50)
    assert simulation.velocities[3, 1] < -1e-3    # it falls


@pytest.mark.parametrize("name, row", [("positions", [1.0, 1.0]), ("velocities", [0.0, 1.0]), ("rotations", 0.1), ("angular_velocities", 1.0)])
def test_fixed_blocks_refuse_to_be_moved(name, row):
    simulation = hdem.Simulation(hdem.Case(pile()))
    values = getattr(simulation, name)
    values[0] = row
    with pytest.raises(ValueError, match=f'{name}: block "floor" is fixed'):
        setattr(simulation, name, values)
    values = getattr(simulation, name)
    values[1] = np.nan
    with pytest.raises(ValueError, match="low.*not finite"):
        setattr(simulation, name, values)
    with pytest.raises(ValueError, match="shape"):
        setattr(simulation, name, values[:2])
    with pytest.raises(AttributeError):
        simulation.forces = 0.0


def test_applied_forces_push_and_stand_in_the_case(tmp_path):
    """A block on a floor: 0.9 of its weight against a friction of tan 30, then nothing, then a lift by twice its weight."""
    case = pile(contact={"method": "hybrid"}, block=pile()["block"][:2], stage=[{"name": "first", "cycles": 2000}, {"name": "second", "cycles": 800}], damping={"preset": "default"}, time={"step": 1e-4})
    simulation = hdem.Simulation(hdem.Case(case), threads=1)
    simulation.run(cycles=1000)
    weight, friction = 2500.0 * 9.81, 9.81 * np.tan(np.radians(30.0))
    forces, rate = np.zeros((2, 2)), 0.9 * 9.81 - friction
    for force, cycles, velocity in (([0.9 * weight, 0.0], 1000, [0.1 * rate, 0.0]), ([0.0, 0.0], 400, [0.1 * rate - 0.04 * friction, 0.0]), ([0.0, 2.0 * weight], 300, [0.1 * rate - 0.04 * friction, 0.03 * 9.81])):
        forces[1] = force
        simulation.applied_forces = forces
        np.testing.assert_array_equal(simulation.applied_forces, forces)
        simulation.run(cycles=cycles)
        np.testing.assert_allclose(simulation.velocities[1], velocity, atol=2e-4)
    energies = simulation.energies
    assert abs(energies["residual"]) < 1e-9 * energies["load_work"]
    simulation.write_checkpoint(tmp_path / "stored")
    again = hdem.Simulation.from_checkpoint(tmp_path / "stored")
    np.testing.assert_array_equal(again.applied_forces, forces)
    for one in (simulation, again):
        one.run()
    assert simulation.state_hash == again.state_hash
    file = tmp_path / "pushed.toml"
    file.write_text(simulation.case_text)
    assert program_hash(tmp_path, file)["state_hash"] == simulation.state_hash


def test_applied_forces_wake_what_rests():
    """Blocks that have come to rest are left out of cycles until something acts on them."""
    simulation = hdem.Simulation(hdem.Case(pile(stage=[{"until": "converged", "max_cycles": 100000}, {"until": "converged", "max_cycles": 20000}], damping={"preset": "default"})), threads=1)
    simulation.run(stages=1)
    simulation.run(cycles=400)
    forces = np.zeros((4, 2))
    forces[3] = [1e5, 0.0]    # four times the weight of the highest one
    simulation.applied_forces = forces
    simulation.run(cycles=400)
    assert simulation.displacements[3, 0] > 0.01
    assert np.all(np.abs(simulation.displacements[:3]) < 0.01)


@pytest.mark.parametrize("values,said", [(np.zeros((3, 2)), "shape"), (np.full((4, 2), np.nan), "not finite"), ("a", "numbers"), (np.zeros(4), "shape")])
def test_applied_forces_that_are_none_are_refused(values, said):
    simulation = hdem.Simulation(hdem.Case(pile()), threads=1)
    with pytest.raises((TypeError, ValueError), match=said):
        simulation.applied_forces = values
    with pytest.raises(AttributeError, match="applied_forces"):
        simulation.forces = np.zeros((4, 2))


def test_removed_blocks_take_no_applied_force():
    simulation = hdem.Simulation(hdem.Case(pile(stage=[{"cycles": 10}, {"cycles": 10, "excavate": ["high"]}])), threads=1)
    simulation.run()
    forces = np.zeros((4, 2))
    forces[3, 0] = 1.0
    with pytest.raises(ValueError, match='"high" is removed'):
        simulation.applied_forces = forces


def test_views_show_the_state_and_hold_it():
    simulation = hdem.Simulation(hdem.Case(pile()), threads=1)
    simulation.run(cycles=5)
    view = simulation.motion_view
    assert not view.flags.owndata and not view.flags.writeable
    with pytest.raises(ValueError):
        view["x"] = 0.0
    with pytest.raises(ValueError):
        view.flags.writeable = True
    ordered = view[simulation.slots]
    assert np.array_equal(np.stack([ordered["x"], ordered["y"]], axis=1) + simulation.origin, simulation.positions)
    part = view["vy"]
    del view
    with pytest.raises(BufferError, match="1 views"):
        simulation.run(cycles=1)
    with pytest.raises(BufferError):
        simulation.velocities = simulation.velocities + [[0, 0], [1, 0], [0, 0], [0, 0]]
    del part
    simulation.run(cycles=1)
    kept = []
    with pytest.raises(BufferError):
        simulation.run(cycles=10, callback=lambda s: kept.append(s.force_view), every=5)
    assert simulation.cycle == 10 and kept[0]["y"].shape == (4,)
    alone = hdem.Simulation(hdem.Case(pile())).motion_view    # the run lives as long as what shows it
    assert np.isfinite(alone["x"]).all()


if __name__ == "__main__":
    run_tests(__file__)
