#!/usr/bin/python3
"""How much longer a run takes from Python than by the program: the shipped tunnel, by turns, one thread.

    PYTHONPATH=build/release/python perf/python_overhead.py build/release/bin/hdem [--rounds N] [--whole]
        --whole    the run as it is shipped, not only its first 15000 cycles after the excavation

Both write no frames beyond those of the case's stages; Python calls back every 1000 cycles and reads displacements there. Reading the case counts, starting Python and
its modules does not: it is printed. Processor time is hardly disturbed by others on the machine, time by the clock is. The bar: 2 % more.
"""
import argparse
import json
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

CASE = Path(__file__).parent.parent / "verification/cases/paper_tunnel/tunnel.toml"
SCRIPT = """
import sys, hdem
simulation = hdem.Simulation(hdem.Case(sys.argv[1], set={}), folder=sys.argv[2], threads=1)
simulation.run(callback=lambda s: s.displacements.max(), every=1000)
"""


def seconds(command):
    """Processor time and time by the clock."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True)
    after, end = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    if done.returncode not in (0, 4):
        sys.exit(done.stderr)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, end - begin


def main():
    parser = argparse.ArgumentParser(description="How much longer a run takes from Python than by the program.")
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--whole", action="store_true")
    options = parser.parse_args()
    changed = {"output.frame_every": 0} | ({} if options.whole else {"stage[1].max_cycles": 15000})
    ratios, hashes = {"processor": [], "clock": []}, set()
    nothing = [min(times) for times in zip(*(seconds([sys.executable, "-c", "import hdem"]) for _ in range(5)))]
    for number in range(options.rounds):
        with tempfile.TemporaryDirectory() as folder:
            sets = [word for key, value in changed.items() for word in ("--set", f"{key}={value}")]
            commands = {"a": [options.program, "run", str(CASE), "-o", f"{folder}/a", "--quiet", "--threads", "1", *sets],
                        "b": [sys.executable, "-c", SCRIPT.replace("set={}", f"set={changed!r}"), str(CASE), f"{folder}/b"]}
            took = {x: seconds(commands[x]) for x in ("ab" if number % 2 else "ba")}
            hashes |= {json.loads(Path(f"{folder}/{x}/summary.json").read_text())["state_hash"] for x in "ab"}
        line = []
        for place, kind in enumerate(ratios):
            theirs, ours = took["a"][place], took["b"][place] - nothing[place]
            ratios[kind].append(ours / theirs)
            line.append(f"{kind}: program {theirs:.3f} s, Python {ours:.3f} s, ratio {ours / theirs:.4f}")
        print("   ".join(line), flush=True)
    print("; ".join(f"median ratio by {kind} {statistics.median(found):.4f}" for kind, found in ratios.items())
          + f"; import {nothing[0]:.3f} s; same bits: {len(hashes) == 1} ({', '.join(sorted(hashes))})")


if __name__ == "__main__":
    main()
