"""Where a client takes hold of an emulated device: a pseudo-terminal, or TCP."""

import contextlib
import os
import shutil
import socket
import tempfile

from slamlab.devices.errors import PortError

MOST = 4096  # bytes read at a time
ROOM = 11520  # bytes kept for a client that does not read: a second of a lidar's line


class End:
    """One end of a wire, the device's; never waits. ``name`` is what a client opens.

    ``dropped`` counts bytes that a client did not read in time, as a real port loses them.
    """

    name, dropped = "", 0

    def __init__(self):
        self._waiting, self.plugged = b"", False

    def files(self):
        """What to wait for with select: files that become readable when a client writes."""
        raise NotImplementedError

    def receive(self):
        """What a client wrote, perhaps nothing: bytes."""
        raise NotImplementedError

    def send(self, data):
        """Send to the client, or keep for it, or drop what has no room."""
        self._waiting += data
        with contextlib.suppress(OSError):  # full, or gone
            while self._waiting:
                self._waiting = self._waiting[self._write(self._waiting) :]
        self.dropped += max(len(self._waiting) - ROOM, 0)
        self._waiting = self._waiting[:ROOM]

    def plug(self):
        """Let clients take hold of it, under the same name as ever."""
        raise NotImplementedError

    def unplug(self):
        """Pull the plug: a client's next reading or writing fails."""
        raise NotImplementedError

    def close(self):
        """Unplug for good."""
        self.unplug()


class PtyEnd(End):
    """A pseudo-terminal, which opens like a serial port; Linux and macOS have them.

    Parameters
    ----------
    label : str, last part of its name

    Raises
    ------
    PortError : this system has none
    """

    def __init__(self, label):
        super().__init__()
        try:
            import pty
            import tty
        except ImportError:
            raise PortError(
                "this system has no pseudo-terminals",
                "it is Windows",
                "use TCP: slamlab emulate --tcp",
            ) from None
        self._pty, self._tty = pty, tty
        self._folder = tempfile.mkdtemp(prefix="slamlab-")
        self.name = os.path.join(self._folder, label)
        self.plug()

    def files(self):
        """See :meth:`End.files`."""
        return [self._master] if self.plugged else []

    def receive(self):
        """See :meth:`End.receive`."""
        try:
            return os.read(self._master, MOST) if self.plugged else b""
        except OSError:  # nothing there
            return b""

    def plug(self):
        """See :meth:`End.plug`."""
        # the slave is kept open, too: else a client that closes it breaks the master
        self._master, self._slave = self._pty.openpty()
        self._tty.setraw(
            self._slave
        )  # before anybody opens it: an echo would come back as requests
        os.set_blocking(self._master, False)
        os.symlink(os.ttyname(self._slave), self.name)
        self.plugged = True

    def unplug(self):
        """See :meth:`End.unplug`."""
        if self.plugged:
            self.plugged, self._waiting = False, b""
            os.unlink(self.name)
            os.close(self._master)
            os.close(self._slave)

    def close(self):
        """See :meth:`End.close`."""
        super().close()
        shutil.rmtree(self._folder, ignore_errors=True)

    def _write(self, data):
        return os.write(self._master, data)


class TcpEnd(End):
    """A TCP port for one client at a time; a second one finds it closed.

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
        """See :meth:`End.files`."""
        if not self.plugged:
            return []
        return [self._listener] + ([self._client] if self._client is not None else [])

    def receive(self):
        """See :meth:`End.receive`."""
        if not self.plugged:
            return b""
        heard = self._hear()  # first: who has gone makes room for who comes
        with contextlib.suppress(BlockingIOError):
            self._accept(self._listener.accept()[0])
        return heard

    def send(self, data):
        """See :meth:`End.send`; without a client there is nobody to keep anything for."""
        if self._client is not None:
            super().send(data)

    def plug(self):
        """See :meth:`End.plug`."""
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
        """See :meth:`End.unplug`."""
        if self.plugged:
            self.plugged = False
            self._let_go()
            self._listener.close()

    def _hear(self):
        heard = b""
        while self._client is not None:
            try:
                data = self._client.recv(MOST)
            except BlockingIOError:
                break
            except OSError:
                data = b""
            heard += data
            if not data:
                self._let_go()
        return heard

    def _accept(self, client):
        if self._client is not None:
            client.close()
            return
        client.setblocking(False)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        client.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, MOST)  # as small as a port's
        self._client = client

    def _let_go(self):
        client, self._client, self._waiting = self._client, None, b""
        if client is not None:
            client.close()

    def _write(self, data):
        return self._client.send(data)
