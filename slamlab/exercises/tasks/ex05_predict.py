"""Exercise 05, predict: a belief of the pose is carried through a drive with noisy wheels."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex05 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex04_laws import NARROW, SAMPLE_TOLERANCE, WHITE
from slamlab.exercises.tasks.ex05_batch import (
    covariances,
    each,
    off_pose,
    same_covariance,
    sandwich,
    turned,
    variances,
)
from slamlab.geometry import wrap
from slamlab.models import jacobians

ROWS = 16


def drives(rng):
    """Poses anywhere with generic covariances, and drives with a turn to either side."""
    x = np.column_stack([rng.uniform(-5, 5, (ROWS, 2)), rng.uniform(-3, 3, ROWS)])
    sigma = np.column_stack([rng.uniform(0.05, 0.2, (ROWS, 2)), rng.uniform(0.03, 0.08, ROWS)])
    turn = rng.choice([-1, 1], ROWS) * rng.uniform(0.4, 1, ROWS)
    wheels = np.column_stack([rng.uniform(0.05, 0.15, ROWS), rng.uniform(0.03, 0.08, ROWS)])
    return {
        "x": x,
        "P": covariances(rng, sigma),
        "u": np.column_stack([rng.uniform(0.8, 2, ROWS), turn]),
        "C": variances(wheels),
    }


# ---- laws -----------------------------------------------------------------------------------


def _moved(inputs, outputs):
    want = each(models.f_odometry, inputs["x"], inputs["u"])
    return np.abs(off_pose(outputs["x"], want)).max(axis=1) < 1e-6


def sampled(inputs):
    """Covariance of drives sampled from the belief and from the wheels' noise, (n, 3, 3)."""
    return each(_sampled, *(inputs[name] for name in ("x", "P", "u", "C")))


def _sampled(x, P, u, C):
    starts = x + NARROW * WHITE[:, :3] @ np.linalg.cholesky(P).T
    driven = u + NARROW * WHITE[:, 3:] @ np.linalg.cholesky(C).T
    ends = models.f_odometry(starts.T, driven.T).T - models.f_odometry(x, u)
    ends[:, 2] = wrap(ends[:, 2])
    return np.cov(ends.T, bias=True) / NARROW**2


def _spread(inputs, outputs):
    return same_covariance(outputs["P"], sampled(inputs), SAMPLE_TOLERANCE)


# ---- mistakes -------------------------------------------------------------------------------


def _A(inputs, after=False):
    return each(jacobians.A_odometry, _at(inputs, after), inputs["u"])


def _W(inputs, after=False):
    return each(jacobians.W_odometry, _at(inputs, after), inputs["u"])


def _at(inputs, after):
    return each(models.f_odometry, inputs["x"], inputs["u"]) if after else inputs["x"]


def _APA(inputs, after=False):
    return sandwich(_A(inputs, after), inputs["P"])


def _Q(inputs, after=False, C=None):
    return sandwich(_W(inputs, after), inputs["C"] if C is None else C)


def _C_in(*where):
    """A P Aᵀ with C's diagonal put into these rows as it is."""

    def wrong(inputs):
        Q = np.zeros_like(inputs["P"])
        for row, of in where:
            Q[:, row, row] = inputs["C"][:, of, of]
        return _APA(inputs) + Q

    return wrong


def _turned_first(inputs, outputs):
    x, u = inputs["x"].copy(), inputs["u"]
    x[:, 2] += u[:, 1]
    want = each(models.f_odometry, x, u * [1, 0])
    return np.abs(off_pose(outputs["x"], want)).max() < 1e-6


def _arc(inputs, outputs):
    x, u = inputs["x"].copy(), inputs["u"]
    x[:, 2] += u[:, 1] / 2
    want = each(models.f_odometry, x, u)
    want[:, 2] = inputs["x"][:, 2] + u[:, 1]
    return np.abs(off_pose(outputs["x"], want)).max() < 1e-6


def _covariance(name, hint, *wrong):
    return Diagnosis(
        name, hint, lambda i, o: any(same_covariance(o["P"], w(i)).all() for w in wrong)
    )


PREDICT = Task(
    id="05-predict",
    title="Predict: drive, and doubt more",
    drive=DRIVES["05-predict"],
    inputs=drives,
    shapes={"x": (ROWS, 3), "P": (ROWS, 3, 3)},
    laws=(
        Law("mean", 1, "the pose goes where f takes it", _moved),
        Law("covariance", 2, "P is the covariance of sampled poses and drives", _spread),
    ),
    diagnoses=(
        Diagnosis(
            "not-moved",
            "The pose came back as it went in. The robot has driven: x ← f(x, u).",
            lambda i, o: np.abs(off_pose(o["x"], i["x"])).max() < 1e-9,
        ),
        Diagnosis(
            "turned-first",
            "Your robot turns first and then drives. f drives along the old heading and turns "
            "at the end: f_odometry does that for you.",
            _turned_first,
        ),
        Diagnosis(
            "arc",
            "Your robot drives half the turn off its old heading: that is the arc of lesson 05's "
            "lap. Here f is lesson 04's f_odometry, along the old heading and then the turn, and "
            "so are A_odometry and W_odometry.",
            _arc,
        ),
        _covariance(
            "jacobian-after",
            "A and W are taken at the pose after the drive. They say how f changes where it is "
            "computed: at the pose before. Compute them before you replace x.",
            lambda i: _APA(i, after=True) + _Q(i, after=True),
            lambda i: _APA(i, after=True) + _Q(i),
            lambda i: _APA(i) + _Q(i, after=True),
        ),
        _covariance(
            "noise-forgotten",
            "The wheels' noise is missing: this P says that the drive was exactly u. "
            "What carries C over to the pose?",
            _APA,
        ),
        _covariance(
            "noise-not-carried",
            "C is added as it is. It is the covariance of d and Δθ, while P is that of x, y, θ: "
            "which matrix says what an error of u does to the pose?",
            _C_in((0, 0), (1, 1)),
            _C_in((0, 0), (2, 1)),
            _C_in((0, 0), (1, 0), (2, 1)),
            _C_in((0, 0), (1, 1), (2, 1)),
        ),
        _covariance(
            "standard-deviation",
            "C holds variances already: look where you take a root or a square of it.",
            lambda i: _APA(i) + _Q(i, C=np.sqrt(i["C"])),
            lambda i: _APA(i) + _Q(i, C=i["C"] @ i["C"]),
        ),
        _covariance(
            "transposed",
            "A stands on the wrong side: Aᵀ P A has the right shape and another meaning. P is "
            "multiplied by A from the left.",
            lambda i: turned(_A(i)) @ i["P"] @ _A(i) + _Q(i),
        ),
        _covariance(
            "not-levered",
            "Q is added, but P itself did not drive: an error of the heading becomes one of "
            "the place. Where is A?",
            lambda i: i["P"] + _Q(i),
        ),
        _covariance(
            "noise-subtracted",
            "Q is taken off. Driving with noisy wheels can only add doubt.",
            lambda i: _APA(i) - _Q(i),
        ),
    ),
)
