"""Loads the compiled part. Where it is missing the error says so, and how to get it."""
from __future__ import annotations

import importlib
import sys
from pathlib import Path

HOW = """The compiled part is made when hdem is built. In the folder of the sources:
    tools/setup && cmake --preset release && cmake --build --preset release
    PYTHONPATH=build/release/python /usr/bin/python3    # here import hdem works
Or install the Debian package of hdem: there it works in any folder, with /usr/bin/python3."""


def _reason(error: ImportError) -> str:
    folder, here = Path(__file__).resolve().parent, f"Python {sys.version_info.major}.{sys.version_info.minor}"
    if error.name != f"{__package__}._core" or error.path is not None:
        return f"hdem: its compiled part cannot be loaded: {error}."
    others = sorted(file.name for file in folder.glob("_core*.so"))
    if others:
        return f"hdem: {folder} has no compiled part for this {here}, only {', '.join(others)}. Use the Python that it was built for, or build hdem with this one."
    return f"hdem: {folder} has no compiled part (_core*.so): it holds the Python half of the package only."


try:
    importlib.import_module("._core", __package__)
except ImportError as error:
    raise ImportError(f"{_reason(error)}\n{HOW}", name=f"{__package__}._core") from None
