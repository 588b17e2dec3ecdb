"""By how much a belief of where a robot ends is wrong, and by which mistake of 04-unsure-drive."""

import numpy as np

from slamlab.exercises.law import Diagnosis, once
from slamlab.geometry import wrap

SLIP = "short drives with an unsure heading and wheels that slip"
"""The probe whose robots scatter most by what their wheels do."""


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
    fit = allowed(own)
    own = np.where(fit[:, None, None], own, np.eye(3))
    share = np.linalg.solve(own, best + _outer(off))
    volumes = np.linalg.slogdet(own)[1] - np.linalg.slogdet(best)[1]
    nats = (np.trace(share, axis1=1, axis2=2) - 3 + volumes) / 2
    return np.where(fit, nats, np.inf)


def allowed(covariance):
    """(n,) whether a matrix is a covariance: symmetric but for rounding, and positive definite."""
    turned = covariance.swapaxes(1, 2)
    size = np.abs(covariance).max(axis=(1, 2))
    symmetric = np.abs(covariance - turned).max(axis=(1, 2)) <= 1e-9 * size
    return symmetric & (np.linalg.eigvalsh((covariance + turned) / 2) > 0).all(axis=1)


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


def _wheels_trusted(inputs, outputs):
    """Whether it fits robots whose wheels do not err better than those whose wheels do."""
    without = inputs | {"C": 0 * inputs["C"]}
    return bool(np.median(lost(without, outputs)) < np.median(lost(inputs, outputs)) / 5)


def _wrapped(inputs, outputs):
    """Whether the heading's variance is far too large, but only where headings reach π."""
    mean, best = ends(inputs)
    far = outputs["covariance"][:, 2, 2] > 2 * best[:, 2, 2]
    reach = np.abs(wrap(mean[:, 2])) + 4 * np.sqrt(best[:, 2, 2]) > np.pi
    return bool(far.any() and not far[~reach].any())


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


MISTAKES = (
    Diagnosis(
        "wheels-trusted",
        "Your robots scatter as if their wheels did not err: what C says of distance and turn "
        "is not in your covariance.",
        _wheels_trusted,
        on=SLIP,
    ),
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
        "Your heading is far too unsure in just those drives that may end on either side of π. "
        "Ends just beyond it count as −π once they are wrapped, and an average of wrapped angles "
        "means nothing. Where else can you cut the circle?",
        _wrapped,
    ),
    Diagnosis(
        "too-sure",
        "In most drives your covariance is smaller than the robots' scatter. Is one of the four "
        "missing: place, heading, distance, turn? Is something divided once too often, by the "
        "number of samples perhaps, or a variance drawn from as if it were a σ? Or are your "
        "samples too few to span it?",
        _volume_off(-0.5),
    ),
    Diagnosis(
        "too-unsure",
        "In most drives your covariance is larger than the robots' scatter: is something "
        "counted twice, a mean not subtracted, a σ taken for a variance, or is it left out that "
        "errors go together?",
        _volume_off(0.5),
    ),
)
