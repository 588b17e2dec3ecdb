"""Task 14-nodes: decode measurement nodes to the values from which they were encoded."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex14_devices_and_live_slam.calls import CALLS

PACKETS, NODES_OF, DAMAGED = 4, 16, 4
TURN = 360 * 64
START, QUALITY, ANGLE, DISTANCE = COLUMNS = range(4)
EXACT = 1e-9  # quotients by 64 and 4 are exact in binary, and so are their sums


def inputs(rng):
    """Nodes whose fields use all bits, some with wrong check bits: {"data": (n, 5 k) bytes}."""
    shape = PACKETS, NODES_OF
    start, quality = rng.integers(0, 2, shape), rng.integers(1, 64, shape)
    start[:, -4:] = [0, 1, 0, 1]  # each packet has valid nodes of both kinds
    angle, distance = rng.integers(1000, TURN, shape), rng.integers(1000, 65536, shape)
    flags, word = quality << 2 | (1 - start) << 1 | start, angle << 1 | 1
    for packet in range(PACKETS):
        same, both, *unchecked = rng.permutation(NODES_OF - 4)[:DAMAGED]
        flags[packet, [same, both]] ^= rng.integers(1, 3)  # now S equals its complement
        word[packet, [both, *unchecked]] -= 1
    return {"data": packed(flags, word, distance)}


def packed(flags, word, distance):
    """Encode (n, k) first bytes, angle words and distance words as (n, 5 k) bytes."""
    parts = flags, word & 255, word >> 8, distance & 255, distance >> 8
    return np.stack(parts, axis=-1).reshape(len(flags), -1)


def _empty(rng):
    return {"data": np.zeros((2, 0), dtype=int)}


def _single(rng):
    angle = rng.integers(0, TURN, (4, 1))
    flags, distance = np.array([[21], [22], [105], [1]]), rng.permutation([[4], [5], [6], [7]])
    return {"data": packed(flags, angle << 1 | 1, distance)}


def _all_damaged(rng):
    angle = rng.integers(0, TURN, (2, 5))
    return {"data": packed(rng.choice([8, 11, 60, 255], (2, 5)), angle << 1 | 1, angle)}


def _edges(rng):
    flags, angle, distance = np.meshgrid([1, 2, 253, 254], [0, TURN - 1], [0, 1, 32768, 65535])
    return {"data": packed(*(each.reshape(1, -1) for each in (flags, angle << 1 | 1, distance)))}


def _first_bytes(rng):
    flags, check = np.meshgrid(np.arange(256), [0, 1])
    word = rng.integers(0, TURN, flags.shape) << 1 | check
    return {"data": packed(flags, word, rng.integers(0, 65536, flags.shape)).reshape(8, -1)}


def fields(i):
    """Return (n, k) first bytes, angle words and distance words."""
    data = i["data"].astype(int).reshape(len(i["data"]), -1, 5)
    return data[..., 0], data[..., 1] | data[..., 2] << 8, data[..., 3] | data[..., 4] << 8


def marks(i):
    """Return (n, k) whether S differs from its complement, and whether C is 1."""
    flags, word, _ = fields(i)
    return (flags ^ flags >> 1) & 1 == 1, word & 1 == 1


def sent(i):
    """Return (n, k, 4) the content of each node, and (n, k) which nodes are valid."""
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
    """Return (n, k, 4) the decoded values of the valid nodes, whichever corrupted nodes were kept;
    NaN if unknown.
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
    """Return the number of rows, and each column of the valid nodes."""
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
    title="Decode measurement nodes",
    call=CALLS["14-nodes"],
    inputs=inputs,
    shapes=lambda i: {
        "nodes": (len(i["data"]), i["data"].shape[1] // 5, 4),
        "count": (len(i["data"]),),
    },
    laws=(
        Law(
            "whole nodes",
            1,
            "there is one row for each valid node, and none for corrupted nodes",
            lambda i, o: o["count"] == sent(i)[1].sum(axis=1),
            _wanted,
            asks="A node has three check bits, two in byte 0 and one in byte 1. How are the first "
            "two related, and which value must the third have?",
            step=_words,
        ),
        Law(
            "start and quality",
            1,
            "S and the quality equal those that were sent",
            _as_sent(START, QUALITY),
            _wanted,
            asks="Write byte 0 in binary, with bit 0 on the right. Which bits hold S, and which "
            "hold the quality? By how many bits must the quality be shifted?",
            step=_words,
            after=("whole nodes",),
        ),
        Law(
            "angle",
            2,
            "the angle equals the one that was sent",
            _as_sent(ANGLE),
            _wanted,
            asks="Which of bytes 1 and 2 counts 256 times as much as the other? Which bit of the "
            "word does not belong to the angle? Which values has an angle of this lidar?",
            step=_words,
            after=("whole nodes",),
        ),
        Law(
            "distance",
            1,
            "the distance equals the one that was sent",
            _as_sent(DISTANCE),
            _wanted,
            asks="The distance has 16 bits and counts in units of 1/4 mm. What is the largest "
            "distance?",
            step=_words,
            after=("whole nodes",),
        ),
    ),
    probes=(
        Probe("an empty packet", _empty, ("whole nodes",)),
        Probe("a single node", _single),
        Probe("only corrupted nodes", _all_damaged),
        Probe("fields at their smallest and largest values", _edges),
        Probe("all values of the first byte", _first_bytes),
    ),
    parts=parts,
    may_round=False,
    begins=(
        "How many nodes are in 15 bytes of data? Which bytes belong to the second node?",
        "Byte 0 of a node is 61, which is 0b111101 in binary. What are S, its "
        "complement and the quality?",
    ),
)
