"""Which geometries belong to the ensemble: the force-based run alone says so, seeds are taken in order."""
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import dataclass

from runs import REFERENCE, VARIANTS, Geometry

# Dips of the three joint sets [deg].
ORIENTATIONS = [(25, 75, -55), (20, 70, -60), (30, 80, -50), (35, 85, -45)]
COLLAPSING = (15, 75, -65)    # most of its geometries collapse
FEWEST_DETACHED, MOST_DETACHED = 1, 15
MAX_CYCLES = 300000
COLLAPSE_CYCLES = 60000
COLLAPSE_RUNS = (REFERENCE, "hybrid", "hybrid_matched")
SEEDS_PER_PLACE = 20    # give up after this many for each realisation that is wanted


def turned(dips, angle):
    """The same joint sets with all dips turned, again within -90 and 90 degrees."""
    return tuple((dip + angle + 90) % 180 - 90 for dip in dips)


class TooFew(Exception):
    """Told to the user in one line."""


@dataclass
class Trial:
    """A geometry, its runs by name, and why it does not belong to the ensemble."""
    geometry: Geometry
    runs: dict
    reason: str = ""

    @property
    def is_collapse(self):
        reference = self.runs[REFERENCE]
        return bool(self.reason) and not reference.failure and (len(reference.detached) > MOST_DETACHED or not reference.summary["converged"])


def reason_against(reference):
    """Empty for a geometry that belongs to the ensemble."""
    if reference.failure:
        return f"run failed: {reference.failure}"
    reasons = []
    count = len(reference.detached)
    if count < FEWEST_DETACHED:
        reasons.append("no block detached")
    if count > MOST_DETACHED:
        reasons.append(f"{count} blocks detached")
    if not reference.summary["converged"]:
        reasons.append(f"not converged within {MAX_CYCLES} cycles")
    return ", ".join(reasons)


def tried(runner, geometry):
    """Whether a geometry belongs to the ensemble: the reference alone says so."""
    trial = Trial(geometry, {REFERENCE: runner.run(geometry, REFERENCE, MAX_CYCLES)})
    trial.reason = reason_against(trial.runs[REFERENCE])
    return trial


def compared(runner, geometry):
    """With all runs of a geometry that belongs to the ensemble."""
    trial = tried(runner, geometry)
    if not trial.reason:
        trial.runs = {name: trial.runs.get(name) or runner.run(geometry, name, MAX_CYCLES) for name in VARIANTS}
    return trial


def collapsed(runner, trial):
    """A collapse run anew, by all methods and to a lower limit: it may go on for very long."""
    return Trial(trial.geometry, {name: runner.run(trial.geometry, name, COLLAPSE_CYCLES) for name in COLLAPSE_RUNS}, trial.reason)


class Search:
    """Geometries of one orientation that are wanted. The next seed is only begun for a place that no other can take any more, so that
    what is found does not depend on which run ends first."""

    def __init__(self, dips, wanted, trial_of, is_wanted):
        self.dips, self.wanted, self.trial_of, self.is_wanted = dips, wanted, trial_of, is_wanted
        self.seed = 0
        self.open = wanted    # places that no begun geometry has or may get

    def next_geometry(self):
        if self.seed >= SEEDS_PER_PLACE * self.wanted:
            raise TooFew(f"dips {self.dips}: {self.seed} seeds do not give the {self.wanted} geometries that are wanted. What each "
                         "of them lacks stands above.")
        self.open -= 1
        self.seed += 1
        return Geometry(self.seed, self.dips)


def search_all(pool, runner, searches, told):
    """(found, other trials), each sorted by seed. `told` is called with each trial that is done."""
    of_dips = {search.dips: search for search in searches}
    found, others, pending = [], [], set()
    while True:
        for search in searches:
            pending |= {pool.submit(search.trial_of, runner, search.next_geometry()) for _ in range(search.open)}
        if not pending:
            break
        done, pending = wait(pending, return_when=FIRST_COMPLETED)
        for trial in (future.result() for future in done):
            told(trial)
            search = of_dips[trial.geometry.dips]
            is_found = search.is_wanted(trial)
            (found if is_found else others).append(trial)
            search.open += not is_found
    return sorted(found, key=lambda trial: trial.geometry), sorted(others, key=lambda trial: trial.geometry)


def places(realisations, angle):
    """Orientations take them in turn."""
    count = len(ORIENTATIONS)
    return [Search(turned(dips, angle), (realisations - i + count - 1) // count, compared, lambda trial: not trial.reason) for i, dips in enumerate(ORIENTATIONS)]


def run_all(runner, realisations, angle, jobs, told):
    """(accepted, discarded, collapses), each sorted by seed: one collapse for four realisations, first from what was discarded."""
    wanted = (realisations + 3) // 4
    with ThreadPoolExecutor(jobs) as pool:
        try:
            accepted, discarded = search_all(pool, runner, places(realisations, angle), told)
            collapses = [trial for trial in discarded if trial.is_collapse][:wanted]
            more = Search(turned(COLLAPSING, angle), wanted - len(collapses), tried, lambda trial: trial.is_collapse)
            collapses += search_all(pool, runner, [more], told)[0]
            return accepted, discarded, list(pool.map(lambda trial: collapsed(runner, trial), collapses))
        except BaseException:
            runner.stop()
            pool.shutdown(cancel_futures=True)
            raise
