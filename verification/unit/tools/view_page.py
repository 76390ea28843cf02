"""Reads a page of `hdem view` as tools/view/README.md describes it, on its own account; and counts the pixels of a picture."""
import base64
import json
import re
import zlib

import matplotlib.image
import numpy as np

SIZE = {"f8": 8, "f4": 4, "f2": 2, "i2": 2, "u4": 4, "u1": 1, "text": 1}
KIND = {"f8": "<f8", "f4": "<f4", "f2": "<f2", "i2": "<i2", "u4": "<u4", "u1": "u1"}


class ViewPage:
    def __init__(self, file):
        self.text = file.read_text(encoding="utf-8")
        scripts = dict(re.findall(r'<script type="application/[a-z-]+" id="([^"]+)">([^<]*)</script>', self.text))
        self.facts = json.loads(scripts.pop("hdem-facts"))
        self.chunks = scripts
        self.runs = self.facts["runs"]

    def arrays(self, entry):
        """name -> array"""
        data, begin, found = zlib.decompress(base64.b64decode(self.chunks[entry["id"]], validate=True)), 0, {}
        for name, coding, count, *scale in entry["layout"]:
            raw = data[begin:begin + count * SIZE[coding]]
            begin += len(raw)
            if coding == "text":
                found[name] = raw.decode().split("\n")
                continue
            values = np.frombuffer(raw, np.uint8).reshape(SIZE[coding], count).T.copy().view(KIND[coding]).ravel()
            if coding == "u4":
                values = np.cumsum(values, dtype=np.uint32)
            found[name] = values.astype(float) * scale[0] if scale else values
        assert begin == len(data), entry["id"]
        return found

    def shapes(self, run=0):
        return self.arrays(self.runs[run]["static"])

    def poses(self, frame, run=0):
        """slots of the frame's blocks, and their x, y, angle in the user's coordinates."""
        facts, shapes = self.runs[run], self.shapes(run)
        entry = facts["frames"][frame]
        arrays = self.arrays(entry["chunk"])
        slots = arrays.get("index", np.arange(len(arrays["flags"])))
        here = {name: shapes[f"reference_{name}/{entry['reference']}"][slots].astype(float) for name in ("x", "y", "angle")}
        x = facts["origin"][0] + shapes["base_x"][slots] + here["x"] + arrays["displacement_x"]
        y = facts["origin"][1] + shapes["base_y"][slots] + here["y"] + arrays["displacement_y"]
        return slots, np.stack([x, y, here["angle"] + arrays["rotation"]], axis=1)


def pixels(file):
    """Rows of pixels, 0 to 255"""
    return np.round(matplotlib.image.imread(file)[:, :, :3] * 255.0).astype(int)


def count(picture, colour, tolerance=6):
    return int(np.count_nonzero(np.all(np.abs(picture - np.array(colour)) <= tolerance, axis=2)))


def middle(picture, colour, tolerance=6):
    """Column and row of the middle of the pixels of a colour."""
    rows, columns = np.nonzero(np.all(np.abs(picture - np.array(colour)) <= tolerance, axis=2))
    return columns.mean() + 0.5, rows.mean() + 0.5


def covered(picture, colour, ground):
    """Pixels of a colour on a ground; those on an edge, which are smoothed, by their share."""
    way = np.array(colour, float) - np.array(ground, float)
    return float(np.sum(np.clip((picture - np.array(ground)) @ way / (way @ way), 0.0, 1.0)))
