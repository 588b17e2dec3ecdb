"""Receiver that decodes live or recorded status frames of eMIR, and updates its odometry."""

from collections import Counter

from slamlab.devices.emir import commands
from slamlab.devices.emir.frames import COMMAND, Framer
from slamlab.devices.emir.status import Status

STATUS_BITS = 36 * 10  # of a status frame on the line


class EmirReceiver:
    """Receiver that processes the bytes from and to an eMIR without a port; updates an Odometry."""

    def __init__(self, odometry, baud):
        self.odometry, self.status = odometry, None
        self._command_framer, self._status_framer = Framer(COMMAND), Framer()
        self._wire_time = STATUS_BITS / baud

    @property
    def damage(self):
        return Counter(self._status_framer.damage)

    def received(self, data, now):
        """Decode bytes that the robot sent until ``now`` [s]; return the number of statuses."""
        frames = self._status_framer.feed(data)
        for content in frames:
            self.status = Status.unpack(content)
            self.odometry.advance(self.status.path, self.status.angle, now - self._wire_time)
        return len(frames)

    def sent(self, data):
        """Process bytes sent to the robot: a command among them can reset the counters."""
        for opcode, _, _ in self._command_framer.feed(data):
            if opcode == commands.RESET_COUNTERS:
                self.odometry.expect_reset()
