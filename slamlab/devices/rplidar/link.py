"""Talk with an RPLIDAR that does not scan: ask, and find the answer in whatever else comes."""

from slamlab.devices.rplidar.finder import Finder
from slamlab.devices.rplidar.requests import Command, request

SILENCE = 0.1  # so long nothing came: the line is empty [s]
DRAIN = 2.0  # the longest wait for that [s]
BOOT = 0.5  # after a RESET it is silent for a while before its boot text [s]
MOST = 4096  # bytes read at a time


class Link:
    """Requests and answers over a port.

    Parameters
    ----------
    port : Transport
    clock : Clock

    ``heard`` is the last that came in, up to 64 bytes, for saying what the device may be.
    """

    def __init__(self, port, clock):
        self.port, self.clock, self.heard = port, clock, b""

    def send(self, data):
        """Send a request that has no answer."""
        self.port.write(data)

    def quiet(self):
        """Stop a scan and drop what is still on its way.

        Returns
        -------
        bool, whether the line fell silent
        """
        self.send(request(Command.STOP))
        return self.drain()

    def drain(self, at_least=0.0):
        """Drop what comes until the line is silent.

        Parameters
        ----------
        at_least : float, so long whatever comes [s]

        Returns
        -------
        bool, whether it fell silent in time
        """
        begin = self.clock.now()
        while self.clock.now() - begin < DRAIN:
            if not self._read(SILENCE) and self.clock.now() - begin >= at_least:
                return True
        return False

    def reset(self):
        """Start the device anew and drop the text that it boots with."""
        self.send(request(Command.RESET))
        self.drain(BOOT)

    def ask(self, data, type, timeout, loop=False, length=None):
        """Send a request and wait for its answer.

        Parameters
        ----------
        data : bytes, the request
        type : Answer, or a collection of those that will do
        timeout : float [s]
        loop : bool, whether an endless answer is wanted
        length : int, of the payload, or None where that is free

        Returns
        -------
        Finder and (Descriptor, payload), or Finder and None when it did not come
        """
        finder = Finder(type, loop, length)
        self.send(data)
        end = self.clock.now() + timeout
        while (left := end - self.clock.now()) > 0:
            found = finder.feed(self._read(left))
            if found is not None:
                return finder, found
        return finder, None

    def _read(self, timeout):
        data = self.port.read(MOST, timeout)
        self.heard = (self.heard + data)[-64:]
        return data
