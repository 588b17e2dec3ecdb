"""04-unsure-drive: where a robot is after a drive when its heading is too unsure for a Jacobian."""

import numpy as np

from slamlab.exercises.drives.ex04 import DRIVES
from slamlab.exercises.law import Diagnosis, Law, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex04.generic import covariances, poses
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


@once
def ends(inputs):
    """Mean and covariance of the pose after the drive, exact.

    The cosine of a Gaussian angle has the expectation cos θ exp(−σ²/2), and a Gaussian a with a
    covariance k to the angle adds k times the expectation of its derivative (Stein's lemma).

    Parameters
    ----------
    inputs : x (n, 3), P (n, 3, 3), u (n, 2), C (n, 2, 2)

    Returns
    -------
    mean (n, 3), covariance (n, 3, 3)
    """
    x, P, (d, turn), C = inputs["x"], inputs["P"], inputs["u"].T, inputs["C"]
    variance, theta = P[:, 2, 2], x[:, 2]
    once, twice = np.exp(-variance / 2), np.exp(-2 * variance)
    along = once[:, None] * np.column_stack([np.cos(theta), np.sin(theta)])
    across = along[:, ::-1] * [-1, 1]  # what a turn of the heading makes of it
    mean = np.column_stack([x[:, :2] + d[:, None] * along, theta + turn])
    c, s = twice * np.cos(2 * theta), twice * np.sin(2 * theta)
    squares = np.array([[1 + c, s], [s, 1 - c]]).transpose(2, 0, 1) / 2
    lean = d[:, None, None] * P[:, :2, 2, None] * across[:, None, :]
    covariance = P.copy()
    covariance[:, :2, :2] += lean + lean.swapaxes(1, 2) - _outer(d[:, None] * along)
    covariance[:, :2, :2] += (d**2 + C[:, 0, 0])[:, None, None] * squares
    cross = (d * variance)[:, None] * across + C[:, 0, 1, None] * along
    covariance[:, :2, 2] += cross
    covariance[:, 2, :2] += cross
    covariance[:, 2, 2] += C[:, 1, 1]
    return mean, covariance


def _outer(v):
    return v[:, :, None] * v[:, None, :]


@once
def lost(inputs, outputs):
    """(n,) by how many nats an answer is more surprised by the ends than the best Gaussian is."""
    mean, best = ends(inputs)
    own = outputs["covariance"]
    off = outputs["mean"] - mean
    off[:, 2] = wrap(off[:, 2])
    fit = _allowed(own)
    own = np.where(fit[:, None, None], own, np.eye(3))
    share = np.linalg.solve(own, best + _outer(off))
    volumes = np.linalg.slogdet(own)[1] - np.linalg.slogdet(best)[1]
    nats = (np.trace(share, axis1=1, axis2=2) - 3 + volumes) / 2
    return np.where(fit, nats, np.inf)


def _allowed(covariance):
    """(n,) whether a matrix is a covariance: symmetric but for rounding, and positive definite."""
    turned = covariance.swapaxes(1, 2)
    size = np.abs(covariance).max(axis=(1, 2))
    symmetric = np.abs(covariance - turned).max(axis=(1, 2)) <= 1e-9 * size
    return symmetric & (np.linalg.eigvalsh((covariance + turned) / 2) > 0).all(axis=1)


def _why(inputs, outputs):
    """Where the answer is off most: the direction in which the ends surprise it most."""
    own, (mean, best) = outputs["covariance"][:1], ends(inputs)
    if not _allowed(own)[0]:
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


def _straight_mean(inputs, outputs):
    """Whether the mean is f(x, u): where a robot ends that has just the believed heading."""
    x, (d, _) = inputs["x"], inputs["u"].T
    straight = x[:, :2] + d[:, None] * np.column_stack([np.cos(x[:, 2]), np.sin(x[:, 2])])
    return np.allclose(outputs["mean"][:, :2], straight, rtol=1e-6)


def _sampled(inputs, outputs):
    """Whether headings scatter, as only those of samples do, and all else is off as little."""
    mean, best = ends(inputs)
    off = wrap(outputs["mean"][:, 2] - mean[:, 2]) ** 2 / best[:, 2, 2]
    share = (outputs["covariance"][:, 2, 2] / best[:, 2, 2] - 1) ** 2
    small = np.median(lost(inputs, outputs)) < 40 * np.mean(off + share)  # on average 1.5 times
    return bool(
        (np.minimum(off, share) > 1e-12).all() and np.maximum(off, share).max() < 0.4 and small
    )


def _wrapped(inputs, outputs):
    """Whether the heading's variance is right in some drives and far too large in others."""
    share = outputs["covariance"][:, 2, 2] / ends(inputs)[1][:, 2, 2]
    return bool((share > 2).any() and (np.abs(share - 1) < 0.5).any())


def _about_zero(inputs, outputs):
    """Whether the covariance is the second moment, from which no mean was subtracted."""
    mean, best = ends(inputs)
    excess = _outer(mean)
    off, size = (
        np.abs(S).max(axis=(1, 2)) for S in (outputs["covariance"] - best - excess, excess)
    )
    return bool(np.median(off / size) < 0.1)


def _volume_off(factor):
    def matches(inputs, outputs):
        sizes = np.linalg.slogdet(outputs["covariance"])[1] - np.linalg.slogdet(ends(inputs)[1])[1]
        return bool((np.median(sizes) * np.sign(factor)) > abs(factor))

    return matches


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
    diagnoses=(
        Diagnosis(
            "too-few-samples",
            "These are samples, and too few: what you lose falls with their number. How many does "
            "a hundredth of a nat take in every drive? And over what need you draw at all?",
            _sampled,
        ),
        Diagnosis(
            "straight-mean",
            "Your mean is f(x, u), the end of a robot that has just the believed heading. Those "
            "that head elsewhere get less far in that direction: where is their average?",
            _straight_mean,
        ),
        Diagnosis(
            "about-zero",
            "You took the average of the squares of the ends themselves. A covariance is about the "
            "mean: subtract it first.",
            _about_zero,
        ),
        Diagnosis(
            "wrapped-ends",
            "In some drives your heading is far too unsure: ends just beyond π count as −π, and an "
            "average of wrapped angles means nothing. Where else can you cut the circle?",
            _wrapped,
        ),
        Diagnosis(
            "too-sure",
            "In most drives your covariance is smaller than the robots' scatter. Which of the four "
            "is missing: place, heading, distance, turn? Or are your samples too few to span it?",
            _volume_off(-0.5),
        ),
        Diagnosis(
            "too-unsure",
            "In most drives your covariance is larger than the robots' scatter: is something "
            "counted twice, or a mean not subtracted?",
            _volume_off(0.5),
        ),
    ),
    probes=(
        Probe("a heading known to 0.06° and wheels that slip", _sure),
        Probe("short drives with an unsure heading and wheels that slip", _slipping),
        Probe("drives backwards", lambda rng: _times(rng, -1)),
        Probe("turns on the spot", lambda rng: _times(rng, 0)),
        Probe("headings near ±π", _turned),
    ),
    parts=_parts,
    rounds=_promised,
)
