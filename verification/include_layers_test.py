#!/usr/bin/python3
"""Plants includes in a small tree and requires include_layers.py to tell the bad ones from the good ones."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).with_name("include_layers.py")

GOOD_TREE = {
    "core/types.h": "#include <Eigen/Core>\n",
    "core/check.h": "#include <string>\n",
    "core/geometry/polygon.h": '#include "core/types.h"\n',
    "core/joint/coulomb_slip.h": '#include "core/types.h"\n',
    "core/model/model.h": '#include "core/geometry/polygon.h"\n#include "core/joint/coulomb_slip.h"\n',
    "core/state/state.h": '#include "core/model/model.h"\n',
    "core/rock/rock_mass.h": '#include "core/model/model.h"\ndouble f(double x) { return std::atan2(x, 1.0); }\n',
    "core/observer.h": '#include "core/state/state.h"\n',
    "core/stage/rules.cpp": "bool f() { return stage.until_converged && stage.solver == RestSolver::statics; }\n",
    "io/case_schema_run.cpp": "stage.until_converged = true;\n",
    "parallel/openmp.cpp": "#include <omp.h>\n#pragma omp parallel\n",
    "parallel/cycle.h": '#include "core/rock/rock_mass.h"\ndouble g(double x) { return std::sqrt(x) + std::frexp(x, &n); }  // not std::hypot()\n',
    "io/case_reader.h": '#include "core/model/model.h"\n#include <hdf5.h>\n',
    "verification/scenes/tunnel.h": '#include "core/rock/rock_mass.h"\n',
    "verification/unit/tunnel_test.cpp": '#include "verification/scenes/tunnel.h"\n#include "io/case_reader.h"\n',
    "perf/cycle.cpp": '#include "verification/scenes/tunnel.h"\n#include "parallel/cycle.h"\n',
    "tools/hdem/main.cpp": '#include "io/case_reader.h"\n#include "parallel/cycle.h"\n',
}

# file that gets one more line, the line, and a part of the complaint
PLANTED = [
    ("core/rock/rock_mass.h", '#include "parallel/cycle.h"', "core may not use parallel"),
    ("core/rock/rock_mass.h", '#include "io/case_reader.h"', "core may not use io"),
    ("core/rock/rock_mass.h", "#include <io/case_reader.h>", "core may not use io"),
    ("io/case_reader.h", '#include "parallel/cycle.h"', "io may not use parallel"),
    ("parallel/cycle.h", '  #  include "io/case_reader.h"', "parallel may not use io"),
    ("parallel/cycle.h", '#include "perf/cycle.cpp"', "parallel may not use perf"),
    ("tools/hdem/main.cpp", '#include "verification/scenes/tunnel.h"', "tools may not use verification/scenes"),
    ("perf/cycle.cpp", '#include "verification/unit/tunnel_test.cpp"', "perf may not use verification"),
    ("verification/scenes/tunnel.h", '#include "verification/unit/tunnel_test.cpp"', "may not use verification"),
    ("core/types.h", '#include "core/geometry/polygon.h"', "floor 1 of core may not use floor 2"),
    ("core/joint/coulomb_slip.h", '#include "core/state/state.h"', "floor 2 of core may not use floor 3"),
    ("core/state/state.h", '#include "core/rock/rock_mass.h"', "floor 3 of core may not use floor 4"),
    ("core/model/model.h", '#include "core/observer.h"', "floor 3 of core may not use floor 4"),
    ("core/model/model.h", '#include "core/state/state.h"', "in a circle"),
    ("core/model/model.h", '#include "core/model/model.h"', "in a circle"),
    ("core/model/model.h", '#include "core/model/absent.h"', "does not exist"),
    ("core/model/model.h", '#include "../types.h"', "not a path from the project root"),
    ("core/model/model.h", "#include <omp.h>", "OpenMP belongs to parallel"),
    ("core/model/model.h", "#include <hdf5.h>", "files belong to io"),
    ("core/model/model.h", "#include <H5Fpublic.h>", "files belong to io"),
    ("core/model/model.h", "#include <iostream>", "console"),
    ("core/model/model.h", "    #pragma omp simd", "OpenMP belongs to parallel"),
    ("core/model/model.h", '_Pragma("omp simd")', "OpenMP belongs to parallel"),
    ("io/case_reader.h", "#include <omp.h>", "OpenMP belongs to parallel"),
    ("tools/hdem/main.cpp", "#pragma omp parallel", "OpenMP belongs to parallel"),
    ("parallel/cycle.h", "#include <hdf5.h>", "files belong to io"),
    ("parallel/cycle.h", "if (state.method == Method::impulse)", "modes are tested in core/stage/rules"),
    ("core/rock/rock_mass.h", "return preset != DampingPreset::paper;", "modes are tested in core/stage/rules"),
    ("io/case_reader.h", "case RestSolver::statics:", "modes are tested in core/stage/rules"),
    ("tools/hdem/main.cpp", "if (stage.until_converged)", "modes are tested in core/stage/rules"),
    ("parallel/cycle.h", "return std::hypot(v.x(), v.y());", "std::hypot has other last digits"),
    ("parallel/cycle.h", "return std::exp2(n) + std::atan2(y, x);", "std::exp2 has other last digits"),
]


def check(tree):
    with tempfile.TemporaryDirectory() as folder:
        for path, text in tree.items():
            file = Path(folder, path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, SCRIPT, folder], capture_output=True, text=True, check=False)


class IncludeLayers(unittest.TestCase):
    def test_a_good_tree_passes(self):
        run = check(GOOD_TREE)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_each_planted_line_fails_and_is_named(self):
        for path, line, complaint in PLANTED:
            with self.subTest(path=path, line=line):
                run = check(GOOD_TREE | {path: GOOD_TREE[path] + line + "\n"})
                self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
                self.assertIn(complaint, run.stdout)
                if complaint != "in a circle":
                    self.assertIn(f"{path}:{len(GOOD_TREE[path].splitlines()) + 1}:", run.stdout)

    def test_an_empty_tree_fails(self):
        self.assertEqual(check({}).returncode, 1)


if __name__ == "__main__":
    unittest.main()
