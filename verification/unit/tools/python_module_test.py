#!/usr/bin/python3
"""The Python module hdem, by pytest.

    python_module_test.py HDEM CASES EXAMPLE    with the package on PYTHONPATH; exit code 77: it was not built, or there is no pytest
"""
import json
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

try:
    import numpy as np
    import pytest

    import hdem
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

PROGRAM, CASES, EXAMPLE = (sys.argv[1:4] + ["", "", ""])[:3] if __name__ == "__main__" else os.environ["HDEM_TEST"].split("\n")
TUNNEL = Path(CASES) / "paper_tunnel/tunnel.toml"
SHORT = ["stage[0].cycles=400", "stage[1].max_cycles=800"]


def pile(**changes):
    """Three blocks on a floor; the highest one can be thrown."""
    def box(name, x, y, size=1.0, **keys):
        return {"name": name, "polygon": [[x, y], [x + size, y], [x + size, y + size], [x, y + size]], "material": "rock", **keys}
    case = {"block": [{"name": "floor", "polygon": [[-5, -1], [5, -1], [5, 0], [-5, 0]], "material": "rock", "fixed": True},
                      box("low", 0, 0), box("middle", 0.1, 1), box("high", 0.2, 2)],
            "material": {"rock": {"density": 2500.0}},
            "joint": {"default": {"normal_stiffness": 1e9, "shear_stiffness": 5e8, "friction_angle_deg": 30.0}},
            "contact": {"method": "force"}, "damping": {"preset": "dynamic"},
            "stage": [{"name": "first", "cycles": 300}, {"name": "second", "cycles": 300}]}
    return {**case, **changes}


def program(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def program_hash(tmp_path, case, *arguments):
    folder = tmp_path / "by_program"
    code, said = program("run", case, "-o", folder, "--quiet", "--overwrite", *arguments)
    assert code in (0, 4), said
    return json.loads((folder / "summary.json").read_text())


@pytest.fixture(scope="module")
def tunnel(tmp_path_factory):
    """What the program makes of the tunnel."""
    arguments = [word for text in SHORT for word in ("--set", text)]
    return program_hash(tmp_path_factory.mktemp("tunnel"), TUNNEL, *arguments, "--threads", 1)


def run_tunnel(threads=1, **keys):
    simulation = hdem.Simulation(hdem.Case(TUNNEL, set=SHORT), threads=threads)
    simulation.run(**keys)
    return simulation


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


def test_a_dict_for_a_section_leaves_the_keys_that_it_does_not_name():
    by_path = hdem.Case(TUNNEL, set={"generator.seed": 3, "joint.default.cohesion": 7.0})
    assert hdem.Case(TUNNEL, set={"generator": {"seed": 3}, "joint": {"default": {"cohesion": 7.0}}}).overrides == by_path.overrides


def test_errors_have_the_programs_texts(tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text(TUNNEL.read_text().replace("density = 2700.0", "density = -1.0").replace("spacing = 3.5", "spacng = 3.5"))
    _, said = program("check", file)
    with pytest.raises(hdem.CaseError) as raised:
        hdem.Case(file)
    assert len(raised.value.problems) >= 2 and isinstance(raised.value, ValueError) and isinstance(raised.value, hdem.Error)
    assert said == "".join(f"error: {problem}\n" for problem in raised.value.problems)
    with pytest.raises(hdem.CaseError, match="generator.sed"):
        hdem.Case(TUNNEL, set={"generator.sed": 1})
    with pytest.raises(hdem.CaseError, match="does not exist"):
        hdem.Case(tmp_path / "none.toml")
    with pytest.raises(TypeError, match="material.rock.density"):
        hdem.Case(pile(material={"rock": {"density": None}}))
    with pytest.raises(hdem.CaseError, match="stable limit"):
        hdem.Simulation(hdem.Case(pile(time={"step": 1.0})))


def test_toml_of_all_kinds_of_values():
    import tomllib
    case = {"title": 'a "b" \\ \x01 \x7f ü', "list": np.arange(4.0).reshape(2, 2), "odd key": True, "sub": {"x": {"a": np.float32(0.5)}, "y": {}},
            "tables": [{"a": 1, "b": {"c": [1e-300, 1e300]}}, {}], "empty": []}
    back = tomllib.loads(hdem.to_toml(case))
    assert back == {**case, "list": [[0.0, 1.0], [2.0, 3.0]], "sub": {"x": {"a": 0.5}, "y": {}}}


def test_blocks_of_a_case():
    case = hdem.Case(TUNNEL)
    n = case.blocks
    areas = [0.5 * abs(np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1))) for p in case.polygons]
    assert np.allclose(areas, case.areas, rtol=1e-9) and np.isclose(case.areas.sum(), 35 * 33)
    assert n == 542 and len(case.names) == n and case.names[0] == "b1" or case.names[0].startswith("b")
    assert np.allclose(case.masses, 2700 * case.areas) and case.material_names == ["rock"] and case.fixed.sum() > 50
    inside = case.excavations == case.excavation_names.index("tunnel")
    assert inside.sum() == 1 and np.isclose(case.areas[inside][0], 9 * 3.5 + np.pi * 4.5**2 / 2, rtol=1e-2)
    pieces = [sum(0.5 * np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1)) for p in parts) for parts in case.parts]
    assert np.allclose(pieces, case.areas, rtol=1e-9)


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


def test_cases_go_to_other_processes_and_simulations_do_not():
    import copy
    import pickle
    case = pickle.loads(pickle.dumps(hdem.Case(pile(), set={"generator.seed": 3})))
    assert (case.blocks, case.overrides) == (4, ["generator.seed=3"])
    with pytest.raises(TypeError, match="checkpoint"):
        copy.copy(hdem.Simulation(case))


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


def test_files_of_a_dict_lie_beside_its_name(tmp_path):
    (tmp_path / "more.csv").write_text("name,x,y\nextra,-3,0\nextra,-2,0\nextra,-2,1\nextra,-3,1\n")
    with pytest.raises(hdem.CaseError, match="more.csv"):
        hdem.Case(pile(blocks_file="more.csv"))
    case = hdem.Case(pile(blocks_file="more.csv"), name=tmp_path / "case.toml")
    assert case.names[-1] == "extra"
    simulation = hdem.Simulation(case, threads=1)
    simulation.run(cycles=10)
    (tmp_path / "more.csv").unlink()    # the run has it
    simulation.write_checkpoint(str(tmp_path))
    simulation.add_stage(cycles=5)
    simulation.run()
    assert hdem.Simulation.from_checkpoint(tmp_path / "checkpoint.h5").names == simulation.names


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


def test_run_that_fails_says_so_and_stays_to_be_looked_at():
    simulation = hdem.Simulation(hdem.Case(pile(contact={"method": "force", "overlap_limit": 1e-7})), threads=1)
    with pytest.raises(hdem.RunError, match="overlap"):
        simulation.run()
    assert np.isfinite(simulation.positions).all()
    with pytest.raises(hdem.RunError, match="failed before"):
        simulation.run()


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


def test_example_runs(tmp_path):
    done = subprocess.run([sys.executable, EXAMPLE, str(tmp_path / "seeds.png")], capture_output=True, text=True)
    if "No module named 'matplotlib'" in done.stderr:
        pytest.skip("no matplotlib")
    assert done.returncode == 0 and "20 seeds: median" in done.stdout, done.stderr
    assert (tmp_path / "seeds.png").stat().st_size > 10000


def test_wheel_holds_the_package(tmp_path):
    import importlib.util
    import zipfile
    if not all(importlib.util.find_spec(name) for name in ("pip", "setuptools", "wheel")):
        pytest.skip("no pip, setuptools or wheel")
    package = Path(hdem.__file__).parent
    done = subprocess.run([sys.executable, "-m", "pip", "wheel", "--no-index", "--no-build-isolation", "--no-deps", "-q", "-w", tmp_path,
                           Path(EXAMPLE).parent.parent], capture_output=True, text=True, env={**os.environ, "HDEM_BUILD": str(package.parent.parent)})
    assert done.returncode == 0, done.stderr
    wheel, = tmp_path.glob("hdem-*.whl")
    files = {name for name in zipfile.ZipFile(wheel).namelist() if name.startswith("hdem/")}
    assert files == {f"hdem/{file.name}" for file in package.iterdir() if file.is_file()} and "hdem/py.typed" in files


def test_stubs_name_what_is_there():
    import ast
    stubs = ast.parse((Path(hdem.__file__).parent / "_core.pyi").read_text())
    assert (Path(hdem.__file__).parent / "py.typed").exists()
    classes = {node.name: {item.name for item in node.body if isinstance(item, ast.FunctionDef)} for node in stubs.body
               if isinstance(node, ast.ClassDef)}
    for name in ("Case", "Run"):
        real = {key for key in vars(getattr(hdem._core, name)) if not key.startswith("__")}
        assert real | {"__init__"} == classes[name] | classes["_Blocks"], name
        without = [key for key in real if not key.startswith("_") and not getattr(getattr(hdem._core, name), key).__doc__]
        assert not without, without


if __name__ == "__main__":
    os.environ["HDEM_TEST"] = "\n".join([PROGRAM, CASES, EXAMPLE])
    sys.exit(pytest.main(["-q", "-x" if "-x" in sys.argv else "-ra", "-p", "no:cacheprovider", __file__, *[a for a in sys.argv[4:] if a != "-x"]]))
