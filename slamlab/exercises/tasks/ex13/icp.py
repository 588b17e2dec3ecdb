"""Task 13-icp: pairs are not known, and nearest points are taken for them."""

from dataclasses import replace

import numpy as np

from slamlab.exercises.drives.ex13 import DRIVES
from slamlab.exercises.law import TOLERANCE, equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex13.motions import carried, first_pairs, looks, matched, motion

SOME = 3  # rounds in which a wrong step has not run away yet, and rounding has not grown


def sliding(rng, rounds, n=60):
    """A long wall full of points, along which the source comes into its place by small steps."""
    inputs, end = looks(rng, rounds), np.column_stack([np.full(6, 2.0), rng.uniform(0, 1, 6)])
    for name in ("source", "target"):
        walls = [rng.uniform((-2, -0.02), (2, 0.02), (n, 2)) for _ in rounds]
        inputs[name] = np.array([rng.permutation(np.vstack([wall, end])) for wall in walls])
    inputs["target"] = carried(inputs["T"], inputs["target"])
    return inputs | {"T": inputs["T"] @ motion(-0.4, 0.05, 0.03)}


def judged_at(law, asked):
    """A law that is asked of matches with some numbers of rounds only."""
    return replace(law, holds=lambda i, o: law.holds(i, o) | ~asked(i["rounds"]))


def by_rounds(inputs, outputs, want=matched):
    """What one round makes, and some more; of many, which may run away, only what is right."""
    rounds, found, right = inputs["rounds"], outputs["result"], want(inputs)["result"]
    off = np.abs(found - right).max(axis=(1, 2))
    return {
        "one round": found[rounds <= 1],
        "more": found[(rounds > 1) & (rounds <= SOME)],
        "many": (off[rounds > SOME] < TOLERANCE).astype(float),
    }


ONE = judged_at(
    equals(
        "round",
        2,
        "one round puts the best motion of the nearest pairs on top of T, no round leaves T as "
        "it is",
        matched,
        asks="In whose frame is the step found, and what has been done to the source by then? "
        "Which of the two motions acts first?",
        step=lambda inputs: {"middle of the first pairs' lengths": first_pairs(inputs)},
    ),
    lambda rounds: rounds <= 1,
)
MORE = judged_at(
    equals(
        "rounds",
        2,
        "each further round seeks new pairs from where the source lies by then",
        matched,
        asks="What is different at the beginning of the second round from that of the first?",
        after=("round",),
    ),
    lambda rounds: rounds > 1,
)

ICP = Task(
    id="13-icp",
    title="Iterative closest point",
    drive=DRIVES["13-icp"],
    inputs=lambda rng: looks(rng, [1, 1, 2, 3, 14]),
    shapes={"result": (3, 3)},
    laws=(ONE, MORE),
    needs=("13-best-motion",),
    probes=(
        Probe("no rounds", lambda rng: looks(rng, [0, 0], (6, 7))),
        Probe("more points in the source", lambda rng: looks(rng, [1, 4], (40, 12))),
        Probe("as many points in both", lambda rng: looks(rng, [1, 3], (9, 9))),
        Probe("two points", lambda rng: looks(rng, [1, 3], (2, 5), off=1)),
        Probe("a bad guess", lambda rng: looks(rng, [1, 2, 5], (12, 15), off=8)),
        Probe("a guess that is right", lambda rng: looks(rng, [1, 2], (6, 8), off=0)),
        Probe("a wall along which the source slides slowly", lambda rng: sliding(rng, [12, 15])),
        Probe("forty rounds", lambda rng: looks(rng, [40], (30, 70), people=9, off=4)),
    ),
    parts=by_rounds,
    rounds=False,
)
