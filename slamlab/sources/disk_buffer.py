"""Disk buffer of parsed readings: in memory up to a limit, then in a temporary file."""

import pickle
from tempfile import TemporaryFile

import numpy as np

from slamlab.files import disk_full_error

IN_MEMORY = 64 * 2**20  # rows beyond this size are written to a temporary file [bytes]


class DiskBuffer:
    """Sequence of rows (readings, tuples …) with append, length and repeated iteration."""

    def __init__(self):
        self._rows, self._free, self._file = [], IN_MEMORY, None
        self._in_file = self._end = 0

    def __del__(self):
        if self._file is not None:
            self._file.close()

    def __len__(self):
        return len(self._rows) + self._in_file

    def append(self, row):
        """Append a row. Raises SourceError if the disk is full."""
        if self._file is None:
            self._free -= _size(row)
            if self._free >= 0:
                self._rows.append(row)
                return
        try:
            self._write(row)
        except OSError as error:
            raise disk_full_error("the readings", error) from None

    def __iter__(self):
        yield from self._rows
        at = 0  # of this iterator: several may run at the same time
        for _ in range(self._in_file):
            self._seek(at)
            row = pickle.load(self._file)
            at = self._file.tell()
            yield row

    def _write(self, row):
        if self._file is None:
            self._file = TemporaryFile()  # noqa: SIM115 - lives as long as the buffer
        self._seek(self._end)
        pickle.dump(row, self._file, protocol=5)
        self._end = self._file.tell()
        self._in_file += 1

    def _seek(self, at):
        if self._file.tell() != at:  # seeking empties the file's buffer
            self._file.seek(at)


def _size(row):
    """Estimate the size of a row [bytes]."""
    size = 200
    for part in row if isinstance(row, tuple) else vars(row).values():
        if isinstance(part, np.ndarray):
            size += 100 + part.nbytes
        elif hasattr(part, "__dict__"):
            size += _size(part)
    return size
