"""What ParaView's own reader makes of a run's frames, as JSON; run by pvbatch.

    dump_arrays.py FOLDER OUT.json
"""
import json
import sys

from paraview import servermanager, simple


def arrays_of(frame):
    cells = frame.GetCellData()
    arrays = {cells.GetArrayName(i): cells.GetArray(i) for i in range(cells.GetNumberOfArrays())}
    return {name: {"components": array.GetNumberOfComponents(), "ranges": [array.GetRange(k) for k in range(array.GetNumberOfComponents())]}
            for name, array in arrays.items()}


def frames_of(file):
    """Opened as by a double click: nothing says which reader to take."""
    source = simple.OpenDataFile(file)
    found = []
    for time in source.TimestepValues:
        frame = servermanager.Fetch(simple.ForceTime(Input=source, ForcedTime=time))
        found.append({"time": time, "cells": frame.GetNumberOfCells(), "points": frame.GetNumberOfPoints(), "bounds": frame.GetBounds(),
                      "kinds": sorted({frame.GetCellType(i) for i in range(frame.GetNumberOfCells())}), "arrays": arrays_of(frame)})
    return found


folder, out = sys.argv[1:3]
with open(out, "w", encoding="utf-8") as file:
    json.dump({kind: frames_of(f"{folder}/{kind}.hdf.series") for kind in ("blocks", "contacts")}, file)
