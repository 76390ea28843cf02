#!/usr/bin/python3
"""A rock mass above a tunnel: generate, run, plot, then twenty of its kind. In a notebook each part between blank lines is a cell.

    PYTHONPATH=build/release/python tools/python/examples/seeds.py [PICTURE.png]
"""
import sys
from concurrent.futures import ThreadPoolExecutor

import hdem
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

rock = {"domain": {"width": 14.0, "height": 12.0, "fixed": ["left", "right", "bottom"]},
        "joint_set": [{"dip_deg": 20.0, "spacing": 1.2, "deviation_deg": 3.0}, {"dip_deg": -65.0, "spacing": 1.4, "deviation_deg": 3.0}],
        "excavation": [{"name": "tunnel", "shape": "circle", "position": [7.0, 6.0], "diameter": 4.0}],
        "material": {"rock": {"density": 2700.0}},
        "joint": {"default": {"normal_stiffness": 2e9, "shear_stiffness": 1e9, "friction_angle_deg": 32.0}},
        "stage": [{"cycles": 1000}, {"excavate": ["tunnel"], "until": "converged", "max_cycles": 40000}]}

def run(seed):
    simulation = hdem.Simulation(hdem.Case(rock, set={"generator.seed": seed}), threads=1)
    simulation.run()
    return simulation

one = run(1)
moved = np.hypot(*one.displacements.T)
print(f"{one.present.sum()} blocks; farthest {one.names[moved.argmax()]}: {1e3 * moved.max():.1f} mm after {one.cycle} cycles")

with ThreadPoolExecutor(2) as two_cores:    # cycles run without Python's lock
    farthest = list(two_cores.map(lambda seed: np.hypot(*run(seed).displacements.T).max(), range(1, 21)))
print(f"20 seeds: median {1e3 * np.median(farthest):.1f} mm, {sum(way > 0.1 for way in farthest)} with a block that fell")

figure, (left, right) = plt.subplots(1, 2, figsize=(7, 3), layout="constrained")
polygons = [polygon for polygon, is_there in zip(one.polygons, one.present) if is_there]
drawn = left.add_collection(PolyCollection(polygons, array=1e3 * moved[one.present], edgecolors="k", linewidths=0.3))
left.set(aspect="equal", xlim=(0, 14), ylim=(0, 12), title="seed 1")
figure.colorbar(drawn, ax=left, label="displacement [mm]")
right.plot(range(1, 21), farthest, "o")
right.set(yscale="log", xlabel="seed", ylabel="farthest displacement [m]")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "seeds.png", dpi=70)
