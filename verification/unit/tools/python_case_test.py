#!/usr/bin/python3
"""The Python module hdem: cases from files and from dicts, and what they say of their blocks, by pytest.

    python_case_test.py HDEM CASES EXAMPLE    with the package on PYTHONPATH; exit code 77: it was not built, or there is no pytest
"""
from python_common import TUNNEL, pile, program, run_tests

import numpy as np
import pytest

import hdem


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


def test_cases_go_to_other_processes_and_simulations_do_not():
    import copy
    import pickle
    case = pickle.loads(pickle.dumps(hdem.Case(pile(), set={"generator.seed": 3})))
    assert (case.blocks, case.overrides) == (4, ["generator.seed=3"])
    with pytest.raises(TypeError, match="checkpoint"):
        copy.copy(hdem.Simulation(case))


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


if __name__ == "__main__":
    run_tests(__file__)
