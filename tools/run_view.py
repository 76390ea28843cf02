#!/usr/bin/python3
"""Makes one page that plays the frames of one or two runs in a browser. Called by `hdem view`; see its --help.

The page is one file that asks the network for nothing; view/README.md says what is in it.
"""
from needed_modules import end_in_one_line, need
if __name__ == "__main__":
    end_in_one_line("hdem view")
need("h5py", "numpy")
import argparse    # noqa: E402
import sys    # noqa: E402
from pathlib import Path    # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parent / "view"))
import page    # noqa: E402
from follow import follow    # noqa: E402
from hdem_io import ResultError, open_run, tell    # noqa: E402
from movie import COLOURS, make_movie    # noqa: E402
from output_file import check_output    # noqa: E402
from plain_text import OneLineParser, as_file_name, printable    # noqa: E402
from run_pack import RunPack    # noqa: E402


OF_MOVIES = {"colour": "displacement", "fps": 10.0, "window": None, "width": 1280}    # and what they are when they are not given


def parse(arguments):
    parser = OneLineParser(prog="hdem view", description="One HTML page that plays the frames of a run, or of two runs side by side; or a film of them.")
    parser.add_argument("runs", type=Path, nargs="+", metavar="RUN", help="a run's folder, or its results.h5; two of them are shown side by side")
    parser.add_argument("-o", "--output", type=Path, help="the page (default: view.html in the first run's folder)")
    parser.add_argument("--contacts", choices=["auto", "all", "ends", "none"],
                        help="frames whose contacts are in the page: all, each stage's last one (ends), none; auto (default): all, or where these are many ends")
    parser.add_argument("--movie", type=Path, metavar="FILE", help="a film instead of a page: .mp4 or .gif, drawn as hdem plot does; needs ffmpeg")
    parser.add_argument("--colour", "--color", choices=COLOURS, help="of the film: as hdem plot --colour (default: displacement)")
    parser.add_argument("--fps", type=float, help="frames of the film a second (default: 10)")
    parser.add_argument("--window", nargs=4, type=float, metavar=("X0", "Y0", "X1", "Y1"), help="only this part in the film [m]")
    parser.add_argument("--width", type=int, help="of the film in pixels (default: 1280)")
    parser.add_argument("--follow", action="store_true", help=argparse.SUPPRESS)    # what hdem run --live starts
    options = parser.parse_args(arguments)
    if len(options.runs) > 2:
        parser.error("one run, or two")
    if options.movie and (len(options.runs) > 1 or options.output):
        parser.error("argument --movie: of one run; the film's name stands behind it, without -o")
    for name, without in OF_MOVIES.items():
        if getattr(options, name) is None:
            setattr(options, name, without)
        elif not options.movie:
            parser.error(f"argument --{name}: of films only. Leave it out, or give --movie FILE.")
    if options.movie and options.contacts:
        parser.error("argument --contacts: of pages only. Leave it out, or leave out --movie.")
    options.contacts = options.contacts or "auto"
    if options.movie and options.movie.suffix.lower() not in (".mp4", ".gif"):
        parser.error("argument --movie: a name that ends with .mp4 or .gif")
    if not 0.1 <= options.fps <= 120.0:
        parser.error("argument --fps: 0.1 to 120")
    if not 160 <= options.width <= 7680:
        parser.error("argument --width: 160 to 7680")
    return options


def output_of(options):
    folders = [run if run.is_dir() else run.parent for run in options.runs]
    if options.output:
        return options.output
    return folders[0] / ("view.html" if len(folders) == 1 else f"view_with_{as_file_name(folders[1].resolve().name)}.html")


def make_page(options):
    """The file it is in."""
    page.template()    # before the work, not after it
    output, read, packs = output_of(options), [run / "results.h5" if run.is_dir() else run for run in options.runs], []
    check_output(output, read)
    for path in options.runs:
        if not path.exists():
            raise ResultError(f"{path}: no such file or folder")
        if path.is_file() and path.suffix != ".h5":
            raise ResultError(f"{path}: not the results of a run. Give the run's folder, or its results.h5.")
        run, pack = open_run(path), RunPack(options.contacts)
        pack.update(run)
        packs.append(pack)
        if run.state() != "done":
            print(f"{printable(path)}: the run is {run.state()}; the page shows it to cycle {pack.frames[-1]['cycle']}", file=sys.stderr)
        if pack.contacts_left_out():
            print(f"{printable(path)}: contacts are in the page for the last frame of each stage only; --contacts all takes all of them", file=sys.stderr)
    return page.write(output, page.build(packs), read)


def main(arguments):
    options = parse(arguments)
    if options.follow:
        return follow(options.runs[0], output_of(options))
    return tell("hdem view", options.runs[0], lambda: make_movie(options) if options.movie else make_page(options))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
