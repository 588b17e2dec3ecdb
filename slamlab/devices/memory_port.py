"""In-memory transport (loopback): an emulated device without a port, in real or simulated time."""

import threading

from slamlab.devices.transport import Transport, connection_lost


class MemoryPort(Transport):
    """In-memory transport to an emulated device, for tests and simulated time.

    Parameters
    ----------
    device : object with feed(data, now) -> bytes: takes what was written, gives what is due by now
        and raises OSError when it is unplugged
    clock : Clock or SimulatedClock
    name : str
    baud : int [bit/s]
    """

    POLL_INTERVAL = 0.002  # between two polls of the device while a read waits [s]

    def __init__(self, device, clock, name="memory", baud=115200):
        self.name, self.baud = name, baud
        self._device, self._clock, self._lock = device, clock, threading.Lock()
        self._waiting, self._closed = b"", False

    def read(self, n, timeout):
        """See :meth:`Transport.read`."""
        end = self._clock.now() + timeout
        while True:
            self._feed(b"")
            left = end - self._clock.now()
            if self._waiting or left <= 0:
                data, self._waiting = self._waiting[:n], self._waiting[n:]
                return data
            self._clock.sleep(min(self.POLL_INTERVAL, left))

    def write(self, data):
        """See :meth:`Transport.write`."""
        self._feed(bytes(data))

    def close(self):
        """See :meth:`Transport.close`."""
        self._closed = True

    def _feed(self, data):
        if self._closed:
            raise connection_lost(self.name, "it was closed")
        try:
            with self._lock:  # one thread reads while another writes
                self._waiting += self._device.feed(data, self._clock.now())
        except OSError as error:
            raise connection_lost(self.name, error) from error
