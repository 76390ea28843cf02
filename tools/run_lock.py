"""Whether a run goes on in a folder: hdem holds a lock on its file .lock as long as it lives."""
import fcntl
from pathlib import Path

LOCK = ".lock"


def is_running(folder):
    """Asked of the lock, not of the file: that of a run that was killed stays behind."""
    try:
        with open(Path(folder) / LOCK, "rb") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
            except BlockingIOError:
                return True
    except OSError:
        pass
    return False


def is_interrupted(summary):
    """Whether summary.json is that of a run which was broken off."""
    return bool(summary.get("interrupted")) or summary.get("state") == "interrupted"
