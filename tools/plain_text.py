"""Names and titles are texts wherever they are shown: no formula, no part of a path, no command of the screen."""
import argparse

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
