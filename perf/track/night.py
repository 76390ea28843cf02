"""One night's measurements: a set of benchmarks in several processes, and what is sure once."""
import datetime
import re
from collections import defaultdict
from statistics import median

import measure
from judge import METRICS

# counted: as perf/gate; timed: names of benchmarks, matched against hdem_perf; converging: exact cycles, one thread.
SETS = {
    "full": {
        "counted": ["counted/wall/force", "counted/voronoi/hybrid", "counted/joints/impulse", "counted/pile/hybrid"],
        "converging": "^converge/(static|dynamic)/.*/1/",
        "timed": "^(machine/|cycle/wall/10000/.*/[12]/|cycle/(voronoi|joints)/10000/hybrid/[12]/|cycle/wall/100000/hybrid/[12]/|"
                 "converge/tunnel/hybrid/[12]/|box2d/wall/10000/)",
    },
    "quick": {
        "counted": ["counted/wall/force", "counted/pile/hybrid"],
        "converging": "^converge/(static|dynamic)/.*/1/",
        "timed": "^(machine/flops/|cycle/(wall|voronoi)/10000/(force|hybrid)/[12]/)",
    },
    "short": {
        "counted": ["counted/wall/force"],
        "converging": "^converge/static/.*/1/",
        "timed": "^(machine/flops/1|cycle/wall/1000/(force|hybrid)/1/)",
    },
}
CYCLE_METRICS = ("cpu_operations_per_point", "machine_operations_per_point", "ns_per_contact_point", "roofline_share", "bytes_per_block")


def split(name):
    """cycle/wall/10000/hybrid/2 -> its case, 2 threads."""
    found = re.fullmatch(r"((?:cycle|converge|machine)/.*)/(\d+)", name)
    return (found[1], int(found[2])) if found else (name, 1)


def figures(row):
    """Metrics of a timed benchmark."""
    case, _ = split(row["name"])
    if case.startswith("machine/"):
        wanted = ("bytes_per_second",) if case.endswith("triad") else ("flops_per_second",)
    elif case.startswith("box2d/"):
        wanted = ("ns_per_contact_point",)
    else:
        wanted = CYCLE_METRICS
    found = {metric: row[metric] for metric in wanted if metric in row}
    if case.startswith("converge/"):
        found |= {"cycles": row["cycles"], "wall_time": 1e-3 * row["real_time"]}
    return found


def check_hashes(hashes):
    """A speed counts only when all processes and all numbers of threads end in the same state."""
    for case, found in hashes.items():
        if len(found) > 1:
            raise measure.MeasureError(f"{case}: {len(found)} different states at the end of the same run. No figure of this night is kept.")


def timed(program, names, processes, say, figures=figures):
    """(case, threads, metric) -> values, one a process, of the metrics that `figures` takes from a row; and the last process's output."""
    values, hashes = defaultdict(list), defaultdict(set)
    for number in range(1, processes + 1):
        say(f"timings, process {number} of {processes}")
        output = measure.run(program, names)
        for row in output.rows:
            case, threads = split(row["name"])
            if "state_hash" in row:
                hashes[case].add(row["state_hash"])
            for metric, value in figures(row).items():
                values[case, threads, metric].append(value)
    check_hashes(hashes)
    return values, output


def measured(program, which, processes, machine, say):
    """Records of this night."""
    chosen = SETS[which]
    values, output = timed(program, chosen["timed"], processes, say)
    say("cycles to convergence")
    for row in measure.run(program, chosen["converging"]).rows:
        values[(*split(row["name"]), "cycles")] = [row["cycles"]]
    for name in chosen["counted"] if measure.has_valgrind() else ():
        say(f"instructions, {name}")
        values[name, 1, "instructions"] = [measure.count_instructions(program, name)[0]]
    date = datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="milliseconds")
    return [{"date": date, "commit": output.commit, "machine": machine, "case": case, "threads": threads, "metric": metric,
             "unit": METRICS[metric].unit, "value": middle, "n": len(found), "spread": median(abs(value - middle) for value in found), "build": output.build}
            for (case, threads, metric), found in values.items() for middle in [median(found)]]
