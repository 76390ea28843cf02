"""The runs of a realisation: what is set in each of them, how hdem is called, what is kept for the next time."""
import hashlib
import json
import os
import subprocess
import threading
from dataclasses import dataclass, field
from pathlib import Path

from output_file import replace_file
from plain_text import read_json

DONE, NOT_CONVERGED, BAD_INPUT, INTERRUPTED = 0, 4, 2, (130, 143, -2, -15)    # what hdem ends with
KEPT = "ensemble.json"    # in a run's folder, written when the run is done

PUBLISHED_STEP = "time.step=5e-5"
PAPER = "stage[1].damping=paper"
STANDING = ["convergence.blocks=standing", "convergence.detached_distance=0.05"]    # what is loose has detached: it is not waited for
REFERENCE = "force"
VARIANTS = {
    REFERENCE: ["contact.method=force", PAPER, PUBLISHED_STEP],
    "hybrid_own_step": [],    # right after the reference, so that a busy minute meets both
    "hybrid": [PUBLISHED_STEP],
    "hybrid_matched": ["contact.restitution=0.333333333", PUBLISHED_STEP],
    "hybrid_paper": [PAPER, PUBLISHED_STEP],
    "force_standing": ["contact.method=force", PAPER, PUBLISHED_STEP, *STANDING],
    "hybrid_standing": [PUBLISHED_STEP, *STANDING],
}


class EnsembleError(Exception):
    """Told to the user in one line."""


class Interrupted(Exception):
    """A run was ended from outside."""


@dataclass(frozen=True, order=True)
class Geometry:
    seed: int
    dips: tuple    # of the three joint sets [deg]

    @property
    def name(self):
        return "_".join(f"{dip:g}" for dip in self.dips) + f"_seed_{self.seed}"

    @property
    def settings(self):
        return [f"generator.seed={self.seed}"] + [f"joint_set[{i}].dip_deg={dip:g}" for i, dip in enumerate(self.dips)]


@dataclass
class Outcome:
    """Of one run: its summary.json, or what it failed of."""
    folder: Path
    summary: dict = field(default_factory=dict)
    cpu_seconds: float = 0.0
    failure: str = ""

    @property
    def detached(self):
        return set(self.summary["detached_blocks"])

    def row(self):
        """What the ensemble's JSON holds of it."""
        if self.failure:
            return {"failure": self.failure}
        wanted = ("cycles_after_excavation", "converged", "time_step", "kinetic_energy", "kinetic_energy_limit", "mean_displacement",
                  "max_displacement", "detached_blocks", "wall_seconds")
        return {key: self.summary[key] for key in wanted} | {"cpu_seconds": self.cpu_seconds, "convergence_seconds": self.convergence_seconds}

    @property
    def convergence_seconds(self):
        """On the wall, of the stage after the excavation."""
        return self.summary["stage_wall_seconds"][-1]


def digest(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


class Runner:
    """Calls hdem, at most once for the same program, case and settings in the same folder."""

    def __init__(self, program, case, folder, more=()):
        self.program, self.case, self.folder, self.more = Path(program), case, folder, list(more)
        try:
            told = subprocess.run([self.program, "--version"], capture_output=True, text=True, check=False)
            self.identity = {"program": digest(self.program), "case": digest(case)}    # a version is told by uncommitted changes too
        except OSError as error:
            raise EnsembleError(f"{program}: cannot be run ({error.strerror}). Build it, or give it with --program or the variable HDEM.") from None
        self.version = told.stdout.split("\n")[0]
        if told.returncode != 0 or not self.version.startswith("hdem "):
            raise EnsembleError(f"{program}: not hdem. Give it with --program or the variable HDEM.")
        self.lock = threading.Lock()
        self.running = set()
        self.is_stopped = False

    def run(self, geometry, variant, max_cycles):
        folder = self.folder / geometry.name / f"{variant}_{max_cycles}"
        settings = geometry.settings + VARIANTS[variant] + [f"stage[1].max_cycles={max_cycles}"] + self.more
        key = self.identity | {"settings": settings}
        return self.kept(folder, key) or self.fresh(folder, key)

    @staticmethod
    def kept(folder, key):
        try:
            kept, summary = read_json(folder / KEPT), read_json(folder / "summary.json")
            return Outcome(folder, summary, kept["cpu_seconds"]) if kept["key"] == key else None
        except (OSError, ValueError, TypeError, KeyError):    # to be run again
            return None

    def fresh(self, folder, key):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / KEPT).unlink(missing_ok=True)
        (folder / "summary.json").unlink(missing_ok=True)
        words = [self.program, "run", self.case, "-o", folder, "--overwrite", "--quiet", "--threads", "1"]
        code, cpu_seconds, said = self.call(words + [word for setting in key["settings"] for word in ("--set", setting)], folder)
        if code in INTERRUPTED:
            raise Interrupted
        if code == BAD_INPUT:
            raise EnsembleError(f"{self.program} refuses a run of the ensemble: {said}. Give an hdem of this version.")
        if code not in (DONE, NOT_CONVERGED):
            return Outcome(folder, failure=said or f"hdem ended with {code}")
        summary = read_json(folder / "summary.json")
        replace_file(folder / KEPT, [json.dumps({"key": key, "cpu_seconds": cpu_seconds}, indent=1), "\n"], "give the same line again when it can be written")
        return Outcome(folder, summary, cpu_seconds)

    def call(self, words, folder):
        """Exit code, processor time [s], and the last line of what was said."""
        with (folder / "errors.txt").open("w+", encoding="utf-8") as errors:
            with self.lock:
                if self.is_stopped:
                    raise Interrupted
                process = subprocess.Popen(words, stdout=errors, stderr=errors)
                self.running.add(process)
            _, status, usage = os.wait4(process.pid, 0)    # says what this one process has used
            process.returncode = os.waitstatus_to_exitcode(status)
            with self.lock:
                self.running.discard(process)
            errors.seek(0)
            said = errors.read().strip().split("\n")[-1]
        return process.returncode, usage.ru_utime + usage.ru_stime, said

    def stop(self):
        """Ends what runs, and lets nothing begin."""
        with self.lock:
            self.is_stopped = True
            for process in self.running:
                process.terminate()
