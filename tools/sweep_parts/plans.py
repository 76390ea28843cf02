"""The plan of a sweep: which values each run has."""
import itertools
import json
import math
import os
import random
import subprocess
from decimal import Decimal, InvalidOperation

from output_file import replace_file, written_to
from plain_text import check_values, one_line, printable, read_json

from . import designs, keys
from .common import FACTOR, SweepError, runs_in
from .criterion import Criterion
from .same_input import digest_of, files_of_plan

PLAN = "plan.json"
MOST_RUNS = 100000
COMMANDS = ("run", "fos")


def values_of(key, text):
    """1,2,5 as they are, also [0,1],[2,3]; 1:3 -> 1, 2, 3; 0:1:0.5 -> 0, 0.5, 1, without round-off."""
    if ":" not in text or set(text) & set("[{\"'"):
        return keys.parts_of(f"--vary {key}={text}", text)
    try:
        begin, end, step = (list(map(Decimal, text.split(":"))) + [Decimal(1)])[:3]
        count = int((end - begin) / step) + 1 if (end - begin) / step >= 0 else 0
    except (InvalidOperation, ZeroDivisionError, ValueError, OverflowError):
        count = 0
    if not 1 <= count <= MOST_RUNS or text.count(":") > 2:
        raise SweepError(f"--vary {key}={text}: not a range. Write from:to or from:to:step, at most {MOST_RUNS} values.")
    return [str(begin + i * step) for i in range(count)]


def split_key(option, text):
    key, equals, values = text.partition("=")
    if not equals or not key or not values:
        raise SweepError(f"{option} {text}: not KEY=VALUES. Write e.g. generator.seed=1:20.")
    return key, values


def require_different_values(key, values):
    """1, 1.0 and 1e0 are the same value."""
    seen = {}
    for text in values:
        value = keys.value_of(text)
        if isinstance(value, str) and as_number(value) is not None and value == text.strip():
            raise SweepError(f"--vary {key}: {text} is no number in TOML. Write it as in a case file, without zeros in front and with digits on both sides of the point.")
        same = (isinstance(value, bool), repr(value) if isinstance(value, (list, dict)) else value)
        if same in seen:
            what = "given twice" if seen[same] == text else f"the same value as {seen[same]}"
            raise SweepError(f"--vary {key}: {text} is {what}, and would count twice. Give each value once.")
        seen[same] = text


def combinations(varied):
    """Every value with every other: the grid."""
    lists = [values_of(key, values) for key, values in varied]
    for (key, _), values in zip(varied, lists):
        require_different_values(key, values)
    runs = [list(chosen) for chosen in itertools.islice(itertools.product(*lists), MOST_RUNS + 1)]
    if len(runs) > MOST_RUNS:
        raise SweepError(f"more than {MOST_RUNS} runs. Give fewer values.")
    return runs


def designed(options, varied):
    if options.runs is None or not 1 <= options.runs <= MOST_RUNS:
        raise SweepError(f"--design {options.design}: needs --runs, 1 to {MOST_RUNS}.")
    if options.design_seed < 0:
        raise SweepError(f"--design-seed {options.design_seed}: must be 0 or greater, e.g. 1.")
    return designs.sample(options.design, varied, options.runs, options.design_seed)


def bisection(options):
    """The chain of each run, or nothing."""
    if options.bisect is not None and options.command_of_hdem != "run":
        raise SweepError(f"--command {options.command_of_hdem}: cannot be bisected; it is a search itself.")
    if options.bisect is None:
        if options.fails or options.tolerance is not None:
            raise SweepError("--fails and --tolerance belong to --bisect here. Give --fails to work or collect.")
        return {}
    key, text = split_key("--bisect", options.bisect)
    low, high = designs.numbers_of(f"--bisect {options.bisect}", text.split(":"), 2)
    if not options.fails:
        raise SweepError("--bisect: needs --fails, e.g. --fails detached_blocks>0.")
    Criterion(options.fails)
    if low >= high or not options.tolerance or not 1e-12 * (high - low) <= options.tolerance <= high - low:
        raise SweepError(f"--bisect {options.bisect}: needs LOW below HIGH and a --tolerance between them.")
    return {"bisect": {"key": key, "low": low, "high": high, "tolerance": options.tolerance, "fails": options.fails}}


MOST_TEXTS = 50    # of one key that are tried; each costs a check


def as_number(value):
    try:
        number = float(value)
    except (TypeError, ValueError):
        return None
    return number if math.isfinite(number) else None


def extremes(keys, rows):
    """Numbers of the first run and of those in which a key has its least or its greatest number, or a text for the first time: a wrong value is among them."""
    tried = {0}
    for place, _ in enumerate(keys):
        values = [(as_number(row[place]), index) for index, row in enumerate(rows)]
        numbers = [(value, index) for value, index in values if value is not None]
        if numbers:
            least, greatest = min(value for value, _ in numbers), max(value for value, _ in numbers)
            tried |= {next(index for value, index in numbers if value == one) for one in (least, greatest)}
        texts = {}
        for value, index in values:
            if value is None:
                texts.setdefault(str(rows[index][place]), index)
        tried |= set(list(texts.values())[:MOST_TEXTS])
    return sorted(tried)


def try_run(options, number, values):
    """hdem's check of a run, where hdem is at hand: a misspelt key would else be found by all runs."""
    words = [word for key, value in values.items() for word in ("--set", f"{key}={value}")]
    try:
        done = subprocess.run([options.program, "check", options.case, *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    except OSError:
        return
    if done.returncode == 2:
        raise SweepError(f"hdem refuses run {number + 1}:", *done.stderr.strip().split("\n"))


def require_free(folder):
    if folder.exists() and not folder.is_dir():
        raise SweepError(f"-o {folder}: is a file. Give the name of a folder.")
    if (folder / PLAN).exists():
        raise SweepError(f"{folder / PLAN}: there is a plan already. Give another folder.")
    for old in runs_in(folder):
        raise SweepError(f"{old}: is a run of another plan, and would count as one of this plan. Give another folder.")


def require_different(names, document):
    """A value that varies under two names would have the last of them alone."""
    for one, other in itertools.combinations(names, 2):
        if keys.overlap(one, other, document):
            raise SweepError(f"{one}: varies twice" + (f", also by {other}" if other != one else "") + ". Give each key once.")


def content_of(plan):
    """The bytes of its file, which can be read again."""
    content = (json.dumps(plan, indent=1) + "\n").encode("utf-8")
    try:
        check_values(content)
    except ValueError as error:
        raise SweepError(f"the plan would have {error}. Give fewer runs or keys.") from None
    return content


def make(options):
    varied = [split_key("--vary", text) for text in options.vary]
    names = [key for key, _ in varied]
    chain = bisection(options)
    document = keys.document_of(options.case)
    require_different(names + [one["key"] for one in chain.values()], document)
    if not varied and not chain:
        raise SweepError("nothing varies. Give --vary KEY=VALUES.")
    if options.design is None and options.runs is not None:
        raise SweepError("--runs: belongs to --design. Without one all combinations are run.")
    rows = designed(options, varied) if options.design else combinations(varied)
    if not options.case.is_file():
        raise SweepError(f"{options.case}: no such file. Give a case.")
    require_free(options.output)
    for number in extremes(names, rows):
        try_run(options, number, dict(zip(names, rows[number])) | {one["key"]: one["low"] for one in chain.values()})
    with written_to(options.output):
        options.output.mkdir(parents=True, exist_ok=True)
    runs = [dict(zip(names, row)) for row in rows]
    case = options.case.resolve()
    plan = {"case": str(case), "case_sha256": digest_of(case), "files_sha256": files_of_plan(case, document, runs), "runs": runs, **chain}
    if options.command_of_hdem != "run":
        plan["command"] = options.command_of_hdem
    if options.design:
        plan["design"] = {"kind": options.design, "seed": options.design_seed}
    replace_file(options.output / PLAN, [content_of(plan)])
    print(f"{len(rows)} runs planned in {printable(options.output)}")
    return 0


def is_word(value):
    """Whether a program can be given it."""
    try:
        return isinstance(value, str) and b"\0" not in os.fsencode(value)
    except UnicodeEncodeError:
        return False


def is_chain(table):
    numbers = [table[name] for name in ("low", "high", "tolerance")]
    return is_word(table["key"]) and all(isinstance(number, (int, float)) and math.isfinite(number) for number in numbers) and all(map(is_word, table["fails"]))


def check(plan):
    """A ValueError, TypeError or KeyError where it is none that `make` has written."""
    if not isinstance(plan, dict):
        raise ValueError("not a table of values")
    if not is_word(plan["case"]) or command_of(plan) not in COMMANDS:
        raise ValueError("case or command is damaged")
    if not isinstance(plan["runs"], list) or not all(isinstance(chosen, dict) and chosen.keys() == plan["runs"][0].keys() for chosen in plan["runs"]):
        raise ValueError("runs are damaged")
    for number, chosen in enumerate(plan["runs"], 1):
        for key, value in chosen.items():
            if not is_word(key) or not is_word(value):
                raise ValueError(f"run {number}: {key} is no text that hdem takes")
    if not isinstance(plan.get("files_sha256", {}), dict) or "bisect" in plan and not is_chain(plan["bisect"]):
        raise ValueError("files_sha256 or bisect is damaged")


def read(folder):
    try:
        plan = read_json(folder / PLAN)
        check(plan)
        return plan
    except (OSError, ValueError, TypeError, KeyError) as error:
        raise SweepError(f"{folder / PLAN}: cannot be read ({one_line(error)}). Make it with `sweep plan`.") from None


def command_of(plan):
    return plan.get("command", "run")


def needs_of(plan):
    """The key without which a summary is not that of the whole run."""
    return FACTOR if command_of(plan) == "fos" else None


def order_of(plan):
    """Numbers of the runs in the order in which they are worked off, so that any first part of them stands for all: a grid is shuffled, always in the same way.
    Designs are in such an order as they are."""
    numbers = list(range(1, len(plan["runs"]) + 1))
    if "design" not in plan:
        random.Random(1).shuffle(numbers)
    return numbers
