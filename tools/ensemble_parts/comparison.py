"""Each hybrid run beside the force-based one of its geometry; medians, quartiles and the worst over the ensemble."""
import statistics

from profiles import stress_difference
from runs import REFERENCE, VARIANTS

SAME_STEP = ("hybrid", "hybrid_matched", "hybrid_paper", "force_standing", "hybrid_standing")    # as the reference has: only there do cycles compare
BESIDE = {"hybrid_standing": "force_standing"}    # others: the reference
GREATER_IS_BETTER = ("reduction", "wall_speedup", "whole_run_speedup", "cpu_speedup")


def compare(name, reference, other):
    """None when one of the two failed."""
    if reference.failure or other.failure:
        return None
    first, second = reference.summary, other.summary
    found = {} if name not in SAME_STEP else {"reduction": 1.0 - second["cycles_after_excavation"] / first["cycles_after_excavation"]}
    return found | {
        "converged": second["converged"],
        "wall_speedup": reference.convergence_seconds / other.convergence_seconds,
        "whole_run_speedup": first["wall_seconds"] / second["wall_seconds"],
        "cpu_speedup": reference.cpu_seconds / other.cpu_seconds,
        "displacement_difference_mm": 1e3 * abs(second["mean_displacement"] - first["mean_displacement"]),
        "max_displacement_difference_mm": 1e3 * abs(second["max_displacement"] - first["max_displacement"]),
        "same_detached": other.detached == reference.detached,
        "stress_difference": stress_difference(reference, other),
    }


def realisation(trial):
    """One entry of the JSON's list."""
    against = lambda name: trial.runs[BESIDE.get(name, REFERENCE)]    # noqa: E731
    return {
        "seed": trial.geometry.seed,
        "dips_deg": list(trial.geometry.dips),
        "runs": {name: run.row() for name, run in trial.runs.items()},
        "against_force": {name: compare(name, against(name), run) for name, run in trial.runs.items() if name != REFERENCE},
    }


def discard(trial):
    """What was found in a geometry that does not belong to the ensemble."""
    return {"seed": trial.geometry.seed, "dips_deg": list(trial.geometry.dips), "reason": trial.reason, "force": trial.runs[REFERENCE].row()}


def collapse(trial):
    reference = trial.runs[REFERENCE]
    row = {"seed": trial.geometry.seed, "dips_deg": list(trial.geometry.dips), "reason": trial.reason,
           "runs": {name: run.row() for name, run in trial.runs.items()}, "shared_detached": {}}
    for name, run in trial.runs.items():
        if name == REFERENCE or run.failure or reference.failure:
            continue
        either = run.detached | reference.detached
        row["shared_detached"][name] = len(run.detached & reference.detached) / len(either) if either else 1.0
    return row


def spread(quantity, values):
    """Median, quartiles and the worst of what is known."""
    if not values:
        return {"count": 0, "median": None, "quartiles": None, "worst": None}
    quartiles = statistics.quantiles(values, n=4, method="inclusive") if len(values) > 1 else 3 * values
    return {"count": len(values), "median": statistics.median(values), "quartiles": [quartiles[0], quartiles[2]],
            "worst": min(values) if quantity in GREATER_IS_BETTER else max(values)}


def over_all(rows, name):
    """Of one kind of hybrid run: a spread by quantity, and shares of realisations."""
    found = [row["against_force"][name] for row in rows if row["against_force"][name]]
    quantities = [quantity for quantity, value in found[0].items() if not isinstance(value, bool)] if found else []
    share = lambda key: statistics.mean(one[key] for one in found) if found else None    # noqa: E731
    return {quantity: spread(quantity, [one[quantity] for one in found if one[quantity] is not None]) for quantity in quantities} | {
        "converged_fraction": share("converged"), "same_detached_fraction": share("same_detached")}


def summary(version, accepted, discarded, collapses):
    """All of the JSON. The figures at its top are those of the hybrid method as hdem runs it by default."""
    rows = [realisation(trial) for trial in accepted]
    statistic = {name: over_all(rows, name) for name in VARIANTS if name != REFERENCE}
    of = lambda name, quantity, which="median": statistic[name].get(quantity, {}).get(which)    # noqa: E731
    return {
        "hdem": version,
        "realisations": rows,
        "median_reduction_paper_pairing": of("hybrid", "reduction"),
        "worst_reduction_paper_pairing": of("hybrid", "reduction", "worst"),
        "median_reduction_matched_pairing": of("hybrid_matched", "reduction"),
        "median_wall_speedup": of("hybrid_own_step", "wall_speedup"),
        "median_whole_run_speedup": of("hybrid_own_step", "whole_run_speedup"),
        "median_cpu_speedup": of("hybrid_own_step", "cpu_speedup"),
        "median_displacement_difference_mm": of("hybrid", "displacement_difference_mm"),
        "same_detached_fraction": statistic["hybrid"]["same_detached_fraction"],
        "median_stress_difference": of("hybrid", "stress_difference"),
        "statistics": statistic,
        "settings": VARIANTS,
        "discards": [discard(trial) for trial in discarded],
        "collapses": [collapse(trial) for trial in collapses],
    }


def failures(found):
    """Runs of the ensemble and of the collapses that did not come to an end."""
    return [f"seed {row['seed']}, dips {row['dips_deg']}, {name}: {run['failure']}"
            for row in found["realisations"] + found["collapses"] for name, run in row["runs"].items() if "failure" in run]
