#!/usr/bin/python3
"""What was compiled for processors with AVX2 or AVX-512 holds nothing that others could be given, and fuses nothing.

    wide_object_test.py libhdem_core.a
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

# Its registers, and what stands in the names of functions on its packs.
PARTS = {"contact_forces_wide": ("%zmm", "hdem::Wide|lanes_avx512"), "integrator_wide": ("%zmm", "hdem::Wide|lanes_avx512"),
         "kernels_avx2": ("%ymm", "lanes_avx2")}


def problems_of(part, own):
    code = subprocess.run(["objdump", "-d", "--no-show-raw-insn", part], check=True, capture_output=True, text=True).stdout
    names = subprocess.run(["nm", "-C", part], check=True, capture_output=True, text=True).stdout
    found = sorted(set(re.findall(r"\bvfn?m(?:add|sub)\w*", code)))
    # The linker keeps one copy of a function that several objects have: it must not be one of these.
    found += [line for line in names.splitlines()
              if re.search(r" [WVu] ", line) and not re.search(own, line) and not re.search(r"DW\.ref\.__g(xx|cc)_personality", line)]
    return code, found


archive = Path(sys.argv[1]).resolve()
seen, bad = 0, []
with tempfile.TemporaryDirectory() as folder:
    for name, (registers, own) in PARTS.items():
        subprocess.run(["ar", "x", archive, f"{name}.cpp.o"], cwd=folder, check=True)
        code, problems = problems_of(Path(folder, f"{name}.cpp.o"), own)
        if registers in code:
            seen += 1
            bad += [f"{name}: {problem}" for problem in problems]
if bad:
    print("fused operations, or functions that other files may be given:\n  " + "\n  ".join(bad))
if not seen:
    print("skipped: nothing was compiled for other processors than the rest")
    sys.exit(77)
sys.exit(bool(bad))
