"""Shows a run's frames in ParaView 5.11 or later: blocks coloured by a field with their edges, and contact forces as tubes.

    LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a pvbatch tools/paraview_view.py FOLDER -o picture.png    without a screen
    pvpython tools/paraview_view.py FOLDER -o picture.png                                       with one
    HDEM_RUN=FOLDER paraview --script=tools/paraview_view.py                                    in the program's own window

    --colour displacement (default), speed, velocity, rotation, stress_magnitude, stress_xx, ..., regime, detached, id
    --contacts               tubes as thick as the normal force
    --frame N                position in blocks.hdf.series, from 0; default: the last
    --size WIDTH HEIGHT      of the picture [pixels]
"""
import argparse
import os
import sys

try:
    import numpy as np
    from paraview import servermanager, simple
    from vtkmodules.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(f"error: needs the Python module {missing.name}: run it with pvbatch, pvpython or paraview (tools/setup --paraview)", file=sys.stderr)
    sys.exit(2)

MOTION = ("displacement", "velocity", "speed", "rotation")    # a falling block has far more of it than the others
BLOCKS, CONTACTS = "blocks.hdf.series", "contacts.hdf.series"


def parse(arguments):
    parser = argparse.ArgumentParser(prog="paraview_view.py", description="A run's frames in ParaView.")
    parser.add_argument("folder", nargs="?", default=os.environ.get("HDEM_RUN", "."), help="of the run (default: the variable HDEM_RUN, or here)")
    parser.add_argument("-o", "--output", help="write this picture; without it only the view is set up")
    parser.add_argument("--colour", "--color", default="displacement", help="cell field of the blocks (default: displacement)")
    parser.add_argument("--contacts", action="store_true", help="tubes as thick as the normal force")
    parser.add_argument("--frame", type=int, default=-1, help="position in the series, from 0 (default: the last)")
    parser.add_argument("--size", nargs=2, type=int, default=(1400, 1200), metavar=("WIDTH", "HEIGHT"))
    return parser.parse_args(arguments)


def open_series(folder, name):
    file = os.path.join(folder, name)
    if not os.path.exists(file):
        sys.exit(f"error: paraview_view.py: {file}: no such file. Give the folder of a run; contacts need output.contacts = true.")
    source = simple.OpenDataFile(file)
    if source is None:
        sys.exit(f"error: paraview_view.py: {file}: ParaView has no reader for it. It needs ParaView 5.11 or later.")
    source.UpdatePipeline()
    return source


def go_to(source, frame):
    """The time of that frame [s]; the data are those of it from here on."""
    times = list(source.TimestepValues) if hasattr(source.TimestepValues, "__iter__") else [source.TimestepValues]
    if not -len(times) <= frame < len(times):
        sys.exit(f"error: paraview_view.py: there is no frame {frame}; the series has {len(times)}, from 0")
    source.UpdatePipeline(times[frame])
    return times[frame]


def colour_range(cells, colour):
    """Low and high: of the blocks that stay in place, or one fallen block would wash out the rest."""
    values = vtk_to_numpy(cells.GetArray(colour))
    values = values if values.ndim == 1 else np.linalg.norm(values, axis=1)
    staying = values[vtk_to_numpy(cells.GetArray("detached")) == 0] if colour in MOTION else values
    if not len(staying):
        return 0.0, 1.0
    low, high = float(min(staying.min(), 0.0)), float(staying.max())
    return low, high if high > low else low + 1.0


def show_blocks(blocks, time, colour, view):
    array = blocks.CellData.GetArray(colour)
    if array is None:
        sys.exit(f"error: paraview_view.py: blocks have no field \"{colour}\"; they have {', '.join(sorted(blocks.CellData.keys()))}")
    shown = simple.Show(blocks, view)
    shown.Representation = "Surface With Edges"
    shown.EdgeColor = [0.15, 0.15, 0.15]
    simple.ColorBy(shown, ("CELLS", colour))
    colours = simple.GetColorTransferFunction(colour)
    now = servermanager.Fetch(simple.ForceTime(Input=blocks, ForcedTime=time))    # else the first frame is fetched
    colours.RescaleTransferFunction(*colour_range(now.GetCellData(), colour))
    shown.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(colours, view)
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.ScalarBarLength = 0.5


def show_contacts(contacts, view):
    """A tube needs a surface, and its radius a value at points: both are made from the lines and their cells."""
    at_points = simple.CellDatatoPointData(Input=contacts)
    lines = simple.ExtractSurface(Input=at_points)
    greatest = contacts.CellData.GetArray("normal_force").GetRange()[1] if contacts.CellData.GetArray("normal_force") else 0.0
    if greatest <= 0.0:
        return
    bounds = contacts.GetDataInformation().GetBounds()
    tubes = simple.Tube(Input=lines, Scalars=["POINTS", "normal_force"], VaryRadius="By Scalar")
    tubes.Radius = 5e-4 * max(bounds[1] - bounds[0], bounds[3] - bounds[2])
    tubes.RadiusFactor = 10.0
    shown = simple.Show(tubes, view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.DiffuseColor = shown.AmbientColor = [0.1, 0.1, 0.1]


def main(arguments):
    options = parse(arguments)
    simple._DisableFirstRenderCameraReset()
    view = simple.GetActiveViewOrCreate("RenderView")
    view.ViewSize = list(options.size)
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0
    view.InteractionMode = "2D"
    blocks = open_series(options.folder, BLOCKS)
    time = go_to(blocks, options.frame)
    show_blocks(blocks, time, options.colour, view)
    if options.contacts:
        contacts = open_series(options.folder, CONTACTS)
        contacts.UpdatePipeline(time)
        show_contacts(contacts, view)
    view.ViewTime = time
    simple.GetAnimationScene().AnimationTime = time
    view.ResetCamera(True)
    if options.output:
        simple.SaveScreenshot(options.output, view, ImageResolution=list(options.size))
        print(options.output)
    else:
        simple.Render(view)


main(sys.argv[1:])
