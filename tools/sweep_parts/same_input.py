"""All runs of a plan have the same input: the case, and the options of hdem. Others do not belong in one table with them."""
import hashlib
from pathlib import Path

from . import keys, settings
from .common import SweepError


def digest_of(file):
    """SHA-256; None where there is no such file: hdem says so."""
    try:
        return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else None
    except OSError:
        return None


def require_other_keys(plan, document, given):
    """A value that is laid over all runs must not be one that the plan varies: the table would say another one than ran."""
    varied = dict.fromkeys([key for chosen in plan["runs"] for key in chosen] + ([plan["bisect"]["key"]] if "bisect" in plan else []))
    for option, laid, _ in settings.overlays(given):
        for key in varied:
            if keys.overlap(laid, key, document):
                raise SweepError(f"{option}: the plan varies {'it' if option == f'--set {key}' else key}, and the table would show the plan's values. "
                                 "Leave it away, or make another plan.")


def require_same_input(plan, words):
    """As the runs of this plan that began before."""
    case, given = Path(plan["case"]), settings.settings_of(words)
    digest = digest_of(case)
    if digest is not None and plan.get("case_sha256", digest) != digest:
        raise SweepError(f"{case}: has changed since the plan was made: its runs do not belong together. Put the case back, or make a new plan in another folder.")
    require_other_keys(plan, keys.document_of(case), given)
