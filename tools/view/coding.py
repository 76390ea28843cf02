"""How numbers are written into the page of `hdem view`: small, and with losses that are never seen. src/coding.js reads them.

A chunk is some arrays one after the other, packed by zlib. Its layout names them: [name, coding, count, scale].

    f8, f4    as they are; f4 of displacements keep 12 binary digits, so 0.025 % at most, more where a smaller step than `finest` needs them
    f2        half floats times a power of two: 11 binary digits, so 0.05 % at most; fewer below 4e-9 of the greatest, in steps of 4e-12 of it
    i2, u1    whole numbers, i2 times `scale`
    u4        differences of whole numbers to the one before
    text      UTF-8, one a line

Bytes of one array are sorted by their place in the number (all lowest bytes first), which packs better.
"""
import base64
import math
import zlib
from concurrent.futures import ThreadPoolExecutor

import numpy as np

KEPT_DIGITS = 12    # binary ones of a displacement
LEVEL = 4    # of zlib: higher ones win 2 % and take twice as long
_packers = ThreadPoolExecutor(max_workers=2)    # zlib works beside Python


def groomed(values, finest):
    """float32 in which the digits are zero that nobody sees: those below `finest` [same unit], beyond the first twelve."""
    values = np.asarray(values, np.float32)
    exponent = np.frexp(values)[1]    # |v| < 2^exponent
    wanted = exponent - math.floor(math.log2(finest)) if finest > 0.0 else np.full(values.shape, 24)
    digits = np.clip(np.maximum(wanted, KEPT_DIGITS), 0, 24).astype(np.uint32)
    dropped = np.uint32(24) - digits
    bits = values.view(np.uint32).copy()
    half = np.where(dropped > 0, np.uint32(1) << np.maximum(dropped, 1) - np.uint32(1), np.uint32(0)).astype(np.uint32)
    rounded = (bits + half) & ~((np.uint32(1) << dropped) - np.uint32(1))
    return np.where(np.isfinite(values), rounded, bits).astype(np.uint32).view(np.float32)


def half_floats(values):
    """float16, and the power of two by which they are to be multiplied."""
    values = np.asarray(values, np.float32)
    finite = np.abs(values[np.isfinite(values)])
    greatest = float(finite.max(initial=0.0))
    scale = 2.0 ** (math.frexp(greatest)[1] - 15) if greatest > 0.0 else 1.0
    with np.errstate(over="ignore"):
        return (values.astype(np.float64) / scale).astype(np.float16), scale


class Chunk:
    """Arrays that are packed together, beside what Python does next."""

    def __init__(self):
        self.layout, self._parts, self._packed = [], [], None

    def add(self, name, coding, values, scale=1.0):
        if coding == "text":
            data = "\n".join(values).encode("utf-8", "replace")
            self.layout.append([name, coding, len(data)])
            self._parts.append(data)
            return
        if coding == "f2":
            values, scale = half_floats(values)
        if coding == "u4":
            values = np.diff(np.asarray(values, np.int64), prepend=0).astype(np.int64) & 0xFFFFFFFF
        values = np.ascontiguousarray(values, {"f8": "<f8", "f4": "<f4", "f2": "<f2", "i2": "<i2", "u4": "<u4", "u1": "u1"}[coding]).ravel()
        self.layout.append([name, coding, len(values)] + ([scale] if scale != 1.0 else []))
        size = values.itemsize
        self._parts.append((values.view("u1").reshape(-1, size).T if size > 1 else values).tobytes())

    def close(self):
        """Nothing more is added: packing begins."""
        data, self._parts = b"".join(self._parts), None
        self._packed = _packers.submit(lambda: base64.b64encode(zlib.compress(data, LEVEL)).decode("ascii"))
        return self

    def text(self):
        """As it stands in the page."""
        return self._packed.result()
