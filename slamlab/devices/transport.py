"""Transport layer: bytes to and from a device over a serial port (UART) or a TCP socket."""

import contextlib
import select
import socket

import serial

from slamlab.devices.errors import ConnectionLost
from slamlab.devices.port_open_errors import serial_open_error, tcp_connect_error

WRITE_TIMEOUT = 1.0  # until a blocked write is a lost connection [s]
CONNECT_TIMEOUT = 5.0  # of a TCP connection [s]
TCP_PREFIX = "socket://"  # of port names that are TCP addresses


class Transport:
    """Transport of bytes to and from one device: ``name`` of the port, baud rate [bit/s]."""

    name, baud = "transport", 115200

    def read(self, n, timeout):
        """Read the next bytes, as soon as there are any, or none at the timeout.

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
        """Write bytes to the device.

        Raises
        ------
        ConnectionLost
        """
        raise NotImplementedError

    def set_dtr(self, on):
        """Set the modem control line DTR where there is one; bool, whether there is."""
        return False

    def close(self):
        """Close the port; may be called again."""


class SerialPort(Transport):
    """Serial port, opened exclusively; DTR is off before, for with DTR an A1's motor stops.

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
            raise serial_open_error(name, error) from error
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
            raise connection_lost(self.name, error) from error

    def write(self, data):
        """See :meth:`Transport.write`."""
        try:
            self._open().write(data)
        except (OSError, TypeError, ValueError) as error:
            raise connection_lost(self.name, error) from error

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
            raise connection_lost(self.name, "it was closed")
        return self._port


class SocketPort(Transport):
    """TCP socket as a transport, as to an emulator: ``socket://HOST:PORT``.

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
        host, colon, port = name.removeprefix(TCP_PREFIX).rpartition(":")
        try:
            if not colon:
                raise ValueError("no port number: it should read socket://HOST:PORT")
            self._socket = socket.create_connection((host, int(port)), CONNECT_TIMEOUT)
        except (OSError, ValueError, OverflowError) as error:
            raise tcp_connect_error(name, error) from error
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket.settimeout(WRITE_TIMEOUT)

    def read(self, n, timeout):
        """See :meth:`Transport.read`."""
        try:
            if not select.select([self._socket], [], [], timeout)[0]:
                return b""
            data = self._socket.recv(n)
        except (OSError, ValueError) as error:
            raise connection_lost(self.name, error) from error
        if not data:
            raise connection_lost(self.name, "the other end closed the connection")
        return data

    def write(self, data):
        """See :meth:`Transport.write`."""
        try:
            self._socket.sendall(data)
        except OSError as error:
            raise connection_lost(self.name, error) from error

    def close(self):
        """See :meth:`Transport.close`."""
        self._socket.close()


def open_port(name, baud=115200):
    """Open a serial port or a TCP connection by its name.

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
    return (SocketPort if name.startswith(TCP_PREFIX) else SerialPort)(name, baud)


def connection_lost(name, why):
    """ConnectionLost for a port that was open and works no more."""
    return ConnectionLost(
        f"the connection to {name} was lost ({why})",
        "the plug was pulled, or another program reads the same port",
        "plug it in again, close other programs that use it, and open it anew",
    )
