"""A chain of runs that closes in on the value of a key at which failing begins: each run's outcome chooses the next value.

The runs of a chain are in the folders step_01, step_02, ... of its run. Which values they have follows from the outcomes alone, so a chain that was cut short goes on with
the same steps. Its summary.json has

    critical    middle of the last bracket, or null where both ends do the same
    stands_at, fails_at    the ends of the bracket
    bracket     "found", "stands at both ends" or "fails at both ends"
    not_converged    steps that count as standing although max_cycles ended them before they were at rest: blocks may still have been on their way
"""
import json

from needed_modules import need
from output_file import replace_file

from .common import DONE, GO_ON, NOT_CONVERGED, SUMMARY, SweepError, flat, read_summary
from .criterion import Criterion


class CutShort(Exception):
    """A step did not come to its end; `code` is its exit code."""

    def __init__(self, code):
        super().__init__(code)
        self.code = code


class Steps:
    """Whether rock fails at a value: +1 or -1, by a run."""

    def __init__(self, folder, chain, run):
        self.folder, self.key, self.run = folder, chain["key"], run
        self.criterion = Criterion(chain["fails"])
        self.known = []    # (value, does it fail?)
        self.not_converged = 0

    def __call__(self, value):
        written = float(f"{value:.10g}")
        folder = self.folder / f"step_{len(self.known) + 1:02d}"
        folder.mkdir(parents=True, exist_ok=True)
        code = self.run(folder, {self.key: f"{written:.10g}"})
        if code not in (DONE, NOT_CONVERGED):
            raise CutShort(code)
        row = flat(read_summary(folder) or {})
        self.criterion.check_names([row])
        fails = self.criterion.fails(row)
        if fails is None:
            raise SweepError(f"{folder / SUMMARY}: has no number for --fails {self.criterion}.")
        self.known.append((written, fails))
        self.not_converged += not fails and code == NOT_CONVERGED
        return 1.0 if fails else -1.0

    def outcome(self):
        stands, fails = ([value for value, failed in self.known if failed is which] for which in (False, True))
        if not stands or not fails:
            return {"critical": None, "stands_at": None, "fails_at": None, "bracket": f"{'fails' if fails else 'stands'} at both ends"}
        low, high = min(((a, b) for a in stands for b in fails), key=lambda pair: abs(pair[0] - pair[1]))
        return {"critical": 0.5 * (low + high), "stands_at": low, "fails_at": high, "bracket": "found"}


def follow(folder, chain, run):
    """Exit code: that of a step that did not end, else 0 where a bracket was found and 4 where there is none."""
    need("scipy")
    from scipy.optimize import bisect
    steps = Steps(folder, chain, run)
    try:
        bisect(steps, chain["low"], chain["high"], xtol=chain["tolerance"], disp=False)
    except CutShort as cut:
        return cut.code
    except ValueError:
        if len(steps.known) != 2 or steps.known[0][1] is not steps.known[1][1]:    # scipy asks for two different ends
            raise
    outcome = steps.outcome()
    found = outcome["bracket"] == "found"
    summary = outcome | {"key": chain["key"], "steps": len(steps.known), "not_converged": steps.not_converged, "converged": found}
    replace_file(folder / SUMMARY, [json.dumps(summary, indent=1), "\n"], GO_ON)
    return DONE if found else NOT_CONVERGED
