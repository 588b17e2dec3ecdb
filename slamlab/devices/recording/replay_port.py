"""Replay of a raw recording as a transport: the received bytes again, at their time or faster."""

from slamlab.devices.clock import Clock
from slamlab.devices.recording.recording_file import RX
from slamlab.devices.transport import Transport, connection_lost


class ReplayPort(Transport):
    """Transport that replays what a device sent; what is written is ignored.

    Parameters
    ----------
    recording : Recording
    channel : str, "lidar" or "emir"
    clock : Clock
    speed : float, times as fast as it was; None as fast as one reads
    begin : float, when the recording begins on that clock; now by default [s]

    ``time`` is the recorded one of the bytes last returned [s].
    """

    def __init__(self, recording, channel, clock=None, speed=1.0, begin=None):
        if speed is not None and not speed > 0:
            raise ValueError(f"speed is above 0, or None for as fast as possible, not {speed}")
        self.name, self.baud = f"replay of {channel}", recording.baud(channel)
        self._clock, self._speed = clock or Clock(), speed
        self._begin = self._clock.now() if begin is None else begin
        self._recorded = recording.begin
        self._records, self._rest = iter(recording.of(channel, RX)), b""
        self.time = recording.begin
        self._next = next(self._records, None)
        self._closed = False

    def read(self, n, timeout):
        """See :meth:`Transport.read`; at its end the connection is lost."""
        if self._closed:
            raise connection_lost(self.name, "it was closed")
        if not self._rest:
            if self._next is None:
                raise connection_lost(self.name, "the recording ends here")
            if not self._due(timeout):
                return b""
            self._rest, self.time = self._next.data, self._next.time
            self._next = next(self._records, None)
        data, self._rest = self._rest[:n], self._rest[n:]
        return data

    def write(self, data):
        """See :meth:`Transport.write`."""
        if self._closed:
            raise connection_lost(self.name, "it was closed")

    def close(self):
        """See :meth:`Transport.close`."""
        self._closed = True

    def _due(self, timeout):
        """Wait until the next bytes are due; whether they are."""
        if self._speed is None:
            return True
        due = self._begin + (self._next.time - self._recorded) / self._speed
        left = due - self._clock.now()
        if left > 0:
            self._clock.sleep(min(left, timeout))
        return left <= timeout
