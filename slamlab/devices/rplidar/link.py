"""Request/response link over a port to an RPLIDAR that does not scan."""

from slamlab.devices.rplidar.requests import Command, request
from slamlab.devices.rplidar.responses import ResponseFinder

QUIET_TIME = 0.1  # time without data after which the line is drained [s]
DRAIN_TIMEOUT = 2.0  # longest time of draining [s]
BOOT_TIME = 0.5  # after a RESET, until the boot text is sent [s]
READ_SIZE = 4096  # bytes read at a time


class Link:
    """Request/response link over a port; ``last_bytes``: the last 64 received bytes."""

    def __init__(self, port, clock):
        self.port, self.clock, self.last_bytes = port, clock, b""

    def send(self, data):
        self.port.write(data)

    def stop_and_drain(self, timeout=DRAIN_TIMEOUT):
        """Stop a scan, drain the line and return whether it became quiet within timeout [s]."""
        self.send(request(Command.STOP))
        return self.drain(timeout=timeout)

    def drain(self, at_least=0.0, timeout=DRAIN_TIMEOUT):
        """Discard received bytes for a minimum time [s], and then until the line is quiet.

        Returns whether the line became quiet within the timeout [s].
        """
        begin = self.clock.now()
        while self.clock.now() - begin < timeout:
            if not self._read(QUIET_TIME) and self.clock.now() - begin >= at_least:
                return True
        return False

    def reset(self):
        """Reset the device, and discard the text that it sends while it boots."""
        self.send(request(Command.RESET))
        self.drain(BOOT_TIME)

    def query(self, data, type, timeout, loop=False, length=None):
        """Send a request and wait for the response, but no longer than the timeout [s].

        ``type``, ``loop`` and ``length`` are those of :class:`ResponseFinder`. Returns the finder,
        and the response or, after the timeout, None.
        """
        finder = ResponseFinder(type, loop, length)
        self.send(data)
        end = self.clock.now() + timeout
        while (left := end - self.clock.now()) > 0:
            found = finder.feed(self._read(left))
            if found is not None:
                return finder, found
        return finder, None

    def _read(self, timeout):
        data = self.port.read(READ_SIZE, timeout)
        self.last_bytes = (self.last_bytes + data)[-64:]
        return data
