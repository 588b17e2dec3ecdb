"""Task 13-trimmed: ICP with the shortest correspondences, whose number may be rounded."""

from dataclasses import replace

import numpy as np

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex13_scan_matching.calls import CALLS
from course.exercises.ex13_scan_matching.icp.task import by_rounds, judged_at, sliding
from course.exercises.ex13_scan_matching.motions import first_pairs, looks, matched


def crowded(rng, rounds, keep, sizes=(36, 48), people=14, off=2.0):
    """Scans with people; the share is that of ``keep`` + 0.4 correspondences."""
    inputs = looks(rng, rounds, sizes, people, off)
    return inputs | {"share": (np.resize(keep, len(rounds)) + 0.4) / inputs["source"].shape[1]}


def _sliding(rng):
    inputs = sliding(rng, [10, 14])
    return inputs | {"share": np.full(2, 60.4 / inputs["source"].shape[1])}


@once
def want(inputs):
    """The result if the number of correspondences is rounded down."""
    return matched(inputs, lambda share, n: int(share * n))


def _rounded_up(inputs):
    return matched(inputs, lambda share, n: int(share * n) + 1)


def _either(law):
    up = equals("", 0, "", _rounded_up)
    return replace(law, holds=lambda i, o: law.holds(i, o) | up.holds(i, o))


def _parts(inputs, outputs):
    """Results, with that of rounding down in place of that of rounding up."""
    up = equals("", 0, "", _rounded_up, tolerance=1e-9).holds(inputs, outputs)
    result = np.where(up[:, None, None], want(inputs)["result"], outputs["result"])
    return by_rounds(inputs, {"result": result}, want)


def _first(inputs):
    once = inputs | {"rounds": np.minimum(inputs["rounds"], 1)}
    result = matched(once, lambda share, n: int(share * n))["result"]
    return {"T after the first iteration, with the number rounded down": result}


ONE = _either(
    equals(
        "round",
        2,
        "one iteration composes T with the best motion of the shortest correspondences; with 0 "
        "iterations T is unchanged",
        want,
        asks="Which rows of the source, and which rows of the target, form the shortest "
        "correspondences?",
        step=lambda inputs: {
            "number of correspondences to use": np.floor(
                inputs["share"] * inputs["source"].shape[1]
            ),
            "median length of the first correspondences": first_pairs(inputs),
        },
    )
)
MORE = _either(
    equals(
        "anew",
        2,
        "each further iteration finds and sorts all correspondences again, and uses the same share",
        want,
        asks="A source point was left out in the first iteration, because its correspondence was "
        "long. May it be used in a later iteration?",
        after=("round",),
        step=_first,
    )
)

TRIMMED = Task(
    id="13-trimmed",
    title="Trimmed ICP",
    call=CALLS["13-trimmed"],
    inputs=lambda rng: crowded(rng, [1, 1, 2, 3, 5], [27, 31, 30, 33, 28]),
    shapes={"result": (3, 3)},
    laws=(
        judged_at(ONE, lambda rounds: rounds <= 1),
        judged_at(MORE, lambda rounds: rounds > 1),
    ),
    needs=("13-best-motion",),
    probes=(
        Probe("many iterations", lambda rng: crowded(rng, [14], [28])),
        Probe("no iterations", lambda rng: crowded(rng, [0, 0], [3], (4, 7), 2)),
        Probe("a share of nearly one", lambda rng: crowded(rng, [1, 3], [9], (8, 12), 2)),
        Probe("two correspondences of six", lambda rng: crowded(rng, [1, 1], [2], (6, 8), 0, 1)),
        Probe("more points in the source", lambda rng: crowded(rng, [1, 3], [20], (30, 12), 5)),
        Probe("a bad guess", lambda rng: crowded(rng, [1, 2, 5], [12], (15, 20), 5, 6)),
        Probe("a wall along which ICP converges slowly", _sliding),
        Probe("many points", lambda rng: crowded(rng, [2], [61], (80, 90), 20)),
    ),
    parts=_parts,
    may_round=False,
    begins=(
        "The lengths of four correspondences are 0.3, 0.1, 2.0 and 0.2 m, and share "
        "is 0.5. Which two do you use?",
        "Which lines of your icp can you use again, and at which place do you choose "
        "the correspondences?",
    ),
)
