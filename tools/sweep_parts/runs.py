"""One run of a plan: begun, gone on with, or left alone because it is done."""
import signal
import subprocess

from . import chains
from .plans import command_of, needs_of
from .same_input import require_own_values
from .common import DONE, INTERRUPTED, NOT_CONVERGED, SweepError, folder_of, read_summary


class Starter:
    """Starts hdem. With `apart` a run has a session of its own: signals reach it through stop() alone, and once."""

    def __init__(self, program, for_hdem, apart=False):
        self.program, self.for_hdem, self.apart = program, for_hdem, apart
        self.running, self.told, self.stopped_by = set(), {}, None

    def run(self, words, keeps=()):
        """hdem's exit code. It gets the files `keeps` too: a lock on them stays as long as hdem lives, also where this program is killed."""
        if self.stopped_by is not None:
            return 128 + self.stopped_by
        try:
            process = subprocess.Popen([self.program, *words, *self.for_hdem], start_new_session=self.apart, pass_fds=keeps)
        except OSError as error:
            raise SweepError(f"{self.program}: cannot be run ({error}). Build it, or give it with --program or the variable HDEM.") from None
        self.running.add(process)
        if self.stopped_by is not None:    # it came while the process was born
            self.tell(process)
        code = process.wait()
        self.running.discard(process)
        return code if code >= 0 else 128 - code

    def tell(self, process):
        """Once only: hdem writes a checkpoint at the first signal, and ends without one at the second."""
        me = object()
        if self.told.setdefault(process, me) is me:
            process.send_signal(self.stopped_by)

    def listen(self):
        """From now on signals stop it."""
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(number) is not signal.SIG_IGN:    # nohup: go on
                signal.signal(number, self.stop)

    def stop(self, number, _frame=None):
        """A handler of signals. A run that is not apart hears of the first one itself: from the terminal, or from SLURM."""
        passes_on = self.apart or self.stopped_by is not None
        self.stopped_by = number
        for process in list(self.running) if passes_on else []:
            self.tell(process)


FIRST_STEP = "step_01"    # of a chain


def summary_of(sweep, plan, number):
    """That of a run with the values of the plan; None before its end."""
    folder = folder_of(sweep, number)
    require_own_values(folder / FIRST_STEP if "bisect" in plan else folder, plan["runs"][number - 1])
    return read_summary(folder, needs_of(plan))


def met_ends(summary):
    """Did every stage meet an end of its `until`? In folders of older versions `converged` says it."""
    return summary.get("met_ends", summary.get("converged", True))


def exit_code_of(folder, needs=None):
    """That of a run that is done; None for all others."""
    summary = read_summary(folder, needs)
    return None if summary is None else DONE if met_ends(summary) else NOT_CONVERGED


def run_in(folder, plan, values, start):
    """hdem's exit code; what is done is left alone. `start`: Starter.run, or the like."""
    require_own_values(folder, values)
    known = exit_code_of(folder, needs_of(plan))
    if known is not None:
        return known
    command = command_of(plan)
    if command == "run" and (folder / "checkpoint.h5").exists():    # fos goes on with the same words
        return start(["run", "--restart", str(folder)])
    return start([command, plan["case"], "-o", str(folder), *(word for key, value in values.items() for word in ("--set", f"{key}={value}"))])


def run_one(sweep, plan, number, start):
    """Exit code of a run, or of a chain of them."""
    folder, values = folder_of(sweep, number), plan["runs"][number - 1]
    if "bisect" not in plan:
        return run_in(folder, plan, values, start)
    require_own_values(folder / FIRST_STEP, values)
    known = exit_code_of(folder)
    if known is not None:
        return known
    return chains.follow(folder, plan["bisect"], lambda step, chosen: run_in(step, plan, values | chosen, start))


def what_did(code):
    return {DONE: "done", NOT_CONVERGED: "not converged"}.get(code, "interrupted" if code in INTERRUPTED else "failed")


def worst(codes):
    """Of an interruption, else of a failure, else of a run that did not converge."""
    return max(codes, key=lambda code: (("done", "not converged", "failed", "interrupted").index(what_did(code)), code), default=DONE)
