"""A stand-in for hdem_perf: prints what a test wants as the program would."""
import json
import stat

BUILD = {"hdem_commit": "abc", "hdem_compiler": "GNU 12.2.0", "hdem_flags": "-O3"}


def row(name, **counters):
    return {"name": f"{name}/iterations:1/manual_time", "run_type": "iteration", "real_time": 1.0, "time_unit": "ms", **counters}


def write(file, rows, **context):
    """An executable `file` that prints those of the rows whose names match --benchmark_filter."""
    text = json.dumps({"context": BUILD | context, "benchmarks": rows})
    file.write_text("#!/usr/bin/python3\n"
                    "import json, re, sys\n"
                    f"document = json.loads({text!r})\n"
                    "wanted = next(a for a in sys.argv if a.startswith('--benchmark_filter=')).split('=', 1)[1]\n"
                    "document['benchmarks'] = [row for row in document['benchmarks'] if re.search(wanted, row['name'])]\n"
                    "names = '\\n'.join(row['name'] for row in document['benchmarks'])\n"
                    "print(names if '--benchmark_list_tests' in sys.argv else json.dumps(document))\n", encoding="utf-8")
    file.chmod(file.stat().st_mode | stat.S_IXUSR)
    return file
