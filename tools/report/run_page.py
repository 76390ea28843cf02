"""The page of one run: summary, pictures, histories, energies, timing, provenance as one HTML file."""
import math
from html import escape

import numpy as np

import run_figures
from hdem_io import ResultError, open_run
from plot_factor import SEARCHES, factor_of
from shell import anchor, card, document, number

# of summary.json, what it is, unit
OUTCOME = [("method", "contact method", ""), ("cycles", "cycles", ""), ("cycles_after_excavation", "cycles after the excavation", ""),
           ("time", "simulated time", "s"), ("time_step", "time step", "s"), ("paper_time_step", "time step of Eq. (32)", "s"),
           ("blocks", "blocks at the end", ""), ("free_blocks", "of them free", ""), ("smallest_block_mass", "mass of the smallest free block", "kg/m"),
           ("contact_points", "closed contact points", ""), ("kinetic_energy", "kinetic energy", "J"), ("kinetic_energy_limit", "its limit", "J"),
           ("unbalanced_force_ratio", "unbalanced force ratio", ""), ("mean_displacement", "mean displacement next to the excavation, without detached blocks", "m"),
           ("max_displacement", "greatest displacement next to the excavation, without detached blocks", "m"), ("mean_displacement_all", "mean displacement of all free blocks", "m"),
           ("max_displacement_all", "greatest displacement of all free blocks", "m"), ("state_hash", "hash of the final state", "")]
NEXT_TO = ("mean_displacement", "max_displacement")    # the excavation, without detached blocks; of all free blocks in a run that excavates nothing
# term of the ledger -> what it is, +1 put in, -1 taken out, 0 stored at the end
LEDGER = {"initial": ("stored at the start", 1), "insitu": ("stored in joints by in-situ stress at the start", 1), "gravity_work": ("work of gravity", 1),
          "load_work": ("work of loads and prescribed motions", 1), "boundary": ("work of tractions and walls at the sides", 1), "water": ("work of water pressures", 1),
          "support": ("work of bolts and linings", 1),
          "position_correction": ("put in by the position correction", 1), "dilation": ("of slip: given back against the normal force", 1),
          "friction": ("spent by slip of springs", -1), "bond_breaking": ("freed by bonds that break", -1), "local_damping": ("spent by local damping", -1),
          "global_damping": ("spent by global damping", -1), "impulse_loss": ("spent by impulses", -1),
          "contact_changes": ("taken by changes of contacts", -1), "property_changes": ("taken by changed stiffness and density", -1),
          "removed": ("gone with removed blocks", -1), "kinetic_energy": ("kinetic", 0),
          "elastic_normal": ("in normal springs", 0), "elastic_shear": ("in shear springs", 0), "driven_kinetic": ("kinetic, of blocks that move as prescribed", 0)}
# what else the page takes from summary.json, and its kind
SUMMARY = {"stages": list, "warnings": list, "converged": bool, "max_displacement": float, "wall_seconds": float, "cycles": float,
           "contact_point_updates_per_second": float}
STAGE = {"name": str, "cycles": float, "until_converged": bool, "converged": bool}
YES_OR_NO = {True: "yes", False: "no", None: "–"}
BALANCE = {1: "put in", -1: "taken out", 0: "stored at the end"}


def check_summary(summary):
    """An empty one is that of a run which has not ended."""
    wanted = [("", summary, SUMMARY if summary else {})]
    wanted += [("stages: ", stage, STAGE) for stage in (summary.get("stages") if isinstance(summary.get("stages"), list) else [])]
    for where, found, kinds in wanted:
        for key, kind in kinds.items():
            value = found.get(key) if isinstance(found, dict) else None
            is_right = isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value) if kind is float else isinstance(value, kind)
            if not is_right:
                raise ResultError(f"summary.json: {where}{key} = {str(value)[:50]} is not what a run writes. Remove the file, or run the case again.")
    for key, _, unit in OUTCOME:
        if summary and unit and summary.get(key) is not None and not (isinstance(summary[key], (int, float)) and math.isfinite(summary[key])):
            raise ResultError(f"summary.json: {key} = {str(summary[key])[:50]} is not a number. Remove the file, or run the case again.")


def cell(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    return number(value) if isinstance(value, (int, float)) or value is None else escape(str(value))


def facts(rows):
    """Two columns: what, and its value with its unit."""
    return ('<div class="wide"><table class="facts"><tbody>'
            + "".join(f'<tr><th>{escape(what)}</th><td>{cell(value)}{" " + escape(unit) if unit else ""}</td></tr>' for what, value, unit in rows)
            + "</tbody></table></div>")


def folded(title, text):
    return f"<details><summary>{escape(title)}</summary><pre>{escape(text)}</pre></details>"


def section(title, body):
    return f'<section id="{anchor(title)}"><h2>{escape(title)}</h2>{body}</section>' if body else ""


def outcome_card(summary, state):
    if state != "done" or not summary:
        return card("open", {"running": "goes on", "interrupted": "was interrupted"}.get(state, "has not ended"), "missed")
    if not summary.get("met_ends", summary["converged"]):
        late = [stage for stage in summary["stages"] if has_met_end(stage) is False]
        if not late or any(stage["until_converged"] for stage in late):
            return card("not converged", "within its limit of cycles", "missed")
        return card("end not reached", f'stage "{escape(late[0]["name"])}" came to max_cycles first', "missed")
    if any(stage["until_converged"] and stage["converged"] for stage in summary["stages"]):
        return card("converged", "every stage that should", "met")
    return card("done", "every stage reached its end" if any(map(has_met_end, summary["stages"])) else "every stage ran as long as asked for", "met")


def has_met_end(stage):
    """None for a stage that has no `until`."""
    by = stage.get("ended_by")
    if by is None:    # in folders of older versions
        return stage["converged"] if stage["until_converged"] else None
    return None if by in ("cycles", "duration") else by != "max_cycles"


def duration(seconds):
    minutes, hours = int(seconds + 0.5) // 60, int(seconds + 0.5) // 3600
    return f"{seconds:.1f} s" if minutes == 0 else f"{minutes} min {int(seconds + 0.5) % 60:02d} s" if hours == 0 else f"{hours} h {minutes % 60:02d} min"


def metres(value):
    return f"{1e3 * value:.3g} mm" if abs(value) < 1.0 else f"{value:.3g} m"


def head(run, summary, last):
    title = last["info"]["title"] or run.provenance()["case_file"]
    where = run.provenance()
    cards = outcome_card(summary, run.state()) + card(len(last["id"]), "blocks") + card(f'{last["info"]["cycle"]:,}'.replace(",", "\u202f"), "cycles")
    cards += card(int(np.count_nonzero(last["detached"])), "detached blocks")
    if summary:
        cards += "".join(card(value, what) for what, value, _ in outcome(summary) if what.startswith("greatest displacement"))
        cards += card(duration(summary["wall_seconds"]), "wall time")
    note = {"running": "The run goes on.", "interrupted": "The run was interrupted; <code>hdem run --restart</code> goes on with it."}.get(
        run.state(), "" if summary else "summary.json is missing.")
    note = f'<p class="note">{note} The page shows what there is.</p>' if note else ""
    return (f'<header id="top"><h1>{escape(title)}</h1><p class="note">{escape(where["case_file"])}, hdem {escape(where["hdem_version"])}, '
            f'{escape(where["begin"])}</p>{note}<div class="cards">{cards}</div></header>')


def outcome(summary):
    """Rows of what the summary has; of a run without excavation nothing is next to one."""
    rows = [(key, what, summary[key], unit) for key, what, unit in OUTCOME if summary.get(key) is not None]
    if summary.get("cycles_after_excavation") is None:
        rows = [row for row in rows if row[0] not in NEXT_TO]
    return [(what, metres(value) if unit == "m" else value, "" if unit == "m" else unit) for _, what, value, unit in rows]


def stages(summary):
    rows = "".join(f'<tr><td>{escape(stage["name"])}</td><td class="n">{number(stage["cycles"])}</td>'
                   f'<td>{escape(str(stage.get("ended_by", "")))}</td>'
                   f'<td>{YES_OR_NO[has_met_end(stage)]}</td></tr>' for stage in summary["stages"])
    return f'<div class="wide"><table><thead><tr><th>stage</th><th class="n">cycles</th><th>ended by</th><th>reached its end</th></tr></thead><tbody>{rows}</tbody></table></div>'


def summary_section(summary, last):
    names = [str(name) for name in last["name"][last["detached"].astype(bool)]]
    detached = [("detached blocks", ", ".join(names[:60]) + (" ..." if len(names) > 60 else "") or "none", "")]
    if not summary:
        return facts(detached)
    warnings = "".join(f'<p class="missed">{escape(str(text))}</p>' for text in summary["warnings"])
    return warnings + stages(summary) + facts(outcome(summary) + detached)


def bracket_text(bracket):
    if not isinstance(bracket, dict):
        return "not looked for"
    low, high = bracket.get("stable_at"), bracket.get("failed_at")
    if low is None or high is None:
        return "nothing fails" if high is None else "fails at any strength"
    return f"{0.5 * (low + high):.4f}: {low:.4f} stands, {high:.4f} fails"


def factor_section(run, summary):
    """Of `hdem fos`; empty for other runs."""
    factor = factor_of(summary)
    if factor is None:
        return ""
    rows = [("factor of safety", bracket_text(factor), ""), ("with peak strength throughout", bracket_text(factor.get("peak")), ""),
            ("with stiffer joints", bracket_text(factor.get("stiffer")), ""), ("bound by limit analysis", str(factor.get("bound_text", "")), ""),
            ("blocks that fail first", ", ".join(map(str, factor.get("failing_blocks", []))) or "none", "")]
    warnings = "".join(f'<p class="missed">{escape(str(text))}</p>' for text in factor.get("warnings", []))
    trials = "".join(f'<tr><td>{escape(SEARCHES[t["search"]][0])}</td><td class="n">{t["factor"]:.4f}</td><td>{escape(t["verdict"])}</td>'
                     f'<td class="n">{number(t["cycles"])}</td><td class="n">{metres(t["displacement"])}</td><td>{escape(t["reason"])}</td></tr>' for t in factor["trials"])
    table = ('<div class="wide"><table><thead><tr><th>trial</th><th class="n">F</th><th>verdict</th><th class="n">cycles</th><th class="n">moved</th><th>why</th></tr></thead>'
             f"<tbody>{trials}</tbody></table></div>")
    failure = run.folder / "failure"
    picture = run_figures.picture(open_run(failure), "displacement", "Blocks that fail, hatched: displacement in the failing trial of the least factor", []) if (failure / "results.h5").exists() else ""
    return warnings + facts(rows) + f'<div class="pictures">{run_figures.factor_picture(run, "Displacement against the factor")}{picture}</div>' + table


def ledger(run):
    """Every term at the last sample, its share of all that was put in, and what is left over."""
    table = run.energy()
    if not len(table["time"]):
        return ""
    terms = {name: float(table[name][-1]) for name in LEDGER if name in table}
    everything = sum(abs(value) for name, value in terms.items() if LEDGER[name][1] == 1) or 1.0

    def row(kind, what, value):
        share = 100.0 * value / everything
        bar = f'<span class="bar" style="width:{min(abs(share), 100.0):.2f}%"></span>'
        return (f'<tr><td>{kind}</td><td class="what">{escape(what)}</td><td class="n">{number(float(f"{value:.5g}"))}</td>'
                f'<td class="n">{number(float(f"{share:.3g}"))} %</td><td class="share">{bar}</td></tr>')
    rows = "".join(row(BALANCE[sign], LEDGER[name][0], terms[name]) for sign in (1, -1, 0) for name in terms if LEDGER[name][1] == sign)
    rows += row("left over", "residual: what the ledger cannot explain", float(table["residual"][-1]))
    return ('<div class="wide"><table><thead><tr><th></th><th>term</th><th class="n">energy [J]</th><th class="n">of all put in</th><th></th></tr></thead>'
            f"<tbody>{rows}</tbody></table></div>" + run_figures.ledger_curves(run))


def thread_rows(summary):
    """How many threads cycles ran on; nothing in folders of older versions."""
    use = summary.get("thread_use", {"rule": "fixed"})
    try:
        if use["rule"] == "fixed":
            return []
        shares = ", ".join(f"{100 * float(share):.3g} % on {int(threads)}" for threads, share in use["share_of_cycles"].items())
        changes = ", ".join(f'{int(change["threads"])} from cycle {int(change["cycle"])}' for change in use["changes"][:8])
        more = f' and {len(use["changes"]) - 8} more changes' if len(use["changes"]) > 8 else ""
        return [("threads of the cycles", shares, ""), ("chosen", changes + more, "")]
    except (AttributeError, KeyError, TypeError, ValueError, OverflowError) as error:
        raise ResultError(f"summary.json: thread_use = {str(use)[:50]} is not what a run writes. Remove the file, or run the case again.") from error


def timing(summary, where, log):
    rows = [("threads, at most", int(where["threads"]), ""), ("processor", where["cpu"], "")]
    if summary:
        rows += thread_rows(summary)
        seconds = max(summary["wall_seconds"], 1e-9)
        rows += [("wall time", duration(seconds), ""), ("speed", float(f'{summary["cycles"] / seconds:.4g}'), "cycles/s"),
                 ("contact-point updates", float(f'{1e-6 * summary["contact_point_updates_per_second"]:.4g}'), "million/s")]
    return facts(rows) + (folded("run.log: rows with the speed at each moment", log) if log else "")


def provenance(where):
    dirty = ", sources changed since" if where["git_dirty"] else ""
    rows = [("hdem", where["hdem_version"], ""), ("commit", where["git_commit"] + dirty, ""), ("compiler", where["compiler"], ""), ("flags", where["flags"], ""),
            ("build", where["build_type"], ""), ("processor", where["cpu"], ""), ("host", where["hostname"], ""), ("begin", where["begin"], ""),
            ("end", where["end"] or "not reached", ""), ("seed", int(where["seed"]), ""), ("case file", where["case_file"], ""),
            ("its SHA-256", where["case_sha256"], ""), ("set besides", "; ".join(where["overrides"]) or "nothing", ""),
            ("command line", " ".join(where["command_line"]), ""), ("environment", "; ".join(where["environment"]) or "no OMP_ variables", "")]
    return facts(rows) + folded("The case file", where["case_text"])


def pictures(run):
    views = [("displacement", "Displacement since the stage began", [])]
    if len(run.blocks("last")["outline"]):
        views.append(("displacement", "The same, around the excavation", ["--excavation"]))
    views += [("stress", "Mean stress of the blocks, from their contact forces", []),
              ("regime", "Regime of the blocks, and their contact forces", ["--contacts"] if run.has_contacts() else [])]
    return f'<div class="pictures">{"".join(run_figures.picture(run, *view) for view in views)}</div>'


def build(run, summary, log):
    """HTML of a run (hdem_io.Run); summary.json as dict and run.log as text, {} and "" where they are missing."""
    if not run.frames:
        raise ResultError(f"{run.folder}: holds no frames yet")
    check_summary(summary)
    last, where = run.blocks("last"), run.provenance()
    first = str(run.frames[0].number)
    parts = {"Summary": summary_section(summary, last),
             "Factor of safety": factor_section(run, summary),
             "Model": run_figures.picture(run, "material", "Model at the start", ["--frame", first]),
             "Displacement and stress": pictures(run),
             "Histories": run_figures.convergence(run) + "".join(run_figures.history(run, name) for name in run.histories),
             "Energy ledger": ledger(run),
             "Timing": timing(summary, where, log),
             "Provenance": provenance(where)}
    parts = {title: body for title, body in parts.items() if body}
    contents = '<a class="home" href="#top">Top</a>' + "".join(f'<a href="#{anchor(title)}">{escape(title)}</a>' for title in parts)
    return document(f'hdem: {last["info"]["title"] or where["case_file"]}', contents,
                    head(run, summary, last) + "".join(section(title, body) for title, body in parts.items()))
