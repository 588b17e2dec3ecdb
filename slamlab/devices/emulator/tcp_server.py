"""TCP server as the port of an emulator, for clients on Windows or on another computer."""

import contextlib
import os
import socket

from slamlab.devices.emulator.pseudo_terminal import READ_SIZE, EmulatorPort
from slamlab.devices.errors import PortError


class TcpServer(EmulatorPort):
    """TCP port that accepts one client at a time and rejects others. Raises PortError."""

    def __init__(self, host="127.0.0.1", port=0):
        super().__init__()
        self._address, self._client = (host, port), None
        self.plug()
        self._address = self._listener.getsockname()[:2]
        self.name = "socket://{}:{}".format(*self._address)

    def files(self):
        if not self.plugged:
            return []
        return [self._listener] + ([self._client] if self._client is not None else [])

    def receive(self):
        if not self.plugged:
            return b""
        received = self._receive_all()  # before accept(): detects a disconnected client
        with contextlib.suppress(BlockingIOError):
            self._accept(self._listener.accept()[0])
        return received

    def send(self, data):
        if self._client is not None:
            super().send(data)

    def plug(self):
        self._listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        try:
            if os.name == "posix":  # elsewhere two programs could share the port
                self._listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            self._listener.bind(self._address)
            self._listener.listen()
        except (OSError, OverflowError) as error:
            self._listener.close()
            raise PortError(
                "the emulator cannot listen on {}:{} ({})".format(*self._address, error),
                "another program uses the port, or this computer does not have the address",
                "choose another port, or 0 for any free port",
            ) from error
        self._listener.setblocking(False)
        self.plugged = True

    def unplug(self):
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
        client.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, READ_SIZE)  # as of a serial port
        self._client = client

    def _drop_client(self):
        client, self._client, self._waiting = self._client, None, b""
        if client is not None:
            client.close()

    def _write(self, data):
        return self._client.send(data)
