"""Exercise 14, the task of a lidar's bytes: five a node, some of them damaged.

A packet is made from what it is to say, so the law is: that is what is read.
"""

import numpy as np

from slamlab.exercises.drives.ex14 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task

PACKETS, NODES_OF, DAMAGED = 4, 16, 4
TURN = 360 * 64
START, QUALITY, ANGLE, DISTANCE = COLUMNS = range(4)
EXACT = 1e-9  # quotients by 64 and 4 are exact in binary; of a sum of some of them nothing is lost


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
        same, both, *unchecked = rng.permutation(NODES_OF - 4)[:DAMAGED]
        flags[packet, [same, both]] ^= rng.integers(1, 3)  # now S and not S are the same
        word[packet, [both, *unchecked]] -= 1
    return {"data": packed(flags, word, distance)}


def packed(flags, word, distance):
    """(n, 5 k) bytes of (n, k) first bytes, words of angle and of distance."""
    parts = flags, word & 255, word >> 8, distance & 255, distance >> 8
    return np.stack(parts, axis=-1).reshape(len(flags), -1)


def _empty(rng):
    return {"data": np.zeros((2, 0), dtype=int)}


def _single(rng):
    """Packets of one whole node."""
    angle = rng.integers(0, TURN, (4, 1))
    flags, distance = np.array([[21], [22], [105], [1]]), rng.permutation([[4], [5], [6], [7]])
    return {"data": packed(flags, angle << 1 | 1, distance)}


def _all_damaged(rng):
    angle = rng.integers(0, TURN, (2, 5))
    return {"data": packed(rng.choice([8, 11, 60, 255], (2, 5)), angle << 1 | 1, angle)}


def _edges(rng):
    """Every field at its least and at its most, one node each."""
    flags, angle, distance = np.meshgrid([1, 2, 253, 254], [0, TURN - 1], [0, 1, 32768, 65535])
    return {"data": packed(*(each.reshape(1, -1) for each in (flags, angle << 1 | 1, distance)))}


def _first_bytes(rng):
    """Every first byte there is, C both 0 and 1."""
    flags, check = np.meshgrid(np.arange(256), [0, 1])
    word = rng.integers(0, TURN, flags.shape) << 1 | check
    return {"data": packed(flags, word, rng.integers(0, 65536, flags.shape)).reshape(8, -1)}


def fields(i):
    """(n, k) first bytes, words of angle and of distance."""
    data = i["data"].astype(int).reshape(len(i["data"]), -1, 5)
    return data[..., 0], data[..., 1] | data[..., 2] << 8, data[..., 3] | data[..., 4] << 8


def marks(i):
    """(n, k) where S differs from not S, and where C is 1."""
    flags, word, _ = fields(i)
    return (flags ^ flags >> 1) & 1 == 1, word & 1 == 1


def sent(i):
    """(n, k, 4) what each node says, and (n, k) which ones are whole."""
    flags, word, distance = fields(i)
    said = np.stack([flags & 1, flags >> 2, (word >> 1) / 64, distance / 4], axis=-1)
    return said, np.logical_and(*marks(i))


def _wanted(i):
    said, good = sent(i)
    nodes = np.zeros(said.shape)
    for row, all_of, kept in zip(nodes, said, good, strict=True):
        row[: kept.sum()] = all_of[kept]
    return {"count": good.sum(axis=1).astype(float), "nodes": nodes}


def read(i, o):
    """(n, k, 4) what was read of the whole nodes, each in its place; NaN where that is not known.

    Whether damaged nodes were kept, all of them or by one of the two marks, is another question.
    """
    _, good = sent(i)
    found = np.full((*good.shape, 4), np.nan)
    for row, (count, nodes, by_s, by_c) in enumerate(
        zip(o["count"], o["nodes"], *marks(i), strict=True)
    ):
        for kept in (by_s & by_c, by_s, by_c, np.full(len(by_s), True)):
            if count == kept.sum():
                found[row, kept] = nodes[: int(count)]
                break
        found[row, ~good[row]] = np.nan
    return found


def _as_sent(*columns):
    def holds(i, o):
        said, good = sent(i)
        off = np.abs(read(i, o) - said)[..., columns] <= EXACT
        return (off.all(axis=-1) | ~good).all(axis=1)

    return holds


def parts(i, o):
    """How many rows, and each column of the whole nodes; of all rows where these are unknown."""
    known = read(i, o)
    lost = np.isnan(known).all(axis=(1, 2))[:, None, None]
    columns = np.nan_to_num(np.where(lost, o["nodes"], known), nan=-1.0)
    named = {f"column {k}": columns[..., k] for k in COLUMNS}
    return {"count": o["count"]} | named


def _words(i):
    flags, word, distance = fields(i)
    return {"first bytes": flags, "angle's words": word, "distance's words": distance}


NODES = Task(
    id="14-nodes",
    title="A lidar's bytes",
    drive=DRIVES["14-nodes"],
    inputs=inputs,
    shapes=lambda i: {
        "nodes": (len(i["data"]), i["data"].shape[1] // 5, 4),
        "count": (len(i["data"]),),
    },
    laws=(
        Law(
            "whole nodes",
            1,
            "there is a row for each node whose marks are right, and none for the others",
            lambda i, o: o["count"] == sent(i)[1].sum(axis=1),
            _wanted,
            asks="Three bits of a node are there for this alone. What do the two in byte 0 say of "
            "each other, and what does the third have to be?",
            step=_words,
        ),
        Law(
            "start and quality",
            1,
            "S and the quality are those that were sent",
            _as_sent(START, QUALITY),
            _wanted,
            asks="Write byte 0 in binary, bit 0 on the right: which bits are S, which the quality, "
            "and what moves these down to where they count as a number?",
            step=_words,
            after=("whole nodes",),
        ),
        Law(
            "angle",
            2,
            "the angle is the one that was sent",
            _as_sent(ANGLE),
            _wanted,
            asks="Of bytes 1 and 2, which one counts 256 times as much? And what stands in the "
            "lowest bit of the word, before the angle begins?",
            step=_words,
            after=("whole nodes",),
        ),
        Law(
            "distance",
            1,
            "the distance is the one that was sent",
            _as_sent(DISTANCE),
            _wanted,
            asks="How many millimetres is the largest number that 16 bits can hold, in quarters?",
            step=_words,
            after=("whole nodes",),
        ),
    ),
    probes=(
        Probe("no node", _empty, ("whole nodes",)),
        Probe("a single node", _single),
        Probe("nothing but damaged nodes", _all_damaged),
        Probe("fields at their least and most", _edges),
        Probe("every first byte there is", _first_bytes),
    ),
    parts=parts,
    rounds=False,
)
