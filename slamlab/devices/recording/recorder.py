"""Recorder that stores every byte that is sent or received over the ports of devices."""

import contextlib
import gzip
import os
import shutil
import threading
from datetime import UTC, datetime
from pathlib import Path

from slamlab import __version__
from slamlab.devices.clock import Clock
from slamlab.devices.errors import ConnectionLost
from slamlab.devices.recording.recording_file import EVENT, MAX_RECORD, RX, TX, Record, header_line
from slamlab.devices.shutdown import Closeable, close_at_exit
from slamlab.devices.transport import Transport, open_port

BAUD_DIGITS = 8  # at most, of a baud rate
FLUSH_INTERVAL = 1.0  # between flushes to disk: the most that a crash loses [s]


class Recorder(Closeable):
    """Writer of a raw recording; compresses the file on closing if its name ends in .gz.

    ``error``: exception that ended the writing, or None; ``received``: number of received bytes.
    Raises FileExistsError or OSError.

    Parameters
    ----------
    path : str or Path, of a new file
    devices : dict by channel, "lidar" or "emir", of properties: port, baud; baud None: the rate of
        the last opening is stored
    clock : Clock of the drivers
    """

    def __init__(self, path, devices, clock=None):
        path = Path(path)
        self.clock, self.error, self.received = clock or Clock(), None, 0
        self._gzip_path = path if path.suffix == ".gz" else None
        self.path = path.with_suffix("") if self._gzip_path else path
        if self._gzip_path and path.exists():
            raise FileExistsError(17, "File exists", str(path))
        self._file, self._lock = self.path.open("xb"), threading.RLock()
        self._flushed = self.clock.now()
        self._header = {
            "slamlab": __version__,
            "created": datetime.now(UTC).isoformat(timespec="seconds"),
            "monotonic_ns": self._now(),
            "devices": {channel: dict(known) for channel, known in devices.items()},
        }
        self._detected = {name for name, known in devices.items() if known.get("baud", 0) is None}
        # with space for the baud rates
        self._header_size = len(header_line(self._header)) + BAUD_DIGITS * len(self._detected)
        self._write_header()
        close_at_exit(self)

    def opener(self, channel, opener=open_port):
        """Return an opener for a driver; it records all bytes of the port of a channel."""

        def opened(name, baud):
            port = RecordedPort(opener(name, baud), self, channel)
            if channel in self._detected:
                self._header["devices"][channel]["baud"] = baud
                self._write_header()
            self.event(channel, f"opened {name} at {baud} baud")
            return port

        return opened

    def event(self, channel, text):
        self.write(EVENT, channel, text.encode())

    def write(self, kind, channel, data):
        """Record bytes with their kind (RX, TX or EVENT) and the current time."""
        with self._lock:
            if self._file is None or self.error is not None:
                return
            self.received += len(data) if kind == RX else 0
            try:
                for at in range(0, len(data) or 1, MAX_RECORD):
                    record = Record(kind, channel, self._now(), data[at : at + MAX_RECORD])
                    self._file.write(record.pack())
                if self.clock.now() - self._flushed >= FLUSH_INTERVAL:
                    self._file.flush()
                    self._flushed = self.clock.now()
            except OSError as error:
                self.error = error

    def _write_header(self):
        with self._lock:
            if self._file is None or self.error is not None:
                return
            line = header_line(self._header).rstrip()
            try:
                self._file.seek(0)
                self._file.write(line.ljust(self._header_size - 1) + b"\n")
                self._file.seek(0, os.SEEK_END)
                self._file.flush()
            except OSError as error:
                self.error = error

    def close(self):
        """Close the recording; repeated calls are safe."""
        with self._lock:
            file, self._file = self._file, None
            if file is None:
                return
            try:
                file.close()
                if self._gzip_path is not None:
                    with self.path.open("rb") as plain, gzip.open(self._gzip_path, "xb") as packed:
                        shutil.copyfileobj(plain, packed)
                    self.path.unlink()
                    self.path = self._gzip_path
            except OSError as error:
                self.error = self.error or error

    def _now(self):
        return round(self.clock.now() * 1e9)


class RecordedPort(Transport):
    """Transport that records all bytes in the chunks in which they are read or written."""

    def __init__(self, port, recorder, channel):
        self._port, self._recorder, self._channel = port, recorder, channel
        self._closed = False
        self.name, self.baud = port.name, port.baud

    def read(self, n, timeout):
        with self._record_gaps():
            data = self._port.read(n, timeout)
        if data:
            self._recorder.write(RX, self._channel, data)
        return data

    def write(self, data):
        self._recorder.write(TX, self._channel, bytes(data))  # before the response arrives
        with self._record_gaps():
            self._port.write(data)

    def set_dtr(self, on):
        return self._port.set_dtr(on)

    def close(self):
        self._closed = True  # before closing: the reading thread then records no lost connection
        self._port.close()
        self._recorder.event(self._channel, "closed")

    @contextlib.contextmanager
    def _record_gaps(self):
        try:
            yield
        except ConnectionLost as error:
            if not self._closed:
                self._recorder.event(self._channel, f"gap: {error.what}")
            raise
