"""Scan data stream of an RPLIDAR: bytes to revolutions, receive timeout, check for damage."""

from collections import Counter

from slamlab.devices.errors import ChecksumError, DataTimeout, DeviceSilent
from slamlab.devices.receive_timeout import ReceiveTimer
from slamlab.devices.rplidar.capsules import DenseDecoder, ExpressDecoder, UltraDecoder
from slamlab.devices.rplidar.measurement_nodes import ScanDecoder
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.revolutions import RevolutionAssembler
from slamlab.devices.rplidar.timestamping import SampleTimestamps

DECODERS = {
    AnswerType.SCAN: ScanDecoder,
    AnswerType.EXPRESS: ExpressDecoder,
    AnswerType.ULTRA: UltraDecoder,
    AnswerType.DENSE: DenseDecoder,
}
FIRST_DATA_TIMEOUT = 6.0  # for the first data: a motor takes up to 5 s to turn evenly [s]
RECEIVE_TIMEOUT = 0.9  # between any further, so that an error comes within a second [s]
DAMAGE_WINDOW = 32768  # bytes over which the share of damaged ones is taken, about 3 s
MAX_DAMAGE = 0.5  # share of dropped bytes beyond which the line is unusable


class ScanStream:
    """Scan data as they arrive: decoder, timestamps, revolutions, receive timeout.

    Parameters
    ----------
    answer : AnswerType, that of the descriptor
    period : float, from one sample to the next [s]
    baud : int [bit/s]
    now : float, when the descriptor came [s]
    after_gap : bool, whether it continues a scan whose connection broke
    """

    def __init__(self, answer, period, baud, now, after_gap=False):
        self.decoder = DECODERS[answer]()
        self._timestamps = SampleTimestamps(period, baud, self.decoder)
        self._assembler = RevolutionAssembler(period, after_gap)
        self._waiting_for_first, self._receive_timer = True, ReceiveTimer(now)
        self._received = self._dropped = 0  # by the decoder when this window began

    def feed(self, data, now):
        """Decode what was read into revolutions, and check timeout and damage.

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
        silence = self._receive_timer.update(now, bool(data))
        if not data:
            self._check_silence(silence)
            return []
        self._waiting_for_first = False
        nodes = self.decoder.feed(data)
        self._check_damage()
        return self._assembler.feed(nodes, self._timestamps.of_samples(len(nodes), now))

    @property
    def counts(self):
        """Statistics: Counter of bytes received, dropped, resyncs, bad checksums."""
        return self.decoder.damage + Counter(bytes=self.decoder.received)

    def _check_silence(self, seconds):
        if self._waiting_for_first and seconds > FIRST_DATA_TIMEOUT:
            raise DataTimeout(
                f"the lidar was told to scan, but nothing came for {seconds:.0f} s",
                "its motor does not turn: no power for it, blocked, or its plug is loose",
                "look whether it turns, and check the adapter's power",
            )
        if not self._waiting_for_first and seconds > RECEIVE_TIMEOUT:
            raise DeviceSilent(
                f"the lidar stopped sending {seconds:.1f} s ago",
                "it was unplugged from its adapter, lost its power, or its motor is blocked",
                "check plug and power, then open it anew",
            )

    def _check_damage(self):
        received = self.decoder.received - self._received
        if received < DAMAGE_WINDOW:
            return
        dropped = self.decoder.damage["bytes dropped"] - self._dropped
        if dropped > MAX_DAMAGE * received:
            raise ChecksumError(
                f"{100 * dropped / received:.0f} % of the lidar's last bytes are corrupted",
                "the speed (baud rate) is another, two programs read the port, or the cable is bad",
                "close other programs that use the port, try another cable, check the baud rate",
            )
        self._received, self._dropped = self.decoder.received, self._dropped + dropped
