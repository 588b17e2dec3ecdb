"""Task 08-associate: nearest pairs first, so that no two would rather have each other."""

import numpy as np

from slamlab.exercises.drives.ex08 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex08.lines import covariances
from slamlab.geometry import wrap

SAME = 1e-9  # what two distances may differ by rounding


def scenes(rng, n=10, sightings=6, walls=5, ahead=0.5, behind=2):
    """Scenes: some walls are seen twice, some not at all, some sightings are of no wall.

    Parameters
    ----------
    rng : numpy.random.Generator
    n, sightings, walls : int
    ahead : float, the walls expected are within this of straight ahead [rad]
    behind : int, so many of them are behind the robot, where the angle jumps
    """
    shape = n, walls
    expected = np.stack([rng.uniform(0.8, 2.2, shape), rng.uniform(-ahead, ahead, shape)], axis=-1)
    expected[:, :behind, 1] += np.pi
    expected[..., 1] = wrap(expected[..., 1])
    S = covariances(rng, shape, (0.08, 0.25), (0.05, 0.3), tie=(0.5, 0.85))
    z = np.zeros((n, sightings, 2))
    if walls:
        scene, of = np.arange(n)[:, None], rng.integers(0, walls, (n, sightings))
        white = rng.standard_normal((n, sightings, 2))
        white *= rng.uniform(0.3, 4, (n, sightings, 1)) / np.linalg.norm(
            white, axis=-1, keepdims=True
        )
        z = expected[scene, of] + np.einsum(
            "nmij,nmj->nmi", np.linalg.cholesky(S)[scene, of], white
        )
        z[..., 1] = wrap(z[..., 1])
    return {"z": z, "expected": expected, "S": S, "gate": rng.uniform(5, 12, n)}


def _at_the_gate(rng):
    """Sightings whose d² is exactly the gate, 9, and just beyond it."""
    z = np.array([[[4.0, 0.0], [-3.0, 0.0]], [[4.5, 0.0], [1.0, 3.0]]])
    expected, S = np.tile([1.0, 0.0], (2, 1, 1)), np.tile(np.eye(2), (2, 1, 1, 1))
    return {"z": z, "expected": expected, "S": S, "gate": np.full(2, 9.0)}


def _behind(rng):
    """Walls behind the robot, seen on either side of π."""
    return scenes(rng, n=4, sightings=3, walls=2, ahead=0.15)


def squared(inputs):
    """(n, m, N) squared Mahalanobis distances of sightings to walls."""
    v = inputs["z"][:, :, None] - inputs["expected"][:, None]
    v[..., 1] = wrap(v[..., 1])
    # S = L Lᵀ: d² is the square of L⁻¹ v
    white = np.linalg.solve(np.linalg.cholesky(inputs["S"])[:, None], v[..., None])[..., 0]
    return np.square(white).sum(axis=-1)


def nearest_first(inputs):
    """{"pairs": (n, m)}, made from the nearest on; −1 for a new wall."""
    found = []
    for d2, gate in zip(squared(inputs), inputs["gate"], strict=True):
        row, left = np.full(len(d2), -1.0), np.where(d2 <= gate + SAME, d2, np.inf)
        while np.isfinite(left).any():
            i, j = np.unravel_index(left.argmin(), left.shape)
            row[i] = j
            left[i], left[:, j] = np.inf, np.inf
        found.append(row)
    return {"pairs": np.array(found).reshape(inputs["z"].shape[:2])}


def _each(inputs, outputs):
    """Scene by scene: pairs (m,) int, distances (m, N), each sighting's own (m,), the gate."""
    scene = zip(outputs["pairs"].astype(int), squared(inputs), inputs["gate"], strict=True)
    for pairs, d2, gate in scene:
        own = [row[j] if j >= 0 else np.inf for row, j in zip(d2, pairs, strict=True)]
        yield pairs, d2, np.array(own), gate


def _once(inputs, outputs):
    given = [pairs[pairs >= 0] for pairs, *_ in _each(inputs, outputs)]
    return [len(set(walls)) == len(walls) for walls in given]


def _in_gate(inputs, outputs):
    return [
        bool((own[pairs >= 0] <= gate + SAME).all())
        for pairs, _, own, gate in _each(inputs, outputs)
    ]


def _envy(inputs, outputs):
    """For each scene (m, N): who is nearer to each other than to what they have."""
    for pairs, d2, own, gate in _each(inputs, outputs):
        taken = [min(own[pairs == j], default=np.inf) for j in range(d2.shape[1])]
        yield (d2 <= gate + SAME) & (d2 < own[:, None] - SAME) & (d2 < np.array(taken) - SAME)


def _nobody_rather(inputs, outputs):
    return [not rather.any() for rather in _envy(inputs, outputs)]


def _twice(inputs, outputs):
    walls = outputs["pairs"].astype(int)
    row = next(row for row, once in zip(walls, _once(inputs, outputs), strict=True) if not once)
    wall = max(row[row >= 0], key=lambda j: (row == j).sum())
    return (
        f"wall {wall} was given to sightings {' and '.join(map(str, np.flatnonzero(row == wall)))}"
    )


def _too_far(inputs, outputs):
    found = (
        (own[i], gate, i, pairs[i])
        for pairs, _, own, gate in _each(inputs, outputs)
        for i in np.flatnonzero((pairs >= 0) & (own > gate))
    )
    d2, gate, i, wall = max(found)
    return f"sighting {i} got wall {wall}, but their d² is {d2:.3g}, above the gate of {gate:.3g}"


ASSOCIATE = Task(
    id="08-associate",
    title="Which wall was it",
    drive=DRIVES["08-associate"],
    inputs=scenes,
    shapes=lambda inputs: {"pairs": inputs["z"].shape[:2]},
    laws=(
        Law(
            "once",
            1,
            "each wall is paired with at most one sighting",
            _once,
            why=_twice,
            asks="When a pair is made, who of the others may still take that wall?",
        ),
        Law(
            "gate",
            1,
            "no pair has a squared Mahalanobis distance above the gate",
            _in_gate,
            why=_too_far,
            asks="What does your function say of a sighting that is far from every wall?",
        ),
        Law(
            "nearest",
            2,
            "no sighting and wall within the gate are nearer to each other than to what they have",
            _nobody_rather,
            want=nearest_first,
            asks="Of all pairs that are possible now, which one can nobody object to?",
            step=lambda inputs: {"d²": squared(inputs)},
        ),
    ),
    probes=(
        Probe("an empty map", lambda rng: scenes(rng, 2, walls=0)),
        Probe("nothing seen", lambda rng: scenes(rng, 2, sightings=0)),
        Probe("one sighting and many walls", lambda rng: scenes(rng, 4, sightings=1, walls=8)),
        Probe(
            "many sightings and one wall",
            lambda rng: scenes(rng, 4, sightings=7, walls=1, behind=0),
        ),
        Probe("a crowded map", lambda rng: scenes(rng, 5, sightings=12, walls=12)),
        Probe("walls behind the robot", _behind),
        Probe("a d² that is just the gate", _at_the_gate),
    ),
    rounds=False,
)
