#!/usr/bin/python3
"""What was compiled for AVX-512 (core/contact/contact_forces_wide.cpp) holds nothing that other processors could be given, and fuses nothing.

    wide_object_test.py libhdem_core.a
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

archive = Path(sys.argv[1]).resolve()
with tempfile.TemporaryDirectory() as folder:
    subprocess.run(["ar", "x", archive, "contact_forces_wide.cpp.o"], cwd=folder, check=True)
    part = Path(folder, "contact_forces_wide.cpp.o")
    code = subprocess.run(["objdump", "-d", "--no-show-raw-insn", part], check=True, capture_output=True, text=True).stdout
    names = subprocess.run(["nm", "-C", part], check=True, capture_output=True, text=True).stdout
if "%zmm" not in code:
    print("skipped: not compiled for AVX-512")
    sys.exit(77)
problems = sorted(set(re.findall(r"\bvfn?m(?:add|sub)\w*", code)))
# The linker keeps one copy of a function that several objects have: it must not be one of these.
problems += [line for line in names.splitlines() if re.search(r" [WVu] ", line) and "hdem::Wide" not in line]
if problems:
    print("fused operations, or functions that other files may be given:\n  " + "\n  ".join(problems))
sys.exit(bool(problems))
