"""All runs of a plan have the same input: the case, the files that it names, and the options of hdem. Others do not belong in one table with them."""
import hashlib
import json
import math
import os
from pathlib import Path

from output_file import fresh_file, put, written_to
from plain_text import open_regular, read_json
from run_lock import is_running

from . import keys, settings
from .common import CLAIMS, GO_ON, SweepError, runs_in

MOST_OVERRIDES = 1 << 24    # bytes
RECORD = "input.json"    # what the runs began with


def refuse(what, remedy):
    raise SweepError(f"{what}: its runs do not belong together. {remedy}, or make a new plan in another folder.")


def digest_of(file):
    """SHA-256; None where there is no such file: hdem says so."""
    try:
        if not file.is_file():
            return None
        with open_regular(file, math.inf) as opened:
            return hashlib.file_digest(opened, "sha256").hexdigest()
    except (OSError, ValueError):
        return None


def texts_in(value):
    """All texts of a case or a part of it, but for names and titles."""
    found, left = set(), [value]    # dotted keys are deeper than functions may call themselves
    while left:
        value = left.pop()
        if isinstance(value, str):
            found.add(value)
        elif isinstance(value, list):
            left += value
        elif isinstance(value, dict):
            left += [inner for key, inner in value.items() if key not in ("name", "title")]
    return found


def is_number(text):
    try:
        float(text)
        return True
    except ValueError:
        return False


def named_files(case, document, values):
    """SHA-256 of each file that the case names, or one of these values of --set: blocks, tables, laws. Any text that is the name of a file counts as one."""
    parts = [document, *(keys.value_of(value) for value in values if not is_number(value))]
    found = ((text, digest_of(case.parent / text)) for text in sorted(texts_in(parts)))
    return {text: digest for text, digest in found if digest is not None}


def inputs_of(plan):
    """The case of a plan and the files that it names."""
    case = Path(plan["case"])
    return [case, *(case.parent / name for name in plan.get("files_sha256", {}))]


class ForeignRun(SweepError):
    """A run with other values than the plan's."""


def overrides_in(file, place):
    """The values of --set that a file of a run holds, by their keys; None where it has none, or Python no module to read it."""
    if not file.is_file():
        return None
    try:
        from checked_hdf5 import CheckedFile, ResultError
    except ImportError:
        return None
    try:
        with CheckedFile(file) as opened:
            texts = opened.texts(place, most=MOST_OVERRIDES)
    except ResultError:    # hdem says what is wrong with it
        return None
    return {key.strip(): value.strip() for key, _, value in (text.partition("=") for text in texts)}


def require_own_values(folder, values):
    """What lies in the folder of a run has the values that the plan gives it. hdem writes them into its results and into its checkpoint."""
    for name, place in (("results.h5", "provenance/overrides"), ("checkpoint.h5", "case/overrides")):
        found = overrides_in(folder / name, place)
        for key, value in values.items() if found is not None else ():
            if key not in found or keys.value_of(found[key]) != keys.value_of(value):
                raise ForeignRun(f"{folder}: is no run of this plan: {name} has {key} = {found.get(key, 'as in the case')}, the plan {value}. Move the folder away, and run this again.")


def files_of_plan(case, document, runs):
    return named_files(case, document, {value for chosen in runs for value in chosen.values()})


def require_unchanged(case, before, now, since):
    for name, digest in before.items():
        if now.get(name, digest) != digest:    # hdem says that a file is not there
            refuse(f"{case.parent / name}: has changed since {since}", "Put the file back")


def require_other_keys(plan, document, given):
    """A value that is laid over all runs must not be one that the plan varies: the table would say another one than ran."""
    varied = dict.fromkeys([key for chosen in plan["runs"] for key in chosen] + ([plan["bisect"]["key"]] if "bisect" in plan else []))
    for option, laid, _ in settings.overlays(given):
        for key in varied:
            if keys.overlap(laid, key, document):
                raise SweepError(f"{option}: the plan varies {'it' if option == f'--set {key}' else key}, and the table would show the plan's values. "
                                 "Leave it away, or make another plan.")


def has_begun(folder):
    """Whether a run has left anything or is with a worker: not where hdem has refused all of them."""
    return any(file.is_file() for run in runs_in(folder) for file in run.rglob("*")) or any(is_running(claim.parent, claim.name) for claim in (folder / CLAIMS).glob("*"))


def write_once(file, content):
    """Of several workers that begin at a time the first one writes it."""
    with written_to(file, GO_ON), fresh_file(file) as fresh:
        with open(fresh, "wb") as opened:
            put(opened, [json.dumps(content, indent=1), "\n"])
        try:
            os.link(fresh, file)
        except FileExistsError:
            pass
        except OSError:    # a file system without links
            if not file.exists():
                os.replace(fresh, file)


def recorded(folder, now):
    """What the runs began with: `now`, where none has begun."""
    file = folder / RECORD
    write_once(file, now)
    try:
        before = read_json(file)
        if not isinstance(before["settings"], dict) or not isinstance(before["files_sha256"], dict):
            raise ValueError("settings or files_sha256 are no table")
    except (ValueError, TypeError, KeyError) as error:
        raise SweepError(f"{file}: damaged ({error}). Remove it, and give the same options of hdem as before.") from None
    if before == now or has_begun(folder):
        return before
    file.unlink(missing_ok=True)
    write_once(file, now)
    return now


def require_same_input(folder, plan, words):
    """As the runs of this plan that began before."""
    case, given = Path(plan["case"]), settings.settings_of(words)
    settings.require_none_of_the_sweep(given)
    digest = digest_of(case)
    if digest is not None and plan.get("case_sha256", digest) != digest:
        refuse(f"{case}: has changed since the plan was made", "Put the case back")
    document = keys.document_of(case)
    require_other_keys(plan, document, given)
    files = files_of_plan(case, document, plan["runs"])
    require_unchanged(case, plan.get("files_sha256", {}), files, "the plan was made")
    files |= named_files(case, {}, [value for _, _, value in settings.overlays(given)])
    before = recorded(folder, {"settings": given, "files_sha256": files})
    if before["settings"] != given:
        began, now = (settings.told(which) or "no option that shapes results" for which in (before["settings"], given))
        refuse(f"{folder}: hdem had {began} before, and now {now}", "Give the same options")
    require_unchanged(case, before["files_sha256"], files, "runs began")
