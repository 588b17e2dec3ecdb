"""Packet encoder: samples as an RPLIDAR sends them, with checksum; the reverse of the decoders.

The optics see a point a little behind the angle at which the motor stands, the farther the more.
The express modes give the motor's angle and that offset; the standard scan the point's own angle.
"""

import struct
from functools import reduce
from operator import xor

import numpy as np

from slamlab.devices.rplidar.capsules import MAJORS_MM, SCALE_LEVELS, ultra_offset_q16
from slamlab.devices.rplidar.responses import AnswerType

QUALITY = 47  # signal quality of every echo
NO_ECHO = 511  # the difference that means "nothing came back"
PARALLAX_ITERATIONS = 3  # fixed-point steps for the parallax offset of a point


def encode_scan_nodes(angle, step, measure, first):
    """Encode measurement nodes of the standard scan.

    Parameters
    ----------
    angle : (n,) the motor's at each sample, growing over the turns [degree]
    step : float, between samples [degree]
    measure : callable((n,) directions [degree]) -> (n,) [mm], 0 for nothing
    first : bool, whether the scan begins here; here it does not matter

    Returns
    -------
    list of bytes
    """
    q6 = np.floor(angle * 64).astype(np.int64) % 23040
    distance = np.clip(np.round(4 * measure(angle)), 0, 65535).astype(np.int64)
    start = np.floor(angle / 360) > np.floor((angle - step) / 360)
    quality = np.where(distance > 0, QUALITY, 0)
    flags = quality << 2 | np.where(start, 1, 2)
    rows = zip(flags.tolist(), (q6 << 1 | 1).tolist(), distance.tolist(), strict=True)
    return [struct.pack("<BHH", *row) for row in rows]


def encode_express_capsule(angle, step, measure, first):
    """Encode a legacy express capsule of 32 samples; parameters as :func:`encode_scan_nodes`."""
    mm, offset_q16 = _with_parallax(angle, measure)
    offset_q3 = offset_q16 >> 13
    mm = np.clip(np.round(measure(angle - offset_q3 / 8)), 0, 16383).astype(np.int64)
    words = (mm << 2 | offset_q3 >> 4).reshape(-1, 2).tolist()
    nibbles = (offset_q3 & 15).reshape(-1, 2).tolist()
    cabins = [
        struct.pack("<HHB", *w, low | high << 4)
        for w, (low, high) in zip(words, nibbles, strict=True)
    ]
    return [_capsule(angle[0], first, b"".join(cabins))]


def encode_ultra_capsule(angle, step, measure, first):
    """Encode an ultra capsule of 96 samples; ``angle`` has the one after them, too."""
    mm, _ = _with_parallax(angle, measure)
    mm = np.round(mm).astype(np.int64)
    majors, middle, last = mm[0::3], mm[1::3], mm[2::3]
    codes = np.searchsorted(MAJORS_MM, np.clip(majors, 0, MAJORS_MM[-1]), side="right") - 1
    base, level = MAJORS_MM[codes], SCALE_LEVELS[codes]
    borrowed = (base[:-1] == 0) & (base[1:] > 0)
    near = np.where(borrowed, base[1:], base[:-1])
    near_level = np.where(borrowed, level[1:], level[:-1])
    first_difference = _difference(middle, near, near_level)
    second_difference = _difference(last, base[1:], level[1:])
    words = codes[:-1] | first_difference << 12 | second_difference << 22
    return [_capsule(angle[0], first, words.astype("<u4").tobytes())]


ENCODERS = {
    AnswerType.SCAN: (encode_scan_nodes, 1, 0),
    AnswerType.EXPRESS: (encode_express_capsule, 32, 0),
    AnswerType.ULTRA: (encode_ultra_capsule, 96, 1),
}
"""By answer type: encoder, samples a packet, and how many more samples it needs."""

PACKET_SIZES = {AnswerType.SCAN: 5, AnswerType.EXPRESS: 84, AnswerType.ULTRA: 132}  # [byte]


def _with_parallax(angle, measure):
    """Distances [mm] and their parallax offsets [1/65536 degree], by fixed-point iteration."""
    offset = np.full(len(angle), 7 << 16)
    for _ in range(PARALLAX_ITERATIONS):
        mm = measure(angle - offset / 65536)
        offset = ultra_offset_q16(np.round(4 * mm).astype(np.int64))
    return mm, offset


def _difference(mm, base, level):
    """Encode a distance's difference to a base in ten bits, nearest step."""
    difference = (mm - base + (1 << level >> 1)) >> level
    fits = (mm > 0) & (np.abs(difference) < NO_ECHO)
    return np.where(fits, difference, NO_ECHO) & 0x3FF


def _capsule(angle, first, body):
    start = int(np.floor(angle * 64)) % 23040 | first << 15
    head = struct.pack("<H", start)
    check = reduce(xor, head + body)
    return bytes([0xA0 | check & 15, 0x50 | check >> 4]) + head + body
