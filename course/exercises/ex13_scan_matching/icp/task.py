"""Task 13-icp: nearest points take the place of unknown correspondences."""

from dataclasses import replace

import numpy as np

from classroom.exercises.correctness_laws import TOLERANCE, equals
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex13_scan_matching.calls import CALLS
from course.exercises.ex13_scan_matching.motions import carried, looks, matched, motion

SIZES = np.array([1, 1e-3])  # along the small wall all steps are small, but their sum is not
SOME = 3  # iterations in which a wrong step does not diverge yet and rounding errors stay small


def sliding(rng, iterations, n=60):
    """Walls with many points, along which the source converges slowly, of the sizes SIZES."""
    inputs, end = looks(rng, iterations), np.column_stack([np.full(6, 2.0), rng.uniform(0, 1, 6)])
    for name in ("source", "target"):
        walls = [rng.uniform((-2, -0.02), (2, 0.02), (n, 2)) for _ in iterations]
        walls = np.array([rng.permutation(np.vstack([wall, end])) for wall in walls])
        inputs[name] = SIZES[:, None, None] * walls
    inputs["target"] = carried(inputs["T"], inputs["target"])
    return inputs | {"T": inputs["T"] @ motion(-0.4 * SIZES, 0.05 * SIZES, 0.03)}


def judged_at(law, asked):
    """A law that judges only matches with some numbers of iterations."""
    return replace(law, holds=lambda i, o: law.holds(i, o) | ~asked(i["iterations"]))


def by_rounds(inputs, outputs, want=matched):
    """Results of one iteration; of some, and whether those of many, which diverge, are right."""
    iterations, found, right = inputs["iterations"], outputs["result"], want(inputs)["result"]
    off = np.abs(found - right).max(axis=(1, 2))
    return {
        "one round": found[iterations <= 1],
        "more": np.append(
            found[(iterations > 1) & (iterations <= SOME)], off[iterations > SOME] < TOLERANCE
        ),
    }


def _first(inputs):
    once = inputs | {"iterations": np.minimum(inputs["iterations"], 1)}
    return {"T after the first iteration": matched(once)["result"]}


def _first_motion(inputs):
    once = inputs | {"iterations": np.ones(len(inputs["iterations"]))}
    found = matched(once)["result"] @ np.linalg.inv(inputs["T"])
    return {"what best_motion returns in the first iteration": found}


ONE = judged_at(
    equals(
        "round",
        2,
        "one iteration composes T with the best motion of the nearest points; with 0 iterations "
        "T is unchanged",
        matched,
        asks="best_motion gets a source that T has transformed, all of it. In which frame is its "
        "result? Which of the two motions acts first on a point?",
        step=_first_motion,
    ),
    lambda iterations: iterations <= 1,
)
MORE = judged_at(
    equals(
        "iterations",
        2,
        "each further iteration finds the nearest points again, with the source transformed by the "
        "new T",
        matched,
        asks="T differs between the first and the second iteration. What else differs?",
        after=("round",),
        step=_first,
    ),
    lambda iterations: iterations > 1,
)

ICP = Task(
    id="13-icp",
    title="Iterative closest point",
    call=CALLS["13-icp"],
    inputs=lambda rng: looks(rng, [1, 1, 2, 3, 14]),
    shapes={"result": (3, 3)},
    laws=(ONE, MORE),
    needs=("13-best-motion",),
    references=(Reference("icp", "source target T iterations", matched),),
    probes=(
        Probe("no iterations", lambda rng: looks(rng, [0, 0], (6, 7))),
        Probe("more points in the source", lambda rng: looks(rng, [1, 4], (40, 12))),
        Probe("equally many points in both clouds", lambda rng: looks(rng, [1, 3], (9, 9))),
        Probe("two points", lambda rng: looks(rng, [1, 3], (2, 5), off=1)),
        Probe("a bad guess", lambda rng: looks(rng, [1, 2, 5], (12, 15), off=8)),
        Probe("a correct guess", lambda rng: looks(rng, [1, 2], (6, 8), off=0)),
        Probe("a wall along which ICP converges slowly", lambda rng: sliding(rng, [12, 15])),
        Probe("forty iterations", lambda rng: looks(rng, [40], (30, 70), people=9, off=4)),
    ),
    parts=by_rounds,
    may_round=False,
    begins=(
        "What do carry(T, source) and nearest return for two source points?",
        "What is T after one iteration, if best_motion returns a translation by 10 cm?",
    ),
)
