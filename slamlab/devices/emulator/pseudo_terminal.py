"""Ports of emulated devices: a pseudo-terminal (pty), which clients open like a serial port."""

import contextlib
import os
import shutil
import tempfile

from slamlab.devices.errors import PortError

READ_SIZE = 4096  # bytes read at a time
BUFFER_SIZE = 11520  # bytes buffered for a client that does not read: 1 s at 115200 baud


class EmulatorPort:
    """Base class of emulator ports: the device's end of a line, non-blocking.

    ``name`` is what a client opens. ``dropped`` counts bytes lost by buffer overflow, since the
    client did not read in time, as a real port loses them.
    """

    name, dropped = "", 0

    def __init__(self):
        self._waiting, self.plugged = b"", False

    def files(self):
        """Files to wait for with select: they become readable when a client writes."""
        raise NotImplementedError

    def receive(self):
        """Receive what a client wrote, perhaps nothing: bytes."""
        raise NotImplementedError

    def send(self, data):
        """Send to the client; buffer what it does not take, drop what overflows."""
        self._waiting += data
        with contextlib.suppress(OSError):  # full, or gone
            while self._waiting:
                self._waiting = self._waiting[self._write(self._waiting) :]
        self.dropped += max(len(self._waiting) - BUFFER_SIZE, 0)
        self._waiting = self._waiting[:BUFFER_SIZE]

    def plug(self):
        """Plug in: let clients connect, under the same name as ever."""
        raise NotImplementedError

    def unplug(self):
        """Unplug: a client's next read or write fails."""
        raise NotImplementedError

    def close(self):
        """Unplug for good and release the port."""
        self.unplug()


class PseudoTerminal(EmulatorPort):
    """Pseudo-terminal (pty) as an emulator's port, on Linux and macOS: opens like a serial port.

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
        """See :meth:`EmulatorPort.files`."""
        return [self._master] if self.plugged else []

    def receive(self):
        """See :meth:`EmulatorPort.receive`."""
        try:
            return os.read(self._master, READ_SIZE) if self.plugged else b""
        except OSError:  # nothing there
            return b""

    def plug(self):
        """See :meth:`EmulatorPort.plug`."""
        # the slave is kept open, too: else a client that closes it breaks the master
        self._master, self._slave = self._pty.openpty()
        self._tty.setraw(
            self._slave
        )  # before anybody opens it: an echo would come back as requests
        os.set_blocking(self._master, False)
        os.symlink(os.ttyname(self._slave), self.name)
        self.plugged = True

    def unplug(self):
        """See :meth:`EmulatorPort.unplug`."""
        if self.plugged:
            self.plugged, self._waiting = False, b""
            os.unlink(self.name)
            os.close(self._master)
            os.close(self._slave)

    def close(self):
        """See :meth:`EmulatorPort.close`."""
        super().close()
        shutil.rmtree(self._folder, ignore_errors=True)

    def _write(self, data):
        return os.write(self._master, data)
