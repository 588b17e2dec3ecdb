"""Emulated devices without ports, in simulated time: clients in the same program open them."""

from slamlab.devices.memory_port import MemoryPort


class MemoryEmulators:
    """Emulated devices in memory: as :class:`EmulatorRunner`, but time passes as a clock says.

    Parameters
    ----------
    devices : dict of devices with feed(bytes, now) -> bytes by name
    clock : SimulatedClock
    """

    def __init__(self, devices, clock):
        self._devices, self.clock = devices, clock

    @property
    def ports(self):
        """Port names that clients open by :meth:`opener`: dict by device."""
        return {name: name for name in self._devices}

    def __getitem__(self, name):
        """Emulated device of a name."""
        return self._devices[name]

    def opener(self, name, baud):
        """Open a device by its name, as :func:`open_port` does; Transport."""
        return MemoryPort(self._devices[name], self.clock, name, baud)

    def close(self):
        """Nothing is open; for symmetry."""

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()
