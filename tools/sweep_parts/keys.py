"""Keys of the case as the command line says them: one value has several spellings, and a key may hold another one."""
import re
import tomllib

from plain_text import read_bytes

from .common import SweepError

LARGEST_CASE = 16000000    # bytes; hdem takes no larger one
STEP = re.compile(r"([^\[]*)(?:\[([0-9]{1,8})\])?")    # load[0]


def document_of(case):
    """The case file as tables; empty where it cannot be read: hdem says why."""
    try:
        return tomllib.loads(read_bytes(case, LARGEST_CASE).decode("utf-8-sig"))
    except (OSError, ValueError, RecursionError):
        return {}


def value_of(text):
    """Of KEY=VALUE: TOML, or a bare word."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except (ValueError, KeyError, RecursionError):
        return text.strip()


def parts_of(option, text):
    """Values between commas; those within brackets or quotes are of one value."""
    parts, within, quote = [""], 0, ""
    for c in text:
        if c == "," and not within and not quote:
            parts.append("")
            continue
        parts[-1] += c
        if quote:
            quote = "" if c == quote else quote
        elif c in "\"'":
            quote = c
        else:
            within += (c in "[{") - (c in "]}")
        if within < 0:
            break
    if within or quote:
        raise SweepError(f"{option}: brackets or quotes do not match. Write e.g. gravity.vector=[0,-9.81],[0,-5].")
    return parts


def number_of(entries, array, name):
    """Of the entry of an array that has this name, given or by default; None where there is none."""
    standard = "set" if array == "joint_set" else array
    names = [entry.get("name", f"{standard}{number}") for number, entry in enumerate(entries, 1) if isinstance(entry, dict)]
    return names.index(name) if name in names else None


def place_of(key, document):
    """The way to the value. Entries of an array are numbers, from 0 on, also where the key has their name; a name that the case does not have stays a text."""
    place, at, array = [], document, ""
    for part in key.strip().split("."):
        step = STEP.fullmatch(part)
        name, index = step.groups() if step else (part, None)
        if isinstance(at, list):
            number = number_of(at, array, name)
            place.append(name if number is None else number)
            at = None if number is None else at[number]
        else:
            place.append(name)
            at, array = at.get(name) if isinstance(at, dict) else None, name
            if index is not None:
                place.append(int(index))
                at = at[int(index)] if isinstance(at, list) and int(index) < len(at) else None
    return place


def overlap(one, other, document):
    """Whether two keys are the same, or one a part of the other. A name that the case does not have may be that of any entry: one that an option gives it."""
    steps = zip(place_of(one, document), place_of(other, document))
    return all(a == b or isinstance(a, int) is not isinstance(b, int) for a, b in steps)
