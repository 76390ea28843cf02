"""One table of all runs; medians, quartiles, shares that failed and histograms of it."""
import csv
import io
import itertools
import sys
from collections import Counter

from output_file import ELSEWHERE, write_output
from plain_text import one_line, printable
from run_lock import LOCK, is_running

from . import estimates, plans
from .common import BESIDE, CLAIMS, SweepError, flat, folder_of
from .criterion import Criterion
from .runs import summary_of
from .same_input import ForeignRun, inputs_of
from .work import told

STATE = "state"


def rows_of(folder, plan):
    rows = []
    for number, chosen in enumerate(plan["runs"], 1):
        row = {"run": number, **chosen, STATE: "missing"}
        of_run = folder_of(folder, number)
        try:
            summary = summary_of(folder, plan, number)
            row |= {name: value for name, value in flat(summary or {}).items() if name not in row}
            runs = is_running(of_run, LOCK) or is_running(folder / CLAIMS, of_run.name)
            row[STATE] = "running" if runs else "done" if summary is not None else "cut short" if of_run.exists() else "missing"
        except SweepError as error:
            state = "foreign" if isinstance(error, ForeignRun) else "damaged"
            if not any(other[STATE] == state for other in rows):    # the first one stands for all
                print(f"error: sweep: {one_line(error)}", file=sys.stderr)
            row[STATE] = state
        rows.append(row)
    return rows


def write_table(file, rows, columns=None, read=(), remedy=BESIDE):
    columns = columns or list(dict.fromkeys(itertools.chain.from_iterable(rows)))
    out = io.StringIO(newline="")
    writer = csv.DictWriter(out, columns, restval="")
    writer.writeheader()
    writer.writerows(rows)
    try:
        content = out.getvalue().encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        raise SweepError(f"{file}: cannot be written: a summary.json has a text that is none. Remove the damaged one, and run this again.") from None
    write_output(file, [content], read, remedy, into_streams=True)


def as_typed(row, varied):
    """Values of the plan are texts; where they are numbers they count as such."""
    def number(text):
        try:
            return float(text)
        except ValueError:
            return text
    return row | {key: number(row[key]) for key in varied}


class Study:
    """What is asked of the runs that are done."""

    def __init__(self, options, done, varied):
        self.options, self.varied = options, varied
        self.criterion = Criterion(options.fails) if options.fails else None
        self.done = [as_typed(row, varied) for row in done]
        if self.criterion:
            self.criterion.check_names(self.done)
        self.names = options.of or estimates.varying(self.done, {"run", *varied})
        for name in [*self.names, *options.histogram]:
            if self.done and not estimates.numbers_in(self.done, name):
                raise SweepError(f"{name}: no run has such a number. The columns of table.csv have their names.")
        if options.by is not None and options.by not in varied:
            raise SweepError(f"--by {options.by}: does not vary in this sweep. There are {', '.join(varied)}.")

    def groups(self):
        """Runs with the same value of --by, in its order; else all."""
        if self.options.by is None:
            return [({}, self.done)]
        values = {row[self.options.by] for row in self.done}
        ordered = sorted(values, key=lambda value: (isinstance(value, str), value))
        return [({self.options.by: value}, [row for row in self.done if row[self.options.by] == value]) for value in ordered]

    def spreads(self):
        rows = []
        for group, members in self.groups():
            for name in self.names:
                values = [value for value, _ in estimates.numbers_in(members, name)]
                if values:
                    rows.append(group | {"quantity": name} | estimates.spread_of(values))
        return rows

    def shares(self):
        """Shares that failed, and how many runs have no answer."""
        rows = []
        for group, members in self.groups():
            answers = [self.criterion.fails(row) for row in members]
            known = [answer for answer in answers if answer is not None]
            if known:
                share = estimates.share_of(sum(known), len(known), self.options.level)
                rows.append((group, share, len(answers) - len(known)))
        return rows

    def histogram(self, name):
        found = estimates.numbers_in(self.done, name)
        failed = [bool(self.criterion.fails(row)) for _, row in found] if self.criterion else None
        return estimates.histogram([value for value, _ in found], failed)


def tell_shares(study, folder):
    rows = []
    for group, share, unknown in study.shares():
        where = "".join(f"{key} = {value:g}: " if isinstance(value, float) else f"{key} = {value}: " for key, value in group.items())
        print(f"{printable(where)}{share}" + (f"; {unknown} runs have no such number" if unknown else ""))
        rows.append(group | {"criterion": str(study.criterion), "runs": share.runs, "failed": share.failed, "share": share.value, "low": share.low, "high": share.high,
                             "level": share.level, "without_answer": unknown})
    write_table(folder / "fails.csv", rows)
    return rows


def study(options, done, varied):
    """Files beside the table: statistics.csv, and where asked for fails.csv, fails.png, histogram_NAME.csv and .png."""
    asked = Study(options, done, varied)
    spreads = asked.spreads()
    if spreads:
        write_table(options.folder / "statistics.csv", spreads)
    for row in spreads if options.of else []:
        group = "".join(f"{key} = {row[key]}: " for key in ([options.by] if options.by else []))
        print(f"{printable(group + row['quantity'])}: median {row['median']:.6g}, quartiles {row['lower_quartile']:.6g} and {row['upper_quartile']:.6g}, {row['runs']} runs")
    shares = tell_shares(asked, options.folder) if options.fails else []
    if options.histogram or (options.by and len(shares) > 1):
        from . import figures    # matplotlib takes a while
        if options.by and len(shares) > 1:
            figures.draw_shares(shares, options.by, options.folder / "fails.png")
        for name in options.histogram:
            rows = asked.histogram(name)
            file = options.folder / f"histogram_{name}"
            write_table(file.with_name(file.name + ".csv"), rows)
            figures.draw_histogram(rows, name, str(asked.criterion or ""), file.with_name(file.name + ".png"))


def collect(options):
    plan = plans.read(options.folder)
    varied = list(plan["runs"][0]) if plan["runs"] else []
    rows = rows_of(options.folder, plan)
    table = options.output or options.folder / "table.csv"
    write_table(table, rows, list(dict.fromkeys(["run", *varied, STATE, *itertools.chain.from_iterable(rows)])), [options.folder / plans.PLAN, *inputs_of(plan)], ELSEWHERE)
    states = Counter(row[STATE] for row in rows)
    done = [row for row in rows if row[STATE] == "done"]
    del states["done"]
    late = sum(row.get("met_ends", row.get("converged")) is False for row in done)
    states = Counter({"of them not converged": late}) + states
    print(f"{printable(table)}: {len(done)} of {len(rows)} runs done" + (f", {told(states)}" if told(states) else ""))
    if options.fails or options.of or options.histogram or options.by:
        if not done:
            raise SweepError("no run is done yet: nothing can be said of them. Run some first.")
        study(options, done, varied)
    return 0 if len(done) == len(rows) else 1
