#!/usr/bin/python3
"""Fails when an include points up a layer, or in a circle.

    include_layers.py [ROOT]

Between folders: parallel and io stand on core, and not on each other; verification, perf and tools stand on all three, perf
also on verification/scenes. Inside core there are four floors (FLOOR); a file may include from its own floor and from those
below. Only core/stage/rules tests method, damping preset, solver and "until converged". Nothing that runs in cycles calls functions of libm
but the square root and those that are exact. OpenMP appears in parallel only, HDF5 nowhere below io.
"""
import re
import sys
from pathlib import Path

MAY_USE = {
    "core": {"core"},
    "parallel": {"core", "parallel"},
    "io": {"core", "io"},
    "verification/scenes": {"core", "parallel", "io", "verification/scenes"},
    "verification": {"core", "parallel", "io", "verification", "verification/scenes"},
    "perf": {"core", "parallel", "io", "perf", "verification/scenes"},
    "tools": {"core", "parallel", "io", "tools"},
}
FOLDERS = ("core", "parallel", "io", "verification", "perf", "tools")

# Floors of core, by folder or by file name without suffix; whatever is not named here is on the top floor.
FLOOR = {"types": 1, "simd": 1, "wide_pack": 1, "huge_pages": 1, "check": 1, "version": 1, "geometry": 2, "joint": 2, "model": 3, "state": 3}
TOP_FLOOR = 4

OPENMP = re.compile(r"^omp\.h$")
HDF5 = re.compile(r"^(hdf5.*|H5.*)\.h(pp)?$")
OUTSIDE_WORLD = re.compile(r"^(iostream|fstream|filesystem|fmt/.*|toml\+\+/.*|nlohmann/.*)$")
BANNED = {    # layer -> what its files may not include, and the reason
    "core": [(OPENMP, "OpenMP belongs to parallel"), (HDF5, "files belong to io"),
             (OUTSIDE_WORLD, "core knows no files, formats or console")],
    "parallel": [(HDF5, "files belong to io")],
    "io": [(OPENMP, "OpenMP belongs to parallel")],
    "verification/scenes": [(OPENMP, "OpenMP belongs to parallel")],
    "verification": [(OPENMP, "OpenMP belongs to parallel")],
    "perf": [(OPENMP, "OpenMP belongs to parallel")],
    "tools": [(OPENMP, "OpenMP belongs to parallel")],
}

# What follows from method, damping preset, solver and "until converged" is decided in core/stage/rules; the checks of what a file says test their range.
MODES = re.compile(r"(==|!=|\bcase)\s*(Method|DampingPreset|RestSolver)::|[.>]until_converged\b(?!\s*=[^=])")
MAY_TEST_MODES = ("core/stage/rules.h", "core/stage/rules.cpp")

# Each libm has other last digits. core/joint/functions.h, core/geometry/tangent.h and unit_direction.h have what a cycle needs.
LIBM = re.compile(r"\bstd::(a?(sin|cos|tan)h?|atan2|hypot|pow|cbrt|exp2?|expm1|log(2|10|1p)?|fma)\(")
IN_CYCLES = ("core/boundary/", "core/contact/", "core/detection/", "core/joint/", "core/motion/", "core/stage/", "core/statics/", "core/support/",
             "core/water/", "parallel/")
BEFORE_CYCLES = ("core/support/bolt_pattern.cpp",)

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')
PRAGMA_OMP = re.compile(r'^\s*#\s*pragma\s+omp\b|_Pragma\s*\(\s*"\s*omp\b')


def layer(path):
    """'core/rock/x.h' -> 'core'; the scenes are a layer of their own because perf may use them."""
    return "verification/scenes" if path.startswith("verification/scenes/") else path.split("/")[0]


def floor(path):
    """'core/types.h' -> 1, 'core/model/model.h' -> 3"""
    return FLOOR.get(path.split("/")[1].split(".")[0], TOP_FLOOR)


def problems_of_include(path, target, quoted, root):
    """Texts for one include of one file; target as it is written."""
    here = layer(path)
    if target.split("/")[0] not in FOLDERS:
        if quoted:
            yield "is not a path from the project root"
        for pattern, reason in BANNED[here]:
            if pattern.match(target):
                yield f"{reason}"
        return
    if not (root / target).exists():
        yield "does not exist"
    elif layer(target) not in MAY_USE[here]:
        yield f"{here} may not use {layer(target)}"
    elif here == "core" and floor(target) > floor(path):
        yield f"points up: floor {floor(path)} of core may not use floor {floor(target)}"


def find_cycle(edges):
    """A list of nodes that form a circle, or None. edges: node -> set of nodes."""
    done, trail = set(), []

    def visit(node):
        if node in trail:
            return trail[trail.index(node):] + [node]
        if node in done:
            return None
        trail.append(node)
        for following in sorted(edges.get(node, ())):
            if found := visit(following):
                return found
        trail.pop()
        done.add(node)
        return None

    for node in sorted(edges):
        if found := visit(node):
            return found
    return None


def find_problems(root):
    """All problems below root, and the number of files read."""
    problems, files, edges = [], 0, {}
    for folder in FOLDERS:
        for file in sorted((root / folder).rglob("*")):
            if file.suffix not in (".h", ".cpp"):
                continue
            files += 1
            path = file.relative_to(root).as_posix()
            if path.startswith("verification/consumer/"):
                continue    # a project of its own
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), start=1):
                if PRAGMA_OMP.search(line) and layer(path) != "parallel":
                    problems.append(f"{path}:{number}: OpenMP belongs to parallel")
                if layer(path) in ("core", "parallel", "io", "tools") and path not in MAY_TEST_MODES and MODES.search(line):
                    problems.append(f"{path}:{number}: modes are tested in core/stage/rules")
                if path.startswith(IN_CYCLES) and path not in BEFORE_CYCLES and (match := LIBM.search(line.split("//")[0])):
                    problems.append(f"{path}:{number}: {match[0][:-1]} has other last digits in other libraries; a cycle takes the square root alone")
                if not (match := INCLUDE.match(line)):
                    continue
                target = match[2]
                for text in problems_of_include(path, target, match[1] == '"', root):
                    problems.append(f"{path}:{number}: include of {target}: {text}")
                edges.setdefault(path, set()).add(target)
    if cycle := find_cycle(edges):
        problems.append(f"files include each other in a circle: {' -> '.join(cycle)}")
    return problems, files


def main(arguments):
    root = Path(arguments[0] if arguments else Path(__file__).parent.parent).resolve()
    problems, files = find_problems(root)
    print("\n".join(problems + [f"{files} files, {len(problems)} problems"]))
    if files == 0:
        print(f"{root} holds no sources")
    return 1 if problems or files == 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
