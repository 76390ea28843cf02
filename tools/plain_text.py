"""Texts that others may have made: files of them are read within bounds, names and titles are texts wherever they are shown: no formula, no part of a path,
no command of the screen."""
import argparse
import json
import os
import stat

LARGEST_FILE = 1 << 26    # bytes
MOST_VALUES = 2000000     # in a JSON file; each may take 250 bytes of memory
MOST_DIGITS = 300         # of a whole number in it, as many as other numbers can have
LONGEST_FILE_NAME = 200    # bytes, of the 255 that a file system takes
LONGEST_LINE = 250         # characters in a picture: a name has at most 200, a title as many as it likes


def printable(text, kept=""):
    """Without what would steer a screen or break a line; characters of `kept` stay."""
    return "".join(c if c.isprintable() or c in kept else "\N{REPLACEMENT CHARACTER}" for c in str(text))


def one_line(text):
    return printable(" ".join(str(text).split()))


class OneLineParser(argparse.ArgumentParser):
    """Says in one line what is wrong with the words of a command, as those in C++ do."""

    def error(self, message):
        self.exit(2, f"error: {self.prog}: {one_line(message).rstrip('.')}. {self.prog} --help lists all options.\n")


def reason_of(error):
    """What an OSError says, without its number."""
    return f"{error.filename}: {error.strerror}" if error.filename is not None and error.strerror else error


def at_once(path, flags):
    """For open(): a pipe that nobody else has open is not waited for."""
    descriptor = os.open(path, flags | os.O_NONBLOCK, 0o666)
    os.set_blocking(descriptor, True)
    return descriptor


def open_regular(file, largest=LARGEST_FILE):
    """Opened for reading bytes. A pipe, a device, and what is too large, is a ValueError."""
    opened = open(file, "rb", opener=at_once)
    found = os.fstat(opened.fileno())
    if stat.S_ISREG(found.st_mode) and found.st_size <= largest:
        return opened
    opened.close()
    raise ValueError(f"has {found.st_size} bytes, more than {largest}" if stat.S_ISREG(found.st_mode) else "is a pipe or a device, not a file")


def read_bytes(file, largest=LARGEST_FILE):
    with open_regular(file, largest) as opened:
        return opened.read(largest)


def check_values(content):
    """The bytes of a JSON file, before memory is asked for what is in them."""
    if len(content) > LARGEST_FILE or sum(map(content.count, (b",", b"[", b"{"))) > MOST_VALUES:
        raise ValueError(f"more than {LARGEST_FILE} bytes, or {MOST_VALUES} values")


def whole_number(digits):
    if len(digits) > MOST_DIGITS:
        raise ValueError(f"a whole number of {len(digits)} digits: {digits[:10]}...")
    return int(digits)


def read_json(file):
    """What a JSON file holds. FileNotFoundError where there is none; whatever else is wrong with it is a ValueError."""
    try:
        content = read_bytes(file)
        check_values(content)
        return json.loads(content.decode("utf-8"), parse_int=whole_number)
    except FileNotFoundError:
        raise
    except OSError as error:
        raise ValueError(error.strerror) from None
    except RecursionError:
        raise ValueError("lists and tables are too deep in each other") from None
    except MemoryError:
        raise ValueError("there is not enough memory for it") from None


def as_file_name(text):
    """A name without a folder, neither hidden nor too long, for what is written beside a run."""
    name = printable(text).replace("/", "_")
    if name.startswith("."):
        name = "_" + name[1:]
    return name.encode(errors="replace")[:LONGEST_FILE_NAME].decode(errors="ignore") or "_"


def literal(artist):
    """A text of matplotlib, drawn as it is: $, ^ and \\ are characters."""
    lines = printable(artist.get_text(), kept="\n").split("\n")
    artist.set_text("\n".join(line if len(line) <= LONGEST_LINE else line[:LONGEST_LINE - 1] + "…" for line in lines))
    artist.set_parse_math(False)
    return artist


def add_legend(axes, handles, **how):
    """Of all handles, also of those whose label begins with _, which matplotlib leaves out."""
    legend = axes.legend(handles, ["-"] * len(handles), **how)
    for text, handle in zip(legend.get_texts(), handles):
        text.set_text(handle.get_label())
        literal(text)
    return legend
