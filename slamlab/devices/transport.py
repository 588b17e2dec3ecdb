"""Transport layer for bytes over a serial port (UART, with pyserial) or over a TCP socket."""

import contextlib
import select
import socket

import serial

from slamlab.devices.errors import ConnectionLost
from slamlab.devices.serial_ports import serial_open_error, tcp_connect_error

WRITE_TIMEOUT = 1.0  # after which a blocked write is a lost connection [s]
CONNECT_TIMEOUT = 5.0  # of a TCP connection [s]
TCP_PREFIX = "socket://"  # of port names that are TCP addresses


class Transport:
    """Byte stream to and from a device over the port ``name`` at the baud rate ``baud`` [bit/s]."""

    name, baud = "transport", 115200

    def read(self, n, timeout):
        """Return at most n bytes as soon as any are available; return none after the timeout [s].

        Raises ConnectionLost.
        """
        raise NotImplementedError

    def write(self, data):
        """Write bytes. Raises ConnectionLost."""
        raise NotImplementedError

    def set_dtr(self, on):
        """Set the modem control line DTR and return whether the port has this line."""
        return False

    def close(self):
        """Close the port; repeated calls are safe."""


class SerialPort(Transport):
    """Serial port, given by name or pyserial URL; opened exclusively. Raises PortError."""

    def __init__(self, name, baud=115200):
        self.name, self.baud = name, baud
        self._port = None
        try:
            port = serial.serial_for_url(name, do_not_open=True)
            port.baudrate, port.timeout, port.write_timeout = baud, 0, WRITE_TIMEOUT
            port.dtr = False  # DTR stops the motor of an A1
            port.exclusive = True
            port.open()
        except (OSError, ValueError, OverflowError) as error:
            raise serial_open_error(name, error) from error
        self._port = port

    def read(self, n, timeout):
        port = self._open()
        try:
            if port.timeout != timeout:
                port.timeout = timeout
            first = port.read(1)
            return first + port.read(min(n - 1, port.in_waiting)) if first and n > 1 else first
        except (OSError, TypeError, ValueError) as error:  # of a port that was closed meanwhile
            raise connection_lost(self.name, error) from error

    def write(self, data):
        try:
            self._open().write(data)
        except (OSError, TypeError, ValueError) as error:
            raise connection_lost(self.name, error) from error

    def set_dtr(self, on):
        try:
            self._open().dtr = on
        except (OSError, TypeError, ValueError):
            return False
        return True

    def close(self):
        port, self._port = self._port, None
        if port is not None:
            with contextlib.suppress(OSError):  # an unplugged port is closed already
                port.close()

    def _open(self):
        if self._port is None:
            raise connection_lost(self.name, "the port is closed")
        return self._port


class SocketPort(Transport):
    """Transport over a TCP connection to ``socket://HOST:PORT``. Raises PortError."""

    def __init__(self, name, baud=115200):
        self.name, self.baud = name, baud
        host, colon, port = name.removeprefix(TCP_PREFIX).rpartition(":")
        try:
            if not colon:
                raise ValueError("the port number is missing; use socket://HOST:PORT")
            self._socket = socket.create_connection((host, int(port)), CONNECT_TIMEOUT)
        except (OSError, ValueError, OverflowError) as error:
            raise tcp_connect_error(name, error) from error
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket.settimeout(WRITE_TIMEOUT)

    def read(self, n, timeout):
        try:
            if not select.select([self._socket], [], [], timeout)[0]:
                return b""
            data = self._socket.recv(n)
        except (OSError, ValueError) as error:
            raise connection_lost(self.name, error) from error
        if not data:
            raise connection_lost(self.name, "the server closed the connection")
        return data

    def write(self, data):
        try:
            self._socket.sendall(data)
        except OSError as error:
            raise connection_lost(self.name, error) from error

    def close(self):
        self._socket.close()


def open_port(name, baud=115200):
    """Open a transport by name, such as COM3 or socket://HOST:PORT. Raises PortError."""
    return (SocketPort if name.startswith(TCP_PREFIX) else SerialPort)(name, baud)


def connection_lost(name, why):
    return ConnectionLost(
        f"the connection to {name} was lost ({why})",
        "the device was unplugged, or another program reads the same port",
        "plug in the device, close other programs that use the port, then open the port again",
    )
