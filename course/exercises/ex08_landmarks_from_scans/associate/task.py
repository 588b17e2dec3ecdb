"""Task 08-associate: greedy nearest neighbour, data association."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex08_landmarks_from_scans.calls import CALLS
from course.exercises.ex08_landmarks_from_scans.lines import covariances
from slamlab.geometry import wrap

SAME = 1e-9  # what two distances may differ by rounding


def scenes(rng, n=10, sightings=6, walls=5, ahead=0.5, behind=2):
    """Scenes with walls measured twice, once or never, and false measurements; ``behind`` walls are
    at ±π, the others within ``ahead`` of 0 [rad]."""
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
    # d² exactly at the gate of 9, and just beyond
    z = np.array([[[4.0, 0.0], [-3.0, 0.0]], [[4.5, 0.0], [1.0, 3.0]]])
    expected, S = np.tile([1.0, 0.0], (2, 1, 1)), np.tile(np.eye(2), (2, 1, 1, 1))
    return {"z": z, "expected": expected, "S": S, "gate": np.full(2, 9.0)}


def _behind(rng):
    # on either side of π
    return scenes(rng, n=4, sightings=3, walls=2, ahead=0.15)


def squared(inputs):
    """Squared Mahalanobis distances (n, m, N) of measurements to walls."""
    v = inputs["z"][:, :, None] - inputs["expected"][:, None]
    v[..., 1] = wrap(v[..., 1])
    # S = L Lᵀ: d² is the square of L⁻¹ v
    white = np.linalg.solve(np.linalg.cholesky(inputs["S"])[:, None], v[..., None])[..., 0]
    return np.square(white).sum(axis=-1)


def _distances(inputs):
    return {"d²": squared(inputs)}


def nearest_first(inputs):
    """{"pairs": (n, m)}, −1 for a new wall."""
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
    """Per scene: pairs (m,), squared distances (m, N), those of the pairs (m,), gate."""
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
    """Per scene (m, N): pairs with a smaller d² than both of their associations."""
    for pairs, d2, own, gate in _each(inputs, outputs):
        taken = [min(own[pairs == j], default=np.inf) for j in range(d2.shape[1])]
        yield (d2 <= gate + SAME) & (d2 < own[:, None] - SAME) & (d2 < np.array(taken) - SAME)


def _nobody_rather(inputs, outputs):
    return [not rather.any() for rather in _envy(inputs, outputs)]


def _twice(inputs, outputs):
    walls = outputs["pairs"].astype(int)
    row = next(row for row, once in zip(walls, _once(inputs, outputs), strict=True) if not once)
    wall = max(row[row >= 0], key=lambda j: (row == j).sum())
    which = " and ".join(map(str, np.flatnonzero(row == wall)))
    return f"wall {wall} is associated with measurements {which}"


def _too_far(inputs, outputs):
    found = (
        (own[i], gate, i, pairs[i])
        for pairs, _, own, gate in _each(inputs, outputs)
        for i in np.flatnonzero((pairs >= 0) & (own > gate))
    )
    d2, gate, i, wall = max(found)
    return f"measurement {i} has wall {wall} with a d² of {d2:.3g}, above the gate of {gate:.3g}"


ASSOCIATE = Task(
    id="08-associate",
    title="Data association",
    call=CALLS["08-associate"],
    inputs=scenes,
    shapes=lambda inputs: {"pairs": inputs["z"].shape[:2]},
    laws=(
        Law(
            "once",
            1,
            "each wall is associated with at most one measurement",
            _once,
            why=_twice,
            asks="After you have associated a wall, which measurements may still use this wall?",
            step=_distances,
        ),
        Law(
            "gate",
            1,
            "no pair has a squared Mahalanobis distance above the gate",
            _in_gate,
            why=_too_far,
            asks="What does your function return for a measurement that is far from every wall?",
            step=_distances,
        ),
        Law(
            "nearest",
            2,
            "no pair within the gate has a smaller d² than both of its associations",
            _nobody_rather,
            want=nearest_first,
            asks="You associate pairs one after the other. In which order do you associate them?",
            step=_distances,
        ),
    ),
    probes=(
        Probe("an empty map", lambda rng: scenes(rng, 2, walls=0)),
        Probe("an empty scan", lambda rng: scenes(rng, 2, sightings=0)),
        Probe("one measurement and many walls", lambda rng: scenes(rng, 4, sightings=1, walls=8)),
        Probe(
            "many measurements and one wall",
            lambda rng: scenes(rng, 4, sightings=7, walls=1, behind=0),
        ),
        Probe("a crowded map", lambda rng: scenes(rng, 5, sightings=12, walls=12)),
        Probe("walls behind the robot", _behind),
        Probe("a d² that is exactly the gate", _at_the_gate),
    ),
    may_round=False,
    begins=(
        "What are v and d² for one measurement and one wall?",
        "How many pairs of a measurement and a wall are there? In which order do you "
        "go through them?",
    ),
)
