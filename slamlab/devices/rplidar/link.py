"""Request and response over a port to an RPLIDAR that does not scan: send, wait, drain, reset."""

from slamlab.devices.rplidar.requests import Command, request
from slamlab.devices.rplidar.response_finder import ResponseFinder

QUIET_TIME = 0.1  # without data after which the line counts as drained [s]
DRAIN_TIMEOUT = 2.0  # longest wait for that [s]
BOOT_TIME = 0.5  # after a RESET it is silent for a while before its boot text [s]
READ_SIZE = 4096  # bytes read at a time


class Link:
    """Request/response link over a port.

    Parameters
    ----------
    port : Transport
    clock : Clock

    ``last_bytes`` are the last 64 received, to tell in an error what the device may be.
    """

    def __init__(self, port, clock):
        self.port, self.clock, self.last_bytes = port, clock, b""

    def send(self, data):
        """Send a request that has no response."""
        self.port.write(data)

    def stop_and_drain(self):
        """Stop a scan and drain what is still on its way.

        Returns
        -------
        bool, whether the line fell silent
        """
        self.send(request(Command.STOP))
        return self.drain()

    def drain(self, at_least=0.0):
        """Drain the line: discard what comes until nothing does.

        Parameters
        ----------
        at_least : float, so long whatever comes [s]

        Returns
        -------
        bool, whether it fell silent in time
        """
        begin = self.clock.now()
        while self.clock.now() - begin < DRAIN_TIMEOUT:
            if not self._read(QUIET_TIME) and self.clock.now() - begin >= at_least:
                return True
        return False

    def reset(self):
        """Reset the device and discard the text that it boots with."""
        self.send(request(Command.RESET))
        self.drain(BOOT_TIME)

    def query(self, data, type, timeout, loop=False, length=None):
        """Send a request and wait for its response, at most until the timeout.

        Parameters
        ----------
        data : bytes, the request
        type : AnswerType, or a collection of those that will do
        timeout : float [s]
        loop : bool, whether an endless answer is wanted
        length : int, of the payload, or None where that is free

        Returns
        -------
        ResponseFinder and (Descriptor, payload), or ResponseFinder and None when it did not come
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
