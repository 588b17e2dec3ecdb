"""Exercise 14, the task of eMIR's status frames: signed and unsigned bytes, damage refused."""

import numpy as np

from slamlab.exercises.drives.ex14 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

GOOD, DAMAGED = 10, 4
BYTES = 16  # before the checksum
SENSOR, SPEED, COMPASS, PATH, ANGLE = 2, 7, 13, 14, 15
ASKED = (SENSOR, SPEED, COMPASS, PATH, ANGLE)
SIGNED = np.array([False, True, False, True, True])
TO_DEGREES = np.array([1, 1, 2, 1, 1])  # the compass counts in 2 degrees


def inputs(rng):
    """Status frames of which each asked byte is above and below 128; some are damaged.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"codes": (n, 36) of the characters}
    """
    count = GOOD + DAMAGED
    data = rng.integers(1, 256, (count, BYTES))
    for column in ASKED:  # half of them are negative where they have a sign
        high = rng.permutation(np.arange(count) % 2)
        data[:, column] = rng.integers(3, 125, count) + 128 * high
    data[:, COMPASS] = np.minimum(data[:, COMPASS], rng.integers(131, 180, count))
    # no checksum is 0: who adds up all but the checksum takes none of them
    data[:, 0] = np.where(data.sum(axis=1) % 256, data[:, 0], data[:, 0] % 255 + 1)
    data = np.column_stack([data, -data.sum(axis=1) % 256])
    for row in rng.choice(count, DAMAGED, replace=False):
        column, off = rng.integers(0, BYTES), rng.integers(1, 255)
        off += off >= data[row, BYTES]
        data[row, column] = (data[row, column] + off) % 256
    frames = ["*" + bytes(row.tolist()).hex().upper() + "/" for row in data]
    return {"codes": np.array([[ord(c) for c in frame] for frame in frames])}


def data_of(i):
    """(n, 17) bytes, and whether they add up to 0 modulo 256."""
    frames = ("".join(map(chr, row.astype(int)))[1:-1] for row in i["codes"])
    data = np.array([list(bytes.fromhex(frame)) for frame in frames])
    return data, data.sum(axis=1) % 256 == 0


def _asked(i, shift=0):
    """(n, 5) the bytes that are asked for, 0 to 255."""
    return data_of(i)[0][:, np.array(ASKED) + shift]


def minus(values, signed, off=256):
    """Bytes as numbers, those above 127 negative where they have a sign."""
    return np.where(signed & (values > 127), values - off, values)


def _right(i):
    return minus(_asked(i), SIGNED) * TO_DEGREES


def _refused(i, o):
    return o["taken"] == data_of(i)[1]


def _columns(which):
    def holds(i, o):
        good = data_of(i)[1]
        found, want = o["values"][good][:, which], _right(i)[good][:, which]
        return (o["taken"][good] > 0) & (np.abs(found - want) < 1e-6).all(axis=1)

    return holds


def _came_out(formula):
    def matches(i, o):
        seen = (o["taken"] > 0) & data_of(i)[1]
        return bool(seen.any() and np.allclose(o["values"][seen], formula(i)[seen]))

    return matches


def _mistake(name, hint, *formulas):
    return Diagnosis(name, hint, lambda i, o: any(_came_out(f)(i, o) for f in formulas))


STATUS = Task(
    id="14-status",
    title="A status frame",
    drive=DRIVES["14-status"],
    inputs=inputs,
    shapes={"taken": (GOOD + DAMAGED,), "values": (GOOD + DAMAGED, 5)},
    laws=(
        Law(
            "damage refused",
            1,
            "None comes back for frames that do not add up to 0 modulo 256, and for no others",
            _refused,
        ),
        Law(
            "without a sign",
            1,
            "distance and compass are those that were sent",
            _columns([0, 2]),
        ),
        Law(
            "with a sign", 1, "speed, path and angle are those that were sent", _columns([1, 3, 4])
        ),
    ),
    diagnoses=(
        Diagnosis(
            "all refused",
            "Every frame is refused. All 17 bytes, the checksum too, add up to 0 modulo 256: not "
            "to 0, and not to 256.",
            lambda i, o: bool((o["taken"] == 0).all()),
        ),
        Diagnosis(
            "none refused",
            "Damaged frames come through. Add up all 17 bytes: the remainder by 256 must be 0, "
            "else return None.",
            lambda i, o: bool((o["taken"] == 1).all()) and _came_out(_right)(i, o),
        ),
        _mistake(
            "all signed",
            "Distance and compass come out negative: they have no sign (the thesis gives one to "
            "all bytes). Only speed, path and angle have.",
            lambda i: minus(_asked(i), True) * TO_DEGREES,
        ),
        _mistake(
            "none signed",
            "Backwards looks like far ahead: speed, path and angle are signed bytes. Above 127, "
            "take 256 off.",
            lambda i: _asked(i) * TO_DEGREES,
        ),
        _mistake(
            "255 taken off",
            "Your negative numbers are one too large: a byte has 256 values, so take 256 off.",
            lambda i: minus(_asked(i), SIGNED, 255) * TO_DEGREES,
        ),
        _mistake(
            "sign bit",
            "The top bit is no minus before the other seven: above 127, take 256 off (two's "
            "complement).",
            lambda i: np.where(SIGNED & (_asked(i) > 127), 128 - _asked(i), _asked(i)) * TO_DEGREES,
        ),
        _mistake(
            "counted from one",
            "These are the neighbours of the bytes asked for: bytes are counted from 0, and the "
            "star is none of them.",
            *(
                lambda i, shift=shift: minus(_asked(i, shift), SIGNED) * TO_DEGREES
                for shift in (-1, 1)
            ),
        ),
        _mistake(
            "compass not doubled",
            "The compass is in units of 2 degrees: asked for are degrees.",
            lambda i: minus(_asked(i), SIGNED),
        ),
        _mistake(
            "all doubled",
            "Only the compass is to be doubled: the angle is asked for in counts.",
            lambda i: minus(_asked(i), SIGNED) * np.array([1, 1, 2, 1, 2]),
        ),
    ),
)
