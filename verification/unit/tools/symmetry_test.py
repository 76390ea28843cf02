#!/usr/bin/python3
"""The same scene mirrored, turned by 90, 180 and 270 degrees, and shifted by 2^20 m: the same numbers to round-off, until chaos.

    symmetry_test.py HDEM [--scenes 9] [--cycles 10000] [--seed 1]    HDEM: the program

Corners are multiples of 2^-12 m, so each of these changes is exact, and no rounding of the input excuses a difference. The order in which blocks are
sorted and forces are added does change, so numbers differ by round-off. Where blocks rattle, that grows as e^t: a scene is compared as long as a
nudge of its blocks by 1e-12 m by itself changes it by less than LITTLE.

Sweeps of impulses over the blocks leave something that depends on their order: about a millionth of the velocity of an impact. Scenes by impulses and
by the hybrid method may differ by what a nudge of a micrometre does, and are compared as long as that is less than VISIBLE. In a few, blocks that graze
each other touch a cycle earlier: UNLIKE.
"""
import argparse
import math
import random
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import small_case

try:
    import h5py
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

STEPS = 20           # moments at which scenes are compared
LITTLE = 1e-7        # [m], [rad] and [m/s]
TIMES = 1e3          # round-off of a changed scene over that of a nudge of 1e-12 m
VISIBLE = 1e-2       # [m], [rad] and [m/s]; blocks hit each other at 6 m/s
UNLIKE = 0.1         # share of scenes
SWEPT = 1e-6         # [m], a nudge that stands for what sweeps leave
NUDGE = 1e-12        # [m]
SHIFT = 2.0 ** 20    # [m]
CHANGES = {          # x, y -> x, y; the last number says whether anticlockwise stays so
    "mirrored": (lambda x, y: (-x, y), -1.0),
    "turned by 90": (lambda x, y: (-y, x), 1.0),
    "turned by 180": (lambda x, y: (-x, -y), 1.0),
    "turned by 270": (lambda x, y: (y, -x), 1.0),
    "mirrored and turned": (lambda x, y: (y, x), -1.0),
}


def exact(value):
    return round(value * 4096.0) / 4096.0


class Scene:
    """Blocks of three to six corners that fall, slide and lie on a slope, thrown at random."""

    def __init__(self, seed):
        chance = random.Random(seed)
        self.method = ("force", "impulse", "hybrid")[seed % 3]
        self.cohesion = chance.choice([0.0, 1e4])
        self.blocks = [("ground", [(-20.0, -2.0), (20.0, -2.0), (20.0, 0.0), (-20.0, exact(chance.uniform(0.0, 8.0)))], (0.0, 0.0))]
        for number in range(8):
            corners = chance.randint(3, 6)
            first, size = chance.uniform(0.0, 6.0), chance.uniform(0.4, 1.0)
            at = (3.0 * (number % 4) - 4.0 + chance.uniform(-0.3, 0.3), 9.5 + 2.5 * (number // 4))
            angles = sorted(first + 2.0 * math.pi * (k + chance.uniform(-0.2, 0.2)) / corners for k in range(corners))
            outline = [(exact(at[0] + size * math.cos(a)), exact(at[1] + size * math.sin(a))) for a in angles]
            self.blocks.append((f"b{number}", outline, (exact(chance.uniform(-1.0, 1.0)), -6.0)))

    def text(self, cycles, change=lambda x, y: (x, y), turns=1.0, shift=0.0, nudge=0.0):
        gravity = change(0.0, -9.81)
        text = f"[gravity]\nvector = {list(gravity)}\n" + small_case.ROCK + f"cohesion = {self.cohesion}\n"
        text += f'[contact]\nmethod = "{self.method}"\n[time]\nstep = 1e-4\n[[stage]]\ncycles = {cycles}\n'
        nudges = {f"b{k}": nudge * (k % 3 - 1) for k in range(8)}
        for name, outline, velocity in self.blocks:
            points = [change(x + nudges.get(name, 0.0), y) for x, y in outline]
            points = [[x + shift, y + shift] for x, y in (points if turns > 0.0 else reversed(points))]
            text += f'[[block]]\nname = "{name}"\npolygon = {points}\n'
            text += "fixed = true\n" if name == "ground" else f"velocity = {list(change(*velocity))}\n"
            text += f'[[history]]\nname = "{name}"\nblock = "{name}"\nevery = {cycles // STEPS}\n'
            text += 'quantities = ["displacement", "velocity", "rotation", "angular_velocity"]\n'
        return text


class Symmetry(unittest.TestCase):
    def moments(self, folder, scene, change=lambda x, y: (x, y), turns=1.0, shift=0.0, nudge=0.0):
        """Displacement, velocity, turn and spin of each block at each moment, as they are in the scene that was not changed."""
        (folder / "scene.toml").write_text(scene.text(OPTIONS.cycles, change, turns, shift, nudge), encoding="utf-8")
        subprocess.run([OPTIONS.hdem, "run", folder / "scene.toml", "-o", folder / "out", "--overwrite", "--quiet", "--threads", "1"], check=True)
        back = np.linalg.inv(np.array([change(1.0, 0.0), change(0.0, 1.0)]))    # rows: images of the axes
        rows = []
        with h5py.File(folder / "out/results.h5", "r") as opened:
            for history in opened["history"].values():
                value = {name: history[name][...] for name in history}
                vector = {kind: np.column_stack([value[f"{kind}_x"], value[f"{kind}_y"]]) @ back for kind in ("displacement", "velocity")}
                rows.append(np.column_stack([vector["displacement"], vector["velocity"], turns * value["rotation"], turns * value["angular_velocity"]]))
        return list(np.stack(rows, axis=1))

    def test_changed_scenes_give_the_same_numbers(self):
        compared = 0
        alike = []
        for seed in range(OPTIONS.seed, OPTIONS.seed + OPTIONS.scenes):
            with tempfile.TemporaryDirectory() as scratch:
                folder = Path(scratch)
                scene = Scene(seed)
                plain = self.moments(folder, scene)
                self.assertEqual(len(plain), STEPS + 1)
                nudged = [np.abs(a - b).max() for a, b in zip(plain, self.moments(folder, scene, nudge=NUDGE))]
                calm = next((k for k, difference in enumerate(nudged) if difference > LITTLE), STEPS + 1)
                compared += calm
                swept = []
                for name, (change, turns) in CHANGES.items():
                    changed = self.moments(folder, scene, change, turns)
                    if scene.method == "force":
                        self.expect_same(f"scene {seed}, {scene.method}, {name}", plain, changed, nudged, calm)
                    else:
                        swept = swept or [np.abs(a - b).max() for a, b in zip(plain, self.moments(folder, scene, nudge=SWEPT))]
                        alike.append(self.are_alike(f"scene {seed}, {scene.method}, {name}", plain, changed, swept))
                self.expect_same(f"scene {seed}, {scene.method}, shifted", plain, self.moments(folder, scene, shift=SHIFT), nudged, calm)
        self.assertGreaterEqual(sum(alike), (1.0 - UNLIKE) * len(alike), "impulses depend on the order of blocks")
        self.assertGreater(compared, 0.5 * OPTIONS.scenes * STEPS, "chaos comes too early for these scenes to say much")

    def expect_same(self, what, plain, changed, nudged, calm):
        for k in range(calm):
            difference = np.abs(plain[k] - changed[k]).max()
            if OPTIONS.verbose:
                print(f"{what}, moment {k}: {difference:.1e}, by a nudge {nudged[k]:.1e}")
            self.assertLessEqual(difference, max(TIMES * nudged[k], 1e-10), f"{what}, moment {k}")

    def are_alike(self, what, plain, changed, swept):
        for k, (one, other) in enumerate(zip(plain, changed)):
            allowed = 30.0 * max(swept[:k + 1])
            difference = np.abs(one - other).max()
            if allowed > VISIBLE:
                break
            if difference > max(allowed, 1e-10):
                if OPTIONS.verbose:
                    print(f"{what}, moment {k}: {difference:.1e} for {allowed:.1e}")
                return False
        return True


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("hdem", type=lambda name: Path(name).resolve())
    parser.add_argument("--scenes", type=int, default=9)
    parser.add_argument("--cycles", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--verbose", action="store_true")
    OPTIONS = parser.parse_args()
    unittest.main(argv=sys.argv[:1])
