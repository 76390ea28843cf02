#!/usr/bin/python3
"""Random scenes for runs that are cut short: what a case file can say about joints, methods, stages, loads and output, in many mixtures.

    random_scene.py SEED    prints the case file of a seed; even ones have more in them (random_support.py)

Scene N is always the same. A scene takes about a second, so that it can be killed and restarted many times.
"""
import random
import sys


def toml(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {toml(one)}" for key, one in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml, value)) + "]"
    return str(value).lower() if isinstance(value, bool) else f'"{value}"' if isinstance(value, str) else str(value)


class Scene:
    """The case file `text`, and the cycles between its checkpoints."""

    def __init__(self, seed):
        self.seed = seed
        self.chance = random.Random(seed)
        self.static = self.chance.random() < 0.2
        self.interval = self.chance.choice((23, 50, 100, 200, 350))
        self.lines = [f'title = "Random scene {seed}"']
        self.names = ["loose1", "loose2"]
        self.choose()
        self.write_rock()
        self.write_loose_blocks()
        self.write_laws()
        self.write_stages()
        self.write_loads()
        self.write_output()
        self.text = "\n".join(self.lines) + "\n"

    def choose(self):
        """What a scene with more in it (random_support.py) decides first."""

    def add(self, header, **values):
        self.lines.append(header)
        self.lines += [f"{key} = {toml(value)}" for key, value in values.items()]

    def between(self, least, most):
        return round(self.chance.uniform(least, most), 3)

    def write_rock(self):
        self.width = self.between(20.5, 23.0) if self.static else self.between(7.0, 12.0)
        self.height = self.between(20.5, 23.0) if self.static else self.between(6.0, 10.0)
        self.add("[domain]", width=self.width, height=self.height, fixed=self.fixed_sides())
        first = self.chance.randint(-40, 40)
        for number in range(2 if self.static else self.chance.choice((2, 2, 3))):
            dip = (first + number * self.chance.randint(50, 75) + 90) % 180 - 90
            spacing = self.between(1.1, 1.4) if self.static else self.between(0.9, 1.3)
            given = {"dip_deg": float(dip), "spacing": spacing, "deviation_deg": self.chance.choice((0.0, 3.0)),
                     "persistence": self.chance.choice((1.0, 1.0, 0.8))}
            self.add("[[joint_set]]", **(given | self.more_of_set(number)))
        self.add("[generator]", seed=self.chance.randint(1, 10 ** 6), smallest_block_area=0.1)
        shape = self.chance.choice(("circle", "horseshoe", "rectangle"))
        size = self.between(0.25, 0.4) * self.height
        sides = {"diameter": size} if shape == "circle" else {"width": size, "height": size}
        self.add("[[excavation]]", name="tunnel", shape=shape, position=[0.5 * self.width, 0.4 * self.height],
                 inside=self.chance.choice(("jointed", "one_block")), **sides)

    def fixed_sides(self):
        return ["left", "right", "bottom"]

    def more_of_set(self, _number):
        return {}

    def more_of_stage(self, _number, _last):
        return {}

    def write_loose_blocks(self):
        """Two blocks that fall on the rock; the second one sometimes hangs until a stage frees it."""
        x, y = 0.3 * self.width, self.height + self.between(0.11, 0.5)
        self.hangs = self.chance.random() < 0.3
        for number, name in enumerate(self.names):
            low, turn = y + 0.9 * number, self.between(-0.1, 0.1)
            self.add("[[block]]", name=name, polygon=[[x, low], [x + 0.6, low + turn], [x + 0.6, low + 0.6 + turn], [x, low + 0.6]],
                     fixed=self.hangs and number == 1)

    def write_laws(self):
        self.add("[material.rock]", density=2700.0)
        friction = self.between(30.0, 40.0) if self.static else self.between(10.0, 40.0)
        self.add("[joint.default]", normal_stiffness=7e9, shear_stiffness=5e8, friction_angle_deg=friction,
                 cohesion=1e4 if self.static else self.chance.choice((0.0, 1e4)))
        self.add("[contact]", method=self.chance.choice(("force", "hybrid") if self.static else ("force", "impulse", "hybrid")))
        if not self.static and self.chance.random() < 0.4:
            self.add("[damping]", preset=self.chance.choice(("paper", "dynamic")))

    def write_stages(self):
        self.cycles = 0
        last = self.chance.choice((2, 3, 4)) - 1
        for number in range(last + 1):
            length = self.chance.randint(100, 300) if self.static else self.chance.randint(200, 900)
            self.cycles += length
            stage = {"cycles": length}
            if self.static or self.chance.random() < 0.5:
                stage = {"until": "converged", "max_cycles": length}
                if self.static:
                    stage["solver"] = "static"
            if number == 1:
                stage["excavate"] = ["tunnel"]
                stage["relax_cycles"] = self.chance.choice((0, length // 3, length // 2))
            if number == last and self.hangs:
                stage["free"] = ["loose2"]
            if number > 1 and not self.static and self.chance.random() < 0.3:
                stage["method"] = self.chance.choice(("force", "impulse", "hybrid"))
            stage |= self.more_of_stage(number, last)
            self.add("[[stage]]", name=f"part{number}", **stage)

    def write_loads(self):
        if self.static or self.chance.random() < 0.5:
            return
        begin = self.chance.randint(0, self.cycles)
        self.add("[[load]]", blocks=["*"], acceleration=[self.between(-3.0, 3.0), 0.0], from_cycle=begin,
                 until_cycle=begin + self.chance.randint(1, 300))
        self.add("[[load]]", blocks=["loose1"], force=[self.between(-2000.0, 2000.0), 0.0], moment=self.between(-500.0, 500.0), from_time=0.002)

    def write_output(self):
        rock = [f"b{self.chance.randint(1, 25)}" for _ in range(2)]
        self.add("[[history]]", name="rock", block=rock[0], quantities=["displacement", "velocity", "force"], every=self.chance.randint(1, 90))
        self.add("[[history]]", name="loose", block="loose1", quantities=["position", "rotation"], every=self.chance.randint(1, 90))
        self.add("[[history]]", name="pair", between=self.names, every=self.chance.randint(1, 90),
                 quantities=["normal_force", "shear_force", "shear_displacement", "overlap", "impulse_points"])
        self.add("[output]", row_every=self.chance.choice((10, 50, 130)), frame_every=self.chance.choice((0, 100, 170, 400)),
                 contacts=self.chance.random() < 0.8, checkpoint_every=self.interval, checkpoint_wall_minutes=0)


if __name__ == "__main__":
    from random_support import scene_of
    print(scene_of(int(sys.argv[1])).text, end="")
