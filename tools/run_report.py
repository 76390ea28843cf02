#!/usr/bin/python3
"""Makes one page of a run's folder. Called by `hdem report`; see its --help.

The page is one file that asks the network for nothing. A run that goes on, or was killed, gives a page of what there is by then.
"""
import sys
from pathlib import Path

from needed_modules import need
need("h5py", "matplotlib", "numpy")
sys.path.insert(0, str(Path(__file__).resolve().parent / "report"))
import run_page    # noqa: E402
from hdem_io import open_run, tell    # noqa: E402
from plain_text import OneLineParser, at_once    # noqa: E402


def parse(arguments):
    parser = OneLineParser(prog="hdem report", description="One HTML page of a run: summary, pictures, histories, energies, timing, provenance.")
    parser.add_argument("result", type=Path, help="the run's folder, or its results.h5")
    parser.add_argument("-o", "--output", type=Path, help="the page (default: report.html in the run's folder)")
    return parser.parse_args(arguments)


def make_page(options):
    """The file it is in."""
    run = open_run(options.result)
    text = run_page.build(run, run.summary(), run.log())
    output = options.output or run.folder / "report.html"
    output.parent.mkdir(parents=True, exist_ok=True)
    with open(output, "w", encoding="utf-8", opener=at_once) as file:
        file.write(text)
    return output


def main(arguments):
    options = parse(arguments)
    return tell("hdem report", options.result, lambda: make_page(options))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
