"""Whether a run goes on in a folder: hdem holds a lock (flock) on its file .lock as long as it lives."""
import fcntl
import json
import os
import socket
from pathlib import Path

LOCK = ".lock"
LONGEST = 4096    # bytes of what the file says


def is_running(folder, name=LOCK):
    """Asked of the lock, not of the file: that of a run that was killed stays behind."""
    try:
        descriptor = os.open(Path(folder) / name, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    except OSError:
        return False
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
        return False
    except BlockingIOError:
        return True
    except OSError:    # no such locks here, as on some file systems of clusters: what the file says has to do
        return may_live(descriptor)
    finally:
        os.close(descriptor)


def may_live(descriptor):
    """Not when the process that the file names was one of this machine and is no more."""
    try:
        owner = json.loads(os.read(descriptor, LONGEST))
        if owner["host"] != socket.gethostname():
            return True
        os.kill(owner["process"], 0)
    except ProcessLookupError:
        return False
    except PermissionError:    # somebody else's
        return True
    except (OSError, ValueError, TypeError, KeyError, OverflowError, RecursionError):    # empty or damaged
        return False
    return True
