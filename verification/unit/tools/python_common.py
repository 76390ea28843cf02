"""What the tests of the Python module hdem have in common: a tunnel, a small pile of blocks, and what the program makes of a case.

Import it before hdem: it ends the program with exit code 77 where the module was not built, or where there is no pytest.
"""
import json
import subprocess
import sys
from pathlib import Path

try:
    import numpy    # noqa: F401
    import pytest

    import hdem
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

PROGRAM, CASES, EXAMPLE = (sys.argv[1:4] + ["", "", ""])[:3]
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


def run_tests(file):
    """The tests of a file, by pytest. What follows the three arguments of the program goes to pytest."""
    sys.exit(pytest.main(["-q", "-x" if "-x" in sys.argv else "-ra", "-p", "no:cacheprovider", file, *[a for a in sys.argv[4:] if a != "-x"]]))
