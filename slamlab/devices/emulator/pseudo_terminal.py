"""Ports of emulated devices: base class, and pseudo-terminal (pty) that acts as a serial port."""

import contextlib
import os
import shutil
import struct
import sys
import tempfile

from slamlab.devices.errors import PortError

# ioctl of Linux for the settings of a terminal with any baud rate (not on MIPS, PowerPC, SPARC):
# flags, line discipline, control characters, input and output rates
TCGETS2, TERMIOS2 = 0x802C542A, struct.Struct("4IB19s2I")
READ_SIZE = 4096  # bytes read at a time
BUFFER_SIZE = 11520  # bytes buffered for a slow client: 1 s at 115200 baud


class EmulatorPort:
    """Base class of non-blocking emulator ports; ``dropped`` counts bytes lost by overflow."""

    name, dropped = "", 0
    baud = None  # baud rate that the client has set [bit/s], if known

    def __init__(self):
        self._waiting, self.plugged = b"", False

    def files(self):
        """Return the open files on which select() can wait."""
        raise NotImplementedError

    def receive(self):
        """Return the bytes that a client has written, which may be empty."""
        raise NotImplementedError

    def send(self, data):
        """Send bytes; keep unread bytes in a buffer, and drop bytes if the buffer overflows."""
        self._waiting += data
        with contextlib.suppress(OSError):  # full, or disconnected
            while self._waiting:
                self._waiting = self._waiting[self._write(self._waiting) :]
        self.dropped += max(len(self._waiting) - BUFFER_SIZE, 0)
        self._waiting = self._waiting[:BUFFER_SIZE]

    def plug(self):
        """Accept clients again, under the same port name as before."""
        raise NotImplementedError

    def unplug(self):
        """Disconnect the client, whose next read or write then fails."""
        raise NotImplementedError

    def close(self):
        """Unplug the device permanently, and release the port."""
        self.unplug()


class PseudoTerminal(EmulatorPort):
    """Pseudo-terminal with a name that ends in ``label``. Raises PortError on Windows."""

    def __init__(self, label):
        super().__init__()
        try:
            import pty
            import tty
        except ImportError:
            raise PortError(
                "this system has no pseudo-terminals",
                "the system is Windows",
                "use TCP with the command slamlab emulate --tcp",
            ) from None
        self._pty, self._tty = pty, tty
        self._folder = tempfile.mkdtemp(prefix="slamlab-")
        self.name = os.path.join(self._folder, label)
        self.plug()

    @property
    def baud(self):
        """Baud rate that the client has set [bit/s], or None if the system does not report it."""
        if sys.platform != "linux" or not self.plugged:
            return None
        import fcntl

        words = bytearray(TERMIOS2.size)
        fcntl.ioctl(self._slave, TCGETS2, words)
        return TERMIOS2.unpack(words)[-1]

    def files(self):
        return [self._master] if self.plugged else []

    def receive(self):
        try:
            return os.read(self._master, READ_SIZE) if self.plugged else b""
        except OSError:  # no data
            return b""

    def plug(self):
        # the slave stays open, because a client that closes the last one breaks the master
        self._master, self._slave = self._pty.openpty()
        # before a client opens it: its echo would be received as requests
        self._tty.setraw(self._slave)
        os.set_blocking(self._master, False)
        os.symlink(os.ttyname(self._slave), self.name)
        self.plugged = True

    def unplug(self):
        if self.plugged:
            self.plugged, self._waiting = False, b""
            os.unlink(self.name)
            os.close(self._master)
            os.close(self._slave)

    def close(self):
        super().close()
        shutil.rmtree(self._folder, ignore_errors=True)

    def _write(self, data):
        return os.write(self._master, data)
