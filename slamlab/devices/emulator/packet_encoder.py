"""Packet encoder of the RPLIDAR emulator: the inverse of the driver's decoders."""

import struct
from functools import reduce
from operator import xor

import numpy as np

from slamlab.devices.rplidar.capsules import (
    DENSE_SCALES,
    MAJORS_MM,
    QUALITY,
    SCALE_LEVELS,
    ultra_offset_q16,
)
from slamlab.devices.rplidar.hq_capsules import HQ_NODE, SYNC, hq_checksum
from slamlab.devices.rplidar.responses import AnswerType

NO_ECHO = 511  # difference that means "no return"
# Parallax: a point lies behind the motor's angle, and farther behind at a larger distance. The
# express modes send the motor's angle and this offset, the standard scan the angle of the point.
PARALLAX_ITERATIONS = 3  # fixed-point steps for the parallax offset of a point


def encode_scan_nodes(angle, step, measure, first):
    """Encode measurement nodes of the standard scan as a list of bytes.

    ``angle``: unwrapped angle of the motor, (n,) [degree]; ``step``: angle between samples
    [degree]; ``measure``: callable((n,) [degree]) -> (n,) [mm], 0 for no return; ``first``:
    whether this is the first packet of a scan.
    """
    q6 = np.floor(angle * 64).astype(np.int64) % 23040
    distance = np.clip(np.round(4 * measure(angle)), 0, 65535).astype(np.int64)
    start = np.floor(angle / 360) > np.floor((angle - step) / 360)
    quality = np.where(distance > 0, QUALITY, 0)
    flags = quality << 2 | np.where(start, 1, 2)
    rows = zip(flags.tolist(), (q6 << 1 | 1).tolist(), distance.tolist(), strict=True)
    return [struct.pack("<BHH", *row) for row in rows]


def encode_express_capsule(angle, step, measure, first):
    """Encode a legacy express capsule of 32 samples; arguments as in :func:`encode_scan_nodes`."""
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
    """Encode an ultra capsule of 96 samples; ``angle`` must contain 97 angles."""
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


def encode_dense_capsule(angle, step, measure, first):
    """Encode a dense capsule of 40 samples."""
    mm = np.clip(np.round(measure(angle)), 0, 65535)
    return [_capsule(angle[0], first, mm.astype("<u2").tobytes())]


def encode_ultra_dense_capsule(angle, step, measure, first):
    """Encode an ultra-dense capsule of 64 samples."""
    mm = np.round(measure(angle)).astype(np.int64)
    scale = np.searchsorted(DENSE_SCALES[1:, 0], mm)
    first_mm, step_mm = DENSE_SCALES[scale].T
    code = np.clip((mm - first_mm + step_mm // 2) // step_mm, 0, (1 << 10 + scale) - 1)
    words = scale | code << 2 | np.where(mm > 0, QUALITY << 2, 0) >> scale << 12 + scale
    low, high = (words & 0xFFFF).reshape(-1, 2).tolist(), (words >> 16).reshape(-1, 2).tolist()
    cabins = [
        struct.pack("<HHB", *pair, one | other << 4)
        for pair, (one, other) in zip(low, high, strict=True)
    ]
    return [_capsule(angle[0], first, b"".join(cabins), bytes(6))]


def encode_hq_capsule(angle, step, measure, first):
    """Encode an HQ capsule of 96 samples."""
    nodes = np.empty(len(angle), HQ_NODE)
    nodes["angle"] = np.floor(angle % 360 / 90 * 16384)
    nodes["distance"] = np.round(4 * measure(angle))
    nodes["quality"] = np.where(nodes["distance"] > 0, QUALITY << 2, 0)
    nodes["flags"] = np.where(np.floor(angle / 360) > np.floor((angle - step) / 360), 1, 2)
    data = bytes([SYNC]) + bytes(8) + nodes.tobytes()
    return [data + hq_checksum(data)]


def encode_noise(angle, step, measure, first):
    """Encode a packet of a type that no decoder knows."""
    return [np.random.default_rng(int(abs(angle[0]) * 64)).bytes(60)]


# by answer type: encoder, samples per packet, number of additional samples
ENCODERS = {
    AnswerType.SCAN: (encode_scan_nodes, 1, 0),
    AnswerType.EXPRESS: (encode_express_capsule, 32, 0),
    AnswerType.ULTRA: (encode_ultra_capsule, 96, 1),
    AnswerType.DENSE: (encode_dense_capsule, 40, 0),
    AnswerType.ULTRA_DENSE: (encode_ultra_dense_capsule, 64, 0),
    AnswerType.HQ: (encode_hq_capsule, 96, 0),
}


def _with_parallax(angle, measure):
    """Compute distances [mm] and parallax offsets [1/65536 degree] by a fixed-point iteration."""
    offset = np.full(len(angle), 7 << 16)
    for _ in range(PARALLAX_ITERATIONS):
        mm = measure(angle - offset / 65536)
        offset = ultra_offset_q16(np.round(4 * mm).astype(np.int64))
    return mm, offset


def _difference(mm, base, level):
    difference = (mm - base + (1 << level >> 1)) >> level
    fits = (mm > 0) & (np.abs(difference) < NO_ECHO)
    return np.where(fits, difference, NO_ECHO) & 0x3FF


def _capsule(angle, first, body, before=b""):
    start = int(np.floor(angle * 64)) % 23040 | first << 15
    head = before + struct.pack("<H", start)
    check = reduce(xor, head + body)
    return bytes([0xA0 | check & 15, 0x50 | check >> 4]) + head + body
