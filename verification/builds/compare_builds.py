#!/usr/bin/python3
"""The program built in several ways must end each scene in the same state, to the last bit.

    compare_builds.py [-o FOLDER] [--jobs N] [--only NAME,NAME] [--list]

Builds the target `hdem` once for each way, in FOLDER (default: build/builds), runs the scenes with each, and compares their state hashes. What
is built already is only brought up to date. Exit code 0: all the same; 1: a build or a run failed; 2: wrong usage; 3: a hash differs.
"""
import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
CASES = HERE.parent / "cases"
sys.path.insert(0, str(HERE.parent / "faults"))
from random_support import scene_of    # noqa: E402

CLANG = ["-DCMAKE_C_COMPILER=clang", "-DCMAKE_CXX_COMPILER=clang++"]
# A machine whose libm has no fused multiply-add: glibc chooses its functions by the processor, at run time.
OLD_MACHINE = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}

# The first one is what the others are compared with. Flags of a user come before those of hdem, which must win.
BUILDS = {
    "release": ["--preset", "release"],
    "portable": ["--preset", "ci"],
    "O2": ["--preset", "ci", "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG"],
    "four lanes": ["--preset", "ci", "-DHDEM_HAS_WIDE_FLAGS=OFF"],    # as on a processor without AVX-512
    "any processor": ["--preset", "ci", "-DHDEM_HAS_WIDE_FLAGS=OFF", "-DHDEM_HAS_AVX2_FLAG=OFF"],    # without AVX2 either
    "O1-checks": ["--preset", "ci", "-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DHDEM_CHECKS=ON"],
    "x86-64-v3": ["--preset", "ci", "-DCMAKE_CXX_FLAGS=-march=x86-64-v3"],
    "clang": ["--preset", "ci", *CLANG],
    "clang-native": ["--preset", "release", *CLANG],
}


def tunnel_stages(*stages):
    return "stage=[" + ", ".join("{" + stage + "}" for stage in stages) + "]"


class Scene:
    """A case, its settings, and what its summary must say so that the scene is the one that is meant. `text` instead of a file."""

    def __init__(self, case, settings, shows, text=None):
        self.case, self.settings, self.shows, self.text = case, settings, shows, text

    def command(self, program, folder):
        case = self.case
        if self.text:
            case = folder.with_suffix(".toml")
            case.write_text(self.text, encoding="utf-8")
        sets = [word for setting in self.settings for word in ("--set", setting)]
        return [program, "run", case, "-o", folder, "--overwrite", "--quiet", "--threads", "1", *sets]


SCENES = {
    "tunnel": Scene(CASES / "ensemble/tunnel.toml", ["stage[0].cycles=2000", "stage[1].max_cycles=8000"],
                    lambda s: s["detached_blocks"] and s["energy"]["friction"] > 0),
    "paper": Scene(CASES / "paper_tunnel/tunnel.toml", ["contact.method=force", "stage[0].cycles=2000", "stage[1].max_cycles=6000"],
                   lambda s: s["energy"]["local_damping"] > 0),
    "static": Scene(CASES / "ensemble/tunnel.toml",
                    ["joint.default.friction_angle_deg=35",
                     tunnel_stages('until="converged", damping="default", solver="static", max_cycles=2000',
                                   'excavate=["tunnel"], until="converged", solver="static", max_cycles=2000')],
                    lambda s: all(stage["static_solution"]["outcome"] == "balanced" for stage in s["stages"])),
    "arch": Scene(CASES / "rest/known_arch.toml", [],
                  lambda s: s["detached_blocks"]),
    "slivers": Scene(CASES / "robust/slivers.toml", ["stage[1].cycles=6000"], lambda s: s["energy"]["impulse_loss"] > 0),
    "rubble": Scene(HERE / "rubble.toml", [], lambda s: s["energy"]["impulse_loss"] > 0 and s["energy"]["friction"] > 0),
    "rubble by impulses": Scene(HERE / "rubble.toml", ["contact.method=impulse"], lambda s: s["energy"]["impulse_loss"] > 0),
    "rubble by springs": Scene(HERE / "rubble.toml", ["contact.method=force"], lambda s: s["energy"]["impulse_loss"] == 0),
    "cavern": Scene(CASES / "cavern/cavern.toml", [tunnel_stages('excavate=["heading"], relax_cycles=300, until="converged", max_cycles=1500')],
                    lambda s: s["energy"]["insitu"] != 0 and s["energy"]["bond_breaking"] > 0),
    "supported": Scene(CASES / "cavern/supported.toml", [f"stage[{i}].{key}" for i in range(8) for key in ("relax_cycles=200", "max_cycles=500")],
                       lambda s: any(bolt["status"] == "yielded" for bolt in s["bolts"]) and s["liners"]),
    "mapped": Scene(CASES / "rockmass/mapped.toml", [], lambda s: len(s["joint_sets"]) > 2),
    "slope": Scene(CASES / "slope/slope.toml", ["stage[0].max_cycles=3000"], lambda s: s["energy"]["water"] != 0),
    **{f"random {number}": Scene(None, [], lambda s: True, scene_of(number).text) for number in range(10000, 10024, 2)},
    "hooks": Scene(HERE / "hooks.toml", [], lambda s: s["detached_blocks"] and s["energy"]["impulse_loss"] > 0),
}


def build(name, folder, jobs):
    """The program; what CMake and the compiler say goes to FOLDER/NAME.log."""
    log = folder / f"{name}.log"
    with log.open("w", encoding="utf-8") as out:
        for command in (["cmake", *BUILDS[name], "-B", folder / name, "-DHDEM_BUILD_TESTS=OFF", "-DHDEM_BUILD_PERF=OFF", "-DHDEM_WERROR=OFF"],
                        ["cmake", "--build", folder / name, "-j", str(jobs), "--target", "hdem"]):
            if subprocess.run(command, cwd=SOURCE, stdout=out, stderr=subprocess.STDOUT, check=False).returncode != 0:
                raise RuntimeError(f"{name} cannot be built, see {log}")
    return folder / name / "bin" / "hdem"


def run_scenes(program, folder, environment):
    """State hash by scene."""
    hashes = {}
    for scene in SCENES:
        results = folder / scene.replace(" ", "_")
        done = subprocess.run(SCENES[scene].command(program, results), env=os.environ | {"OMP_WAIT_POLICY": "passive"} | environment,
                              capture_output=True, text=True, check=False)
        if done.returncode not in (0, 4):  # 4: not converged within its cycles
            raise RuntimeError(f'scene "{scene}" of {program} ended with {done.returncode}: {done.stderr.strip()}')
        summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
        if not SCENES[scene].shows(summary):
            raise RuntimeError(f'scene "{scene}" of {program} does not show what it is there for, see {results}/summary.json')
        hashes[scene] = summary["state_hash"]
    return hashes


def differing(rows):
    """(build, scene) whose hash is not that of the first row."""
    reference = next(iter(rows.values()))
    return [(name, scene) for name, hashes in rows.items() for scene, value in hashes.items() if value != reference[scene]]


def show(name, hashes, reference, seconds):
    marks = " ".join(hashes[scene][:8] + (" " if hashes[scene] == reference[scene] else "!") for scene in SCENES)
    print(f"{name:22} {seconds[0]:6.0f} {seconds[1]:5.0f}  {marks}", flush=True)


def names_of(text):
    names = text.split(",")
    unknown = [name for name in names if name not in BUILDS]
    if unknown:
        raise argparse.ArgumentTypeError(f"unknown {', '.join(unknown)}; there are {', '.join(BUILDS)}")
    return names


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, default=SOURCE / "build" / "builds", help="folder of builds and runs")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers at once")
    parser.add_argument("--only", type=names_of, default=list(BUILDS), help="builds, behind commas; the first one is the reference")
    parser.add_argument("--list", action="store_true", help="print the builds and the scenes and exit")
    given = parser.parse_args()
    if given.list:
        print("\n".join([f"{name:16} {' '.join(BUILDS[name])}" for name in BUILDS] + ["", *SCENES]))
        return 0

    folder = given.output.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    print(f"{'build':22} {'built':>6} {'run':>5}  " + " ".join(f"{scene[-9:]:9}" for scene in SCENES))
    rows = {}
    for name in given.only:
        start = time.monotonic()
        program = build(name, folder, given.jobs)
        built = time.monotonic()
        for row, environment in ((name, {}),) + (((f"{name}, old machine", OLD_MACHINE),) if name == given.only[0] else ()):
            begun = time.monotonic()
            rows[row] = run_scenes(program, folder / f"{name}.runs", environment)
            show(row, rows[row], next(iter(rows.values())), (built - start, time.monotonic() - begun))
    found = differing(rows)
    for name, scene in found:
        print(f'differs: "{scene}" of {name}')
    print(f"{len(rows)} rows of {len(SCENES)} scenes, {len(found)} hashes differ from those of {next(iter(rows))}")
    return 3 if found else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except RuntimeError as error:
        print(f"compare_builds.py: {error}", file=sys.stderr)
        sys.exit(1)
