"""Exercise 11, move: what every sample drove is read off its two poses.

Bands are wide: at 7 standard deviations of a normal, chance fails nobody in 10⁶ gradings.
"""

import numpy as np

from slamlab.exercises.drives.ex11 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.geometry import wrap

CLOUDS, SAMPLES = 2, 1500
BAND = 7.0  # standard deviations


def clouds(rng):
    """Clouds with headings all round, drives, and generic covariances of their noise."""
    rows = np.dstack(
        [
            rng.uniform(-4, 4, (CLOUDS, SAMPLES)),
            rng.uniform(-4, 4, (CLOUDS, SAMPLES)),
            rng.uniform(-np.pi, np.pi, (CLOUDS, SAMPLES)),
        ]
    )
    sigma = np.column_stack([rng.uniform(0.05, 0.12, CLOUDS), rng.uniform(0.03, 0.06, CLOUDS)])
    rho = rng.choice([-1, 1], CLOUDS) * rng.uniform(0.5, 0.7, CLOUDS)
    C = sigma[:, :, None] * sigma[:, None, :]
    C[:, 0, 1] *= rho
    C[:, 1, 0] *= rho
    turn = rng.choice([-1, 1], CLOUDS) * rng.uniform(0.4, 0.8, CLOUDS)
    return {
        "rows": rows,
        "u": np.column_stack([rng.uniform(0.8, 1.6, CLOUDS), turn]),
        "C": C,
        "seed": rng.integers(1, 2**31, CLOUDS).astype(float),
    }


def driven(before, after, heading):
    """(..., n, 3) distance along a heading, turn, and way across it, of every sample."""
    step = after - before
    c, s = np.cos(heading), np.sin(heading)
    along, across = c * step[..., 0] + s * step[..., 1], c * step[..., 1] - s * step[..., 0]
    return np.stack([along, wrap(step[..., 2]), across], axis=-1)


def _drives(i, o, heading=None):
    """(k, n, 3) of the first call, by each sample's old heading if not by another."""
    heading = i["rows"][..., 2] if heading is None else heading
    return driven(i["rows"], o["moved"][:, 0], heading)


def _white(i, o):
    """(k, n, 2) the noise of every sample, in units of C's root: standard normal when right."""
    off = _drives(i, o)[..., :2] - i["u"][:, None]
    return off @ np.linalg.inv(np.linalg.cholesky(i["C"])).swapaxes(-1, -2)


def _along(i, o):
    return (np.abs(_drives(i, o)[..., 2]) < 1e-6).all(axis=1)


def _right_on_average(i, o):
    return (np.abs(_white(i, o).mean(axis=1)) * np.sqrt(SAMPLES) < BAND).all(axis=1)


def _spread_right(i, o):
    e = _white(i, o)
    e = e - e.mean(axis=1, keepdims=True)
    off = e.swapaxes(-1, -2) @ e / SAMPLES - np.eye(2)
    # a sample variance of n normals strays by √(2/n), a covariance by √(1/n)
    scale = np.array([[np.sqrt(2), 1], [1, np.sqrt(2)]]) / np.sqrt(SAMPLES)
    return (np.abs(off) < BAND * scale).all(axis=(1, 2))


def _by_the_seed(i, o):
    first, same, other = o["moved"].swapaxes(0, 1)
    return np.array(
        [(a == b).all() and not (a == c).all() for a, b, c in zip(first, same, other, strict=True)]
    )


# ---- mistakes -------------------------------------------------------------------------------


def _covariance(i, o):
    return np.array([np.cov(one[:, :2].T, bias=True) for one in _drives(i, o)])


def _has_covariance(name, hint, wrong):
    """The drawn noise has this covariance of d and Δθ instead of C."""

    def matches(i, o):
        found, want = _covariance(i, o), wrong(i["C"])
        scale = np.sqrt(np.einsum("kaa,kbb->kab", want, want))
        return (np.abs(found - want) < 0.2 * scale).all()

    return Diagnosis(name, hint, matches)


def _diagonal(C):
    return C * np.eye(2)


def _means(i, o):
    """(k, 2) mean distance and turn."""
    return _drives(i, o)[..., :2].mean(axis=1)


def _all_alike(i, o):
    return np.ptp(_drives(i, o)[..., :2], axis=1).max() < 1e-6


def _without_noise(i, o):
    return _all_alike(i, o) and np.abs(_drives(i, o)[:, 0, :2] - i["u"]).max() < 1e-6


def _along_other(offset):
    """Whether the samples went along their heading and some of the turn that they made."""

    def matches(i, o):
        turn = _drives(i, o)[..., 1]
        return (
            np.ptp(turn) > 1e-6
            and np.abs(_drives(i, o, i["rows"][..., 2] + offset * turn)[..., 2]).max() < 1e-6
        )

    return matches


def _one_heading(i, o):
    """All went the same way, whatever their heading."""
    step = o["moved"][:, 0] - i["rows"]
    direction = np.arctan2(step[..., 1], step[..., 0])
    return np.ptp(wrap(direction - direction[:, :1]), axis=1).max() < 1e-6


MOVE = Task(
    id="11-move",
    title="Move: every sample drives",
    drive=DRIVES["11-move"],
    inputs=clouds,
    shapes={"moved": (CLOUDS, 3, SAMPLES, 3)},
    laws=(
        Law("heading", 1, "every sample drives along the heading it had, then turns", _along),
        Law("average", 1, "over thousands of samples the noise averages out", _right_on_average),
        Law("spread", 2, "what the samples drove has the covariance C", _spread_right),
        Law("seed", 1, "the same seed gives the same cloud, another seed another", _by_the_seed),
    ),
    diagnoses=(
        Diagnosis(
            "not-moved",
            "The samples came back where they were. Return the moved ones.",
            lambda i, o: np.abs(o["moved"][:, 0] - i["rows"]).max() < 1e-9,
        ),
        Diagnosis(
            "noise-forgotten",
            "Every sample drives exactly u: the wheels' noise is missing. The cloud would never "
            "grow, and after a few draws it is one point.",
            _without_noise,
        ),
        Diagnosis(
            "one-draw-for-all",
            "All samples got the same draw of the noise, so the cloud moves as one and its doubt "
            "does not grow. Draw one for each sample: size n.",
            _all_alike,
        ),
        Diagnosis(
            "another-generator",
            "The same seed gives another cloud: draw from the rng that is passed in, none from "
            "np.random or a generator of your own.",
            lambda i, o: not (o["moved"][:, 0] == o["moved"][:, 1]).all(),
        ),
        Diagnosis(
            "always-the-same",
            "Whatever the seed, the cloud is the same: draw from the rng that is passed in; do not "
            "make one with a fixed seed.",
            lambda i, o: (o["moved"][:, 0] == o["moved"][:, 2]).all(),
        ),
        Diagnosis(
            "one-heading",
            "All samples went in the same direction. Each drives along its own heading.",
            _one_heading,
        ),
        Diagnosis(
            "turn-forgotten",
            "The headings came back as they were: θ grows by the turn.",
            lambda i, o: np.abs(_drives(i, o)[..., 1]).max() < 1e-9,
        ),
        Diagnosis(
            "sine-and-cosine",
            "Sine and cosine are swapped: x grows by d cos θ, y by d sin θ.",
            lambda i, o: np.abs(_drives(i, o, np.pi / 2 - i["rows"][..., 2])[..., 2]).max() < 1e-6,
        ),
        Diagnosis(
            "backwards",
            "Your samples drive backwards: look at the sign of d.",
            lambda i, o: (np.abs(_means(i, o) + i["u"] * [1, -1]) < 0.05).all(),
        ),
        Diagnosis(
            "noise-alone",
            "Your samples move by the noise alone: u, which was driven, is missing.",
            lambda i, o: np.abs(_means(i, o)).max() < 0.05,
        ),
        Diagnosis(
            "turned-first",
            "Your samples turn first and then drive. Here the drive is along the old heading, the "
            "turn at the end.",
            _along_other(1.0),
        ),
        Diagnosis(
            "arc",
            "Your samples drive half the turn off their old heading: that is an arc. Here the "
            "drive is along the old heading, the turn at the end.",
            _along_other(0.5),
        ),
        Diagnosis(
            "noise-on-the-pose",
            "The noise is put on x, y, θ. It is the wheels that err: put it on d and Δθ first.",
            lambda i, o: (
                np.median(np.abs(_drives(i, o)[..., 2])) > 1e-3
                and np.abs(_drives(i, o).mean(axis=1)[:, :2] - i["u"]).max() < 0.05
            ),
        ),
        _has_covariance(
            "correlation-forgotten",
            "Distance and turn have the right deviations, but err independently. C has entries "
            "off its diagonal: rng.multivariate_normal takes all of it.",
            _diagonal,
        ),
        _has_covariance(
            "standard-deviation",
            "The diagonal of C holds variances, and you scale normal draws by them: take the root "
            "(or rng.multivariate_normal, which takes C).",
            lambda C: _diagonal(C) ** 2,
        ),
        _has_covariance(
            "root-taken-twice",
            "The noise is far too large: multivariate_normal takes the covariance itself, and "
            "normal the root of a variance, once.",
            lambda C: np.sqrt(_diagonal(C)),
        ),
        _has_covariance(
            "C-as-root",
            "You multiply standard normal draws by C: that has the covariance C C. What is needed "
            "is a root of it, such as np.linalg.cholesky(C), or rng.multivariate_normal.",
            lambda C: C @ C,
        ),
    ),
)
