#!/usr/bin/python3
"""How much longer a run takes from Python than by the program: the shipped tunnel, by turns, one thread.

    PYTHONPATH=build/release/python perf/python_overhead.py build/release/bin/hdem [ROUNDS]

Both write no frames beyond those of the case's stages; Python calls back every 1000 cycles and reads displacements there. Times are processor time of the
process (others on the machine matter less); reading the case counts. The bar: 2 % more.
"""
import json
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

CASE = Path(__file__).parent.parent / "verification/cases/paper_tunnel/tunnel.toml"
SHORT = {"stage[1].max_cycles": 15000, "output.frame_every": 0}
SCRIPT = """
import sys, hdem
simulation = hdem.Simulation(hdem.Case(sys.argv[1], set={}), folder=sys.argv[2], threads=1)
simulation.run(callback=lambda s: s.displacements.max(), every=1000)
"""


def seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 4):
        sys.exit(done.stderr)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main(program, rounds=5):
    ratios, hashes = [], set()
    nothing = min(seconds([sys.executable, "-c", "import hdem"]) for _ in range(3))
    for _ in range(int(rounds)):
        with tempfile.TemporaryDirectory() as folder:
            sets = [word for key, value in SHORT.items() for word in ("--set", f"{key}={value}")]
            theirs = seconds([program, "run", str(CASE), "-o", f"{folder}/a", "--quiet", "--threads", "1", *sets])
            script = SCRIPT.replace("set={}", f"set={SHORT!r}")
            ours = seconds([sys.executable, "-c", script, str(CASE), f"{folder}/b"]) - nothing
            hashes |= {json.loads(Path(f"{folder}/{x}/summary.json").read_text())["state_hash"] for x in "ab"}
            ratios.append(ours / theirs)
            print(f"program {theirs:.3f} s   Python {ours:.3f} s   ratio {ratios[-1]:.4f}", flush=True)
    print(f"median ratio {statistics.median(ratios):.4f}   import {nothing:.3f} s   same bits: {len(hashes) == 1}")


if __name__ == "__main__":
    main(*sys.argv[1:])
