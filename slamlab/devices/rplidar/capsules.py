"""Decoders of capsules, packets of the express modes with start angle, distances, checksum.

Where Slamtec's document and SDK differ, the decoders follow the SDK: angle offsets are unsigned,
and sample numbers start at 0.
"""

from functools import reduce
from operator import xor

import numpy as np

from slamlab.devices.rplidar.measurement_nodes import NO_NODES, NODE_DTYPE, TURN_Q6, PacketDecoder

QUALITY = 0x2F  # quality of a sample with a distance: capsules carry none
MAX_STEP_RATIO = 1.3  # of the angles of two successive capsules; beyond it capsules were lost


class CapsuleDecoder(PacketDecoder):
    """Base class of the capsule decoders. Equation (14.3).

    The angles of a capsule are interpolated up to the start angle of the next capsule. ``header``:
    number of bytes before the distances; the last two contain the start angle.
    """

    header = 4

    def __init__(self):
        super().__init__()
        self._previous, self._angle_step = None, None

    @property
    def delay(self):
        """The latency of the decoder, one capsule [samples]."""
        return self.points

    def _decode(self):
        while (capsule := self._next_packet()) is not None:
            nodes = self._decode_previous(capsule)
            if len(nodes):
                yield nodes

    def _checksum_is_valid(self, packet):
        """Verify the XOR checksum of an express capsule."""
        return reduce(xor, packet[2:]) == (packet[0] & 15 | (packet[1] & 15) << 4)

    def _resynchronise(self):
        self._previous = None
        super()._resynchronise()

    def _decode_previous(self, capsule):
        """Decode the previous capsule, given the start angle of this capsule."""
        previous, self._previous = self._previous, capsule
        if capsule[self.header - 1] & 0x80:  # S: the measurement was restarted
            previous = None  # belongs to the earlier one
        if previous is None:
            self._angle_step = None
            return NO_NODES
        start = self._start_q8(previous)
        angle_step = (self._start_q8(capsule) - start) % (TURN_Q6 << 2)
        before = self._angle_step or angle_step
        jumped = not before <= MAX_STEP_RATIO * angle_step <= MAX_STEP_RATIO**2 * before
        self._angle_step = angle_step
        if jumped:
            self._gap = True
            return NO_NODES
        return self._nodes(start, angle_step, *self._unpack(previous, capsule))

    def _start_q8(self, capsule):
        """Return the start angle of a capsule [1/256 degree]."""
        return (int.from_bytes(capsule[self.header - 2 : self.header], "little") & 0x7FFF) << 2

    def _nodes(self, start_q8, turned_q8, distance_q2, offset_q16, quality=QUALITY):
        step = (turned_q8 << 8) // self.points
        angle = (start_q8 << 8) + step * np.arange(self.points)
        nodes = np.empty(self.points, NODE_DTYPE)
        nodes["angle_q6"] = (angle - offset_q16 >> 10) % TURN_Q6
        nodes["distance_q2"] = distance_q2
        nodes["quality"] = np.where(distance_q2 > 0, quality, 0)
        after = (angle + step) % (TURN_Q6 << 10)
        nodes["start"] = after < step
        # the step is truncated: 0° may lie between the end of this capsule and the next start angle
        nodes["start"][-1] |= ((start_q8 + turned_q8) << 8) % (TURN_Q6 << 10) < after[-1]
        return self._marked(nodes)

    def _unpack(self, capsule, following):
        """Return distances [1/4 mm], angle offsets [1/65536 degree] and, optionally, qualities."""
        raise NotImplementedError


class ExpressDecoder(CapsuleDecoder):
    """Legacy express capsules: 16 cabins with two distances [mm] and two offsets [1/8 degree]."""

    size, points = 84, 32

    def _unpack(self, capsule, following):
        words, nibbles = _cabins(capsule[self.header :])
        offset_q3 = (words & 3) << 4 | nibbles
        return (words & 0xFFFC).ravel(), offset_q3.ravel() << 13


class DenseDecoder(CapsuleDecoder):
    """Dense capsules: 40 distances [mm] without offsets."""

    size, points = 84, 40

    def _unpack(self, capsule, following):
        return np.frombuffer(capsule, "<u2", offset=self.header).astype(np.int32) << 2, 0


class UltraDenseDecoder(CapsuleDecoder):
    """Ultra-dense capsules: 32 cabins with two distances in four scales, and qualities.

    Slamtec's SDK also averages neighbours that differ by at most 2 mm, the smallest step.
    """

    size, points, header = 170, 64, 10

    def _unpack(self, capsule, following):
        low, high = _cabins(capsule[self.header :])
        words = (low | high << 16).ravel()
        scale = words & 3
        first_mm, step_mm = DENSE_SCALES[scale].T
        code = words >> 2 & (1 << 10 + scale) - 1
        return first_mm + step_mm * code << 2, 0, words >> 12 + scale << scale >> 2


class UltraDecoder(CapsuleDecoder):
    """Ultra capsules (boost mode): 32 words with a distance and two differences to neighbours."""

    size, points = 132, 96

    def _unpack(self, capsule, following):
        data = capsule[self.header :] + following[self.header : self.header + 4]
        words = np.frombuffer(data, "<u4")
        words = words.astype(np.int64)
        major, level = MAJORS_MM[words & 0xFFF], SCALE_LEVELS[words & 0xFFF]
        base, following = major[:-1], major[1:]
        borrowed = (base == 0) & (following > 0)  # the first difference refers to the next distance
        near = np.where(borrowed, following, base)
        near_level = np.where(borrowed, level[1:], level[:-1])
        first, second = (_signed10(words[:-1] >> shift) for shift in (12, 22))
        mm = np.column_stack(
            [
                base,
                np.where(_usable(first), near + (first << near_level), 0),
                np.where(_usable(second), following + (second << level[1:]), 0),
            ]
        ).ravel()
        distance_q2 = np.maximum(mm, 0) << 2
        return distance_q2, ultra_offset_q16(distance_q2)


def _cabins(data):
    """Split n cabins of five bytes into words (n, 2) and nibbles (n, 2)."""
    cabin = np.frombuffer(data, np.uint8).reshape(-1, 5).astype(np.int32)
    words = cabin[:, 0:4:2] | cabin[:, 1:4:2] << 8
    return words, np.column_stack([cabin[:, 4] & 15, cabin[:, 4] >> 4])


def ultra_offset_q16(distance_q2):
    """Return the angle offsets [1/65536 degree] due to parallax at distances (n,) int [1/4 mm]."""
    k = 98361 // np.maximum(distance_q2, 1)
    far = EIGHT_DEGREES - (k << 6) - k**3 // 98304
    radians = np.where(distance_q2 < 200, SEVEN_AND_A_HALF_DEGREES, far)
    return (radians * 180 / 3.14159265).astype(np.int64)


EIGHT_DEGREES, SEVEN_AND_A_HALF_DEGREES = int(np.radians(8) * 65536), int(np.radians(7.5) * 65536)


def _signed10(field):
    field = field & 0x3FF
    return field - (field >> 9 << 10)


def _usable(difference):
    return (difference != -512) & (difference != 511)


# scales of ultra-dense distances, each one bit wider than the previous: first distance, step [mm]
DENSE_SCALES = np.array([(0, 2), (2046, 3), (8187, 4), (24567, 5)])
# variable bit scale of 12-bit distances: first code, its distance [mm], bits of scaling
VARBIT_BANDS = ((3328, 16384, 4), (1792, 4096, 3), (1280, 2048, 2), (512, 512, 1), (0, 0, 0))


def _varbit_tables():
    majors, levels = np.zeros(4096, np.int64), np.zeros(4096, np.int64)
    for code, mm, level in reversed(VARBIT_BANDS):
        majors[code:], levels[code:] = mm + (np.arange(4096 - code) << level), level
    return majors, levels


MAJORS_MM, SCALE_LEVELS = _varbit_tables()
