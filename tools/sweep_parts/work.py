"""Work off a plan: many runs at a time, shared with other workers, until all are done or enough is known."""
import errno
import fcntl
import os
import stat
import threading
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial

from . import estimates, plans, runs
from .common import CLAIMS, DONE, SweepError, flat, folder_of, read_summary
from .criterion import Criterion
from .same_input import require_same_input

STRANGE = (errno.ENXIO, errno.ELOOP, errno.EISDIR, errno.EEXIST, errno.ENOTDIR)    # a pipe or a socket, a link, a folder; in place of the folder a file


def open_claim(file):
    """Its descriptor. Only a file that lies there itself is opened; a pipe is not waited for."""
    try:
        file.parent.mkdir(exist_ok=True)
        descriptor = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_CLOEXEC | os.O_NONBLOCK | os.O_NOFOLLOW, 0o666)
        if stat.S_ISREG(os.fstat(descriptor).st_mode):
            return descriptor
        os.close(descriptor)
        wrong = file
    except OSError as error:
        if error.errno not in STRANGE:
            raise
        wrong = error.filename
    raise SweepError(f"{wrong}: not what a worker has made. Remove it.")


@contextmanager
def claim(sweep, number):
    """Yields the open file of the claim, or None where the run belongs to another worker. The lock ends with this worker and with the hdem that it starts, however they end.
    Where a file system has no locks hdem's own refusal has to do."""
    descriptor = open_claim(sweep / CLAIMS / f"run_{number:06d}")
    held = descriptor
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        held = None
    except OSError:
        pass
    try:
        yield held
    finally:
        os.close(descriptor)


class Enough:
    """Whether the share of failed runs is known well enough.

    Only the runs from the first on in the plan's order count, up to the first that is still missing. Runs that fail may take longer than others: with all that are done
    by now the share would be that of the fast ones.
    """

    def __init__(self, options, summary_of):
        self.summary_of = summary_of    # number -> summary, or None before the end of the run
        self.width, self.at_least, self.level = options.until_width, options.at_least, options.level
        self.criterion = Criterion(options.fails)
        if self.width is not None and not options.fails:
            raise SweepError("--until-width: needs --fails, e.g. --fails detached_blocks>0.")
        if self.width is not None and not 0.0 < self.width < 1.0:
            raise SweepError(f"--until-width {self.width:g}: must be between 0 and 1.")
        self.known, self.share = {}, None

    def answer(self, number):
        if number not in self.known:
            summary = self.summary_of(number)
            if summary is None:
                return None
            row = flat(summary)
            self.criterion.check_names([row])
            self.known[number] = self.criterion.fails(row)
        return self.known[number]

    def reached(self, order):
        if self.width is None:
            return False
        answers = []
        for number in order:
            answer = self.answer(number)
            if answer is None:
                break
            answers.append(answer)
        if len(answers) < max(self.at_least, 1):
            return False
        self.share = estimates.share_of(sum(answers), len(answers), self.level)
        return self.share.width <= self.width


class Worker:
    def __init__(self, options, plan):
        self.options, self.plan = options, plan
        self.order = plans.order_of(plan)
        self.enough = Enough(options, partial(runs.summary_of, options.folder, plan))
        self.start = runs.Starter(options.program, options.for_hdem, apart=True)
        self.lock, self.waiting = threading.Lock(), iter(self.order)
        self.codes, self.elsewhere, self.stopped, self.error = [], 0, False, None

    def next(self):
        """The number of a run to look at, or None."""
        with self.lock:
            if self.start.stopped_by is not None or self.error:
                return None
            self.stopped = self.stopped or self.enough.reached(self.order)
            return None if self.stopped else next(self.waiting, None)

    def take(self, number):
        with claim(self.options.folder, number) as held:
            if held is not None:
                return runs.run_one(self.options.folder, self.plan, number, partial(self.start.run, keeps=(held,)))
        self.elsewhere += 1
        return None

    def work(self):
        """One of several threads; each waits for one run at a time."""
        try:
            while (number := self.next()) is not None:
                code = self.take(number)
                if code is not None:
                    self.codes.append(code)
        except (SweepError, OSError, ValueError) as error:
            self.error = self.error or error

    def report(self):
        counts = Counter(map(runs.what_did, self.codes))
        counts["with another worker"] = self.elsewhere
        left = sum(read_summary(folder_of(self.options.folder, number), plans.needs_of(self.plan)) is None for number in self.order)
        print(f"{len(self.order)} runs: {told(counts) or 'none looked at'}; {left} without an outcome")
        if self.stopped:
            print(f"enough is known: {self.enough.share}, no wider than {self.options.until_width:g}")


def told(counts):
    return ", ".join(f"{count} {what}" for what, count in counts.items() if count)


def work(options):
    """Exit code: the worst of the runs of this worker; 0 when it stopped because enough is known."""
    if options.jobs < 1:
        raise SweepError(f"--jobs {options.jobs}: must be at least 1.")
    plan = plans.read(options.folder)
    require_same_input(options.folder, plan, options.for_hdem)
    worker = Worker(options, plan)
    worker.start.listen()
    with ThreadPoolExecutor(options.jobs) as pool:
        for _ in range(options.jobs):
            pool.submit(worker.work)
    if worker.error:
        raise worker.error
    worker.report()
    if worker.start.stopped_by is not None:
        return 128 + worker.start.stopped_by
    code = runs.worst(worker.codes)
    return DONE if worker.stopped and runs.what_did(code) == "not converged" else code
