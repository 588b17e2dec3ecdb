"""04-unsure-drive: where a robot is after a drive when its heading is too unsure for a Jacobian."""

import numpy as np

from slamlab.exercises.drives.ex04 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex04.generic import covariances, poses
from slamlab.exercises.tasks.ex04.scatter import MISTAKES, SLIP, allowed, ends, lost
from slamlab.geometry import wrap

ROWS = 20
LIMITS = (1.0, 0.1, 0.01)
"""Nats that half of the drives may lose; the last is also what no drive may exceed at the top.

The linearised step loses 11 in half of the drives, second order and sigma points 0.1 to 0.6, a
hundred samples 0.1, a thousand 0.002 and up to 0.02, ten thousand at most 0.003, and what is exact
nothing.
"""


def _drives(rng, n, heading, wheels=1.0):
    """Beliefs with standard deviations of the heading as given, (n,), and noisy drives."""
    noise = wheels * np.column_stack([rng.uniform(0.05, 0.2, n), rng.uniform(0.02, 0.1, n)])
    return {
        "x": poses(rng, n),
        "P": covariances(rng, np.column_stack([rng.uniform(0.05, 0.3, (n, 2)), heading])),
        "u": np.column_stack([rng.uniform(2, 6, n), rng.uniform(-1, 1, n)]),
        "C": covariances(rng, noise),
    }


def _random(rng):
    return _drives(rng, ROWS, rng.permutation(np.linspace(0.3, 0.8, ROWS)))


def _sure(rng):
    inputs = _drives(rng, 3, np.full(3, 0.01), wheels=3.0)
    return inputs | {"P": inputs["P"] * 0.01}


def _slipping(rng):
    inputs = _drives(rng, 3, np.full(3, 0.8), wheels=3.0)
    return inputs | {"u": inputs["u"] * [0.1, 1]}


def _times(rng, share):
    inputs = _drives(rng, 3, rng.uniform(0.3, 0.8, 3))
    return inputs | {"u": inputs["u"] * [share, 1]}


def _turned(rng):
    inputs = _drives(rng, 3, rng.uniform(0.3, 0.8, 3))
    inputs["x"][:, 2] = [np.pi, -np.pi, 3.1]
    return inputs


def _why(inputs, outputs):
    """Where the answer is off most: the direction in which the ends surprise it most."""
    own, (mean, best) = outputs["covariance"][:1], ends(inputs)
    if not allowed(own)[0]:
        return "that is no covariance: it must be symmetric, with positive eigenvalues"
    off = outputs["mean"][0] - mean[0]
    off[2] = wrap(off[2])
    values, vectors = np.linalg.eig(np.linalg.solve(own[0], best[0] + np.outer(off, off)))
    direction = np.real(vectors[:, np.argmax(np.abs(np.log(np.abs(values))))])
    says, spread = (np.sqrt(direction @ S @ direction) for S in (own[0], best[0]))
    lines = (
        f"it loses {lost(inputs, outputs)[0]:.3g} nats: ends lie on average at {_short(mean[0])};",
        f"along {_short(direction)} [m, m, rad] they scatter by {spread:.3f}, you say {says:.3f},",
        f"and your mean is off by {abs(direction @ off):.3f} in this direction",
    )
    return "\n    ".join(lines)


def _short(vector):
    return np.array2string(vector, precision=2, suppress_small=True)


def _step(inputs):
    """What the top of a solution holds: where robots end on average."""
    return {"mean": ends(inputs)[0]}


def _half(name, limit, asks):
    """A law that holds where half of the drives lose no more than the limit."""

    def holds(inputs, outputs):
        nats = lost(inputs, outputs)
        return (nats <= limit) | (np.median(nats) <= limit)

    says = f"of each kind of drive, you lose no more than {limit:g} nat in half at least"
    return Law(name, 1, says, holds, why=_why, asks=asks, step=_step)


def _shapes(inputs):
    n = len(inputs["x"])
    return {"mean": (n, 3), "covariance": (n, 3, 3)}


def _parts(inputs, outputs):
    S, mean = outputs["covariance"], outputs["mean"].copy()
    mean[:, 2] = np.sin(mean[:, 2])  # wrapped or not
    cross = np.stack([S[:, :2, 2], S[:, 2, :2]])
    return {"mean": mean, "place": S[:, :2, :2], "cross": cross, "heading": S[:, 2, 2]}


def _promised(inputs):
    """(n,) whether σ of heading, distance and wheels are as the text says."""
    P, C = (np.einsum("nii->ni", inputs[name]) for name in ("P", "C"))
    near, most = np.abs(inputs["u"][:, 0]) <= 6, np.square([0.601, 0.301])
    return near & (P[:, 2] < 0.801**2) & (most > C).all(axis=1)


TASK = Task(
    id="04-unsure-drive",
    title="A drive with an unsure heading",
    drive=DRIVES["04-unsure-drive"],
    inputs=_random,
    shapes=_shapes,
    laws=(
        _half(
            "one-nat",
            LIMITS[0],
            "Some robots drive more to the left, some more to the right than believed. On which "
            "side of f(x, u), seen from the start, is the average of their ends?",
        ),
        _half(
            "tenth",
            LIMITS[1],
            "What does your method know of cos θ: its value, its slope, its curvature, or its "
            "values at many headings?",
        ),
        _half(
            "hundredth",
            LIMITS[2],
            "If you draw samples: how does the error of a covariance fall with their number? If "
            "you place points: are there enough where the heading is far off?",
        ),
        Law(
            "every-drive",
            1,
            f"in no drive do you lose more than {LIMITS[2]:g} nat",
            lambda inputs, outputs: lost(inputs, outputs) <= LIMITS[2],
            why=_why,
            asks="Given the heading, all the rest is Gaussian and straight. What is left to "
            "average over, and in how many dimensions?",
            step=_step,
        ),
    ),
    diagnoses=MISTAKES,
    probes=(
        Probe("a heading known to 0.06° and wheels that slip", _sure),
        Probe(SLIP, _slipping),
        Probe("drives backwards", lambda rng: _times(rng, -1)),
        Probe("turns on the spot", lambda rng: _times(rng, 0)),
        Probe("headings near ±π", _turned),
    ),
    parts=_parts,
    rounds=_promised,
)
