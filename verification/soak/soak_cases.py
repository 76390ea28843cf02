"""The case files of the soak: a wall at rest, a pile under loads that come and go, rubble that slides and falls."""

LAWS = """[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = {friction}
"""
OUTPUT = """[output]
row_every = {row_every}
frame_every = 0
checkpoint_every = {checkpoint_every}
checkpoint_wall_minutes = 0
"""


def block(name, left, bottom, width, height, fixed=False):
    right, top = left + width, bottom + height
    corners = f"[[{left}, {bottom}], [{right}, {bottom}], [{right}, {top}], [{left}, {top}]]"
    return f'[[block]]\nname = "{name}"\npolygon = {corners}\nfixed = {str(fixed).lower()}\n'


def stages(settling, cycles):
    """What moves while blocks are set down belongs to the first stage, what moves afterwards to the second."""
    return f'[[stage]]\nname = "settling"\ncycles = {settling}\n[[stage]]\nname = "soak"\ncycles = {cycles - settling}\n'


def wall(method, settling, cycles, slope=0.0):
    """Six bricks in three courses, each on the middle of two; with a slope, x and y of gravity turned by so many degrees are given."""
    gravity = {0.0: "[0.0, -9.81]", 40.0: "[6.3057, -7.5149]"}[slope]
    bricks = block("ground", -1.0, -0.5, 5.0, 0.5, True)
    for course, lefts in enumerate(((0.0, 1.0, 2.0), (0.5, 1.5), (1.0,))):
        bricks += "".join(block(f"brick{course}{i}", left, 0.5 * course, 1.0, 0.5) for i, left in enumerate(lefts))
    return f'title = "Soak: a wall at rest"\n{bricks}[gravity]\nvector = {gravity}\n[contact]\nmethod = "{method}"\n' + \
        LAWS.format(friction=35.0) + stages(settling, cycles)


def pile(method, settling, cycles):
    """Ten blocks in four courses; a weight of fifty tonnes on top, and a push at one side that comes and goes twenty times."""
    blocks = block("ground", -1.0, -0.5, 6.0, 0.5, True)
    for course in range(4):
        blocks += "".join(block(f"block{course}{i}", 0.5 * course + i, 0.6 * course, 1.0, 0.6) for i in range(4 - course))
    loads = '[[load]]\nblocks = ["block30"]\nforce = [0.0, -500000.0]\n'
    period = (cycles - settling) // 20
    for number in range(20):
        begin = settling + number * period
        loads += f'[[load]]\nblocks = ["block00", "block30"]\nforce = [20000.0, 0.0]\nfrom_cycle = {begin}\nuntil_cycle = {begin + period // 2}\n'
    return f'title = "Soak: a loaded pile"\n{blocks}[contact]\nmethod = "{method}"\n{loads}' + LAWS.format(friction=35.0) + stages(settling, cycles)


def rubble(method, settling, cycles, side):
    """A square of jointed rock without a wall on its right: it slides out on a floor."""
    floor = block("floor", side, -2.0, 2.0 * side, 2.0, True)
    sets = "".join(f"[[joint_set]]\ndip_deg = {dip}\nspacing = 1.0\ndeviation_deg = 4.0\n" for dip in (35.0, -60.0))
    return f'title = "Soak: rubble"\n[domain]\nwidth = {side}\nheight = {side}\nfixed = ["left", "bottom"]\n{sets}{floor}' + \
        f'[generator]\nsmallest_block_area = 0.3\n[contact]\nmethod = "{method}"\n' + LAWS.format(friction=20.0) + stages(settling, cycles)
