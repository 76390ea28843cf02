"""The ensemble as text."""
UNKNOWN = "-"
QUANTITIES = {    # name in the JSON: (heading, factor, digits)
    "reduction": ("fewer cycles [%]", 100.0, 1),
    "wall_speedup": ("wall speed-up after the excavation", 1.0, 2),
    "whole_run_speedup": ("wall speed-up of the whole run", 1.0, 2),
    "cpu_speedup": ("processor speed-up of the whole run", 1.0, 2),
    "displacement_difference_mm": ("mean displacement differs by [mm]", 1.0, 4),
    "max_displacement_difference_mm": ("max displacement differs by [mm]", 1.0, 4),
    "stress_difference": ("stress along profiles differs by [%]", 100.0, 2),
}
STANDING_TITLES = {"force_standing": "force-based", "hybrid_standing": "hybrid, R = 0.1, against that"}
TITLES = {"hybrid": "hybrid, R = 0.1", "hybrid_matched": "hybrid, R = 1/3", "hybrid_own_step": "hybrid, own step", "hybrid_paper": "hybrid as published"}


def aligned(heading, rows):
    """Columns as wide as they need to be."""
    cells = [heading] + [[str(cell) for cell in row] for row in rows]
    widths = [max(len(row[i]) for row in cells) for i in range(len(heading))]
    return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(row, widths)).rstrip() for row in cells)


def number(value, factor=1.0, digits=1):
    return UNKNOWN if value is None else f"{factor * value:.{digits}f}"


def dips(row):
    return "/".join(f"{dip:g}" for dip in row["dips_deg"])


def cycles(run):
    """With a mark when the run did not come to rest."""
    return UNKNOWN if "failure" in run else str(run["cycles_after_excavation"]) + ("" if run["converged"] else "+")


def detached(run):
    return UNKNOWN if "failure" in run else len(run["detached_blocks"])


def of_run(run, key, factor=1.0, digits=1):
    return number(run.get(key), factor, digits)


def realisations(rows):
    heading = ["seed", "dips", "force", "hybrid", "matched", "published", "fewer %", "match. %", "publ. %", "force s", "own s", "speed-up", "whole", "detached", "same",
               "mean mm", "diff mm", "max mm", "diff mm", "stress %"]
    lines = []
    for row in rows:
        runs, against = row["runs"], {name: found or {} for name, found in row["against_force"].items()}
        force, own, hybrid = runs["force"], against["hybrid_own_step"], against["hybrid"]
        lines.append([row["seed"], dips(row), cycles(force), *(cycles(runs[name]) for name in ("hybrid", "hybrid_matched", "hybrid_paper")),
                      *(number(against[name].get("reduction"), 100.0) for name in ("hybrid", "hybrid_matched", "hybrid_paper")),
                      of_run(force, "convergence_seconds", digits=2), of_run(runs["hybrid_own_step"], "convergence_seconds", digits=2), number(own.get("wall_speedup"), digits=2),
                      number(own.get("whole_run_speedup"), digits=2), f"{detached(force)}|{detached(runs['hybrid'])}",
                      {True: "yes", False: "no"}.get(hybrid.get("same_detached"), UNKNOWN),
                      of_run(force, "mean_displacement", 1e3, 3), number(hybrid.get("displacement_difference_mm"), digits=4),
                      of_run(force, "max_displacement", 1e3, 3), number(hybrid.get("max_displacement_difference_mm"), digits=4),
                      number(hybrid.get("stress_difference"), 100.0, 2)])
    return aligned(heading, lines)


def spread(found, factor, digits):
    """median (quartile to quartile) worst"""
    if not found or not found["count"]:
        return UNKNOWN
    low, high = (number(value, factor, digits) for value in found["quartiles"])
    return f"{number(found['median'], factor, digits)} ({low} to {high}) {number(found['worst'], factor, digits)}"


def spreads(statistics, titles):
    """One column a kind of run."""
    lines = [[heading, *(spread(statistics[name].get(quantity), factor, digits) for name in titles)]
             for quantity, (heading, factor, digits) in QUANTITIES.items()]
    lines += [[heading, *(number(statistics[name][key], 100.0, 0) for name in titles)]
              for key, heading in (("same_detached_fraction", "the same blocks detached [%]"), ("converged_fraction", "at rest in the end [%]"))]
    return aligned(["", *titles.values()], lines)


def discards(rows):
    if not rows:
        return "Discarded geometries: none"
    counts = {}
    for row in rows:
        counts[dips(row)] = counts.get(dips(row), 0) + 1
    lines = [[row["seed"], dips(row), row["reason"]] for row in rows]
    return (f"Discarded geometries: {len(rows)} ({', '.join(f'{count} with {name}' for name, count in counts.items())})\n"
            + aligned(["seed", "dips", "reason"], lines))


def collapses(rows, limit):
    lines = []
    for row in rows:
        for name, run in row["runs"].items():
            lines.append([row["seed"], dips(row), name, cycles(run), detached(run), number(row["shared_detached"].get(name), 100.0),
                          of_run(run, "kinetic_energy"), of_run(run, "kinetic_energy_limit"), of_run(run, "wall_seconds", digits=2)])
    heading = ["seed", "dips", "run", "cycles", "detached", "shared %", "kinetic J", "rest below J", "wall s"]
    return f"Collapses, to at most {limit} cycles\n" + aligned(heading, lines)


def all_of(found, collapse_cycles):
    return "\n\n".join([
        f"{len(found['realisations'])} realisations, {found['hdem']}; cycles after the excavation, + not at rest by then",
        realisations(found["realisations"]),
        "Against the force-based run: median (quartiles) worst\n" + spreads(found["statistics"], TITLES),
        "Ended as soon as the rock still standing is at rest\n" + spreads(found["statistics"], STANDING_TITLES),
        discards(found["discards"]),
        collapses(found["collapses"], collapse_cycles),
    ])
