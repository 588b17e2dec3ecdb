"""TCP server as an emulator's port: for Windows, and for another computer."""

import contextlib
import os
import socket

from slamlab.devices.emulator.pseudo_terminal import READ_SIZE, EmulatorPort
from slamlab.devices.errors import PortError


class TcpServer(EmulatorPort):
    """TCP server for one client at a time, as an emulator's port; a second one finds it closed.

    Parameters
    ----------
    host : str, on which it listens
    port : int, 0 for any that is free

    Raises
    ------
    PortError
    """

    def __init__(self, host="127.0.0.1", port=0):
        super().__init__()
        self._address, self._client = (host, port), None
        self.plug()
        self._address = self._listener.getsockname()[:2]
        self.name = "socket://{}:{}".format(*self._address)

    def files(self):
        """See :meth:`EmulatorPort.files`."""
        if not self.plugged:
            return []
        return [self._listener] + ([self._client] if self._client is not None else [])

    def receive(self):
        """See :meth:`EmulatorPort.receive`."""
        if not self.plugged:
            return b""
        received = self._receive_all()  # first: who has gone makes room for who comes
        with contextlib.suppress(BlockingIOError):
            self._accept(self._listener.accept()[0])
        return received

    def send(self, data):
        """See :meth:`EmulatorPort.send`; without a client nothing is buffered."""
        if self._client is not None:
            super().send(data)

    def plug(self):
        """See :meth:`EmulatorPort.plug`."""
        self._listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        try:
            if os.name == "posix":  # elsewhere that would let two programs have one port
                self._listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            self._listener.bind(self._address)
            self._listener.listen()
        except (OSError, OverflowError) as error:
            self._listener.close()
            raise PortError(
                "no emulator can listen on {}:{} ({})".format(*self._address, error),
                "another program does, or this machine has no such address",
                "take another port, or 0 for any that is free",
            ) from error
        self._listener.setblocking(False)
        self.plugged = True

    def unplug(self):
        """See :meth:`EmulatorPort.unplug`."""
        if self.plugged:
            self.plugged = False
            self._drop_client()
            self._listener.close()

    def _receive_all(self):
        received = b""
        while self._client is not None:
            try:
                data = self._client.recv(READ_SIZE)
            except BlockingIOError:
                break
            except OSError:
                data = b""
            received += data
            if not data:
                self._drop_client()
        return received

    def _accept(self, client):
        if self._client is not None:
            client.close()
            return
        client.setblocking(False)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        client.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, READ_SIZE)  # as small as a port's
        self._client = client

    def _drop_client(self):
        client, self._client, self._waiting = self._client, None, b""
        if client is not None:
            client.close()

    def _write(self, data):
        return self._client.send(data)
