"""A film of a run's frames for slides, for `hdem view --movie`: hdem plot draws them, ffmpeg packs them."""
import os
import shutil
import subprocess
import sys

import numpy as np

from fields import all_fields, range_of
from hdem_frames import read_block_arrays
from hdem_io import ResultError, open_run
from output_file import check_output, fresh_file, is_stream, make_folder_of, written_to

COLOURS = ["displacement", "displacement_x", "displacement_y", "rotation", "velocity", "stress", "stress_xx", "stress_yy", "stress_xy", "regime", "material", "none"]
FIELD_OF = {"velocity": "speed", "stress": "stress_magnitude"}    # under the names of fields.py
DPI = 160.0
ELSEWHERE = "give another name of a film"


def colour_ranges(run, colour):
    """Of each frame: low and high over all frames of its stage, so that colours mean the same from one to the next."""
    if colour in ("regime", "material", "none"):
        return [None] * len(run.frames)
    name, found, begins = FIELD_OF.get(colour, colour), {}, []
    for frame in run.frames:
        blocks = run.read(read_block_arrays, "blocks", frame.number)
        low, high = range_of(name, all_fields(blocks)[name], blocks["detached"].astype(bool))
        begin = int(blocks["info"]["stage_begin_cycle"])
        old = found.get(begin, (low, high))
        found[begin] = (min(low, old[0]), max(high, old[1]))
        begins.append(begin)
    return [scaled(*found[begin], colour) for begin in begins]


def scaled(low, high, colour):
    most = max(-low, high)
    if not most > 0.0:
        return None
    signed = colour in ("displacement_x", "displacement_y", "rotation", "stress_xx", "stress_yy", "stress_xy")
    return (-most, most) if signed else (0.0, most)


def packer(output, fps, size):
    """ffmpeg, to which raw pictures are written."""
    program = shutil.which("ffmpeg")
    if not program:
        raise ResultError("--movie needs ffmpeg: run tools/setup, or install it")
    into = ["-vf", "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=none", "-f", "gif"] if output.suffix.lower() == ".gif" else [
        "-c:v", "libx264", "-crf", "20", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"]
    return [program, "-loglevel", "error", "-y", "-f", "rawvideo", "-pixel_format", "rgba", "-video_size", f"{size[0]}x{size[1]}", "-framerate", f"{fps:g}", "-i", "-",
            *into, "-threads", "2"]


def pictures(run, options):
    """Each frame as rows of pixels, all of one size that is even both ways."""
    import plot    # with matplotlib, which a page does not need
    plot.plt.rcParams.update(plot.STYLE)
    size = None
    for frame, colours in zip(run.frames, colour_ranges(run, options.colour)):
        how = plot.parse([str(run.folder), "--colour", options.colour, "--frame", str(frame.number), "--dpi", f"{DPI:g}", "--width", f"{25.4 * options.width / DPI:.6f}"])
        how.range, how.window = colours, options.window
        drawn = plot.draw_frame(run, how)
        if size is None:    # that of the first one: a legend that comes later must not change it
            room = drawn.get_size_inches() + (0.0, 0.3)
            size = tuple(2 * round(float(side) * DPI / 2.0) for side in room)
        drawn.set_size_inches(size[0] / DPI, size[1] / DPI)
        drawn.canvas.draw()
        pixels = np.asarray(drawn.canvas.buffer_rgba())
        whole = np.full((size[1], size[0], 4), 255, np.uint8)
        rows, columns = min(size[1], pixels.shape[0]), min(size[0], pixels.shape[1])
        whole[:rows, :columns] = pixels[:rows, :columns]
        plot.plt.close(drawn)
        yield size, whole.tobytes()


def make_movie(options):
    """The file it is in."""
    run, output = open_run(options.runs[0]), options.movie
    if not run.frames:
        raise ResultError(f"{run.folder}: holds no frames. A run writes one at the end of each stage; output.frame_every in the case asks for more.")
    packer(output, options.fps, (0, 0))    # whether it is there
    check_output(output, remedy=ELSEWHERE)
    if is_stream(output):
        raise ResultError(f"{output}: no file, but a pipe or a device. Give another film.")
    make_folder_of(output, ELSEWHERE)
    with written_to(output, ELSEWHERE), fresh_file(output) as fresh:
        process = None
        for number, (size, data) in enumerate(pictures(run, options)):
            process = process or subprocess.Popen([*packer(output, options.fps, size), f"file:{fresh}"], stdin=subprocess.PIPE, stderr=subprocess.PIPE)
            try:
                process.stdin.write(data)
            except BrokenPipeError:
                break
            if sys.stderr.isatty():
                print(f"\rframe {number + 1} of {len(run.frames)} ", end="", file=sys.stderr)
        _, said = process.communicate()
        if process.returncode != 0:
            raise ResultError(f"{output}: ffmpeg failed: {said.decode(errors='replace').strip().splitlines()[-1:] or process.returncode}")
        os.replace(fresh, output)
    return output
