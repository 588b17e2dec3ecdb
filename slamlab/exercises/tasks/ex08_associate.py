"""Exercise 08, association: nearest pairs first, so that no two would rather have each other."""

from itertools import combinations

import numpy as np

from slamlab.exercises.drives.ex08 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex08_pairings import GATE, MISTAKES, nearest_first, squared
from slamlab.geometry import wrap

SCENES, SIGHTINGS, WALLS = 10, 6, 5


def _draw(rng):
    shape = (SCENES, WALLS)
    expected = np.stack([rng.uniform(0.8, 2.2, shape), rng.uniform(-0.5, 0.5, shape)], axis=-1)
    expected[:, :2, 1] += np.pi  # behind, where the angle jumps
    expected[..., 1] = wrap(expected[..., 1])
    sigma = np.stack([rng.uniform(0.08, 0.25, shape), rng.uniform(0.05, 0.3, shape)], axis=-1)
    tie = rng.choice([-1.0, 1.0], shape) * rng.uniform(0.5, 0.85, shape)
    S = sigma[..., :, None] * sigma[..., None, :]
    S[..., 0, 1] *= tie
    S[..., 1, 0] *= tie
    # some walls are seen twice, some not at all
    of = rng.integers(0, WALLS, (SCENES, SIGHTINGS))
    white = rng.standard_normal((SCENES, SIGHTINGS, 2))
    reach = rng.uniform(0.3, 4.0, (SCENES, SIGHTINGS, 1))
    white *= reach / np.linalg.norm(white, axis=-1, keepdims=True)
    scene = np.arange(SCENES)[:, None]
    z = expected[scene, of] + np.einsum("nmij,nmj->nmi", np.linalg.cholesky(S)[scene, of], white)
    z[..., 1] = wrap(z[..., 1])
    return {"z": z, "expected": expected, "S": S, "gate": np.full(SCENES, GATE)}


def scenes(rng):
    """Scenes in which no mistake goes unseen and no two look alike."""
    while True:
        inputs = _draw(rng)
        near = np.abs(squared(inputs) - GATE).min() < 0.01
        answers = [
            nearest_first(squared(inputs), GATE),
            *(wrong(inputs) for wrong in MISTAKES.values()),
        ]
        if not near and not any((a == b).all() for a, b in combinations(answers, 2)):
            return inputs


def _once(inputs, outputs):
    return [
        len(set(row[row >= 0])) == np.count_nonzero(row >= 0)
        for row in outputs["pairs"].astype(int)
    ]


def _own(inputs, outputs):
    """(n, m) the squared distance of each sighting to its wall, inf where it has none."""
    pairs = outputs["pairs"].astype(int)
    d2 = np.take_along_axis(squared(inputs), np.maximum(pairs, 0)[..., None], axis=2)[..., 0]
    return np.where(pairs >= 0, d2, np.inf)


def _in_gate(inputs, outputs):
    own = _own(inputs, outputs)
    return ((own <= GATE) | np.isinf(own)).all(axis=1)


def _nobody_rather(inputs, outputs):
    """No sighting and wall in the gate that are nearer to each other than to what they have."""
    pairs, own, d2 = outputs["pairs"].astype(int), _own(inputs, outputs), squared(inputs)
    taken = np.full((SCENES, WALLS), np.inf)
    for scene, sighting in zip(*np.nonzero(pairs >= 0), strict=True):
        j = pairs[scene, sighting]
        taken[scene, j] = min(taken[scene, j], own[scene, sighting])
    rather = (d2 <= GATE) & (d2 < own[..., None] - 1e-9) & (d2 < taken[:, None] - 1e-9)
    return ~rather.any(axis=(1, 2))


def _is(name, hint, *algorithms):
    """A diagnosis: the pairs are those of one of these mistakes."""
    return Diagnosis(
        name,
        hint,
        lambda i, o: any((o["pairs"] == MISTAKES[algorithm](i)).all() for algorithm in algorithms),
    )


ASSOCIATE = Task(
    id="08-associate",
    title="Which wall was it",
    drive=DRIVES["08-associate"],
    inputs=scenes,
    shapes={"pairs": (SCENES, SIGHTINGS)},
    laws=(
        Law("once", 1, "each wall is paired with at most one sighting", _once),
        Law("gate", 1, "no pair has a squared Mahalanobis distance above the gate", _in_gate),
        Law(
            "nearest",
            2,
            "no sighting and wall within the gate are nearer to each other than to what they have",
            _nobody_rather,
        ),
    ),
    diagnoses=(
        _is(
            "euclid",
            "This is Pythagoras: metres and radians are added as if they were alike. d² = vᵀ S⁻¹ v "
            "counts in standard deviations.",
            "euclid",
        ),
        _is(
            "S-not-inverted",
            "S⁻¹, not S: the larger the doubt, the less a difference counts.",
            "S-not-inverted",
        ),
        _is(
            "entries",
            "1 / S inverts every entry. The inverse of the matrix is np.linalg.inv(S), or use "
            "np.linalg.solve.",
            "entries",
        ),
        _is(
            "unwrapped",
            "The angle of v is not wrapped: a wall behind the robot, expected at 179° and seen at "
            "−179°, is 2° off.",
            "unwrapped",
        ),
        _is(
            "diagonal",
            "Only the variances of S are used. Its errors hang together: take the whole matrix.",
            "diagonal",
        ),
        _is(
            "not-squared",
            "The gate is for the squared distance: compare d² with it, not its root.",
            "not-squared",
        ),
        _is(
            "gate-forgotten",
            "Every sighting found a wall, however far: above the gate it is a new one, None.",
            "gate-forgotten",
            "no-gate, alone",
        ),
        _is(
            "first-found",
            "The first wall within the gate was taken, not the nearest: Smolec's code does so, and "
            "the answer depends on the order of the map.",
            "first-found",
            "first-found, again",
        ),
        _is(
            "each-alone",
            "Two sightings got the same wall: each wall is used at most once, by the nearest.",
            "each-alone",
        ),
        _is(
            "in-turn",
            "The sightings choose in their turn, so an early one takes a wall that a later one is "
            "nearer to. Sort all pairs by d² and make the nearest first.",
            "in-turn",
        ),
    ),
)
