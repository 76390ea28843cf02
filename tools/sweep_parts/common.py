"""What all parts of tools/sweep share: the error that users see, folders of runs, what summary.json says."""
from plain_text import read_json

DONE, NOT_CONVERGED, INTERRUPTED = 0, 4, (5, 129, 130, 143)    # exit codes of hdem
SUMMARY = "summary.json"
GO_ON = "give the same line again when it can be written"    # remedy for files of the sweep itself
BESIDE = "move away what is in its place, or change the rights of the folder"    # and for those that `collect` writes into it
CLAIMS = "claims"    # folder: a file for each run that a worker has


class SweepError(Exception):
    """Told to the user in one line; more lines are more arguments."""


def folder_of(folder, number):
    return folder / f"run_{number:06d}"


def runs_in(folder):
    """Folders of runs, of whatever plan."""
    return sorted(folder.glob("run_" + "[0-9]" * 6))


FACTOR = "factor_of_safety"    # in the summary of a search by hdem fos that is done; before, it is that of the stages alone


def read_summary(folder, needs=None):
    """None without one, or without the key that it `needs`: the run has not come to its end."""
    try:
        summary = read_json(folder / SUMMARY)
        if not isinstance(summary, dict):
            raise ValueError("not a table of values")
    except FileNotFoundError:
        return None
    except ValueError as error:
        raise SweepError(f"{folder / SUMMARY}: damaged ({error}). Remove it to run this again.") from None
    return summary if needs is None or needs in summary else None


def flat(summary):
    """Numbers and texts by name; energies as energy.NAME, lists as their length."""
    row = {}
    for key, value in summary.items():
        if isinstance(value, dict):
            row |= {f"{key}.{name}": len(inner) if isinstance(inner, list) else inner for name, inner in value.items()}
        else:
            row[key] = len(value) if isinstance(value, list) else value
    return row
