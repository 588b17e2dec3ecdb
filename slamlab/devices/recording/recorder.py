"""Recorder: logs every byte that goes over the ports of devices while programs use them."""

import contextlib
import gzip
import shutil
import threading
from datetime import UTC, datetime
from pathlib import Path

from slamlab import __version__
from slamlab.devices.clock import Clock
from slamlab.devices.errors import ConnectionLost
from slamlab.devices.recording.recording_file import EVENT, MAX_RECORD, RX, TX, Record, header_line
from slamlab.devices.shutdown import close_at_exit
from slamlab.devices.transport import Transport, open_port

FLUSH_INTERVAL = 1.0  # between flushes to disk: what is lost at most in a crash [s]


class Recorder:
    """Recorder of a raw recording; its file is append-only.

    Where the name ends in .gz the file is packed when it is closed, and has no .gz until then.

    Parameters
    ----------
    path : str or Path, of a file that is not there yet
    devices : dict by channel, "lidar" or "emir", of what is known: port, baud
    clock : Clock, the drivers' one

    ``error`` is why it could not write on, if so: the devices go on. ``received`` counts bytes.

    Raises
    ------
    FileExistsError, OSError
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
        header = {
            "slamlab": __version__,
            "created": datetime.now(UTC).isoformat(timespec="seconds"),
            "monotonic_ns": self._now(),
            "devices": devices,
        }
        self._file.write(header_line(header))
        self._file.flush()
        close_at_exit(self)

    def opener(self, channel, opener=open_port):
        """Wrap an opener of ports, so that all that goes over them is recorded.

        Parameters
        ----------
        channel : str, "lidar" or "emir"
        opener : callable(name, baud) -> Transport

        Returns
        -------
        callable(name, baud) -> Transport, as drivers take it
        """

        def opened(name, baud):
            port = RecordedPort(opener(name, baud), self, channel)
            self.event(channel, f"opened {name} at {baud} baud")
            return port

        return opened

    def event(self, channel, text):
        """Record an event, such as a lost connection."""
        self.write(EVENT, channel, text.encode())

    def write(self, kind, channel, data):
        """Record bytes with the time now.

        Parameters
        ----------
        kind : RX, TX or EVENT
        channel : str
        data : bytes
        """
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

    def close(self):
        """Close the recording; may be called again."""
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

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()

    def _now(self):
        return round(self.clock.now() * 1e9)


class RecordedPort(Transport):
    """Transport whose every byte is recorded, in the pieces in which it was read.

    Parameters
    ----------
    port : Transport
    recorder : Recorder
    channel : str
    """

    def __init__(self, port, recorder, channel):
        self._port, self._recorder, self._channel = port, recorder, channel
        self._closed = False
        self.name, self.baud = port.name, port.baud

    def read(self, n, timeout):
        """See :meth:`Transport.read`."""
        with self._record_gaps():
            data = self._port.read(n, timeout)
        if data:
            self._recorder.write(RX, self._channel, data)
        return data

    def write(self, data):
        """See :meth:`Transport.write`."""
        self._recorder.write(TX, self._channel, bytes(data))  # before it: answers come after
        with self._record_gaps():
            self._port.write(data)

    def set_dtr(self, on):
        """See :meth:`Transport.set_dtr`."""
        return self._port.set_dtr(on)

    def close(self):
        """See :meth:`Transport.close`."""
        self._closed = True  # before it: a thread that reads meanwhile loses no connection by it
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
