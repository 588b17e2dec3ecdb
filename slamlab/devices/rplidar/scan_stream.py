"""Scan data stream of an RPLIDAR: converts bytes to revolutions, checks timeout and corruption."""

from collections import Counter

import numpy as np

from slamlab.devices.errors import ChecksumError, DataTimeout, DeviceSilent
from slamlab.devices.reader_thread import ReceiveTimer
from slamlab.devices.rplidar.capsules import (
    DenseDecoder,
    ExpressDecoder,
    UltraDecoder,
    UltraDenseDecoder,
)
from slamlab.devices.rplidar.hq_capsules import HqDecoder
from slamlab.devices.rplidar.measurement_nodes import ScanDecoder
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.revolutions import RevolutionAssembler
from slamlab.devices.rplidar.timestamping import SampleTimestamps

DECODERS = {
    AnswerType.SCAN: ScanDecoder,
    AnswerType.EXPRESS: ExpressDecoder,
    AnswerType.HQ: HqDecoder,
    AnswerType.ULTRA: UltraDecoder,
    AnswerType.DENSE: DenseDecoder,
    AnswerType.ULTRA_DENSE: UltraDenseDecoder,
}
FIRST_DATA_TIMEOUT = 6.0  # for the first data: a motor needs up to 5 s for a steady rotation [s]
RECEIVE_TIMEOUT = 0.9  # for further data, so that an error is raised within a second [s]
CORRUPTION_WINDOW = 32768  # bytes over which the share of dropped ones is computed, about 3 s
MAX_CORRUPTED = 0.5  # share of dropped bytes beyond which the line is unusable
RETURN_WINDOW = 0.9  # over which the share of samples with a distance is computed [s]
MIN_RETURNS = 0.005  # share of samples with a distance, below which a lidar counts as blind


class ScanStream:
    """Stream of scan data that follows a descriptor; decodes and assembles revolutions.

    ``period``: sample period [s]; ``after_gap``: whether the connection was lost before the stream;
    ``blind``: whether almost no sample of the last second has a distance.
    """

    def __init__(self, answer, period, baud, now, after_gap=False):
        self.decoder = DECODERS[answer]()
        self._timestamps = SampleTimestamps(period, baud, self.decoder)
        self._assembler = RevolutionAssembler(period, after_gap)
        self._waiting_for_first, self._receive_timer = True, ReceiveTimer(now)
        self._received = self._dropped = 0  # by the decoder, at the beginning of the window
        self.blind, self._window_begin, self._samples, self._returns = False, None, 0, 0

    def feed(self, data, now):
        """Decode bytes that were read until ``now`` [s], and return the completed revolutions.

        Raises DataTimeout if no data arrives, DeviceSilent if the stream stops, and ChecksumError
        if most of the bytes are corrupted.
        """
        elapsed = self._receive_timer.update(now, bool(data))
        if not data:
            self._check_receive_timeout(elapsed)
            return []
        self._waiting_for_first = False
        nodes = self.decoder.feed(data)
        self._check_corruption()
        self._check_returns(nodes["distance_q2"], now)
        return self._assembler.feed(nodes, self._timestamps.of_samples(len(nodes), now))

    @property
    def counts(self):
        return self.decoder.damage + Counter(bytes=self.decoder.received)

    def _check_receive_timeout(self, seconds):
        if self._waiting_for_first and seconds > FIRST_DATA_TIMEOUT:
            raise DataTimeout(
                f"the lidar has sent no data for {seconds:.0f} s after the scan request",
                "the motor does not rotate: it has no power, is blocked, or has a loose plug",
                "check whether the motor rotates, and check the power supply of the adapter",
            )
        if not self._waiting_for_first and seconds > RECEIVE_TIMEOUT:
            raise DeviceSilent(
                f"the lidar stopped sending {seconds:.1f} s ago",
                "the lidar was unplugged from the adapter, lost power, or has a blocked motor",
                "check the plug and the power supply, then connect to the lidar again",
            )

    def _check_returns(self, distance, now):
        self._window_begin = now if self._window_begin is None else self._window_begin
        self._samples += len(distance)
        self._returns += int(np.count_nonzero(distance))
        if self._samples and now - self._window_begin >= RETURN_WINDOW:
            self.blind = self._returns < MIN_RETURNS * self._samples
            self._window_begin, self._samples, self._returns = now, 0, 0

    def _check_corruption(self):
        received = self.decoder.received - self._received
        if received < CORRUPTION_WINDOW:
            return
        dropped = self.decoder.damage["bytes dropped"] - self._dropped
        if dropped > MAX_CORRUPTED * received:
            raise ChecksumError(
                f"{100 * dropped / received:.0f} % of the last bytes from the lidar are corrupted",
                "the baud rate is wrong, two programs read the port, or the cable is bad",
                "close other programs on the port, try another cable, and check the baud rate",
            )
        self._received, self._dropped = self.decoder.received, self._dropped + dropped
