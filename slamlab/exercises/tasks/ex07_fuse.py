"""The task of exercise 07 about two estimates that share an error: their best combination."""

import numpy as np

from slamlab.exercises.drives.ex07 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex07_gains import MISTAKES
from slamlab.exercises.tasks.ex07_laws import TOLERANCE, T, close, covariances, spread, white

CASES, PAIRS = 4, 20


def estimates(rng):
    """Pairs of estimates of a landmark; their errors have exactly the covariances given."""
    sigmas = rng.uniform(0.1, 0.4, (CASES, 4))
    joint = covariances(rng, sigmas, surplus=1)
    errors = white(rng, PAIRS, 4) @ T(np.linalg.cholesky(joint))
    both = (rng.uniform(1, 6, (CASES, 2)) * rng.choice([-1, 1], (CASES, 2)))[:, None]
    return {
        "a": both + errors[:, :, :2],
        "P_a": joint[:, :2, :2],
        "b": both + errors[:, :, 2:],
        "P_b": joint[:, 2:, 2:],
        "P_ab": joint[:, :2, 2:],
    }


def _errors(inputs, outputs):
    """(cases, samples, 2) of the fused estimates; those of a and b are 0 on average."""
    return outputs["x"] - inputs["a"].mean(axis=1, keepdims=True)


def _sigma(inputs):
    return np.sqrt(np.trace(inputs["P_a"], axis1=1, axis2=2))


def _unbiased(inputs, outputs):
    return np.abs(_errors(inputs, outputs).mean(axis=1)).max(axis=1) <= TOLERANCE * _sigma(inputs)


def _best(inputs, outputs):
    """Were the error correlated with a − b, some share of a − b would still lower it."""
    error, apart = _errors(inputs, outputs), inputs["a"] - inputs["b"]
    shared = T(error) @ apart / apart.shape[1]
    scale = _sigma(inputs) * np.sqrt((apart**2).sum(axis=2).mean(axis=1))
    return np.abs(shared).max(axis=(1, 2)) <= TOLERANCE * scale


def _honest(inputs, outputs):
    actual, claims = spread(_errors(inputs, outputs)), np.moveaxis(outputs["P"], 1, 0)
    # every call must claim it: P does not depend on a and b
    return np.all([close(P, actual) for P in claims], axis=0)


FUSE = Task(
    id="07-fuse",
    title="Two estimates that share an error",
    drive=DRIVES["07-fuse"],
    inputs=estimates,
    shapes={"x": (CASES, 2 * PAIRS, 2), "P": (CASES, 2 * PAIRS, 2, 2)},
    laws=(
        Law("unbiased", 1, "over many pairs a, b the errors of x average out", _unbiased),
        Law("best", 2, "no other share of a − b brings x nearer to the truth", _best),
        Law("honest", 2, "P is the covariance that the errors of x really have", _honest),
    ),
    diagnoses=MISTAKES,
)
