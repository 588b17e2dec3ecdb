"""Exercise 14, the task of a counter of one byte: how far it went."""

import numpy as np

from slamlab.exercises.drives.ex14 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

DRIVES_OF, READINGS = 6, 40
MOST = 120  # counts between two readings


def inputs(rng):
    """Counters of robots that go far ahead and far back, read often enough.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"values": (n, k) signed bytes}
    """
    way = rng.integers(40, MOST, (DRIVES_OF, READINGS)) * np.where(
        np.arange(READINGS) < rng.integers(15, 25, (DRIVES_OF, 1)), 1, -1
    )
    way *= rng.choice([-1, 1], (DRIVES_OF, 1))
    way[:, 1::4] //= 7  # small steps, too, and some against the rest
    way[:, 3::8] *= -1
    begin = rng.integers(20, 100, (DRIVES_OF, 1)) * rng.choice([-1, 1], (DRIVES_OF, 1))
    return {"values": (begin + np.cumsum(way, axis=1) + 128) % 256 - 128}


def _since_first(i):
    return i["values"] - i["values"][:, :1]


def _start(i, o):
    return np.abs(o["result"][:, 0]) < 1e-9


def _ring(i, o):
    """Each count differs from the first as the bytes do, but for whole rounds."""
    off = (o["result"] - o["result"][:, :1] - _since_first(i)) / 256
    return (np.abs(off - np.rint(off)) < 1e-9).all(axis=1)


def _short(i, o):
    return (np.abs(np.diff(o["result"])) < 128).all(axis=1)


def _mistake(name, hint, *formulas):
    def matches(i, o):
        return any(np.allclose(o["result"], formula(i["values"])) for formula in formulas)

    return Diagnosis(name, hint, matches)


def summed(steps):
    """(n, k) from 0 on, of (n, k - 1) steps."""
    return np.concatenate([np.zeros((len(steps), 1)), np.cumsum(steps, axis=1)], axis=1)


def ring(number, period=256):
    return (number + period // 2) % period - period // 2


UNWRAP = Task(
    id="14-unwrap",
    title="A counter that overflows",
    drive=DRIVES["14-unwrap"],
    inputs=inputs,
    shapes={"result": (READINGS,)},
    laws=(
        Law("start", 1, "the count begins at 0", _start),
        Law("same ring", 1, "counts differ as the bytes do, but for whole rounds of 256", _ring),
        Law("shorter way", 2, "no step is longer than half a round", _short),
    ),
    diagnoses=(
        _mistake(
            "jumps left in",
            "After 127 the robot seems to jump 255 counts back: this is the bytes' plain "
            "difference. Each step is known modulo 256 only; take the shorter way round.",
            lambda v: v - v[:, :1],
        ),
        _mistake(
            "modulo at the wrong place",
            "You wrap the whole way, so it never leaves −128 to 127. Wrap each step, then add up.",
            lambda v: ring(v - v[:, :1]),
            lambda v: (v - v[:, :1]) % 256,
            lambda v: summed(np.diff(v)) % 256,
        ),
        _mistake(
            "only forwards",
            "Every step came out forwards: % 256 gives 0 to 255. Shift by 128 before it and back "
            "after it, and steps back are steps back.",
            lambda v: summed(np.diff(v) % 256),
        ),
        _mistake(
            "one side only",
            "Only one of the two overflows is mended: forwards over 127, and backwards over −128.",
            lambda v: summed(np.diff(v) + 256 * (np.diff(v) < -128)),
            lambda v: summed(np.diff(v) - 256 * (np.diff(v) > 128)),
            lambda v: summed(np.diff(v) - 256 * (np.diff(v) > 127)),
        ),
        _mistake(
            "mended the wrong way",
            "A jump down by more than 128 is an overflow forwards: 256 is added to it, not taken "
            "off.",
            lambda v: summed(np.diff(v) + 256 * np.sign(np.diff(v)) * (np.abs(np.diff(v)) > 128)),
        ),
        _mistake(
            "255 for 256",
            "A byte has 256 values: from 127 to −128 is one step.",
            lambda v: summed(np.diff(v) - 255 * np.sign(np.diff(v)) * (np.abs(np.diff(v)) > 128)),
            lambda v: summed((np.diff(v) + 128) % 255 - 128),
            lambda v: summed((np.diff(v) + 127) % 255 - 127),
        ),
        _mistake(
            "as an angle",
            "np.unwrap takes its numbers for radians: a round here is 256 (period=256).",
            lambda v: np.unwrap(v.astype(float), axis=1),
            lambda v: np.unwrap(v.astype(float), axis=1) - v[:, :1],
        ),
        _mistake(
            "first value kept",
            "The count begins at the byte's value. Asked for is the way since the first reading: "
            "begin at 0.",
            lambda v: v[:, :1] + summed(ring(np.diff(v))),
        ),
        _mistake(
            "backwards",
            "Ahead comes out as back: a step is the later reading minus the earlier one.",
            lambda v: -summed(ring(np.diff(v))),
            lambda v: summed(ring(-np.diff(v))),
        ),
        _mistake(
            "size of the steps",
            "Way back is added to the way ahead: steps keep their sign.",
            lambda v: summed(np.abs(ring(np.diff(v)))),
        ),
        _mistake(
            "steps not added up",
            "These are the steps. Add them up: np.cumsum.",
            lambda v: np.concatenate([np.zeros((len(v), 1)), ring(np.diff(v))], axis=1),
        ),
    ),
)
