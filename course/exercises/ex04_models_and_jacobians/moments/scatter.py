"""The exact moments for 04-moments, and mistakes that an answer reveals."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, once
from slamlab.geometry import wrap

SLIP = "short distances with an uncertain heading and large control noise"
"""The probe in which the control noise contributes most to the covariance."""


@once
def ends(inputs):
    """Exact mean (n, 3) and covariance (n, 3, 3) of the pose after the step."""
    # E cos θ = cos E θ · exp(−σ²/2); E a f(θ) = E a · E f(θ) + k E f′(θ), k the covariance of a and
    # θ (Stein's lemma).
    x, P, (d, turn), C = inputs["x"], inputs["P"], inputs["u"].T, inputs["C"]
    variance, theta = P[:, 2, 2], x[:, 2]
    once, twice = np.exp(-variance / 2), np.exp(-2 * variance)
    along = once[:, None] * np.column_stack([np.cos(theta), np.sin(theta)])
    across = along[:, ::-1] * [-1, 1]  # its derivative by the heading
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
    """KL divergence from the best Gaussian to the answer [nat], (n,); infinite if that is no
    covariance."""
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
    """(n,) whether a matrix is symmetric (but for rounding) and positive definite."""
    turned = covariance.swapaxes(1, 2)
    size = np.abs(covariance).max(axis=(1, 2))
    symmetric = np.abs(covariance - turned).max(axis=(1, 2)) <= 1e-9 * size
    return symmetric & (np.linalg.eigvalsh((covariance + turned) / 2) > 0).all(axis=1)


def _straight_mean(inputs, outputs):
    x, (d, _) = inputs["x"], inputs["u"].T
    straight = x[:, :2] + d[:, None] * np.column_stack([np.cos(x[:, 2]), np.sin(x[:, 2])])
    return np.allclose(outputs["mean"][:, :2], straight, rtol=1e-6)


def _sampled(inputs, outputs):
    mean, best = ends(inputs)
    off = wrap(outputs["mean"][:, 2] - mean[:, 2]) ** 2 / best[:, 2, 2]
    share = (outputs["covariance"][:, 2, 2] / best[:, 2, 2] - 1) ** 2
    small = np.median(lost(inputs, outputs)) < 40 * np.mean(off + share)  # on average 1.5 times
    return bool(
        (np.minimum(off, share) > 1e-12).all() and np.maximum(off, share).max() < 0.4 and small
    )


def _fit(share, *names):
    """Whether the moments are rather those of P or C times ``share``, entry by entry."""

    def matches(inputs, outputs):
        others = inputs | {name: inputs[name] * share(inputs[name]) for name in names}
        return bool(np.median(lost(others, outputs)) < np.median(lost(inputs, outputs)) / 5)

    return matches


def _wrapped(inputs, outputs):
    """Whether the heading's variance is far too large only near π."""
    mean, best = ends(inputs)
    far = outputs["covariance"][:, 2, 2] > 2 * best[:, 2, 2]
    reach = np.abs(wrap(mean[:, 2])) + 4 * np.sqrt(best[:, 2, 2]) > np.pi
    return bool(far.any() and not far[~reach].any())


def _about_zero(inputs, outputs):
    """Whether the covariance is the second moment about zero."""
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
        "Your covariance does not contain the control noise C of distance and turn.",
        _fit(np.zeros_like, "C"),
        on=SLIP,
        asks="Which terms of your covariance depend on C?",
    ),
    Diagnosis(
        "uncorrelated",
        "Your moments are those of uncorrelated errors. P and C may be full matrices: draw or "
        "choose values with these covariances, also between components.",
        _fit(lambda S: np.eye(S.shape[-1]), "P", "C"),
        asks="Which entries of P and C does your result not depend on? Compute the covariance of "
        "your samples or nodes.",
    ),
    Diagnosis(
        "too-few-samples",
        "These are too few samples: the loss decreases with their number. How many samples do you "
        "need for 0.01 nat in every motion? Over which variables must you sample?",
        _sampled,
        asks="How many samples do you use, and how does the error of a covariance decrease "
        "with their number?",
    ),
    Diagnosis(
        "straight-mean",
        "Your mean is f(x, u), the end point of a robot with exactly the estimated heading. "
        "Robots with other headings get less far in this direction. Where is the mean of all end "
        "points?",
        _straight_mean,
        asks="Where do robots end that drive to the left or to the right of the estimated "
        "heading? Where is the mean of all?",
    ),
    Diagnosis(
        "about-zero",
        "You computed the mean of the squared end points. Subtract their mean before you square.",
        _about_zero,
        asks="About which point do you compute the mean of the squares?",
    ),
    Diagnosis(
        "wrapped-ends",
        "Your variance of the heading is far too large in motions that may end on both sides of "
        "π. Headings just beyond π are wrapped to about −π, so their mean is meaningless. Do not "
        "wrap, or wrap the differences from the estimated heading.",
        _wrapped,
        asks="Two robots have the headings 179° and −179°. What is the mean of your two numbers?",
    ),
    Diagnosis(
        "too-sure",
        "In most motions your covariance is too small: overconfident. Is one of the four errors "
        "missing (position, heading, distance, turn)? Do you use a variance as a σ, or do you "
        "divide twice, for example by the number of samples? Are there too few samples? Do your "
        "samples or nodes have the covariances P and C? Compute theirs, and compare.",
        _volume_off(-0.5),
        asks="Which of the four errors (position, heading, distance, turn) does your "
        "covariance contain, and with which variances?",
    ),
    Diagnosis(
        "too-unsure",
        "In most motions your covariance is too large. Do you use an error twice, omit the "
        "subtraction of the mean, use a σ as a variance, or omit the correlations?",
        _volume_off(0.5),
        asks="How often does each error enter your covariance? About which point do you "
        "compute it?",
    ),
)
