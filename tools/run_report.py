#!/usr/bin/python3
"""Makes one page of a run's folder. Called by `hdem report`; see its --help.

The page is one file that asks the network for nothing. A run that goes on, or was killed, gives a page of what there is by then.
"""
from needed_modules import end_in_one_line, need
if __name__ == "__main__":
    end_in_one_line("hdem report")
need("h5py", "matplotlib", "numpy")
import sys    # noqa: E402
from pathlib import Path    # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parent / "report"))
import run_page    # noqa: E402
from hdem_io import open_run, tell    # noqa: E402
from output_file import check_output, make_folder_of, write_output    # noqa: E402
from plain_text import OneLineParser    # noqa: E402


def parse(arguments):
    parser = OneLineParser(prog="hdem report", description="One HTML page of a run: summary, pictures, histories, energies, timing, provenance.")
    parser.add_argument("result", type=Path, help="the run's folder, or its results.h5")
    parser.add_argument("-o", "--output", type=Path, help="the page (default: report.html in the run's folder)")
    return parser.parse_args(arguments)


def make_page(options):
    """The file it is in."""
    run = open_run(options.result)
    output = options.output or run.folder / "report.html"
    check_output(output, [run.file])    # before the work
    text = run_page.build(run, run.summary(), run.log())
    make_folder_of(output)
    write_output(output, [text], [run.file], into_streams=True)
    return output


def main(arguments):
    options = parse(arguments)
    return tell("hdem report", options.result, lambda: make_page(options))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
