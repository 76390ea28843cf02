"""A small case that has everything a result can show, for the tests of what reads results."""
import subprocess

ROCK = """
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 30.0
"""

# A concave block on a ground beside a prop that is removed, and a block that falls 0.2 m.
CASE = 'title = "Small run"' + ROCK + """
[time]
step = 1e-4
[convergence]
detached_distance = 0.05
[[block]]
name = "ground"
polygon = [[-1, -1], [9, -1], [9, 0], [-1, 0]]
fixed = true
[[block]]
name = "l"
polygon = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
[[block]]
name = "prop"
polygon = [[6, 0], [7, 0], [7, 1], [6, 1]]
[[block]]
name = "ball"
polygon = [[4, 0.2], [5, 0.2], [5, 1.2], [4, 1.2]]
[[stage]]
name = "settle"
cycles = 200
[[stage]]
name = "fall"
cycles = 1500
excavate = ["prop"]
[output]
row_every = 100
[[history]]
name = "rest"
between = ["ground", "l"]
quantities = ["normal_force", "overlap"]
every = 10
[[history]]
name = "ball"
block = "ball"
quantities = ["displacement", "speed"]
every = 10
"""

# The same with what frames and histories show only where the case has it: water, bolts, a lining, a joint with a memory.
SUPPORTED = CASE.replace("friction_angle_deg = 30.0", "friction_angle_deg = 30.0\nresidual_friction_angle_deg = 20.0\ndilation_angle_deg = 5.0") + """
[water]
table = [[-1, 0.4], [4, 0.2], [9, 0.3]]
[[bolt]]
name = "anchor"
from = [0.5, 1.5]
to = [0.5, -0.5]
area = 1e-4
pretension = 1e3
yield = 2e3
[[bolt]]
name = "cable"
kind = "grouted"
from = [1.5, 0.5]
to = [1.5, -0.8]
area = 1e-4
bond_stiffness = 1e7
bond_strength = 1e4
segment = 0.2
stage = "fall"
[[liner]]
name = "coat"
path = [[2, 1], [2, 0]]
thickness = 0.1
modulus = 1e10
normal_stiffness = 1e8
[[history]]
name = "anchor"
bolt = "anchor"
quantities = ["axial_force", "status"]
every = 10
[[history]]
name = "coat"
liner = "coat"
quantities = ["thrust", "moment"]
every = 10
[[history]]
name = "pressure"
point = [2, -0.5]
quantities = ["pore_pressure"]
every = 10
"""

# The same with a lining that stands far above the blocks and a water table below them.
BESIDE = CASE + """
[water]
table = [[-1, -4.0], [9, -5.0]]
[[liner]]
name = "coat"
path = [[9, 12], [9, 0], [9, -1]]
thickness = 0.1
modulus = 1e10
normal_stiffness = 1e8
"""


def run(hdem, scratch, text=CASE):
    """Its results, in a folder below `scratch`."""
    case, folder = scratch / "small.toml", scratch / "out"
    case.write_text(text, encoding="utf-8")
    subprocess.run([hdem, "run", case, "-o", folder, "--quiet"], check=True)
    return folder
