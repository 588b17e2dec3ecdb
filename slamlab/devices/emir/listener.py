"""What is heard of eMIR, live or from a recording: its statuses, and the way they add up to."""

from collections import Counter

from slamlab.devices.emir import commands
from slamlab.devices.emir.frames import COMMAND, Framer
from slamlab.devices.emir.status import Status

FRAME = 36 * 10  # bits of a status on the line


class EmirListener:
    """Takes in the bytes from and to an eMIR; knows no port.

    Parameters
    ----------
    odometry : Odometry, advanced by every status
    baud : int [bit/s]

    ``status`` is the last one, None at first; ``damage`` counts as a Framer's.
    """

    def __init__(self, odometry, baud):
        self.odometry, self.status = odometry, None
        self._told, self._heard, self._wire = Framer(COMMAND), Framer(), FRAME / baud

    @property
    def damage(self):
        """Counter, see :class:`Framer`."""
        return Counter(self._heard.damage)

    def hear(self, data, now):
        """Take in what it sent.

        Parameters
        ----------
        data : bytes
        now : float, when the last of them was there [s]

        Returns
        -------
        int, how many statuses that were
        """
        frames = self._heard.feed(data)
        for content in frames:
            self.status = Status.unpack(content)
            self.odometry.advance(self.status.path, self.status.angle, now - self._wire)
        return len(frames)

    def told(self, data):
        """Take in what it is told: it may set its counters back.

        Parameters
        ----------
        data : bytes
        """
        for opcode, _, _ in self._told.feed(data):
            if opcode == commands.RESET_COUNTERS:
                self.odometry.expect_reset()
