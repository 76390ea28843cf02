"""What scripts write: whole or not there, and never in place of what hdem wrote or of what was read."""
import errno
import io
import os
import re
import stat
from contextlib import contextmanager, suppress

from needed_modules import unfinished
from plain_text import at_once

RANDOM = 6    # bytes in the name of a file that is not whole yet, as in io/fresh_file.cpp
NO_SPACE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
ELSEWHERE = "give another place with -o"
# Files of runs and of sweeps.
OF_HDEM = re.compile(r"summary\.json|trials\.json|plan\.json|input\.json|run\.log|\.lock|run_[0-9]{6}|.*\.(h5|hdf|hdf\.series)")


class OutputRefused(ValueError):
    """What the user named is no place for a file that a script writes."""


class OutputFailed(OSError):
    """A file that could not be written, and what to do."""


@contextmanager
def written_to(file, remedy=ELSEWHERE):
    """Whatever the system says within names the file and the remedy."""
    try:
        yield
    except OSError as error:
        what = f"free space, or {remedy}" if error.errno in NO_SPACE else remedy
        raise OutputFailed(f"{file}: cannot be written ({error.strerror or error}). {what[0].upper()}{what[1:]}.") from None


def is_stream(file):
    """A pipe or a device, or what stands for a file that is open, as /dev/stdout does. A link of the user's is none: it is replaced."""
    target = os.path.join(os.path.dirname(file), os.readlink(file)) if os.path.islink(file) else file
    if any(re.fullmatch("/proc/.*/fd", os.path.realpath(os.path.dirname(one))) for one in (file, target)):
        return True
    try:
        kind = os.lstat(file).st_mode
    except OSError:
        return False
    return not any(is_kind(kind) for is_kind in (stat.S_ISREG, stat.S_ISDIR, stat.S_ISLNK))


def is_same(one, other):
    """A link is itself: it would be replaced, and not what it leads to."""
    return os.path.abspath(one) == os.path.abspath(other) or os.path.exists(one) and os.path.exists(other) and not os.path.islink(other) and os.path.samefile(one, other)


def check_output(file, read=(), remedy=ELSEWHERE):
    """Refuses what hdem itself writes, what was `read`, and folders."""
    why = None
    if OF_HDEM.fullmatch(os.path.basename(file)):
        why = "hdem itself writes files of this name, for runs and sweeps"
    elif os.path.isdir(file):
        why = "a folder"
    elif any(is_same(one, file) for one in read):
        why = "was read, and would be lost"
    if why:
        raise OutputRefused(f"{file}: {why}. {remedy[0].upper()}{remedy[1:]}.")


def make_folder_of(file, remedy=ELSEWHERE):
    with written_to(file, remedy):
        os.makedirs(os.path.dirname(file) or ".", exist_ok=True)


@contextmanager
def fresh_file(file):
    """The name of a new empty file beside `file`, which is gone at the end."""
    name = f"{file}.{os.urandom(RANDOM).hex()}.tmp"
    unfinished.add(name)
    try:
        os.close(os.open(name, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666))
        yield name
    finally:
        with suppress(OSError):
            os.unlink(name)
        unfinished.discard(name)


def put(opened, parts):
    for part in parts:
        opened.write(part.encode("utf-8") if isinstance(part, str) else part)


def replace_file(file, parts, remedy=ELSEWHERE):
    """Writes texts or bytes, whole or not at all: until then an earlier file stays. A link is replaced, not what it leads to."""
    with written_to(file, remedy), fresh_file(file) as fresh:
        with open(fresh, "wb") as opened:
            put(opened, parts)
        os.replace(fresh, file)


def write_output(file, parts, read=(), remedy=ELSEWHERE, into_streams=False):
    """A file that the user asked for, made of what was `read`."""
    check_output(file, read, remedy)
    if not is_stream(file):
        replace_file(file, parts, remedy)
    elif into_streams:
        with written_to(file, remedy), open(file, "wb", opener=at_once) as opened:
            put(opened, parts)
    else:
        raise OutputRefused(f"{file}: no file, but a pipe or a device. {remedy[0].upper()}{remedy[1:]}.")


def write_picture(figure, file, read=(), remedy=ELSEWHERE, **how):
    """A figure of matplotlib; the ending of the name decides the format."""
    check_output(file, read, remedy)    # before it is drawn
    drawn = io.BytesIO()
    figure.savefig(drawn, format=os.path.splitext(file)[1][1:] or "png", **how)
    write_output(file, [drawn.getvalue()], read, remedy)
