"""Emulated devices in memory (loopback), for clients in the same program."""

import threading

from slamlab.devices.emulator.serial_line import with_baud_rate
from slamlab.devices.shutdown import Closeable
from slamlab.devices.transport import Transport, connection_lost


class InMemoryPort(Transport):
    """Transport to a device that has feed(bytes, now) -> bytes; raises OSError when unplugged."""

    POLL_INTERVAL = 0.002  # of the device, while a read waits [s]

    def __init__(self, device, clock, name="memory", baud=115200):
        self.name, self.baud = name, baud
        self._device, self._clock, self._lock = device, clock, threading.Lock()
        self._waiting, self._closed = b"", False

    def read(self, n, timeout):
        end = self._clock.now() + timeout
        while True:
            self._feed(b"")
            left = end - self._clock.now()
            if self._waiting or left <= 0:
                data, self._waiting = self._waiting[:n], self._waiting[n:]
                return data
            self._clock.sleep(min(self.POLL_INTERVAL, left))

    def write(self, data):
        self._feed(bytes(data))

    def close(self):
        self._closed = True

    def _feed(self, data):
        if self._closed:
            raise connection_lost(self.name, "the port is closed")
        try:
            with self._lock:  # one thread reads while another writes
                self._waiting += self._device.feed(data, self._clock.now())
        except OSError as error:
            raise connection_lost(self.name, error) from error


class InMemoryEmulators(Closeable):
    """Like :class:`EmulatorRunner`, but the devices run in memory and with a given clock."""

    def __init__(self, devices, clock):
        self._devices, self.clock = devices, clock

    @property
    def ports(self):
        """The name of each device's port, which :meth:`opener` accepts."""
        return {name: name for name in self._devices}

    def __getitem__(self, name):
        return self._devices[name]

    def opener(self, name, baud):
        return InMemoryPort(with_baud_rate(self._devices[name], baud), self.clock, name, baud)

    def close(self):
        """Do nothing, because no port is open."""
