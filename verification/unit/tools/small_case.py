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


def run(hdem, scratch):
    """Its results, in a folder below `scratch`."""
    case, folder = scratch / "small.toml", scratch / "out"
    case.write_text(CASE, encoding="utf-8")
    subprocess.run([hdem, "run", case, "-o", folder, "--quiet"], check=True)
    return folder
