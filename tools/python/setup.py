"""Builds the wheel: CMake compiles the module, portable, and installs the package into the wheel's folder.

HDEM_BUILD=FOLDER takes the module of a build folder instead, as it is (the preset release is for this machine only).
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
WORK = ROOT / "build/wheel"    # nothing is written beside the sources
VERSION = re.search(r"^\s+VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.MULTILINE)[1]


class Build(build_ext):
    def build_extension(self, ext):
        target = Path(self.get_ext_fullpath(ext.name)).resolve().parent.parent    # of the folder hdem
        if "HDEM_BUILD" in os.environ:
            shutil.copytree(Path(os.environ["HDEM_BUILD"]) / "python/hdem", target / "hdem", dirs_exist_ok=True,
                            ignore=shutil.ignore_patterns("__pycache__"))
            return
        build = WORK / "cmake"
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release", "-DHDEM_BUILD_TESTS=OFF",
                        "-DHDEM_PYTHON_FOLDER=.", *(["-G", "Ninja"] if shutil.which("ninja") else []), f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", str(build), "--target", "hdem_python", "-j", jobs], check=True)
        subprocess.run(["cmake", "--install", str(build), "--component", "python", "--prefix", str(target)], check=True)


WORK.mkdir(parents=True, exist_ok=True)
setup(version=VERSION, packages=[], ext_modules=[Extension("hdem._core", sources=[])], cmdclass={"build_ext": Build},
      options={"build": {"build_base": str(WORK / "python")}, "egg_info": {"egg_base": str(WORK)}})
