"""What each script does first: it says which Python modules are missing, in one line and with exit code 2.

    from needed_modules import need
    need("h5py", "matplotlib", "numpy")
"""
import importlib
import sys
from pathlib import Path

IN_SOURCES = (Path(__file__).parent / "setup").exists()


def missing_of(names):
    """Those that cannot be imported: not there, or of another Python."""
    missing = []
    for name in names:
        try:
            importlib.import_module(name)
        except ImportError:
            missing.append(name)
    return missing


def remedy_for(missing):
    """Where hdem is installed there is no tools/setup."""
    first = "run tools/setup" if IN_SOURCES else f"install {' '.join(f'python3-{name}' for name in missing)}"
    return f"{first}, or use /usr/bin/python3"


def need(*names, remedy=None):
    """Ends the program when one of them is missing. From here on the screen takes any text."""
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")    # a name in another alphabet, or a path in none
    missing = missing_of(names)
    if missing:
        print(f"error: needs the Python module{'s' if len(missing) > 1 else ''} {', '.join(missing)}: {remedy or remedy_for(missing)}", file=sys.stderr)
        sys.exit(2)
