"""Bytes of a scan and when they came, turned into whole turns; silence and garbage are errors."""

from collections import Counter

from slamlab.devices.errors import ChecksumError, DataTimeout, DeviceSilent
from slamlab.devices.rplidar.answers import Answer
from slamlab.devices.rplidar.capsules import DenseDecoder, ExpressDecoder, UltraDecoder
from slamlab.devices.rplidar.nodes import ScanDecoder
from slamlab.devices.rplidar.timing import SampleTimes
from slamlab.devices.rplidar.turns import Assembler
from slamlab.devices.silence import Silence

DECODERS = {
    Answer.SCAN: ScanDecoder,
    Answer.EXPRESS: ExpressDecoder,
    Answer.ULTRA: UltraDecoder,
    Answer.DENSE: DenseDecoder,
}
FIRST = 6.0  # for the first data: a motor takes up to 5 s to turn evenly [s]
STEADY = 0.9  # for any further, so that who waits knows within a second [s]
WINDOW = 32768  # bytes over which damage is judged, some three seconds
TOO_MUCH = 0.5  # share of them that makes no sense


class Stream:
    """A scan as it arrives.

    Parameters
    ----------
    answer : Answer, that of the descriptor
    period : float, from one sample to the next [s]
    baud : int [bit/s]
    now : float, when the descriptor came [s]
    after_gap : bool, whether it continues a scan whose connection broke
    """

    def __init__(self, answer, period, baud, now, after_gap=False):
        self.decoder = DECODERS[answer]()
        self._times = SampleTimes(period, baud, self.decoder)
        self._turns = Assembler(period, after_gap)
        self._first, self._silence = True, Silence(now)
        self._received = self._dropped = 0  # by the decoder when this window began

    def feed(self, data, now):
        """Take in what was read.

        Parameters
        ----------
        data : bytes, none when nothing came
        now : float, when they were there [s]

        Returns
        -------
        list of Turn, those that ended

        Raises
        ------
        DataTimeout : nothing has come yet
        DeviceSilent : nothing comes any more
        ChecksumError : most of it makes no sense
        """
        silence = self._silence.listened(now, bool(data))
        if not data:
            self._check_silence(silence)
            return []
        self._first = False
        nodes = self.decoder.feed(data)
        self._check_damage()
        return self._turns.feed(nodes, self._times.of(len(nodes), now))

    @property
    def counts(self):
        """Counter: bytes received and damage."""
        return self.decoder.damage + Counter(bytes=self.decoder.received)

    def _check_silence(self, seconds):
        if self._first and seconds > FIRST:
            raise DataTimeout(
                f"the lidar was told to scan, but nothing came for {seconds:.0f} s",
                "its motor does not turn: no power for it, blocked, or its plug is loose",
                "look whether it turns, and check the adapter's power",
            )
        if not self._first and seconds > STEADY:
            raise DeviceSilent(
                f"the lidar ceased to send, {seconds:.1f} s ago",
                "it was unplugged from its adapter, lost its power, or its motor is blocked",
                "check plug and power, then open it anew",
            )

    def _check_damage(self):
        received = self.decoder.received - self._received
        if received < WINDOW:
            return
        dropped = self.decoder.damage["bytes dropped"] - self._dropped
        if dropped > TOO_MUCH * received:
            raise ChecksumError(
                f"{100 * dropped / received:.0f} % of the lidar's last bytes make no sense",
                "the speed is another one, two programs read the port, or the cable is bad",
                "close other programs that use the port, try another cable, check the baud",
            )
        self._received, self._dropped = self.decoder.received, self._dropped + dropped
