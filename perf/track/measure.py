"""Runs hdem_perf and reads what it prints; counts instructions with callgrind."""
import json
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COUNTED_FUNCTION = "hdem_counted_cycles"


class MeasureError(Exception):
    """Told to the user in one line."""


class Output:
    """One run of hdem_perf: how it was built, and its benchmarks by name."""

    def __init__(self, text, command):
        try:
            document = json.loads(text)
            context = document["context"]
            self.commit, self.compiler, self.flags = (context[f"hdem_{key}"] for key in ("commit", "compiler", "flags"))
            self.rows = [row for row in document["benchmarks"] if row.get("run_type") == "iteration"]
        except (ValueError, KeyError) as error:
            raise MeasureError(f"{command}: its output is not that of hdem_perf ({error}). Give the program with --program.") from error
        for row in self.rows:
            row["name"] = without_details(row["name"])
            if row.get("error_occurred"):
                raise MeasureError(f"{row['name']}: {row['error_message']}. No figure of this run can be used.")

    @property
    def build(self):
        return f"{self.compiler} {self.flags}"


def program_or_error(program):
    if not Path(program).exists():
        preset = Path(program).parts[-3] if len(Path(program).parts) > 2 else "release"
        raise MeasureError(f"{program}: no such program. Build it (cmake --preset {preset} && cmake --build --preset {preset}) or give it with --program.")
    return Path(program)


def without_details(name):
    return re.sub(r"/iterations:\d+|/repeats:\d+|/manual_time", "", name)


def listed(program, names):
    """Names of the benchmarks that match the expression; nothing is run."""
    done = subprocess.run([str(program_or_error(program)), f"--benchmark_filter={names}", "--benchmark_list_tests"], capture_output=True, text=True, check=False)
    found = [without_details(line) for line in done.stdout.split()]
    if done.returncode != 0 or not found:
        raise MeasureError(f"{program}: has no benchmark \"{names}\". Build the program from this tree.")
    return found


def run(program, names, *options, before=(), environment=None):
    """One process of hdem_perf with the benchmarks whose names match the expression."""
    command = [*before, str(program_or_error(program)), f"--benchmark_filter={names}", "--benchmark_format=json", *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    if done.returncode != 0 or not done.stdout.strip():
        said = (done.stderr.strip().splitlines() or ["nothing was said"])[-1]
        raise MeasureError(f"{' '.join(command)}: ended with exit code {done.returncode}: {said}")
    return Output(done.stdout, program)


def has_valgrind():
    return shutil.which("valgrind") is not None


def count_instructions(program, name):
    """Instructions of the thousand cycles of a benchmark counted/..., and how the program was built. The making of the scene is not counted."""
    with tempfile.TemporaryDirectory() as folder:
        counts = Path(folder) / "callgrind.out"
        output = run(program, f"^{name}/iterations:1$", before=(
            "valgrind", "--quiet", "--tool=callgrind", "--collect-atstart=no", f"--toggle-collect={COUNTED_FUNCTION}", f"--callgrind-out-file={counts}"))
        found = re.search(r"^(?:totals|summary): (\d+)", counts.read_text(encoding="utf-8"), re.MULTILINE)
    if not found or int(found[1]) == 0:
        raise MeasureError(f"{name}: callgrind counted nothing in {COUNTED_FUNCTION}. Build the program from this tree.")
    return int(found[1]), output
