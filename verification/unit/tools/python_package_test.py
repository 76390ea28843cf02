#!/usr/bin/python3
"""The Python module hdem as a package: its example, its wheel and its stubs, by pytest.

    python_package_test.py HDEM CASES EXAMPLE    with the package on PYTHONPATH; exit code 77: it was not built, or there is no pytest
"""
import os
import subprocess
import sys
from pathlib import Path

from python_common import EXAMPLE, run_tests

import pytest

import hdem


def test_example_runs(tmp_path):
    done = subprocess.run([sys.executable, EXAMPLE, str(tmp_path / "seeds.png")], capture_output=True, text=True)
    if "No module named 'matplotlib'" in done.stderr:
        pytest.skip("no matplotlib")
    assert done.returncode == 0 and "20 seeds: median" in done.stdout, done.stderr
    assert (tmp_path / "seeds.png").stat().st_size > 10000


def test_wheel_holds_the_package(tmp_path):
    import importlib.util
    import zipfile
    if not all(importlib.util.find_spec(name) for name in ("pip", "setuptools", "wheel")):
        pytest.skip("no pip, setuptools or wheel")
    package = Path(hdem.__file__).parent
    done = subprocess.run([sys.executable, "-m", "pip", "wheel", "--no-index", "--no-build-isolation", "--no-deps", "-q", "-w", tmp_path,
                           Path(EXAMPLE).parent.parent], capture_output=True, text=True, env={**os.environ, "HDEM_BUILD": str(package.parent.parent)})
    assert done.returncode == 0, done.stderr
    wheel, = tmp_path.glob("hdem-*.whl")
    files = {name for name in zipfile.ZipFile(wheel).namelist() if name.startswith("hdem/")}
    assert files == {f"hdem/{file.name}" for file in package.iterdir() if file.is_file()} and "hdem/py.typed" in files


def test_stubs_name_what_is_there():
    import ast
    stubs = ast.parse((Path(hdem.__file__).parent / "_core.pyi").read_text())
    assert (Path(hdem.__file__).parent / "py.typed").exists()
    classes = {node.name: {item.name for item in node.body if isinstance(item, ast.FunctionDef)} for node in stubs.body
               if isinstance(node, ast.ClassDef)}
    for name in ("Case", "Run"):
        real = {key for key in vars(getattr(hdem._core, name)) if not key.startswith("__")}
        assert real | {"__init__"} == classes[name] | classes["_Blocks"], name
        without = [key for key in real if not key.startswith("_") and not getattr(getattr(hdem._core, name), key).__doc__]
        assert not without, without


if __name__ == "__main__":
    run_tests(__file__)
