"""Keeps the page of a run that goes on up to date, for `hdem run --live`.

hdem starts it beside the run, with a pipe as its input on which nothing ever comes: the end of the pipe is the end of the run, however that
came. A page that cannot be written must not disturb a run: it is told at the end.
"""
import os
import select
import sys
import time

import page
from hdem_io import ResultError, open_run
from plain_text import one_line
from run_pack import RunPack

LOOK = 0.5    # s between two looks for new frames
EVERY = 2.0    # s between two pages at least
SHARE = 0.25    # of the time that it may take, so that large models do not spend it on pages


def follow(folder, output):
    """Until the pipe ends. The exit code: 1 when the last page could not be written."""
    pack, seen, goes_on, problem, next_time = RunPack(), None, True, None, 0.0
    while goes_on:
        goes_on = not has_ended(LOOK)
        now = what_is_there(folder)
        if goes_on and (now == seen or time.monotonic() < next_time):
            continue
        begin = time.monotonic()
        try:
            pack.update(open_run(folder))
            pack.is_over = not goes_on
            page.write(output, page.build([pack], EVERY if goes_on else None))
            seen, problem = now, None
        except (ResultError, OSError, ValueError) as error:    # frames on their way, a full disk: it is tried again
            problem = error
        next_time = time.monotonic() + max(EVERY, (time.monotonic() - begin) / SHARE)
    if problem:
        print(f"error: hdem run --live: {one_line(f'{output} is not up to date: {problem}')}", file=sys.stderr)
    return 1 if problem else 0


def has_ended(seconds):
    """Waits so long for the end of the pipe."""
    ready, _, _ = select.select([0], [], [], seconds)
    return bool(ready) and not os.read(0, 65536)


def what_is_there(folder):
    """Changes with each frame, and when histories are written."""
    try:
        results = (folder / "results.h5").stat().st_mtime_ns
        return results, sorted(file.name for file in (folder / "frames").iterdir() if file.suffix == ".hdf")
    except OSError:
        return None
