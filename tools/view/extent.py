"""What the page draws beside blocks, from corner to corner: it fits its picture to that and to the blocks. For run_pack.py."""
import numpy as np


def box_of(points):
    """x0, y0, x1, y1; None of nothing."""
    return [*points.min(axis=0).tolist(), *points.max(axis=0).tolist()] if len(points) else None


class Extent:
    """Every bolt and lining counts where it was first seen: what falls away with its block must not make all the rest small."""

    def __init__(self):
        self._seen, self._points, self._lined = set(), [], []

    def add_places(self, points):
        """Of outlines and water tables, which stay where they are."""
        self._points.append(np.asarray(points, float).reshape(-1, 2))

    def add_bolts(self, bolts):
        self._points.append(bolts["points"][self._new("bolt", bolts["bolt"])].reshape(-1, 2))

    def add_linings(self, liners):
        self._lined.append(liners["points"][self._new("liner", liners["liner"])].reshape(-1, 2))

    def _new(self, kind, numbers):
        """Which of them no frame before had."""
        new = np.array([(kind, int(number)) not in self._seen for number in numbers], bool)
        self._seen.update((kind, int(number)) for number in numbers)
        return new

    def boxes(self, origin):
        """Of all but linings, and of linings, whose diagrams stand off them."""
        return {name: box_of(np.concatenate([np.empty((0, 2)), *points]) - origin) for name, points in (("beside", self._points), ("lined", self._lined))}
