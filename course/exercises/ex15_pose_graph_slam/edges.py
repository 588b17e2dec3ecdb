"""Random edges between poses, and special cases."""

import numpy as np

from classroom.exercises.task import Probe
from slamlab.geometry import compose, wrap

PLAIN, ROUND = 12, 6  # edges; for the last ones θ_j − θ_i − θ_z is beyond π


def edges(rng, plain=PLAIN, round=ROUND):
    """``plain`` edges, and ``round`` ones whose sum of turns crosses π: x_i, x_j, z (n, 3)."""
    count = plain + round
    z = np.column_stack([sized(rng, 0.5, 2, (count, 2)), sized(rng, 0.3, 1.2, count)])
    e = np.column_stack([sized(rng, 0.2, 0.9, (count, 2)), sized(rng, 0.1, 0.5, count)])
    turn = z[:, 2] + e[:, 2]
    across = np.sign(turn) * (np.pi - np.abs(turn) / 2)
    heading = np.where(np.arange(count) < plain, rng.uniform(-1.2, 1.2, count) - turn, across)
    x_i = np.column_stack([rng.uniform(-4, 4, (count, 2)), wrap(heading)])
    return {"x_i": x_i, "x_j": compose(compose(x_i, z), e), "z": z}


def sized(rng, low, high, size=None):
    """Random numbers of either sign and of a magnitude between bounds."""
    return rng.choice([-1.0, 1.0], size) * rng.uniform(low, high, size)


def _of(rng, **changes):
    inputs = edges(rng, 2, 2)
    for name, (columns, values) in changes.items():
        inputs[name][:, columns] = values
    return inputs


def _no_motion(rng):
    return _of(rng, z=(np.s_[:], 0.0))


def _one_place(rng):
    inputs = edges(rng, 2, 2)
    inputs["x_j"][:, :2] = inputs["x_i"][:, :2]
    return inputs


def _exact(rng):
    inputs = edges(rng, 2, 2)
    return inputs | {"x_j": compose(inputs["x_i"], inputs["z"])}


def _quarter_turns(rng):
    quarters = np.array([[0, 1, 2], [2, -1, 1], [-1, 2, 1], [1, 0, -1]]) * np.pi / 2
    xy = rng.integers(-3, 4, (3, 4, 2)).astype(float)
    names = ("x_i", "x_j", "z")
    return {n: np.column_stack([xy[k], quarters[:, k]]) for k, n in enumerate(names)}


def _both_sides(rng):
    near = np.pi - rng.uniform(0.01, 0.1, 4)
    side = np.array([1, -1, 1, -1])
    return _of(rng, x_i=(2, side * near), x_j=(2, -side * near), z=(2, side * 0.05))


def _half_turns(rng):
    """Nearly half a turn from i to j; z measures one in the other direction."""
    inputs, side = _of(rng), np.array([1, -1, 1, -1])
    inputs["x_j"][:, 2] = wrap(inputs["x_i"][:, 2] + side * rng.uniform(2.6, 3.1, 4))
    inputs["z"][:, 2] = -side * rng.uniform(2.6, 3.1, 4)
    return inputs


def _far(rng):
    inputs = edges(rng, 2, 2)
    away = np.append(sized(rng, 300, 500, 2), 0.0)
    return inputs | {"x_i": inputs["x_i"] + away, "x_j": inputs["x_j"] + away}


PROBES = (
    Probe("an edge whose z is zero", _no_motion),
    Probe("two poses at one position", _one_place),
    Probe("an edge without error", _exact),
    Probe("quarter turns", _quarter_turns),
    Probe("headings on both sides of π", _both_sides),
    Probe("turns of nearly 180°", _half_turns),
    Probe("poses far from the origin", _far),
    Probe("one edge", lambda rng: edges(rng, 1, 0)),
)
