"""Exceptions of the device drivers: each states the error, a likely cause, and what to do."""


class SlamlabError(Exception):
    """Base class of device errors.

    Parameters
    ----------
    what : str, what is wrong
    cause : str, the likely cause
    step : str, what to do
    """

    def __init__(self, what, cause, step):
        self.what, self.cause, self.step = what, cause, step
        super().__init__(f"{what}. Likely cause: {cause}. What to do: {step}.")

    def __reduce__(self):
        return type(self), (self.what, self.cause, self.step)


class PortError(SlamlabError, OSError):
    """The port cannot be opened."""


class PortNotFound(PortError, FileNotFoundError):
    """The device or address does not exist."""


class PortPermission(PortError, PermissionError):
    """The user has no permission to open the port."""


class PortBusy(PortError):
    """Another program uses the port."""


class DeviceNotResponding(SlamlabError, TimeoutError):
    """The port is open, but the device on it does not respond."""


class ProtocolError(SlamlabError):
    """The received bytes violate the protocol."""


class UnexpectedDescriptor(ProtocolError):
    """The response descriptor does not have the type that the request requires."""


class ChecksumError(ProtocolError):
    """Most of the received packets are malformed or have a wrong checksum."""


class DeviceFault(SlamlabError):
    """The device reports a hardware fault with the status ``health``."""

    health = None


class ConnectionLost(SlamlabError, ConnectionError):
    """The connection was lost, for example because the device was unplugged."""


class DataTimeout(SlamlabError, TimeoutError):
    """No data arrived before the receive timeout."""


class DeviceSilent(ConnectionLost, DataTimeout):
    """The data stream stopped although the port is still open (receive timeout)."""


class UnsupportedMode(SlamlabError, ValueError):
    """The device does not support the scan mode."""
