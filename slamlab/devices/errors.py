"""What can go wrong between a program and a device: each with what, the likely cause, what to do.

Where Python has a kind of its own for it, an error is of that kind, too.
"""


class SlamlabError(Exception):
    """Something foreseeable went wrong.

    Parameters
    ----------
    what : str, what is the case
    cause : str, the likely one
    step : str, what to do next
    """

    def __init__(self, what, cause, step):
        self.what, self.cause, self.step = what, cause, step
        super().__init__(f"{what}. Likely: {cause}. Next: {step}.")

    def __reduce__(self):
        return type(self), (self.what, self.cause, self.step)


class PortError(SlamlabError, OSError):
    """A port cannot be opened."""


class PortNotFound(PortError, FileNotFoundError):
    """There is no such port."""


class PortPermission(PortError, PermissionError):
    """The port may not be opened by this user."""


class PortBusy(PortError):
    """Another program has the port."""


class DeviceNotResponding(SlamlabError, TimeoutError):
    """The port is open, but what hangs on it does not answer as the device should."""


class ProtocolError(SlamlabError):
    """What the device sends is not what the protocol says."""


class UnexpectedDescriptor(ProtocolError):
    """Another answer came than the request asked for."""


class ChecksumError(ProtocolError):
    """Bytes arrive, but most of them damaged."""


class DeviceFault(SlamlabError):
    """The device says that it is broken; ``health`` is what it said."""

    health = None


class ConnectionLost(SlamlabError, ConnectionError):
    """The device was there and is no more."""


class DataTimeout(SlamlabError, TimeoutError):
    """Data should have come by now."""


class DeviceSilent(ConnectionLost, DataTimeout):
    """A stream ceased though the port still is open: unplugged behind the adapter, or stalled."""


class UnsupportedMode(SlamlabError, ValueError):
    """The device has no such scan mode."""
