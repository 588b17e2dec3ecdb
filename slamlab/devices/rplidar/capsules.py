"""Decoders of capsules, the express modes' packets: start angle, many distances, checksum.

A capsule's angles need the one that follows. Where Slamtec's document and its SDK differ this is
the SDK's way: offsets are unsigned, points counted from 0.
"""

from functools import reduce
from operator import xor

import numpy as np

from slamlab.devices.rplidar.measurement_nodes import NO_NODES, NODE_DTYPE, TURN_Q6, Decoder

QUALITY = 0x2F  # of a point that has a distance: capsules carry none
SYNC_NIBBLES = (0xA, 0x5)  # high halves of a capsule's first two bytes
HEADER_SIZE = 4  # bytes before the distances
MAX_STEP_RATIO = 1.3  # of two capsules in a row; beyond it some between were lost


class CapsuleDecoder(Decoder):
    """Base class of the capsule decoders: finds capsules, checks checksums, decodes them in pairs.

    Equation (14.3).

    Subclasses say what ``points`` a capsule holds and how distances are packed.
    """

    points = 0

    def __init__(self):
        super().__init__()
        self._previous, self._angle_step, self._in_sync, self._gap = None, None, True, False

    @property
    def delay(self):
        """Delay: samples from the last node returned to the packet's end, one capsule."""
        return self.points

    def _decode(self):
        while (capsule := self._next_capsule()) is not None:
            nodes = self._decode_previous(capsule)
            if len(nodes):
                yield nodes

    def _next_capsule(self):
        """Next capsule whose checksum is right, or None."""
        while self._buffer:
            # a single byte is judged too: waiting for a second, the count would hang on the cuts
            pairs = zip(self._buffer, SYNC_NIBBLES, strict=False)
            if all(byte >> 4 == nibble for byte, nibble in pairs):
                if len(self._buffer) < self.size:
                    return None
                capsule = self._buffer[: self.size]
                if reduce(xor, capsule[2:]) == (capsule[0] & 15 | (capsule[1] & 15) << 4):
                    self._buffer = self._buffer[self.size :]
                    self._in_sync = True
                    return capsule
                self.damage["bad checksums"] += 1
            self._resynchronise()
        return None

    def _resynchronise(self):
        """Drop bytes up to the next possible start of a capsule, which can lie in a damaged one."""
        if self._in_sync:
            self.damage["resyncs"] += 1
        self._in_sync, self._previous, self._gap = False, None, True
        at = 1
        while at < len(self._buffer) and self._buffer[at] >> 4 != SYNC_NIBBLES[0]:
            at += 1
        self._drop(at)

    def _decode_previous(self, capsule):
        """Decode the capsule before, now that the start angle after it is known."""
        previous, self._previous = self._previous, capsule
        if capsule[3] & 0x80:  # S: measuring has begun anew, what was before does not belong to it
            previous = None
        if previous is None:
            self._angle_step = None
            return NO_NODES
        start = _start_q8(previous)
        angle_step = (_start_q8(capsule) - start) % (TURN_Q6 << 2)
        before = self._angle_step or angle_step
        jumped = not before <= MAX_STEP_RATIO * angle_step <= MAX_STEP_RATIO**2 * before
        self._angle_step = angle_step
        if jumped:
            self._gap = True
            return NO_NODES
        return self._nodes(start, angle_step, *self._unpack(previous, capsule))

    def _nodes(self, start_q8, turned_q8, distance_q2, offset_q16):
        """Nodes from distances (points,) and what to take off their angles (points,) or 0."""
        step = (turned_q8 << 8) // self.points
        angle = (start_q8 << 8) + step * np.arange(self.points)
        nodes = np.empty(self.points, NODE_DTYPE)
        nodes["angle_q6"] = (angle - offset_q16 >> 10) % TURN_Q6
        nodes["distance_q2"] = distance_q2
        nodes["quality"] = np.where(distance_q2 > 0, QUALITY, 0)
        after = (angle + step) % (TURN_Q6 << 10)
        nodes["start"] = after < step
        # where the step was cut off, 0° may lie between this capsule's end and the next one's start
        nodes["start"][-1] |= ((start_q8 + turned_q8) << 8) % (TURN_Q6 << 10) < after[-1]
        nodes["after_gap"] = False
        nodes["after_gap"][0], self._gap = self._gap, False
        return nodes

    def _unpack(self, capsule, following):
        """Distances (points,) [1/4 mm] and offsets of the angles [1/65536 degree]."""
        raise NotImplementedError


class ExpressDecoder(CapsuleDecoder):
    """Decoder of legacy capsules: 16 cabins of two distances [mm] and two offsets [1/8 degree]."""

    size, points = 84, 32

    def _unpack(self, capsule, following):
        cabin = np.frombuffer(capsule, np.uint8, offset=HEADER_SIZE).reshape(-1, 5).astype(np.int32)
        words = cabin[:, 0:4:2] | cabin[:, 1:4:2] << 8
        low = np.column_stack([cabin[:, 4] & 15, cabin[:, 4] >> 4])
        offset_q3 = (words & 3) << 4 | low
        return (words & 0xFFFC).ravel(), offset_q3.ravel() << 13


class DenseDecoder(CapsuleDecoder):
    """Decoder of dense capsules: 40 distances [mm], no offsets."""

    size, points = 84, 40

    def _unpack(self, capsule, following):
        return np.frombuffer(capsule, "<u2", offset=HEADER_SIZE).astype(np.int32) << 2, 0


class UltraDecoder(CapsuleDecoder):
    """Decoder of ultra capsules: 32 words of a distance, two differences, to it and the next."""

    size, points = 132, 96

    def _unpack(self, capsule, following):
        data = capsule[HEADER_SIZE:] + following[HEADER_SIZE : HEADER_SIZE + 4]
        words = np.frombuffer(data, "<u4")
        words = words.astype(np.int64)
        major, level = MAJORS_MM[words & 0xFFF], SCALE_LEVELS[words & 0xFFF]
        base, following = major[:-1], major[1:]
        borrowed = (base == 0) & (following > 0)  # the first difference has nothing to differ from
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


def _start_q8(capsule):
    """Start angle of a capsule [1/256 degree]."""
    return (int.from_bytes(capsule[2:4], "little") & 0x7FFF) << 2


def ultra_offset_q16(distance_q2):
    """Parallax of the optics: how far a point lies behind the angle at which it was taken.

    Parameters
    ----------
    distance_q2 : (n,) int [1/4 mm]

    Returns
    -------
    (n,) int [1/65536 degree]
    """
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


VARBIT_BANDS = ((3328, 16384, 4), (1792, 4096, 3), (1280, 2048, 2), (512, 512, 1), (0, 0, 0))
"""Variable bit scale of 12-bit distances: first code, its distance [mm], bits of scaling."""


def _varbit_tables():
    majors, levels = np.zeros(4096, np.int64), np.zeros(4096, np.int64)
    for code, mm, level in reversed(VARBIT_BANDS):
        majors[code:], levels[code:] = mm + (np.arange(4096 - code) << level), level
    return majors, levels


MAJORS_MM, SCALE_LEVELS = _varbit_tables()
