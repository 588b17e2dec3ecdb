"""Exercise 14, the open task: trials that tell wrong drivers of a counter from right ones.

Trials are data, ways with the counts that belong to them; the drivers under test stay with the
judge. Which faults they have, and which of each kind, is drawn.
"""

from functools import lru_cache

import numpy as np

from slamlab.exercises.drives.ex14 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex14 import faulty_drivers

READINGS, WAYS = 1000, 20
"""Most readings and ways that trials may take: a robot sends ten readings a second."""
STEPS = ((40, 1), (70, 2), (88, 2), (97, 2))
"""Faulty drivers to be found, of a hundred, and the points for them.

A drive ahead and back, as in the lesson, finds 18 to 31; steps at random in one way 74 to 79, with
ways of one reading and of none besides 89 to 96; all is found by edges, all steps and a far way.
"""


def inputs(rng):
    """A key for the drivers that are drawn.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"_drivers": (2,)}
    """
    return {"_drivers": rng.integers(1, 2**31, 2)}


def ways_of(o):
    """The trials as (values, counts); none where the lengths do not fit."""
    lengths = o["lengths"].astype(int)
    if len(lengths) == 0 or (lengths < 0).any() or lengths.sum() != len(o["values"]):
        return []
    ends = np.cumsum(lengths)[:-1]
    return list(zip(np.split(o["values"], ends), np.split(o["counts"], ends), strict=True))


def objection(o):
    """What is wrong with trials by themselves: name and sentence; None if they can be used."""
    ways = ways_of(o)
    readings = len(o["values"])
    if not ways:
        return "none", (
            f"There are no trials. At least one way must be tried, and at most {WAYS}, with "
            f"{READINGS} readings at most."
        )
    if readings > READINGS or len(ways) > WAYS:
        return "too much", (
            f"Your trials are {len(ways)} ways with {readings} readings in all. At most {WAYS} "
            f"ways may be tried, with {READINGS} readings at most."
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
                f"{values[at + 1]:g}. That is half a round, ahead or back: right drivers differ "
                "here."
            )
        right = faulty_drivers.right(values)
        if not np.array_equal(counts, right):
            at = np.flatnonzero(counts != right)[0]
            return "wrong counts", (
                f"In trials()[{k}], counts[{at}] is {counts[at]:g}, and a right driver returns "
                f"{right[at]:g}. They would take it for a faulty one."
            )
    return None


def found(i, o):
    """How many of the faulty drivers the trials tell from right ones; 0 if they cannot be used."""
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
    return sum(faulty_drivers.told(driver, ways) for driver in drivers)


def _why(i, o):
    wrong = objection(o)
    if wrong:
        return wrong[1]
    ways = len(o["lengths"])
    effort = f"{len(o['values'])} readings in {ways} way{'' if ways == 1 else 's'}"
    return f"Of the 100 faulty drivers {found(i, o)} are found, with {effort}."


def _law(least, points, asks):
    return Law(
        f"finds {least}",
        points,
        f"right drivers pass, and of 100 faulty ones {least} are found",
        lambda i, o: found(i, o) >= least,
        why=_why,
        asks=asks,
    )


ASKS = (
    "At which readings does a counter overflow, in how many directions, and what is the first "
    "byte of a way?",
    "What does a driver promise of a robot that goes as fast as it may, ahead and back, and of "
    "one that stands still?",
    "What is the shortest way that a driver must understand? And what can it remember of the "
    "way before?",
    "Of all bytes and of all steps from −127 to 127, which ones has no way of yours? And how far "
    "does your longest way go: could a total of 16 bits hold it?",
)


def _objected(name, hint):
    return Diagnosis(name, hint, lambda i, o: (objection(o) or ("",))[0] == name)


def _all(values):
    """All values, steps and totals of all ways, and which steps overflow."""

    def of(o):
        ways = [v for v, _ in ways_of(o)]
        raw = np.concatenate([np.diff(v) for v in ways])
        return values(ways, raw, faulty_drivers.ring(raw))

    return of


def _lacking(name, hint, lacks):
    return Diagnosis(name, hint, lambda i, o: objection(o) is None and bool(_all(lacks)(o)))


TRIALS = Task(
    id="14-trials",
    title="Trials for drivers that others wrote",
    drive=DRIVES["14-trials"],
    inputs=inputs,
    shapes={"values": (None,), "counts": (None,), "lengths": (None,)},
    laws=tuple(_law(*step, asks) for step, asks in zip(STEPS, ASKS, strict=True)),
    diagnoses=(
        _objected(
            "none",
            "A list without trials tests no driver: begin with one way, such as a few steps ahead "
            "and back.",
        ),
        _objected(
            "too much",
            "Trials cost a robot's time. One way that holds many cases does the work of many ways.",
        ),
        _objected(
            "no byte",
            "A driver is handed signed bytes, whole numbers from −128 to 127. What it does with "
            "anything else nobody has promised.",
        ),
        _objected(
            "half a round",
            "Trials may ask for what is promised only: fewer than 128 counts between two readings.",
        ),
        _objected(
            "wrong counts",
            "The counts that you expect are wrong, so that right drivers fail. Choose the steps "
            "first: the counts are their sums, and the bytes follow from these.",
        ),
        _lacking(
            "no overflow",
            "In none of your ways does the counter overflow, where nearly everything can go wrong.",
            lambda ways, raw, steps: (raw == steps).all(),
        ),
        _lacking(
            "one direction",
            "The counter overflows in one direction only. Somebody may have mended that one and "
            "forgotten the other.",
            lambda ways, raw, steps: (raw <= 127).all() or (raw >= -127).all(),
        ),
        _lacking(
            "slow",
            "Your robot does not go as fast as it may, both ahead and back. Limits are wrong at "
            "their edge first: which is the longest step that is promised in either direction?",
            lambda ways, raw, steps: steps.max() < 127 or steps.min() > -127,
        ),
        _lacking(
            "always from 0",
            "All your ways begin at the byte 0, where a driver that keeps the first byte in its "
            "count is right by luck.",
            lambda ways, raw, steps: not any(v[0] for v in ways if len(v)),
        ),
        _lacking(
            "one way",
            "At most one of your ways has more than two readings. What a driver keeps from the way "
            "before shows in a second one that is handed to the same driver.",
            lambda ways, raw, steps: sum(len(v) > 2 for v in ways) < 2,
        ),
        _lacking(
            "no shortest way",
            "Readings may be one, or none at all. Programs that are right for many often fail at "
            "the fewest.",
            lambda ways, raw, steps: {len(v) for v in ways} < {0, 1} | {len(v) for v in ways},
        ),
        _lacking(
            "never far",
            "None of your ways goes further than 32 767 counts, ahead or back: a total of 16 bits "
            "would do, and an overflow there stays unseen.",
            lambda ways, raw, steps: (
                not any(np.abs(faulty_drivers.right(v)).max(initial=0) > 32767 for v in ways)
            ),
        ),
        _lacking(
            "not everything",
            "Some bytes, or some steps from −127 to 127, are in none of your ways. A driver may be "
            "wrong at a single one of them.",
            lambda ways, raw, steps: len(set(steps)) < 255 or len(set(np.concatenate(ways))) < 256,
        ),
    ),
)
