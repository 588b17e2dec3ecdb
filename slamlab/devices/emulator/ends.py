"""Where a client takes hold of an emulated device: the end of a wire, such as a pseudo-terminal."""

import contextlib
import os
import shutil
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
