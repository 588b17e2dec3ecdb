"""The task of exercise 13 about scans that overlap in part: ICP that trims."""

import numpy as np

from slamlab.exercises.drives.ex13 import DRIVES, ROUNDS
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex13_clouds import is_best, nudged
from slamlab.exercises.tasks.ex13_fit import fit
from slamlab.exercises.tasks.ex13_icp import (
    SHAPES,
    SHARED,
    WRONG_SIDE,
    first_pairs,
    lands,
    one_pair,
    scene,
    stacked,
)

CLUTTER = 14
ROUNDINGS = (0, -1, 1)
"""What the number of pairs to keep may be off: a share may be rounded either way."""


def cluttered(rng, count=3):
    """Scans that overlap, but people stand in the source who were not there in the target."""
    shares = rng.choice([0.54, 0.6, 0.62], count)
    # a pair more or less must lead home as well; and the other share: the first round tells
    one = 1 / (SHARED + CLUTTER)
    cases = (one_pair(rng, CLUTTER, (s, s - one, s + one, 1 - s)) for s in shares)
    return stacked(cases) | {"share": shares} | far_off(rng)


def far_off(rng, count=6):
    """Scans whose guess is so bad that the first round changes which pairs are short."""
    cases = []
    for _ in range(count):
        target, source, people, T = scene(rng, CLUTTER)
        guess = nudged(rng, T, target.mean(axis=0), size=3.0)
        cases.append({"source": np.concatenate([source, people]), "target": target, "guess": guess})
    cases = stacked(cases) | {"share": rng.choice([0.54, 0.6, 0.62], count)}
    return {f"far_{name}": array for name, array in cases.items()}


def second_round(inputs, outputs):
    """The inputs of the far scans at the start, and after the student's first round."""
    start = {name: inputs[f"far_{name}"] for name in ("source", "target", "guess", "share")}
    return start, start | {"guess": outputs["far_one"]}


def kept_count(inputs):
    """(k,) how many pairs the shares stand for."""
    return np.rint(inputs["share"] * inputs["source"].shape[1]).astype(int)


# ---- laws -----------------------------------------------------------------------------------


def _first_round(inputs, outputs):
    return _best_of_shortest(inputs, outputs["one"])


def _sorted_anew(inputs, outputs):
    return _best_of_shortest(second_round(inputs, outputs)[1], outputs["far_two"])


def _best_of_shortest(inputs, motions):
    """(k,) whether each motion is the best one of the pairs that are shortest at the guess."""
    _, target, distances = first_pairs(inputs)
    order, holds = distances.argsort(axis=1), False
    for off in ROUNDINGS:
        cases = zip(motions, inputs["source"], target, order, kept_count(inputs), strict=True)
        kept = ((T, p, q, rows[: k + off]) for T, p, q, rows, k in cases)
        holds |= np.array([is_best(T[None], p[None, r], q[None, r])[0] for T, p, q, r in kept])
    return holds


# ---- mistakes -------------------------------------------------------------------------------


def first_step(inputs, choose, off=0):
    """The best motion of the first pairs in rows choose(order by distance, how many to keep)."""
    moved, target, distances = first_pairs(inputs)
    steps = []
    for p, q, d, count in zip(moved, target, distances, kept_count(inputs), strict=True):
        of_source, of_target = choose(d.argsort(), count + off)
        steps.append(fit(p[None, of_source], q[None, of_target]))
    return np.concatenate(steps)


def _same(rows):
    return rows, rows


def shortest(order, count):
    return _same(order[:count])


def longest(order, count):
    return _same(order[-count:])


def share_dropped(order, count):
    return _same(order[:-count])


def first_rows(order, count):
    return _same(np.arange(count))


def all_pairs(order, count):
    return _same(order)


def torn(order, count):
    return order[:count], np.arange(count)


def keeps(choose, put=lambda step, guess: step @ guess):
    """Whether one round is that of the pairs that ``choose`` keeps."""

    def matches(inputs, outputs):
        steps = (first_step(inputs, choose, off) for off in ROUNDINGS)
        return any(np.allclose(outputs["one"], put(s, inputs["guess"]), atol=1e-6) for s in steps)

    return matches


def sorted_once(inputs, outputs):
    """Whether the second round fits the rows that were shortest in the first."""
    start, after = second_round(inputs, outputs)
    order = first_pairs(start)[2].argsort(axis=1)
    moved, target, _ = first_pairs(after)
    for off in ROUNDINGS:
        cases = zip(moved, target, order, kept_count(start) + off, strict=True)
        steps = np.concatenate([fit(p[None, r[:k]], q[None, r[:k]]) for p, q, r, k in cases])
        if np.allclose(outputs["far_two"], steps @ outputs["far_one"], atol=1e-6):
            return True
    return False


TRIMMED = Task(
    id="13-trimmed",
    title="Trimmed ICP",
    drive=DRIVES["13-trimmed"],
    inputs=cluttered,
    shapes=SHAPES | {name: (None, 3, 3) for name in ("far_one", "far_two")},
    laws=(
        Law(
            "first-round",
            1,
            "one round is the best motion of the shortest share of the pairs",
            _first_round,
        ),
        Law(
            "sorted-anew",
            1,
            "so is the next, of the pairs that are short by then",
            _sorted_anew,
        ),
        Law("lands", 1, f"after {ROUNDS} rounds all that both scans saw lies on itself", lands),
    ),
    diagnoses=(
        Diagnosis(
            "not-trimmed",
            "All pairs were fitted: those who stood in one scan only drag the pose. Keep the share "
            "of the pairs that is shortest.",
            keeps(all_pairs),
        ),
        Diagnosis(
            "longest-kept",
            "The longest pairs were kept, which are the worst ones. Sort the other way.",
            keeps(longest),
        ),
        Diagnosis(
            "share-dropped",
            "The share says how many pairs to keep; here that many were dropped.",
            keeps(share_dropped),
        ),
        Diagnosis(
            "first-rows",
            "The first rows were kept, whatever their distance. Sort the pairs by distance first.",
            keeps(first_rows),
        ),
        Diagnosis(
            "torn-pairs",
            "Source and target were put into different orders, which tears the pairs apart. "
            "Use the same rows of both.",
            keeps(torn),
        ),
        Diagnosis(
            "sorted-once",
            "The second round fits the rows that were shortest in the first. After a step others "
            "are: find the pairs and sort them in every round.",
            sorted_once,
        ),
        Diagnosis("wrong-side", WRONG_SIDE, keeps(shortest, lambda s, guess: guess @ s)),
    ),
    needs=("13-best-motion",),
)
