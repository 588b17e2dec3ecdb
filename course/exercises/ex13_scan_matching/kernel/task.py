"""Task 13-kernel: ICP with a robust kernel, by iteratively reweighted least squares."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex13_scan_matching.calls import CALLS
from course.exercises.ex13_scan_matching.icp.task import SIZES, by_rounds, judged_at, sliding
from course.exercises.ex13_scan_matching.motions import (
    carried,
    first_pairs,
    looks,
    matched,
    nearest,
)


def crowded(rng, iterations, sizes=(36, 48), people=14, off=2.0, c=(0.1, 0.4)):
    """Scans with people, and c (k,) [m]."""
    inputs = looks(rng, iterations, sizes, people, off)
    return inputs | {"c": rng.uniform(*c, len(iterations))}


def _sliding(rng):
    return sliding(rng, [10, 14]) | {"c": SIZES * rng.uniform(0.1, 0.3, 2)}


def _of_length_zero(rng):
    """Correspondences whose length is exactly zero: T maps such numbers without rounding."""
    inputs = crowded(rng, [1, 2], (6, 8), 0, 0)
    T = np.array([[0, -1, 1.5], [1, 0, -0.5], [0, 0, 1]])
    target = np.rint(1024 * inputs["target"]) / 1024
    source = (target[:, :6] - T[:2, 2]) @ T[:2, :2]
    return inputs | {"source": source, "target": target, "T": np.array([T, T])}


def weights(lengths, c):
    """Weights ρ'(e) / 2e of the kernel of Geman and McClure, ρ(e) = c²e²/(c² + e²)."""
    return (c**2 / (c**2 + lengths**2)) ** 2


def want(inputs):
    return matched(inputs, weights)


def _first(inputs):
    once = inputs | {"iterations": np.minimum(inputs["iterations"], 1)}
    return {"T after the first iteration": want(once)["result"]}


def _centroids(inputs):
    """Weighted centroids of the first correspondences, and their median length."""
    found = []
    for p, q, T, c in zip(*(inputs[name] for name in ("source", "target", "T", "c")), strict=True):
        moved = carried(T, p)
        rows, lengths = nearest(moved, q)
        w = weights(lengths, c)
        found.append([np.average(points, axis=0, weights=w) for points in (moved, q[rows])])
    a, b = np.moveaxis(np.array(found), 1, 0)
    return {
        "median length of the first correspondences": first_pairs(inputs),
        "weighted centroid of the transformed source": a,
        "weighted centroid of its nearest points": b,
    }


ONE = equals(
    "round",
    2,
    "one iteration composes T with the motion that minimises the weighted sum of squares; with 0 "
    "iterations T is unchanged",
    want,
    asks="What is ρ'(e), and what remains if you divide it by 2e, with the c that you are given? "
    "In which sums of the best motion does each correspondence occur, with which weight?",
    step=_centroids,
)
MORE = equals(
    "anew",
    2,
    "each further iteration finds the correspondences and computes the weights again",
    want,
    asks="A correspondence was long in the first iteration. After the step it is short. Which "
    "weight does it have in the second iteration?",
    after=("round",),
    step=_first,
)

KERNEL = Task(
    id="13-kernel",
    title="A robust kernel",
    call=CALLS["13-kernel"],
    inputs=lambda rng: crowded(rng, [1, 1, 2, 3, 5]),
    shapes={"result": (3, 3)},
    laws=(
        judged_at(ONE, lambda iterations: iterations <= 1),
        judged_at(MORE, lambda iterations: iterations > 1),
    ),
    probes=(
        Probe("many iterations", lambda rng: crowded(rng, [14])),
        Probe("no iterations", lambda rng: crowded(rng, [0, 0], (4, 7), 2)),
        Probe("correspondences of length zero", _of_length_zero),
        Probe("two points", lambda rng: crowded(rng, [1, 1], (2, 5), 0, 1)),
        Probe("c of 1 cm", lambda rng: crowded(rng, [1, 3], (8, 12), 2, c=(0.01, 0.011))),
        Probe("c of 100 m", lambda rng: crowded(rng, [1, 3], (8, 12), 2, c=(99, 100))),
        Probe("more points in the source", lambda rng: crowded(rng, [1, 3], (30, 12), 5)),
        Probe("a bad guess", lambda rng: crowded(rng, [1, 2, 5], (15, 20), 5, 6)),
        Probe("a wall along which ICP converges slowly", _sliding),
        Probe("many points", lambda rng: crowded(rng, [2], (80, 90), 20)),
    ),
    parts=lambda inputs, outputs: by_rounds(inputs, outputs, want),
    may_round=False,
    needs=("13-best-motion",),
    references=(Reference("robust_icp", "source target T iterations c", want),),
    begins=(
        "Differentiate ρ. Which weights have correspondences of 0, c and 10c, as fractions of the "
        "first one?",
        "Two points have the weights 1 and 3. Where is their weighted centroid?",
        "Set the derivative of the weighted sum with respect to t to zero. Which t follows for a "
        "given rotation?",
    ),
)
