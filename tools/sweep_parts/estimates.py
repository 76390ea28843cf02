"""Numbers of many runs: medians and quartiles, the share that failed with its interval, histograms. By scipy and numpy."""
from dataclasses import dataclass

from needed_modules import need

from .common import SweepError
from .criterion import number_of

MOST_BINS = 60
SPREAD = ("runs", "mean", "standard_deviation", "least", "lower_quartile", "median", "upper_quartile", "greatest")


@dataclass(frozen=True)
class Share:
    """Of runs that failed, with Wilson's interval."""
    failed: int
    runs: int
    low: float
    high: float
    level: float

    @property
    def width(self):
        return self.high - self.low

    @property
    def value(self):
        return self.failed / self.runs

    def __str__(self):
        return f"{self.failed} of {self.runs} failed, {self.value:.3f}; {100 * self.level:g} % interval {self.low:.3f} to {self.high:.3f}"


def share_of(failed, count, level):
    """[Wilson1927] E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209-212: right also for few runs, and for none or all that fail."""
    need("scipy")
    from scipy.stats import binomtest
    if count < 1:
        raise SweepError("no run has an outcome yet: there is no share of failed ones. Run some first.")
    if not 0.0 < level < 1.0:
        raise SweepError(f"--level {level:g}: must be between 0 and 1, e.g. 0.95.")
    interval = binomtest(failed, count).proportion_ci(confidence_level=level, method="wilson")
    return Share(failed, count, float(interval.low), float(interval.high), level)


def spread_of(values):
    """Row of SPREAD. Quartiles lie between two runs where they must, in proportion (numpy's default)."""
    need("numpy")
    import numpy as np
    low, lower, median, upper, high = np.quantile(values, (0.0, 0.25, 0.5, 0.75, 1.0))
    deviation = np.std(values, ddof=1) if len(values) > 1 else ""
    return dict(zip(SPREAD, (len(values), np.mean(values), deviation, low, lower, median, upper, high)))


def numbers_in(rows, name):
    """Values of a quantity and the rows they are of; those without one are left out."""
    found = [(number_of(row.get(name)), row) for row in rows]
    return [(value, row) for value, row in found if value is not None]


def varying(rows, left_out):
    """Names of all quantities that are numbers and not the same in all runs."""
    names = dict.fromkeys(name for row in rows for name in row)
    return [name for name in names if name not in left_out and len({value for value, _ in numbers_in(rows, name)}) > 1]


def bins_of(values):
    """Edges by the rule of Freedman and Diaconis or that of Sturges, whichever gives more bins; whole numbers that are few have one bin each."""
    need("numpy")
    import numpy as np
    values = np.asarray(values, dtype=float)
    low, high = values.min(), values.max()
    if np.all(values == np.round(values)) and high - low < MOST_BINS:
        return np.arange(low - 0.5, high + 1.0)
    edges = np.histogram_bin_edges(values, "auto")
    return edges if len(edges) <= MOST_BINS + 1 else np.linspace(low, high, MOST_BINS + 1)


def histogram(values, failed):
    """Rows from, to, runs, failed. `failed`: one per value, or None where there is no criterion."""
    import numpy as np
    edges = bins_of(values)
    counts = np.histogram(values, edges)[0]
    rows = [{"from": a, "to": b, "runs": int(count)} for a, b, count in zip(edges, edges[1:], counts)]
    if failed is not None:
        of_failed = np.histogram([value for value, fails in zip(values, failed) if fails], edges)[0]
        for row, count in zip(rows, of_failed):
            row["failed"] = int(count)
    return rows
