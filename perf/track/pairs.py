"""Two benchmarks by turns: ratios within a pair of runs, their median and its interval."""
import random
from statistics import median
from typing import NamedTuple

import measure
from scipy.stats import binom

LEAST_PAIRS = 7
LEVEL = 0.95
WALL = "ns_per_contact_point"


class Side(NamedTuple):
    """A benchmark of a program."""
    program: str
    name: str


class Pair(NamedTuple):
    """What is compared under the name `case`."""
    case: str
    now: Side
    then: Side


class Interval(NamedTuple):
    low: float
    middle: float
    high: float


def judged_metric(case):
    """Machine operations a contact point: by processor time on one thread, as other work counts least in that; by the clock on several."""
    return "cpu_operations_per_point" if case.endswith("/1") else "machine_operations_per_point"


def measured(side, repetitions):
    """The median row of one process."""
    rows = measure.run(side.program, f"^{side.name}/", f"--benchmark_repetitions={repetitions}").rows
    wanted = (judged_metric(side.name), WALL)
    if any(metric not in row for row in rows for metric in wanted):
        raise measure.MeasureError(f"{side.program}: {side.name} does not print {' and '.join(wanted)}. It is too old to be compared with.")
    return {metric: median(row[metric] for row in rows) for metric in wanted} | {"hash": {row["state_hash"] for row in rows if "state_hash" in row}}


class Measured:
    """All runs of a pair: costs by metric, one a run, in the order of the pairs; the hashes of the states at the end."""

    def __init__(self, pair):
        self.pair = pair
        self.costs = {side: {judged_metric(pair.case): [], WALL: []} for side in ("now", "then")}
        self.hashes = {"now": set(), "then": set()}

    def add(self, side, row):
        self.hashes[side] |= row["hash"]
        if len(self.hashes[side]) > 1:
            raise measure.MeasureError(f"{getattr(self.pair, side).program}: {self.pair.case}: its runs end in different states. No figure of this run can be used.")
        for metric, values in self.costs[side].items():
            values.append(row[metric])

    def ratios(self, metric):
        """Cost of now over cost of then, pair by pair."""
        return [a / b for a, b in zip(self.costs["now"][metric], self.costs["then"][metric])]

    def has_same_answers(self):
        """None where a program prints no hash."""
        return self.hashes["now"] == self.hashes["then"] if self.hashes["now"] and self.hashes["then"] else None


def run(pairs, count, repetitions, say, order):
    """Each of `count` rounds runs all pairs in a random order, and of a pair first the one or the other side: a busy minute meets both alike."""
    found = [Measured(pair) for pair in pairs]
    for number in range(1, count + 1):
        for entry in order.sample(found, len(found)):
            say(f"round {number} of {count}: {entry.pair.case}")
            for side in order.sample(["now", "then"], 2):
                entry.add(side, measured(getattr(entry.pair, side), repetitions))
    return found


def random_order(seed=None):
    return random.Random(seed)


def interval(values):
    """Median and its interval by the sign test: from the k-th least to the k-th greatest value, k as great as leaves at least 95 % between. Exact, whatever
    the values' distribution; a few runs that something else disturbed do not move it. 9 pairs leave out one at either end, 7 none."""
    rank = int(binom.ppf(0.5 * (1.0 - LEVEL), len(values), 0.5))
    if rank < 1:
        raise ValueError(f"{len(values)} values have no interval of {LEVEL:.0%}")
    ordered = sorted(values)
    return Interval(ordered[rank - 1], median(ordered), ordered[-rank])


def verdict(ratio, allowed):
    """Of a cost now over then; `allowed` of a loss is no alarm."""
    if ratio.low > 1.0:
        return "slower" if ratio.middle > 1.0 + allowed else "slower, as allowed"
    if ratio.high < 1.0:
        return "faster"
    return "same" if 1.0 - allowed <= ratio.low and ratio.high <= 1.0 + allowed else "cannot tell"


def bar_verdict(share, bar):
    """Of a speed over the yardstick's."""
    if share.low >= bar:
        return "met"
    return "missed" if share.high < bar else "cannot tell"
