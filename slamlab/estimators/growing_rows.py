"""Growing rows (dynamic array): a table to which rows are appended, read without a copy."""

import numpy as np

FIRST_ROOM = 1024  # rows


class GrowingRows:
    """Table to which rows are appended again and again, such as a map of scans.

    Parameters
    ----------
    width : int, numbers in a row
    """

    def __init__(self, width):
        self._room, self._count = np.empty((FIRST_ROOM, width)), 0

    def append(self, rows):
        """Append rows, (n, width)."""
        count = self._count + len(rows)
        if count > len(self._room):  # doubled, so that a row is moved once on average
            room = np.empty((max(count, 2 * len(self._room)), self._room.shape[1]))
            room[: self._count] = self.rows
            self._room = room
        self._room[self._count : count] = rows
        self._count = count

    @property
    def rows(self):
        """All rows so far, (n, width), read-only; what is appended later is not in it."""
        rows = self._room[: self._count]
        rows.flags.writeable = False
        return rows
