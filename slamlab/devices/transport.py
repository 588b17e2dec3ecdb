"""Ways for bytes to and from a device: a serial port, a TCP connection."""

import contextlib
import select
import socket

import serial

from slamlab.devices.errors import ConnectionLost
from slamlab.devices.refusals import why_not_open, why_not_reached

WRITE_TIMEOUT = 1.0  # [s]
CONNECT_TIMEOUT = 5.0  # [s]
TCP = "socket://"


class Transport:
    """Bytes to and from one device; ``name`` is what people call it, ``baud`` its speed [bit/s]."""

    name, baud = "transport", 115200

    def read(self, n, timeout):
        """The next bytes, as soon as there are any.

        Parameters
        ----------
        n : int, how many at most
        timeout : float, how long to wait for the first [s]

        Returns
        -------
        bytes, none when nothing came

        Raises
        ------
        ConnectionLost
        """
        raise NotImplementedError

    def write(self, data):
        """Send bytes.

        Raises
        ------
        ConnectionLost
        """
        raise NotImplementedError

    def set_dtr(self, on):
        """Set the modem line DTR where there is one; bool, whether there is."""
        return False

    def close(self):
        """Let go; may be called again."""


class SerialPort(Transport):
    """A serial port, ours alone; DTR is off before it opens, for with DTR an A1's motor stops.

    Parameters
    ----------
    name : str, a device or a URL that pyserial knows
    baud : int [bit/s]

    Raises
    ------
    PortNotFound, PortPermission, PortBusy, PortError
    """

    def __init__(self, name, baud=115200):
        self.name, self.baud = name, baud
        self._port = None
        try:
            port = serial.serial_for_url(name, do_not_open=True)
            port.baudrate, port.timeout, port.write_timeout = baud, 0, WRITE_TIMEOUT
            port.dtr = False
            port.exclusive = True
            port.open()
        except (OSError, ValueError) as error:
            raise why_not_open(name, error) from error
        self._port = port

    def read(self, n, timeout):
        """See :meth:`Transport.read`."""
        port = self._open()
        try:
            if port.timeout != timeout:
                port.timeout = timeout
            first = port.read(1)
            return first + port.read(min(n - 1, port.in_waiting)) if first and n > 1 else first
        except (OSError, TypeError, ValueError) as error:  # pyserial's own when closed meanwhile
            raise lost(self.name, error) from error

    def write(self, data):
        """See :meth:`Transport.write`."""
        try:
            self._open().write(data)
        except (OSError, TypeError, ValueError) as error:
            raise lost(self.name, error) from error

    def set_dtr(self, on):
        """See :meth:`Transport.set_dtr`; a pseudo-terminal has none."""
        try:
            self._open().dtr = on
        except (OSError, TypeError, ValueError):
            return False
        return True

    def close(self):
        """See :meth:`Transport.close`."""
        port, self._port = self._port, None
        if port is not None:
            with contextlib.suppress(OSError):  # what was unplugged is closed already
                port.close()

    def _open(self):
        if self._port is None:
            raise lost(self.name, "it was closed")
        return self._port


class SocketPort(Transport):
    """A TCP connection, as to an emulator: ``socket://HOST:PORT``.

    Parameters
    ----------
    name : str
    baud : int, of the line at the other end [bit/s]

    Raises
    ------
    PortNotFound, PortError
    """

    def __init__(self, name, baud=115200):
        self.name, self.baud = name, baud
        host, colon, port = name.removeprefix(TCP).rpartition(":")
        try:
            if not colon:
                raise ValueError("no port number: it should read socket://HOST:PORT")
            self._socket = socket.create_connection((host, int(port)), CONNECT_TIMEOUT)
        except (OSError, ValueError, OverflowError) as error:
            raise why_not_reached(name, error) from error
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket.settimeout(WRITE_TIMEOUT)

    def read(self, n, timeout):
        """See :meth:`Transport.read`."""
        try:
            if not select.select([self._socket], [], [], timeout)[0]:
                return b""
            data = self._socket.recv(n)
        except (OSError, ValueError) as error:
            raise lost(self.name, error) from error
        if not data:
            raise lost(self.name, "the other end closed the connection")
        return data

    def write(self, data):
        """See :meth:`Transport.write`."""
        try:
            self._socket.sendall(data)
        except OSError as error:
            raise lost(self.name, error) from error

    def close(self):
        """See :meth:`Transport.close`."""
        self._socket.close()


def open_port(name, baud=115200):
    """Open a port by its name.

    Parameters
    ----------
    name : str, such as /dev/ttyUSB0, COM3, socket://HOST:PORT
    baud : int [bit/s]

    Returns
    -------
    Transport

    Raises
    ------
    PortNotFound, PortPermission, PortBusy, PortError
    """
    return (SocketPort if name.startswith(TCP) else SerialPort)(name, baud)


def lost(name, why):
    """The error of a port that was open and works no more."""
    return ConnectionLost(
        f"the connection {name} broke ({why})",
        "the plug was pulled, or another program reads the same port",
        "plug it in again, close other programs that use it, and open it anew",
    )
