"""Task 14-trials, the open task: test cases that detect faulty drivers.

A test case is a sequence of readings (here called a way) with its counts.
"""

from functools import lru_cache

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.task import Task
from course.exercises.ex14_devices_and_live_slam.calls import CALLS
from course.exercises.ex14_devices_and_live_slam.trials import faulty_drivers

READINGS, WAYS = 1000, 20
"""Limits of all test cases together: a robot sends ten readings a second."""
STEPS = ((40, 1), (70, 2), (88, 2), (97, 2))
"""Numbers of faulty drivers to detect, of a hundred, and the points for them.

A drive forwards and backwards, as in the lesson, detects 18 to 31. One sequence of random steps
detects 74 to 79; together with sequences of one reading and of none, 89 to 96. Sequences with the
longest steps, all steps and a large total detect all.
"""


def inputs(rng):
    """Return {"_drivers": (2,)}, a seed for the drivers that are drawn."""
    return {"_drivers": rng.integers(1, 2**31, 2)}


def ways_of(o):
    """Return the test cases as (values, counts); an empty list if the lengths do not fit."""
    lengths = o["lengths"].astype(int)
    if len(lengths) == 0 or (lengths < 0).any() or lengths.sum() != len(o["values"]):
        return []
    ends = np.cumsum(lengths)[:-1]
    return list(zip(np.split(o["values"], ends), np.split(o["counts"], ends), strict=True))


def objection(o):
    """Return the name and the message of an invalid set of test cases; None if it is valid."""
    ways = ways_of(o)
    readings = len(o["values"])
    if not ways:
        return "none", (
            "trials() contains no test case. It must contain at least one sequence, at most "
            f"{WAYS} sequences, and at most {READINGS} readings in all."
        )
    if readings > READINGS or len(ways) > WAYS:
        return "too much", (
            f"Your test cases have {readings} readings in all, and the number of sequences is "
            f"{len(ways)}. At most {READINGS} readings and {WAYS} sequences are allowed."
        )
    for k, (values, counts) in enumerate(ways):
        whole = (values == np.rint(values)) & (values >= -128) & (values <= 127)
        if not whole.all():
            return "no byte", (
                f"In trials()[{k}], values[{np.flatnonzero(~whole)[0]}] is {values[~whole][0]:g}. "
                "A signed byte is a whole number from −128 to 127."
            )
        steps = faulty_drivers.ring(np.diff(values))
        if (steps == -128).any():
            at = np.flatnonzero(steps == -128)[0]
            return "half a round", (
                f"In trials()[{k}], values[{at}] is {values[at]:g} and the next is "
                f"{values[at + 1]:g}. This step of 128 counts has no known direction, and the "
                "specification allows at most 127."
            )
        right = faulty_drivers.right(values)
        if not np.array_equal(counts, right):
            at = np.flatnonzero(counts != right)[0]
            return "wrong counts", (
                f"In trials()[{k}], counts[{at}] is {counts[at]:g}, but a correct driver returns "
                f"{right[at]:g}. Your test case would fail the correct driver."
            )
    return None


def found(i, o):
    """Return how many faulty drivers the test cases detect; 0 if they are invalid."""
    return _found(
        tuple(i["_drivers"].astype(int).tolist()),
        *(o[name].tobytes() for name in ("values", "counts", "lengths")),
    )


@lru_cache(maxsize=4)  # each law asks for it
def _found(key, *data):
    values, counts, lengths = (np.frombuffer(each) for each in data)
    o = {"values": values, "counts": counts, "lengths": lengths}
    if objection(o):
        return 0
    ways = [values.astype(int) for values, _ in ways_of(o)]
    drivers = faulty_drivers.drawn(np.random.default_rng(key))
    return sum(faulty_drivers.is_detected(driver, ways) for driver in drivers)


def _why(i, o):
    wrong = objection(o)
    if wrong:
        return wrong[1]
    ways = len(o["lengths"])
    effort = f"{len(o['values'])} readings in {ways} sequence{'' if ways == 1 else 's'}"
    return f"Your test cases detect {found(i, o)} of the 100 faulty drivers, with {effort}."


def _law(least, points, asks, step):
    return Law(
        f"finds {least}",
        points,
        f"correct drivers pass, and at least {least} of 100 faulty drivers are detected",
        lambda i, o: found(i, o) >= least,
        why=_why,
        asks=asks,
        step=step,
    )


ASKS = (
    "At which values does the counter overflow, and in how many directions? Which byte may be the "
    "first of a sequence?",
    "What does the specification say about the longest steps, forwards and backwards, and about a "
    "robot that stands still?",
    "What is the shortest sequence that a driver must accept? Which values can a faulty driver "
    "keep from the previous sequence?",
    "Which bytes, and which steps from −127 to 127, are missing in all your sequences? Does the "
    "total count of your longest sequence exceed 16 bits?",
)


ON_THE_WAY = (
    "Write a driver that returns the plain differences from the first reading, and one that "
    "returns the readings. Which of your sequences does each of them fail?",
    "Write a driver with a limit of 126 instead of 127 for a step forwards, and the same for a "
    "step backwards. Which of your sequences does each of them fail?",
    "Write a driver that keeps its last reading and its total between two calls, and one that "
    "raises an exception for one reading. Which of your sequences does each of them fail?",
    "Print the sorted list of the bytes of all your sequences, that of the steps, and the largest "
    "and the smallest count. What is missing?",
)


def _objected(name, hint, asks):
    return Diagnosis(name, hint, lambda i, o: (objection(o) or ("",))[0] == name, asks=asks)


def _all(values):
    """Apply a test to the sequences, and to the raw and unwrapped steps of all of them."""

    def of(o):
        ways = [v for v, _ in ways_of(o)]
        raw = np.concatenate([np.diff(v) for v in ways])
        return values(ways, raw, faulty_drivers.ring(raw))

    return of


def _lacking(name, hint, lacks, asks):
    return Diagnosis(
        name, hint, lambda i, o: objection(o) is None and bool(_all(lacks)(o)), asks=asks
    )


TRIALS = Task(
    id="14-trials",
    title="Test cases for drivers",
    call=CALLS["14-trials"],
    inputs=inputs,
    shapes={"values": (None,), "counts": (None,), "lengths": (None,)},
    laws=tuple(_law(*each, *texts) for *texts, each in zip(ASKS, ON_THE_WAY, STEPS, strict=True)),
    diagnoses=(
        _objected(
            "none",
            "An empty list tests no driver. Begin with one sequence, such as a few steps forwards "
            "and backwards.",
            asks="How many test cases does your list contain? What is the smallest test case "
            "that a driver can fail?",
        ),
        _objected(
            "too much",
            "Each reading takes time on a real robot. Combine several cases in one sequence.",
            asks="How many readings and how many sequences do you have, and how many does the "
            "task allow?",
        ),
        _objected(
            "no byte",
            "The readings must be signed bytes, whole numbers from −128 to 127. The specification "
            "says nothing about other numbers.",
            asks="What are the smallest and the largest number among your readings? Are all of "
            "them integers?",
        ),
        _objected(
            "half a round",
            "A test case may use only what the specification allows: at most 127 counts between "
            "two readings.",
            asks="Between which two of your readings is the step 128? Could a driver know its "
            "direction?",
        ),
        _objected(
            "wrong counts",
            "Your expected counts are wrong, so a correct driver fails. Choose the steps first. "
            "The counts are their sums, and the bytes follow from the counts.",
            asks="What does your unwrap return for each of your sequences, and what are your "
            "counts?",
        ),
        _lacking(
            "no overflow",
            "The counter overflows in none of your sequences, and most faults show only at an "
            "overflow.",
            lambda ways, raw, steps: (raw == steps).all(),
            asks="Between which two of your readings does the counter pass from 127 to −128?",
        ),
        _lacking(
            "one direction",
            "The counter overflows in one direction only. A driver may correct this direction and "
            "forget the other.",
            lambda ways, raw, steps: (raw <= 127).all() or (raw >= -127).all(),
            asks="How often do your sequences pass from 127 to −128, and how often from −128 "
            "to 127?",
        ),
        _lacking(
            "slow",
            "Your sequences do not contain the longest steps in both directions. Many faults are "
            "limits that are off by one. Which step is the longest that is allowed?",
            lambda ways, raw, steps: steps.max() < 127 or steps.min() > -127,
            asks="What are the largest step forwards and the largest step backwards in your "
            "sequences?",
        ),
        _lacking(
            "one sequence",
            "You have one sequence only. Which values must a driver reset at the first reading of "
            "a sequence?",
            lambda ways, raw, steps: len(ways) == 1,
            asks="How often do your test cases call a driver? What may it keep from one call "
            "to the next?",
        ),
        _lacking(
            "always from 0",
            "All your sequences begin at the byte 0. A driver that adds the first byte to its "
            "counts is then right by chance.",
            lambda ways, raw, steps: not any(v[0] for v in ways if len(v)),
            asks="With which bytes do your sequences begin?",
        ),
        _lacking(
            "one way",
            "At most one of your sequences has more than two readings. A driver that keeps values "
            "from the previous sequence fails only on a second sequence.",
            lambda ways, raw, steps: sum(len(v) > 2 for v in ways) < 2,
            asks="How many of your sequences have more than two readings?",
        ),
        _lacking(
            "no shortest way",
            "A sequence may have one reading or none. Many programs fail for the shortest inputs.",
            lambda ways, raw, steps: {len(v) for v in ways} < {0, 1} | {len(v) for v in ways},
            asks="Which lengths do your sequences have? What is the shortest one that is allowed?",
        ),
        _lacking(
            "never far",
            "None of your sequences goes beyond 32 767 counts, forwards or backwards. So they do "
            "not detect a driver whose total has only 16 bits.",
            lambda ways, raw, steps: (
                not any(np.abs(faulty_drivers.right(v)).max(initial=0) > 32767 for v in ways)
            ),
            asks="What is the largest count in your test cases? How many bits does it need?",
        ),
        _lacking(
            "not everything",
            "Some bytes, or some steps from −127 to 127, are in none of your sequences. A driver "
            "may be wrong for a single one of them.",
            lambda ways, raw, steps: len(set(steps)) < 255 or len(set(np.concatenate(ways))) < 256,
            asks="Count how many different bytes and how many different steps your sequences "
            "contain. How many are there in all?",
        ),
    ),
    needs=("14-unwrap",),
    begins=(
        "A robot drives 3 counts forwards and then 2 backwards. Which readings and "
        "which counts does this test case contain, if the first reading is 10?",
        "At which readings would a driver fail that does not know of any overflow?",
    ),
)
