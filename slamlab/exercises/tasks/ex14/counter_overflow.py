"""Exercise 14, the task of a counter of one byte: how far it went."""

import numpy as np

from slamlab.exercises.drives.ex14 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task

WAYS, READINGS = 6, 40
MOST = 120  # counts between two readings
ROUND = 256
EXACT = 1e-9  # whole numbers


def inputs(rng):
    """Counters of robots that go far ahead and far back, read often enough.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"values": (n, k) signed bytes}
    """
    way = rng.integers(40, MOST, (WAYS, READINGS)) * np.where(
        np.arange(READINGS) < rng.integers(15, 25, (WAYS, 1)), 1, -1
    )
    way *= rng.choice([-1, 1], (WAYS, 1))
    way[:, 1::4] //= 7  # small steps, too, and some against the rest
    way[:, 3::8] *= -1
    begin = rng.integers(20, 100, (WAYS, 1)) * rng.choice([-1, 1], (WAYS, 1))
    return {"values": ring(begin + np.cumsum(way, axis=1))}


def ring(number):
    """A number as the signed byte that stands for it."""
    return (number + 128) % ROUND - 128


def _by_steps(*steps):
    """Inputs of a few ways by their steps, each begun at some byte."""

    def inputs(rng):
        way = np.cumsum(np.column_stack([np.zeros(len(steps), dtype=int), steps]), axis=1)
        return {"values": ring(rng.integers(-127, 128, (len(steps), 1)) + way)}

    return inputs


def _single(rng):
    return {"values": rng.permutation([-128, -1, 0, 127])[:, None]}


def _all_steps(rng):
    """Every step there is, in any order, from the least byte on."""
    steps = np.array([rng.permutation(np.arange(-127, 128)) for _ in range(2)])
    begin = np.array([[-128], [127]])
    return {"values": ring(np.column_stack([begin, begin + np.cumsum(steps, axis=1)]))}


def steps(i):
    """(n, k - 1) counts between two readings, the shorter way round."""
    return ring(np.diff(i["values"].astype(int), axis=1))


def _wanted(i):
    added = np.cumsum(steps(i), axis=1)
    return {"result": np.column_stack([np.zeros(len(added)), added])}


def _ring(i, o):
    """Each count differs from the first as the bytes do, but for whole rounds."""
    off = o["result"] - o["result"][:, :1] - (i["values"] - i["values"][:, :1])
    return (np.abs(off - ROUND * np.rint(off / ROUND)) < EXACT).all(axis=1)


def _between(i):
    return {"differences": np.diff(i["values"], axis=1), "counts between": steps(i)}


UNWRAP = Task(
    id="14-unwrap",
    title="A counter that overflows",
    drive=DRIVES["14-unwrap"],
    inputs=inputs,
    shapes=lambda i: {"result": i["values"].shape[1:]},
    laws=(
        Law(
            "start",
            1,
            "the count begins at 0",
            lambda i, o: np.abs(o["result"][:, 0]) < EXACT,
            _wanted,
            asks="How far has the robot gone at the first reading, whatever the byte is?",
            alone=False,
        ),
        Law(
            "same ring",
            1,
            "counts differ as the bytes do, but for whole rounds of 256",
            _ring,
            _wanted,
            asks="How many values does a byte have, and how many steps are there from 127 to −128?",
            step=_between,
        ),
        Law(
            "shorter way",
            2,
            "each step is shorter than half a round",
            lambda i, o: (np.abs(np.diff(o["result"], axis=1)) < ROUND / 2).all(axis=1),
            _wanted,
            asks="From one byte to the next there are two ways round the ring. Which of them can "
            "the robot have gone, and which number do you add then?",
            step=_between,
            alone=False,
        ),
    ),
    probes=(
        Probe("a single reading", _single),
        Probe("two readings", _by_steps([127], [-127], [1], [-1], [0])),
        Probe("a robot that stands still", _by_steps([0, 0, 0, 5, 0], [0, 0, -5, 0, 0])),
        Probe(
            "the longest steps", _by_steps(*([s, s, s, -s, -s, -s, -s] for s in (126, 127, -127)))
        ),
        Probe("many rounds", _by_steps([121] * 300, [-121] * 300)),
        Probe("every step there is", _all_steps),
    ),
)
