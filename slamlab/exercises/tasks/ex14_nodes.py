"""Exercise 14, the task of a lidar's bytes: five a node, some of them damaged.

A packet is made from what it is to say, so the law is: that is what is read.
"""

import numpy as np

from slamlab.exercises.drives.ex14 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

PACKETS, NODES_OF, BROKEN = 4, 16, 4
TURN = 360 * 64
START, QUALITY, ANGLE, DISTANCE = range(4)


def inputs(rng):
    """Packets of nodes with fields that use all their bits, of which some have wrong marks.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"data": (n, 5 k) bytes}
    """
    shape = PACKETS, NODES_OF
    start, quality = rng.integers(0, 2, shape), rng.integers(1, 64, shape)
    start[:, -4:] = [0, 1, 0, 1]  # both kinds are whole in each packet
    angle, distance = rng.integers(1000, TURN, shape), rng.integers(1000, 65536, shape)
    flags, word = quality << 2 | (1 - start) << 1 | start, angle << 1 | 1
    for packet in range(PACKETS):
        same, both, *unchecked = rng.permutation(NODES_OF - 4)[:BROKEN]
        flags[packet, [same, both]] ^= rng.integers(1, 3)  # now S and not S are the same
        word[packet, [both, *unchecked]] -= 1
    parts = flags, word & 255, word >> 8, distance & 255, distance >> 8
    return {"data": np.stack(parts, axis=-1).reshape(PACKETS, -1)}


def fields(i):
    """(n, k) first bytes, words of angle and of distance."""
    data = i["data"].astype(int).reshape(PACKETS, NODES_OF, 5)
    return data[..., 0], words(data, 1), words(data, 3)


def marks(i):
    """(n, k) where S differs from not S, and where C is 1."""
    flags, word, _ = fields(i)
    return (flags ^ flags >> 1) & 1 == 1, word & 1 == 1


def words(data, at, big=False):
    """(n, k) words of two bytes, the low one first, or last."""
    low, high = (data[..., at + 1], data[..., at]) if big else (data[..., at], data[..., at + 1])
    return low | high << 8


def _read(i, o):
    """(n, k - BROKEN, 4) rows of the good nodes, whichever others were kept; NaN else."""
    found, (by_s, by_c) = np.full((PACKETS, NODES_OF - BROKEN, 4), np.nan), marks(i)
    for row, (count, nodes) in enumerate(zip(o["count"], o["nodes"], strict=True)):
        good = by_s[row] & by_c[row]
        for kept in (good, by_s[row], by_c[row], np.full(NODES_OF, True)):
            if count == kept.sum():
                found[row] = nodes[: int(count)][good[kept]]
    return found


def _good(i, values):
    """(n, k - BROKEN) of values of all nodes those of the good ones."""
    return values[np.logical_and(*marks(i))].reshape(PACKETS, -1)


def _are(column, formula):
    """Law or mistake: a column is a formula of the bytes (n, k, 5) and the three fields."""

    def holds(i, o):
        data = i["data"].astype(int).reshape(PACKETS, NODES_OF, 5)
        want = _good(i, formula(data, *fields(i)) * np.ones((PACKETS, NODES_OF)))
        return (np.abs(_read(i, o)[..., column] - want) < 1e-6).all(axis=1)

    return holds


def _marks(i, o):
    start = _are(START, lambda data, flags, word, distance: flags & 1)
    quality = _are(QUALITY, lambda data, flags, word, distance: flags >> 2)
    return start(i, o) & quality(i, o)


def _mistake(name, hint, column, *formulas):
    return Diagnosis(name, hint, lambda i, o: any(_are(column, f)(i, o).all() for f in formulas))


def _signed(word):
    return word - (word >> 15 << 16)


NODES = Task(
    id="14-nodes",
    title="A lidar's bytes",
    drive=DRIVES["14-nodes"],
    inputs=inputs,
    shapes={"nodes": (PACKETS, NODES_OF, 4), "count": (PACKETS,)},
    laws=(
        Law(
            "whole nodes",
            1,
            "there is a row for each node whose marks are right, and none for the others",
            lambda i, o: o["count"] == NODES_OF - BROKEN,
        ),
        Law("start and quality", 1, "S and the quality are those that were sent", _marks),
        Law(
            "angle",
            2,
            "the angle is the one that was sent",
            _are(ANGLE, lambda data, flags, word, distance: (word >> 1) / 64),
        ),
        Law(
            "distance",
            1,
            "the distance is the one that was sent",
            _are(DISTANCE, lambda data, flags, word, distance: distance / 4),
        ),
    ),
    diagnoses=(
        Diagnosis(
            "damaged kept",
            "Damaged nodes are among your rows. A node has S different from not S, and C = 1; "
            "leave out what has not.",
            lambda i, o: bool((o["count"] == NODES_OF).all()),
        ),
        Diagnosis(
            "c not checked",
            "Nodes with C = 0 are among your rows: the lowest bit of byte 1 has to be 1.",
            lambda i, o: bool((o["count"] == NODES_OF - 2).all()),
        ),
        Diagnosis(
            "s not checked",
            "Nodes whose S and not S are the same are among your rows: they have to differ.",
            lambda i, o: bool((o["count"] == NODES_OF - 3).all()),
        ),
        _mistake(
            "big endian",
            "High and low byte have changed places. Little endian: the first byte is the low one.",
            ANGLE,
            lambda data, flags, word, distance: (words(data, 1, big=True) >> 1) / 64,
            lambda data, flags, word, distance: words(data, 1, big=True) / 64,
        ),
        _mistake(
            "big endian",
            "High and low byte of the distance have changed places. Little endian: the first byte "
            "is the low one.",
            DISTANCE,
            lambda data, flags, word, distance: words(data, 3, big=True) / 4,
        ),
        _mistake(
            "shift forgotten",
            "Your angles are twice as large: bit 0 of the word is C, the angle begins at bit 1. "
            "Shift it down by one.",
            ANGLE,
            lambda data, flags, word, distance: word / 64,
            lambda data, flags, word, distance: (word & ~1) / 64,
        ),
        _mistake(
            "c in the angle",
            "Your angles are 1/128 degree too large: C is still in the word when you divide it. "
            "Shift it out first.",
            ANGLE,
            lambda data, flags, word, distance: word / 128,
        ),
        _mistake(
            "angle not divided",
            "Your angles are in 1/64 degree. Divide by 64.",
            ANGLE,
            lambda data, flags, word, distance: word >> 1,
        ),
        _mistake(
            "whole degrees",
            "Your angles are cut off to whole degrees: // 64 throws the rest away, / 64 keeps it.",
            ANGLE,
            lambda data, flags, word, distance: word >> 7,
        ),
        _mistake(
            "radians",
            "Your angles are in radians; asked for are degrees, as the device counts.",
            ANGLE,
            lambda data, flags, word, distance: np.radians((word >> 1) / 64),
        ),
        _mistake(
            "distance not divided",
            "Your distances are four times too large: the device counts quarters of a millimetre.",
            DISTANCE,
            lambda data, flags, word, distance: distance,
        ),
        _mistake(
            "whole millimetres",
            "Your distances are cut off to whole millimetres: / 4 keeps the quarters, // 4 and "
            ">> 2 do not.",
            DISTANCE,
            lambda data, flags, word, distance: distance >> 2,
        ),
        _mistake(
            "sign",
            "Far distances come out negative: the word has no sign, all 16 bits count upwards.",
            DISTANCE,
            lambda data, flags, word, distance: _signed(distance) / 4,
            lambda data, flags, word, distance: _signed(distance) >> 2,
        ),
        _mistake(
            "metres",
            "Your distances are in metres; asked for are millimetres, as the device counts.",
            DISTANCE,
            lambda data, flags, word, distance: distance / 4000,
        ),
        _mistake(
            "quality not shifted",
            "Your quality is four times too large: S and not S stand in the low bits of byte 0. "
            "Shift them out.",
            QUALITY,
            lambda data, flags, word, distance: flags,
            lambda data, flags, word, distance: flags & 0xFC,
        ),
        _mistake(
            "not s for s",
            "You took bit 1, not S, for S: it is bit 0.",
            START,
            lambda data, flags, word, distance: flags >> 1 & 1,
        ),
    ),
)
