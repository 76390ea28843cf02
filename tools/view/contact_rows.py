"""Contacts of all frames: each place of a contact once, and what it carries frame by frame. For run_pack.py."""
import numpy as np

SAME_PLACE = 1.0 / 500.0    # of the block's radius: ends of a contact that moved less are where they were
REACH = 4.0    # ends of a contact farther than this many radii from the first block's centroid stand at its limit
STEP = REACH / 32767.0
MOST_OF_ONE_PAIR = 256    # contacts between the parts of two blocks
QUANTITIES = ["normal_force", "shear_force", "slip", "plastic_slip", "opening", "damage", "broken", "pore_pressure"]    # where the frame has them


class ContactRows:
    """A row: two blocks (slots) and both ends in the axes of the first one, in steps of its radius."""

    def __init__(self):
        self.blocks, self.ends, self.count = [], [], 0
        self._key, self._row = np.empty(0, np.int64), np.empty(0, np.int64)    # the last row of each contact, by key
        self._last = np.empty((0, 4))

    def rows_of(self, contacts, slot_of_id, pose, radius):
        """Row of each contact of a frame, and the frame's order by row. `pose` [slots, 3]: x, y, angle."""
        slots = slot_of_id[contacts["blocks"]]
        first = slots[:, 0]
        x, y, angle = pose[first].T
        cosine, sine = np.cos(angle), np.sin(angle)
        dx, dy = contacts["points"][:, :, 0] - x[:, None], contacts["points"][:, :, 1] - y[:, None]
        local = np.stack([cosine[:, None] * dx + sine[:, None] * dy, cosine[:, None] * dy - sine[:, None] * dx], axis=2).reshape(-1, 4) / radius[first, None]
        key = self._keys(slots, len(slot_of_id))
        place = np.searchsorted(self._key, key)
        known = place < len(self._key)
        known[known] = self._key[place[known]] == key[known]
        stays = known.copy()
        stays[known] = np.all(np.abs(self._last[place[known]] - local[known]) <= SAME_PLACE, axis=1)
        rows = np.empty(len(key), np.int64)
        rows[stays] = self._row[place[stays]]
        new = np.flatnonzero(~stays)
        rows[new] = self.count + np.arange(len(new))
        self._remember(key, place, known, new, rows, local)
        self.blocks.append(slots[new])
        self.ends.append(np.round(np.clip(local[new], -REACH, REACH) / STEP).astype(np.int16))
        self.count += len(new)
        order = np.argsort(rows, kind="stable")
        return rows[order], order

    @staticmethod
    def _keys(slots, count):
        """Of the two blocks, and a number where their parts have several contacts."""
        pair = slots[:, 0].astype(np.int64) * count + slots[:, 1]
        order = np.argsort(pair, kind="stable")
        sorted_pair = pair[order]
        begins = np.r_[True, sorted_pair[1:] != sorted_pair[:-1]]
        turn = np.arange(len(pair)) - np.flatnonzero(begins)[np.cumsum(begins) - 1]
        key = np.empty(len(pair), np.int64)
        key[order] = sorted_pair * MOST_OF_ONE_PAIR + turn % MOST_OF_ONE_PAIR
        return key

    def _remember(self, key, place, known, new, rows, local):
        moved = new[known[new]]
        self._row[place[moved]], self._last[place[moved]] = rows[moved], local[moved]
        added = new[~known[new]]
        if len(added):
            order = np.argsort(key[added], kind="stable")
            added = added[order]
            where = np.searchsorted(self._key, key[added])
            self._key, self._row = np.insert(self._key, where, key[added]), np.insert(self._row, where, rows[added])
            self._last = np.insert(self._last, where, local[added], axis=0)

    def tables(self):
        if not self.blocks:
            return np.empty((0, 2), np.int64), np.empty((0, 4), np.int16)
        return np.concatenate(self.blocks), np.concatenate(self.ends)
