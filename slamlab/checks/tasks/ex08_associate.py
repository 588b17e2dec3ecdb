"""Exercise 08, association: nearest pairs first, so that no two would rather have each other."""

from itertools import combinations

import numpy as np

from slamlab.checks.drives.ex08 import DRIVES
from slamlab.checks.task import Diagnosis, Law, Task
from slamlab.geometry import wrap

SCENES, SIGHTINGS, WALLS = 10, 6, 5
GATE = 9.21  # χ² of 2 degrees: 99 %


def squared(inputs, by="inverse", wrapped=True):
    """(n, m, N) distances of sightings to walls, by default vᵀ S⁻¹ v.

    Parameters
    ----------
    inputs : z (n, m, 2), expected (n, N, 2), S (n, N, 2, 2)
    by : "inverse" for S⁻¹, "S" for S, "nothing" for the identity, "diagonal" for that of S alone
    wrapped : bool, whether the angle of v is
    """
    v = inputs["z"][:, :, None] - inputs["expected"][:, None]
    if wrapped:
        v[..., 1] = wrap(v[..., 1])
    S = inputs["S"]
    weights = {
        "inverse": lambda: np.linalg.inv(S),
        "S": lambda: S,
        "nothing": lambda: np.broadcast_to(np.eye(2), S.shape),
        "diagonal": lambda: np.linalg.inv(S * np.eye(2)),
        "entries": lambda: 1 / S,
    }
    return np.einsum("nmki,nkij,nmkj->nmk", v, weights[by](), v)


def nearest_first(distances, gate):
    """(n, m) pairs made from the nearest on; −1 for a new wall."""
    pairs = np.full(distances.shape[:2], -1)
    for scene, row in zip(distances, pairs, strict=True):
        left = np.where(scene <= gate, scene, np.inf)
        while np.isfinite(left).any():
            i, j = np.unravel_index(left.argmin(), left.shape)
            row[i] = j
            left[i], left[:, j] = np.inf, np.inf
    return pairs


def in_turn(distances, gate, first=False):
    """(n, m) each sighting in its turn takes the nearest wall left, or the first in the gate."""
    pairs = np.full(distances.shape[:2], -1)
    for scene, row in zip(distances, pairs, strict=True):
        left = np.where(scene <= gate, scene, np.inf)
        for i, options in enumerate(left):
            if np.isfinite(options).any():
                j = np.isfinite(options).argmax() if first else options.argmin()
                row[i] = j
                left[:, j] = np.inf
    return pairs


def each_alone(distances, gate, first=False):
    """(n, m) each sighting takes its wall, whoever else has it."""
    inside = distances <= gate
    best = inside.argmax(axis=2) if first else np.where(inside, distances, np.inf).argmin(axis=2)
    return np.where(inside.any(axis=2), best, -1)


MISTAKES = {
    "euclid": lambda i: nearest_first(squared(i, "nothing"), GATE),
    "S-not-inverted": lambda i: nearest_first(squared(i, "S"), GATE),
    "unwrapped": lambda i: nearest_first(squared(i, wrapped=False), GATE),
    "diagonal": lambda i: nearest_first(squared(i, "diagonal"), GATE),
    "entries": lambda i: nearest_first(squared(i, "entries"), GATE),
    "not-squared": lambda i: nearest_first(squared(i), GATE**2),
    "gate-forgotten": lambda i: nearest_first(squared(i), np.inf),
    "in-turn": lambda i: in_turn(squared(i), GATE),
    "first-found": lambda i: in_turn(squared(i), GATE, first=True),
    "first-found, again": lambda i: each_alone(squared(i), GATE, first=True),
    "each-alone": lambda i: each_alone(squared(i), GATE),
    "no-gate, alone": lambda i: squared(i).argmin(axis=2),
}


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
