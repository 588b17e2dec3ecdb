"""Receiver of eMIR's status frames, live or from a recording, which updates the wheel odometry."""

from collections import Counter

from slamlab.devices.emir import commands
from slamlab.devices.emir.frames import COMMAND, Framer
from slamlab.devices.emir.status import Status

STATUS_BITS = 36 * 10  # of a status frame on the line


class EmirReceiver:
    """Receiver of the bytes from and to an eMIR; knows no port.

    Parameters
    ----------
    odometry : Odometry, advanced by every status
    baud : int [bit/s]

    ``status`` is the last one, None at first; ``damage`` counts as a Framer's.
    """

    def __init__(self, odometry, baud):
        self.odometry, self.status = odometry, None
        self._command_framer, self._status_framer = Framer(COMMAND), Framer()
        self._wire_time = STATUS_BITS / baud

    @property
    def damage(self):
        """Statistics of damaged frames: Counter, see :class:`Framer`."""
        return Counter(self._status_framer.damage)

    def received(self, data, now):
        """Decode what the robot sent into statuses and odometry.

        Parameters
        ----------
        data : bytes
        now : float, when the last of them was there [s]

        Returns
        -------
        int, how many statuses that were
        """
        frames = self._status_framer.feed(data)
        for content in frames:
            self.status = Status.unpack(content)
            self.odometry.advance(self.status.path, self.status.angle, now - self._wire_time)
        return len(frames)

    def sent(self, data):
        """Note what was sent to the robot: it may reset its counters.

        Parameters
        ----------
        data : bytes
        """
        for opcode, _, _ in self._command_framer.feed(data):
            if opcode == commands.RESET_COUNTERS:
                self.odometry.expect_reset()
