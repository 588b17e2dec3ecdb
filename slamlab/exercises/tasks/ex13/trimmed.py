"""Task 13-trimmed: ICP that fits only the shortest share of the pairs.

A share of n pairs may be rounded up or down: inputs are such that there are no other ways.
"""

from dataclasses import replace

import numpy as np

from slamlab.exercises.drives.ex13 import DRIVES
from slamlab.exercises.law import equals, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex13.icp import by_rounds, judged_at, sliding
from slamlab.exercises.tasks.ex13.motions import first_pairs, looks, matched


def crowded(rng, rounds, keep, sizes=(36, 48), people=14, off=2.0):
    """Looks with people in them; the share is that of some pairs to keep, and a bit of one more."""
    inputs = looks(rng, rounds, sizes, people, off)
    return inputs | {"share": (np.resize(keep, len(rounds)) + 0.4) / inputs["source"].shape[1]}


def _sliding(rng):
    inputs = sliding(rng, [10, 14])
    return inputs | {"share": np.full(2, 60.4 / inputs["source"].shape[1])}


@once
def want(inputs):
    """What comes of a share that is rounded down."""
    return matched(inputs, lambda share, n: int(share * n))


def _rounded_up(inputs):
    return matched(inputs, lambda share, n: int(share * n) + 1)


def _either(law):
    """A law that allows rounding up as well."""
    up = equals("", 0, "", _rounded_up)
    return replace(law, holds=lambda i, o: law.holds(i, o) | up.holds(i, o))


def _parts(inputs, outputs):
    """Motions as if all had rounded down."""
    up = equals("", 0, "", _rounded_up, tolerance=1e-9).holds(inputs, outputs)
    result = np.where(up[:, None, None], want(inputs)["result"], outputs["result"])
    return by_rounds(inputs, {"result": result}, want)


ONE = _either(
    equals(
        "round",
        2,
        "one round puts the best motion of the shortest share of the pairs on top of T, no round "
        "leaves T as it is",
        want,
        asks="Which rows of the source, and which of the target, belong to the shortest pairs?",
        step=lambda inputs: {
            "pairs to keep": np.floor(inputs["share"] * inputs["source"].shape[1]),
            "middle of the first pairs' lengths": first_pairs(inputs),
        },
    )
)
MORE = _either(
    equals(
        "anew",
        2,
        "each further round seeks and sorts the pairs anew and keeps as large a share",
        want,
        asks="A pair was long in the first round, so it was left out. May it come back?",
        after=("round",),
    )
)

TRIMMED = Task(
    id="13-trimmed",
    title="Trimmed ICP",
    drive=DRIVES["13-trimmed"],
    inputs=lambda rng: crowded(rng, [1, 1, 2, 3, 5], [27, 31, 30, 33, 28]),
    shapes={"result": (3, 3)},
    laws=(
        judged_at(ONE, lambda rounds: rounds <= 1),
        judged_at(MORE, lambda rounds: rounds > 1),
    ),
    needs=("13-best-motion",),
    probes=(
        Probe("many rounds", lambda rng: crowded(rng, [14], [28])),
        Probe("no rounds", lambda rng: crowded(rng, [0, 0], [3], (4, 7), 2)),
        Probe("a share of nearly one", lambda rng: crowded(rng, [1, 3], [9], (8, 12), 2)),
        Probe("two pairs kept of six", lambda rng: crowded(rng, [1, 1], [2], (6, 8), 0, 1)),
        Probe("more points in the source", lambda rng: crowded(rng, [1, 3], [20], (30, 12), 5)),
        Probe("a bad guess", lambda rng: crowded(rng, [1, 2, 5], [12], (15, 20), 5, 6)),
        Probe("a wall along which the source slides slowly", _sliding),
        Probe("many points", lambda rng: crowded(rng, [2], [61], (80, 90), 20)),
    ),
    parts=_parts,
    rounds=False,
)
