"""Exceptions of the device drivers: each says what is wrong, the likely cause, what to do.

Where Python has an exception of its own for it, an error is of that kind, too.
"""


class SlamlabError(Exception):
    """Base class of slamlab's device errors: a foreseeable failure.

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
    """Port cannot be opened."""


class PortNotFound(PortError, FileNotFoundError):
    """Port does not exist: no such device or address."""


class PortPermission(PortError, PermissionError):
    """Permission denied: this user may not open the port."""


class PortBusy(PortError):
    """Port in use: another program has it open."""


class DeviceNotResponding(SlamlabError, TimeoutError):
    """Response timeout in the handshake: the port is open, but no such device answers on it."""


class ProtocolError(SlamlabError):
    """Protocol violation: what the device sends is not what the protocol says."""


class UnexpectedDescriptor(ProtocolError):
    """Response descriptor of another type than the request asked for."""


class ChecksumError(ProtocolError):
    """Corrupted data: bytes arrive, but most fail their checksum or make no sense."""


class DeviceFault(SlamlabError):
    """Device reports a hardware fault; ``health`` is what it said."""

    health = None


class ConnectionLost(SlamlabError, ConnectionError):
    """Connection lost: the device was there and is no more (unplugged)."""


class DataTimeout(SlamlabError, TimeoutError):
    """Receive timeout: data should have come by now."""


class DeviceSilent(ConnectionLost, DataTimeout):
    """Receive timeout in mid-stream, the port open: unplugged behind the adapter, or stalled."""


class UnsupportedMode(SlamlabError, ValueError):
    """Scan mode that the device does not support."""
