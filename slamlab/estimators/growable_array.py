"""Growable (dynamic) array: appending or reading rows does not copy the array."""

import numpy as np

INITIAL_CAPACITY = 1024  # rows


class GrowableArray:
    """Array of ``width`` columns to which rows are appended."""

    def __init__(self, width):
        self._buffer, self._count = np.empty((INITIAL_CAPACITY, width)), 0

    def append(self, rows):
        count = self._count + len(rows)
        if count > len(self._buffer):  # doubled, so that appending costs O(1) on average
            buffer = np.empty((max(count, 2 * len(self._buffer)), self._buffer.shape[1]))
            buffer[: self._count] = self.rows
            self._buffer = buffer
        self._buffer[self._count : count] = rows
        self._count = count

    @property
    def rows(self):
        """All rows so far (n, width), read-only."""
        rows = self._buffer[: self._count]
        rows.flags.writeable = False
        return rows
