"""Random scenes with more in them: in-situ stress, joints with a memory, sides, water, bolts, linings, ramps, other rock, ends of stages.

Each scene has some of these, in a mixture that follows from its number alone.
"""
import random

from random_scene import Scene

# Joints of all laws, weak enough to slip, to open and to break in a second's run.
LAWS = {
    "residual": {"normal_stiffness": 7e9, "shear_stiffness": 5e8, "friction_angle_deg": 30.0, "cohesion": 3e4, "tension": 1e4,
                 "residual_friction_angle_deg": 20.0, "residual_cohesion": 1e3, "residual_tension": 1e2, "dilation_angle_deg": 8.0,
                 "dilation_limit": 0.003},
    "worn": {"law": "barton_bandis", "normal_stiffness": 5e9, "shear_stiffness": 5e8, "jrc": 9.0, "jcs": 60e6,
             "residual_friction_angle_deg": 25.0, "length": 1.0},
    "closing": {"law": "barton_bandis", "shear_stiffness": 5e8, "jrc": 8.0, "jcs": 80e6, "rock_strength": 100e6, "closure_cycle": 2,
                "residual_friction_angle_deg": 27.0, "length": 1.0},
    "toothed": {"law": "patton", "normal_stiffness": 7e9, "shear_stiffness": 5e8, "friction_angle_deg": 25.0, "cohesion": 1e5,
                "residual_friction_angle_deg": 22.0, "asperity_angle_deg": 10.0, "dilation_limit": 0.01},
    "yielding": {"law": "continuously_yielding", "normal_stiffness": 6e9, "shear_stiffness": 5e8, "friction_angle_deg": 25.0,
                 "mobilised_angle_deg": 40.0, "wear_length": 0.002},
    "plesha": {"law": "plesha", "normal_stiffness": 7e9, "shear_stiffness": 5e8, "friction_angle_deg": 28.0, "asperity_angle_deg": 8.0,
               "wear": 1e-4},
    "saeb": {"law": "saeb_amadei", "normal_stiffness": 7e9, "shear_stiffness": 5e8, "friction_angle_deg": 28.0, "asperity_angle_deg": 9.0,
             "transition_stress": 20e6, "rock_cohesion": 1e6, "rock_friction_angle_deg": 30.0, "residual_share": 0.6},
    "hyperbola": {"normal_stiffness": 3e9, "greatest_closure": 5e-3, "shear_stiffness": 5e8, "friction_angle_deg": 24.0},
}
# What impulses cannot compute is left out, or given otherwise.
IMPULSIVE = {"residual": {"tension": None, "residual_tension": None}, "closing": {"rock_strength": None, "closure_cycle": None, "normal_stiffness": 5e9},
             "hyperbola": {"greatest_closure": None}}


class RichScene(Scene):
    """A scene with more in it."""

    def choose(self):
        self.more = random.Random(f"{self.seed} more")
        self.laws = self.more.sample(sorted(LAWS), 2) if self.more.random() < 0.6 else []
        self.sides = self.more.random() < 0.4 and not self.static
        self.stressed = self.sides or self.more.random() < 0.5
        self.wet = self.more.random() < 0.5 and not self.static
        self.supported = self.more.random() < 0.6 and not self.static
        self.ramped = self.more.random() < 0.5 and not self.static

    def fixed_sides(self):
        return ["bottom"] if self.sides else super().fixed_sides()

    def write_rock(self):
        super().write_rock()
        if not self.static and self.more.random() < 0.25:
            x, y = 0.1 * self.width, 0.75 * self.height
            self.add("[[region]]", name="zone", polygon=[[x, y], [0.45 * self.width, y], [0.45 * self.width, 0.95 * self.height], [x, 0.95 * self.height]])
            self.add("[voronoi]", edge=0.6, region="zone")
        if not self.static and self.more.random() < 0.25:
            self.add("[[fault]]", name="main", points=[[-1.0, 0.2 * self.height], [self.width + 1.0, 0.8 * self.height]])

    def more_of_set(self, number):
        more = {"joint": self.laws[number]} if number < len(self.laws) else {}
        if not self.static and self.more.random() < 0.3:
            more["spacing"] = {"mean": 1.2, "distribution": "lognormal", "sd": 0.3, "least": 0.8}
        return more

    def write_laws(self):
        super().write_laws()
        self.surface = self.height + (self.more.choice((5.0, 60.0)) if self.sides else 0.0)
        if self.stressed:
            self.add("[insitu]", surface=self.surface, ratio=self.more.choice((0.5, 1.0, 1.5)))
        if self.wet:
            self.add("[water]", ponded=self.more.random() < 0.7,
                     **({"level": 0.7 * self.height} if self.more.random() < 0.5 else
                        {"table": [[0.0, self.height + 2.0], [self.width, 0.3 * self.height]]}))

    def write_stages(self):
        super().write_stages()
        if self.sides:
            self.write_sides()
        if self.supported:
            self.write_bolts()
            self.write_liner()

    def more_of_stage(self, number, last):
        more = {}
        if self.wet and number == last and self.more.random() < 0.6:
            more = {"water_level": round(self.more.uniform(0.2, 1.1) * self.height, 3), "relax_cycles": self.more.choice((0, 150))}
        if number == 1 and self.supported and self.more.random() < 0.5:
            more |= {"relax_cycles": 120, "relax_to": 0.4}
        if self.ramped and number == last:
            more |= {"set": ["joint.default.friction_angle_deg = 12.0", "joint.default.cohesion = 100.0"], "set_cycles": 170}
        return more

    def write_sides(self):
        stages = [line.split('"')[1] for line in self.lines if line.startswith('name = "part')]
        self.add("[[boundary]]", name="left", side="left", kind="roller")
        first, rest = stages[:1], stages[1:]
        self.add("[[boundary]]", name="hold", side="right", kind="fixed", stages=first)
        kind = self.more.choice(("stress", "velocity", "servo", "roller"))
        if kind == "servo" and '"impulse"' in "".join(self.lines):
            kind = "roller"
        given = {"stress": {"stress": "insitu"}, "velocity": {"velocity": [-0.02, 0.0], "ramp_cycles": [0, 150]},
                 "servo": {"target": 3e5, "max_velocity": 0.05}, "roller": {}}[kind]
        self.add("[[boundary]]", name="push", side="right", kind=kind, stages=rest, **given)
        self.add("[[boundary]]", name="cover", side="top", kind="stress", stress="insitu")

    def write_bolts(self):
        around = {"around": "tunnel", "length": 2.0, "along": 1.2, "stage": "part1", "spacing": 1.5}
        grown = {
            "anchored": {"area": 2e-4, "pretension": 2e4, "yield": 2.1e4, "rupture_strain": 0.01},
            "grouted": {"area": 2e-4, "bond_stiffness": 1e7, "bond_strength": 2e3, "plate": self.more.random() < 0.5, "yield": 5e4},
            "local": {"stiffness": 1e7, "shear_stiffness": 1e7, "shear_strength": 1e3, "rupture_strain": 0.1, "active_length": 0.05}}
        for kind in self.more.sample(sorted(grown), self.more.randint(1, 3)):
            self.add("[[bolt]]", name=kind, kind=kind, arc=[-30, 210], **around, **grown[kind])

    def write_liner(self):
        self.lined = self.more.random() < 0.7
        if self.lined:
            self.add("[[liner]]", name="shotcrete", around="tunnel", stage="part1", thickness=0.1, modulus=1e10, moment_strength=500.0,
                     normal_stiffness=1e9, bond_strength=1e3, cohesion=1e3, hardening=[[0, 0.1], [200, 1.0]],
                     **({"arc": [-10, 190]} if self.more.random() < 0.5 else {}))

    def write_loads(self):
        super().write_loads()
        if self.ramped:
            self.add("[[load]]", blocks=["*"], acceleration=[self.between(-2.0, 2.0), 0.0], since="part1",
                     table=[[0, 0.0], [100, 1.0], [200, -1.0], [300, 0.0]])
            self.add("[[load]]", blocks=["loose2"], force=[500.0, 0.0], ramp_cycles=[50, 400])

    def write_output(self):
        has_impulses = '"impulse"' in "".join(self.lines)
        for name in self.laws:
            law = LAWS[name] | (IMPULSIVE.get(name, {}) if has_impulses else {})
            self.add(f"[joint.{name}]", **{key: value for key, value in law.items() if value is not None})
        super().write_output()
        if self.wet:
            self.add("[[history]]", name="pressure", point=[0.5 * self.width, 0.2 * self.height], quantities=["pore_pressure"], every=37)
        if self.laws:
            self.add("[[history]]", name="memory", between=["b3", "b4"], quantities=["plastic_slip", "opening", "damage", "broken"], every=41)
        if self.supported and self.lined:
            self.add("[[history]]", name="lining", liner="shotcrete", quantities=["thrust", "moment", "hinges", "parted"], every=29)


def scene_of(number):
    """Scene `number`; even ones have more in them."""
    return Scene(number) if number % 2 else RichScene(number)
