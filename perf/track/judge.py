"""Which changes count: sure figures by their last step, timings by rank."""
from dataclasses import dataclass, replace
from statistics import median

from scipy.stats import mannwhitneyu

RECENT, BEFORE, LEAST_BEFORE = 5, 28, 10    # nights
SIGNIFICANCE = 1e-3
LEAST_CHANGE = 0.03


@dataclass(frozen=True)
class Metric:
    """`kind`: "sure" (not touched by how busy the machine is; a step above `tolerance` counts at once), "timing" (by rank), "shown" (not judged)."""

    unit: str
    kind: str
    text: str
    tolerance: float = 0.0
    smaller_is_better: bool = True


METRICS = {
    "instructions": Metric("", "sure", "instructions of a thousand cycles (callgrind)", 0.01),
    "cycles": Metric("", "sure", "cycles to convergence"),
    "bytes_per_block": Metric("B", "sure", "memory a block", 0.03),
    "cpu_operations_per_point": Metric("", "timing", "operations that the processor could have done in its time for one contact point, one thread"),
    "machine_operations_per_point": Metric("", "shown", "operations that the machine could have done in the time of one contact point"),
    "ns_per_contact_point": Metric("ns", "shown", "time a contact point and cycle"),
    "roofline_share": Metric("", "shown", "share of the roofline", smaller_is_better=False),
    "bytes_per_second": Metric("B/s", "shown", "triad of the machine", smaller_is_better=False),
    "flops_per_second": Metric("1/s", "shown", "operations of the machine", smaller_is_better=False),
    "wall_time": Metric("s", "shown", "wall time"),
}


@dataclass(frozen=True)
class Verdict:
    status: str           # "worse", "better", "suspect" (worse, but alone), "same", "short" (too few nights), "shown"
    change: float = 0.0   # of the median, or of the last value
    p: float = 1.0
    before: float = 0.0   # what the change is counted from

    @property
    def is_alarm(self):
        return self.status == "worse"


def named(metric, change, p, before):
    worse = (change > 0.0) == metric.smaller_is_better
    return Verdict("worse" if worse else "better", change, p, before)


def relative(value, before):
    return value / before - 1.0 if before else (0.0 if value == before else 1.0)


def by_step(metric, values):
    """A sure figure against the night before."""
    if len(values) < 2:
        return Verdict("short")
    change = relative(values[-1], values[-2])
    return named(metric, change, 0.0, values[-2]) if abs(change) > metric.tolerance else Verdict("same", change, 1.0, values[-2])


def by_rank(metric, values):
    """Mann-Whitney of the last 5 nights against up to 28 before: a shift of less than 3 % of the median does not count, however sure."""
    recent, before = values[-RECENT:], values[-RECENT - BEFORE:-RECENT]
    if len(before) < LEAST_BEFORE:
        return Verdict("short")
    change = relative(median(recent), median(before))
    p = 1.0 if len(set(recent + before)) == 1 else float(mannwhitneyu(recent, before, alternative="two-sided").pvalue)
    counts = abs(change) > LEAST_CHANGE and p < SIGNIFICANCE
    return named(metric, change, p, median(before)) if counts else Verdict("same", change, p, median(before))


def judge(series):
    """The verdict on the last night of a series by itself."""
    metric = METRICS[series.metric]
    values = series.values[series.begin:]
    if metric.kind == "shown":
        return Verdict("shown")
    if metric.kind == "timing":
        return by_rank(metric, values)
    step = by_step(metric, values)
    drift = by_rank(metric, values)
    return drift if step.status in ("same", "short") and drift.status in ("worse", "better") else step


def judge_night(all_series):
    """(series, verdict) of all that was measured. Of many timings one may look worse by chance: alone, its p must be below 1e-3 for all of them together."""
    judged = [(series, judge(series)) for series in all_series]
    timings = [verdict for series, verdict in judged if METRICS[series.metric].kind == "timing" and verdict.status not in ("short", "shown")]
    is_alone = sum(verdict.is_alarm for verdict in timings) < 2

    def confirmed(series, verdict):
        by_chance = METRICS[series.metric].kind == "timing" and verdict.is_alarm and is_alone and verdict.p * len(timings) >= SIGNIFICANCE
        return replace(verdict, status="suspect") if by_chance else verdict
    return [(series, confirmed(series, verdict)) for series, verdict in judged]
