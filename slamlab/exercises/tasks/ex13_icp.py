"""The task of exercise 13 about scans without pairs: iterative closest point."""

import numpy as np

from slamlab.exercises.drives.ex13 import DRIVES, ROUNDS
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex13_clouds import (
    carried,
    either_sign,
    good_guess,
    is_best,
    landed,
    motion,
    nearest,
    outline,
    paired,
)
from slamlab.exercises.tasks.ex13_fit import fit

SHARED = 36


def overlapping(rng, count=3):
    """Scans of irregular rooms: the source sees a part of what the target sees."""
    return stacked(one_pair(rng) for _ in range(count))


def stacked(cases):
    """Cases, each a dict of arrays, as one dict of stacks."""
    cases = list(cases)
    return {name: np.array([case[name] for case in cases]) for name in cases[0]}


def scene(rng, clutter=0):
    """A target, a source that saw a part of it, who else stood there, and T between the two."""
    target = outline(rng, 48)
    T = motion(*either_sign(rng, 0.4, 1.5, 2), either_sign(rng, 1.4, 2.8))
    back = np.linalg.inv(T)
    source = carried(back, rng.permutation(target)[:SHARED])
    way = rng.uniform(0, 2 * np.pi)
    group = target.mean(axis=0) + 4.2 * np.array([np.cos(way), np.sin(way)])
    return target, source, carried(back, group + rng.uniform(-0.4, 0.4, (clutter, 2))), T


def one_pair(rng, clutter=0, shares=(1.0,)):
    """A source, its target and a guess, with a large turn between the two."""
    target, source, people, T = scene(rng, clutter)
    # what trimming leaves has to suffice: fewer wrong pairs among it
    low = 0.65 if clutter else 0.4
    guess = good_guess(rng, T, source, target, people, shares, low)
    source = rng.permutation(np.concatenate([source, people]))
    return {"source": source, "target": target, "guess": guess}


# ---- laws -----------------------------------------------------------------------------------


def first_pairs(inputs):
    """The source as the guess lays it, its nearest target points and their distances [m]."""
    moved = carried(inputs["guess"], inputs["source"])
    pairs, distances = nearest(moved, inputs["target"])
    return moved, paired(pairs, inputs["target"]), distances


def _first_round(inputs, outputs):
    _, target, _ = first_pairs(inputs)
    return is_best(outputs["one"], inputs["source"], target)


def lands(inputs, outputs):
    return landed(outputs["end"], inputs["source"], inputs["target"]) >= SHARED


# ---- mistakes -------------------------------------------------------------------------------


def first_step(inputs):
    """The best motion of the first pairs, seen from the target's frame."""
    return fit(*first_pairs(inputs)[:2])


def answers(output, formula):
    """Whether an output is what the formula gives for the inputs."""
    return lambda inputs, outputs: np.allclose(outputs[output], formula(inputs), atol=1e-6)


def by_row(inputs):
    n = min(inputs["source"].shape[1], inputs["target"].shape[1])
    moved = carried(inputs["guess"], inputs["source"])
    return fit(moved[:, :n], inputs["target"][:, :n]) @ inputs["guess"]


def without_guess(inputs):
    pairs, _ = nearest(inputs["source"], inputs["target"])
    return fit(inputs["source"], paired(pairs, inputs["target"]))


def source_not_moved(inputs):
    return fit(inputs["source"], first_pairs(inputs)[1]) @ inputs["guess"]


def same_step_again(inputs):
    return np.linalg.matrix_power(first_step(inputs), ROUNDS) @ inputs["guess"]


def one_round_only(inputs, outputs):
    return bool(_first_round(inputs, outputs).all()) and np.allclose(
        outputs["end"], outputs["one"], atol=1e-9
    )


def wrong_side(inputs):
    return inputs["guess"] @ first_step(inputs)


WRONG_SIDE = (
    "The step was put on the wrong side. It is found in the target's frame, after T has been "
    "applied, so it goes to the left: T becomes step @ T, not T @ step."
)
STEP_ONLY = (
    "What came back is the last step alone. Each step starts where the ones before it left the "
    "source: collect them, T becomes step @ T."
)
SHAPES = {"one": (None, 3, 3), "end": (None, 3, 3)}

ICP = Task(
    id="13-icp",
    title="Iterative closest point",
    drive=DRIVES["13-icp"],
    inputs=overlapping,
    shapes=SHAPES,
    laws=(
        Law("first-round", 1, "one round is the best motion of the nearest pairs", _first_round),
        Law("lands", 2, f"after {ROUNDS} rounds every source point lies on a target point", lands),
    ),
    diagnoses=(
        Diagnosis("wrong-side", WRONG_SIDE, answers("one", wrong_side)),
        Diagnosis("step-only", STEP_ONLY, answers("one", first_step)),
        Diagnosis(
            "by-row",
            "Points were paired by their row. Two scans do not list the same spots in the same "
            "order: pair each moved source point with the nearest target point.",
            answers("one", by_row),
        ),
        Diagnosis(
            "guess-ignored",
            "The pairs were sought with the source as it was given, as if there were no first "
            "guess: carry it by T first.",
            answers("one", without_guess),
        ),
        Diagnosis(
            "source-not-moved",
            "The motion was fitted to the source as it was given and then put on top of T, which "
            "moves it twice. Fit the moved source, or keep the fit alone.",
            answers("one", source_not_moved),
        ),
        Diagnosis(
            "inverted",
            "This is the inverse motion. T has to carry the source onto the target.",
            answers("one", lambda i: np.linalg.inv(first_step(i) @ i["guess"])),
        ),
        Diagnosis(
            "same-step-again",
            "Every round takes the step of the first. Move the source by the new T before pairs "
            "are sought again.",
            answers("end", same_step_again),
        ),
        Diagnosis(
            "one-round-only",
            "More rounds change nothing: either the loop ends after one, or the pairs are sought "
            "before the loop. They have to be sought anew in every round.",
            one_round_only,
        ),
    ),
    needs=("13-best-motion",),
)
