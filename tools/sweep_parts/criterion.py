"""What counts as failed: comparisons of numbers of summary.json, as the user writes them."""
import difflib
import math
import operator
import re
from dataclasses import dataclass

from .common import SweepError

FORM = re.compile(r"\s*([^\s<>=]+)\s*(<=|>=|<|>|=)\s*([^\s<>=]+)\s*")
COMPARE = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "=": operator.eq}
GREATEST = 1e150    # its square is a number, too
TRUTH = {"true": 1.0, "false": 0.0}


@dataclass(frozen=True)
class Comparison:
    name: str
    sign: str
    bound: float

    def holds(self, row):
        """None where the run has no such number."""
        value = number_of(row.get(self.name))
        return None if value is None else COMPARE[self.sign](value, self.bound)


def number_of(value):
    """A number, with 1 for true; None for texts, nothing, and what is not finite or beyond all that is measured."""
    if isinstance(value, (bool, int, float)) and abs(value) < GREATEST:    # false also for what is no number
        return float(value)
    return None


def read(text):
    """One comparison, e.g. detached_blocks>2, converged=false, energy.friction>1e4."""
    match = FORM.fullmatch(text)
    if not match:
        raise SweepError(f"--fails {text}: not NAME>NUMBER. Write e.g. detached_blocks>0 or converged=false; there are < <= > >= =.")
    name, sign, bound = match.groups()
    try:
        value = TRUTH[bound] if bound in TRUTH else float(bound)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise SweepError(f"--fails {text}: {bound} is not a number. Write a number, true or false.")
    return Comparison(name, sign, value)


class Criterion:
    """A run has failed when one of the comparisons holds."""

    def __init__(self, texts):
        self.texts = list(texts)
        self.comparisons = [read(text) for text in self.texts]

    def __str__(self):
        return " or ".join(self.texts)

    def check_names(self, rows):
        """A name that no run knows is a misprint, and not a criterion that never holds. `rows`: of runs that are done."""
        known = {name for row in rows for name, value in row.items() if number_of(value) is not None}
        for comparison in self.comparisons:
            if rows and comparison.name not in known:
                near = difflib.get_close_matches(comparison.name, known, 3)
                hint = f"Did you mean {', '.join(near)}?" if near else f"There are {', '.join(sorted(known))}."
                raise SweepError(f"{comparison.name}: no run has such a number in its summary.json. {hint}")

    def fails(self, row):
        """True or false; None where a number is missing and no other comparison holds."""
        answers = [comparison.holds(row) for comparison in self.comparisons]
        return True if True in answers else None if None in answers else False
