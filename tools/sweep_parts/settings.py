"""Options of hdem behind --: what they lay over the case, and which of them shape results."""
import shlex

from .common import SweepError

SHAPE_NOTHING = {"--quiet", "--live", "--overwrite", "--threads", "--max-wall"}
METHOD = "contact.method"    # what --method lays over


def settings_of(words):
    """Values of each option that shapes results, in their order."""
    found, option = {}, ""
    for word in words:
        value = word
        if word.startswith("-"):
            option, equals, value = word.partition("=")
            found.setdefault(option, [])
            if not equals:
                continue
        found.setdefault(option, []).extend(laid_over(value) if option == "--set" else [value])
    return {name: values for name, values in found.items() if name not in SHAPE_NOTHING and set(name) != set("-q")}    # hdem takes -qq too


def laid_over(text):
    """KEY=VALUE without blanks around; hdem also takes several in brackets: [KEY=VALUE,KEY=VALUE]."""
    if text.startswith("[") and text.endswith("]"):
        return [one for part in text[1:-1].split(",") if part for one in laid_over(part)]
    key, equals, value = (part.strip(" \t") for part in text.partition("="))
    return [key + equals + value]


def overlays(settings):
    """Option, key and value of all that is laid over the case."""
    for text in settings.get("--set", []):
        key, _, value = text.partition("=")
        yield f"--set {key}", key, value
    for value in settings.get("--method", []):
        yield "--method", METHOD, value


def require_none_of_the_sweep(settings):
    for option in ("-o", "--output", "--restart"):
        if option in settings:
            raise SweepError(f"{option}: the sweep itself gives it to each run. Leave it away.")


def told(settings):
    """As on the command line."""
    return shlex.join(word for option, values in settings.items() for word in ([option] if not values else [word for value in values for word in (option, value)]))
