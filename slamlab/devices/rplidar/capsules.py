"""Capsules, the packets of the express modes: many distances, one angle at which they begin.

A capsule's angles need the one that follows. Where Slamtec's document and its SDK differ this is
the SDK's way: offsets are unsigned, points counted from 0.
"""

from functools import reduce
from operator import xor

import numpy as np

from slamlab.devices.rplidar.nodes import NODE, NOTHING, TURN, Decoder

QUALITY = 0x2F  # of a point that has a distance: capsules carry none
HEADER = 4  # bytes before the distances
LEAP = 1.3  # a capsule that turns so much more or less than the one before follows lost ones


class CapsuleDecoder(Decoder):
    """Finds capsules, checks them, and hands them on in pairs.

    Subclasses say what ``points`` a capsule holds and how distances are packed.
    """

    points = 0

    def __init__(self):
        super().__init__()
        self._previous, self._turned, self._in_step, self._gap = None, None, True, False

    @property
    def late(self):
        """int, samples between the last node returned and the end of the packet: one capsule."""
        return self.points

    def _decode(self):
        while (capsule := self._next()) is not None:
            nodes = self._follow(capsule)
            if len(nodes):
                yield nodes

    def _next(self):
        """The next capsule whose checksum holds, or None."""
        while len(self._buffer) >= 2:
            first, second = self._buffer[:2]
            if first >> 4 == 0xA and second >> 4 == 0x5:
                if len(self._buffer) < self.size:
                    return None
                capsule = self._buffer[: self.size]
                if reduce(xor, capsule[2:]) == (first & 15 | (second & 15) << 4):
                    self._buffer = self._buffer[self.size :]
                    self._in_step = True
                    return capsule
                self.damage["bad checksums"] += 1
            self._lose()
        return None

    def _lose(self):
        """Drop bytes up to the next that may begin a capsule, which can lie in a damaged one."""
        if self._in_step:
            self.damage["resyncs"] += 1
        self._in_step, self._previous, self._gap = False, None, True
        at = 1
        while at < len(self._buffer) and self._buffer[at] >> 4 != 0xA:
            at += 1
        self._drop(at)

    def _follow(self, capsule):
        """Nodes of the capsule before, now that the one after it is known."""
        previous, self._previous = self._previous, capsule
        if capsule[3] & 0x80:  # S: measuring has begun anew, what was before does not belong to it
            previous = None
        if previous is None:
            self._turned = None
            return NOTHING
        start = _start_q8(previous)
        turned = (_start_q8(capsule) - start) % (TURN << 2)
        before = self._turned or turned
        leapt = not before <= LEAP * turned <= LEAP**2 * before
        self._turned = turned
        if leapt:
            self._gap = True
            return NOTHING
        return self._nodes(start, turned, *self._unpack(previous, capsule))

    def _nodes(self, start_q8, turned_q8, distance_q2, offset_q16):
        """Nodes from distances (points,) and what to take off their angles (points,) or 0."""
        step = (turned_q8 << 8) // self.points
        angle = (start_q8 << 8) + step * np.arange(self.points)
        nodes = np.empty(self.points, NODE)
        nodes["angle_q6"] = (angle - offset_q16 >> 10) % TURN
        nodes["distance_q2"] = distance_q2
        nodes["quality"] = np.where(distance_q2 > 0, QUALITY, 0)
        after = (angle + step) % (TURN << 10)
        nodes["start"] = after < step
        # where the step was cut off, 0° may lie between this capsule's end and the next one's start
        nodes["start"][-1] |= ((start_q8 + turned_q8) << 8) % (TURN << 10) < after[-1]
        nodes["after_gap"] = False
        nodes["after_gap"][0], self._gap = self._gap, False
        return nodes

    def _unpack(self, capsule, following):
        """Distances (points,) [1/4 mm] and offsets of the angles [1/65536 degree]."""
        raise NotImplementedError


class ExpressDecoder(CapsuleDecoder):
    """Legacy capsules: 16 cabins of two distances [mm] and two offsets [1/8 degree]."""

    size, points = 84, 32

    def _unpack(self, capsule, following):
        cabin = np.frombuffer(capsule, np.uint8, offset=HEADER).reshape(-1, 5).astype(np.int32)
        words = cabin[:, 0:4:2] | cabin[:, 1:4:2] << 8
        low = np.column_stack([cabin[:, 4] & 15, cabin[:, 4] >> 4])
        offset_q3 = (words & 3) << 4 | low
        return (words & 0xFFFC).ravel(), offset_q3.ravel() << 13


class DenseDecoder(CapsuleDecoder):
    """Dense capsules: 40 distances [mm], no offsets."""

    size, points = 84, 40

    def _unpack(self, capsule, following):
        return np.frombuffer(capsule, "<u2", offset=HEADER).astype(np.int32) << 2, 0


class UltraDecoder(CapsuleDecoder):
    """Ultra capsules: 32 words of a distance and of two differences, to it and to the next one."""

    size, points = 132, 96

    def _unpack(self, capsule, following):
        words = np.frombuffer(capsule + following[HEADER : HEADER + 4], "<u4", offset=HEADER)
        words = words.astype(np.int64)
        major, level = MAJORS[words & 0xFFF], LEVELS[words & 0xFFF]
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
    """The angle at which a capsule begins [1/256 degree]."""
    return (int.from_bytes(capsule[2:4], "little") & 0x7FFF) << 2


def ultra_offset_q16(distance_q2):
    """How far a point lies behind the angle at which it was taken: the optics' parallax.

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


BANDS = ((3328, 16384, 4), (1792, 4096, 3), (1280, 2048, 2), (512, 512, 1), (0, 0, 0))
"""Of the 12-bit distances: first code, its distance [mm], bits by which codes are scaled."""


def _tables():
    majors, levels = np.zeros(4096, np.int64), np.zeros(4096, np.int64)
    for code, mm, level in reversed(BANDS):
        majors[code:], levels[code:] = mm + (np.arange(4096 - code) << level), level
    return majors, levels


MAJORS, LEVELS = _tables()
