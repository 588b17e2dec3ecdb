"""Task 14-unwrap: unwrap a counter of one byte."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex14_devices_and_live_slam.calls import CALLS

WAYS, READINGS = 6, 40
MOST = 120  # counts between two readings
ROUND = 256
EXACT = 1e-9  # whole numbers


def inputs(rng):
    """Counters that go far forwards and backwards: {"values": (n, k) signed bytes}."""
    way = rng.integers(40, MOST, (WAYS, READINGS)) * np.where(
        np.arange(READINGS) < rng.integers(15, 25, (WAYS, 1)), 1, -1
    )
    way *= rng.choice([-1, 1], (WAYS, 1))
    way[:, 1::4] //= 7  # small steps, too, and some against the rest
    way[:, 3::8] *= -1
    begin = rng.integers(20, 100, (WAYS, 1)) * rng.choice([-1, 1], (WAYS, 1))
    return {"values": ring(begin + np.cumsum(way, axis=1))}


def ring(number):
    """Wrap a number into the range of a signed byte."""
    return (number + 128) % ROUND - 128


def _by_steps(*steps):
    def inputs(rng):
        way = np.cumsum(np.column_stack([np.zeros(len(steps), dtype=int), steps]), axis=1)
        return {"values": ring(rng.integers(-127, 128, (len(steps), 1)) + way)}

    return inputs


def _single(rng):
    return {"values": rng.permutation([-128, -1, 0, 127])[:, None]}


def _all_steps(rng):
    steps = np.array([rng.permutation(np.arange(-127, 128)) for _ in range(2)])
    begin = np.array([[-128], [127]])
    return {"values": ring(np.column_stack([begin, begin + np.cumsum(steps, axis=1)]))}


def steps(i):
    """Return (n, k - 1) counts between two readings, the shorter way round the ring."""
    return ring(np.diff(i["values"].astype(int), axis=1))


def _wanted(i):
    added = np.cumsum(steps(i), axis=1)
    return {"result": np.column_stack([np.zeros(len(added)), added])}


def _ring(i, o):
    """Return whether each count differs from the first as the bytes do, modulo 256."""
    off = o["result"] - o["result"][:, :1] - (i["values"] - i["values"][:, :1])
    return (np.abs(off - ROUND * np.rint(off / ROUND)) < EXACT).all(axis=1)


def _between(i):
    return {"differences": np.diff(i["values"], axis=1), "counts between": steps(i)}


UNWRAP = Task(
    id="14-unwrap",
    title="Unwrap a counter",
    call=CALLS["14-unwrap"],
    inputs=inputs,
    shapes=lambda i: {"result": i["values"].shape[1:]},
    laws=(
        Law(
            "start",
            1,
            "the first count is 0",
            lambda i, o: np.abs(o["result"][:, 0]) < EXACT,
            _wanted,
            asks="How many counts are there from the first reading to itself? Does the first byte "
            "matter?",
            alone=False,
            step="Call unwrap with the readings [5], then with the readings [100]. Each result has "
            "one count, and both counts are equal.",
        ),
        Law(
            "same ring",
            1,
            "the differences of counts equal those of the bytes modulo 256",
            _ring,
            _wanted,
            asks="How many values does a byte have, and how many counts are there from 127 to "
            "−128?",
            alone=False,
            step=_between,
        ),
        Law(
            "shorter way",
            2,
            "each step between two readings is at most 127 counts, forwards or backwards",
            lambda i, o: (
                (np.abs(np.diff(o["result"], axis=1)) < ROUND / 2).all(axis=1) & _ring(i, o)
            ),
            _wanted,
            asks="The step between two bytes is known modulo 256. Which two values can it have, "
            "one forwards and one backwards? Which of them can the robot have driven?",
            step=_between,
        ),
    ),
    probes=(
        Probe("a single reading", _single),
        Probe("two readings", _by_steps([127], [-127], [1], [-1], [0])),
        Probe("a robot that stops", _by_steps([0, 0, 0, 5, 0], [0, 0, -5, 0, 0])),
        Probe(
            "the longest steps", _by_steps(*([s, s, s, -s, -s, -s, -s] for s in (126, 127, -127)))
        ),
        Probe("a long drive", _by_steps([121] * 300, [-121] * 300)),
        Probe("all steps from −127 to 127", _all_steps),
    ),
    references=(Reference("unwrap", "values", _wanted),),
    begins=(
        "The readings are 5, 8 and 6. Which counts do you return?",
        "A wheel turns forwards by 10 counts, and the first reading is 120. What is "
        "the second reading?",
    ),
)
