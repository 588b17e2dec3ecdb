"""The task of exercise 07 about the correlation matrix of a covariance."""

import numpy as np

from slamlab.exercises.drives.ex07 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex07_laws import T, close, covariances, mistake, samples

PLAIN, CERTAIN, RESCALED = slice(0, 8), slice(8, 12), slice(12, 20)
ROBOT, MAP = slice(0, 3), slice(3, 7)
COARSE = 1e-3
"""Of a correlation: a small number against division by zero passes, no mistake does."""


def beliefs(rng):
    """Covariances of a robot and two landmarks; of a certain robot; the first in other units."""
    low, high = np.array([0.1, 0.1, 0.02, 0.2, 0.2, 0.2, 0.2]), 4.0
    P = covariances(rng, low * rng.uniform(1, high, (12, 7)))
    P[CERTAIN, ROBOT], P[CERTAIN, :, ROBOT] = 0, 0
    # centimetres, degrees, feet: a unit for each component
    units = rng.choice([1, 3.28, 39.4, 57.3, 100], (8, 7))
    return {"P": np.concatenate([P, P[PLAIN] * units[:, :, None] * units[:, None, :]])}


def _samples(inputs, outputs):
    rho, P = outputs["result"], inputs["P"]
    whole = [_alike(rho[PLAIN], P[PLAIN]), _alike(rho[CERTAIN, MAP, MAP], P[CERTAIN, MAP, MAP])]
    return np.concatenate(whole)


def _alike(rho, P):
    """Whether correlations are those of samples that have this covariance."""
    want = np.array([np.corrcoef(errors.T) for errors in samples(P)])
    return np.abs(rho - want).max(axis=(1, 2)) <= COARSE


def _units(inputs, outputs):
    rho = outputs["result"]
    return np.abs(rho[RESCALED] - rho[PLAIN]).max(axis=(1, 2)) <= COARSE


def _certain(inputs, outputs):
    rho = outputs["result"][CERTAIN].copy()
    own = np.diagonal(rho, axis1=1, axis2=2)[:, ROBOT]
    # of something certain, a correlation of 1 or of 0 with itself can both be argued for
    fine = np.minimum(np.abs(own), np.abs(own - 1)).max(axis=1) <= COARSE
    rho[:, np.arange(7), np.arange(7)] = 0
    others = np.concatenate([rho[:, ROBOT], T(rho[:, :, ROBOT])], axis=1)
    return fine & (np.abs(others).max(axis=(1, 2)) <= COARSE)


# ---- mistakes -------------------------------------------------------------------------------


def _variances(inputs):
    return np.diagonal(inputs["P"][PLAIN], axis1=1, axis2=2)


def _right(inputs):
    sigma = np.sqrt(_variances(inputs))
    return inputs["P"][PLAIN] / (sigma[:, :, None] * sigma[:, None, :])


def _divided(by):
    return lambda i: i["P"][PLAIN] / by(_variances(i))


def _undefined(inputs, outputs):
    undefined = outputs["undefined"][CERTAIN].any()
    return undefined and close(outputs["result"][PLAIN], _right(inputs)).all()


def _not_zero(inputs, outputs):
    return close(outputs["result"][PLAIN], _right(inputs)).all()


_on_plain = {"rows": PLAIN}

CORRELATION = Task(
    id="07-correlation",
    title="The correlation matrix",
    drive=DRIVES["07-correlation"],
    inputs=beliefs,
    shapes={"result": (7, 7), "undefined": (20, 7, 7)},
    laws=(
        Law(
            "samples",
            2,
            "ρ_ij is the correlation of samples that have the covariance P",
            _samples,
        ),
        Law("units", 1, "ρ stays the same when the units of the state change", _units),
        Law("certain", 1, "what has variance 0 has correlation 0 with all others", _certain),
    ),
    diagnoses=(
        mistake(
            "by-variances",
            "Both variances are divided off, and that is too much: P_ij has the unit of σ_i σ_j, "
            "and the diagonal holds σ². Where does the root belong?",
            _divided(lambda d: d[:, :, None] * d[:, None, :]),
            **_on_plain,
        ),
        mistake(
            "one-sigma",
            "P_ij was divided by one standard deviation only. It has the unit of both components: "
            "one σ belongs to its row, another to its column.",
            _divided(lambda d: np.sqrt(d)[:, :, None]),
            _divided(lambda d: np.sqrt(d)[:, None, :]),
            **_on_plain,
        ),
        mistake(
            "one-variance",
            "P_ij / P_jj tells by how much i moves when j moves by 1: a gain, not a correlation. "
            "The diagonal is 1, but is the matrix symmetric?",
            _divided(lambda d: d[:, :, None]),
            _divided(lambda d: d[:, None, :]),
            **_on_plain,
        ),
        mistake(
            "one-number-for-all",
            "All entries were divided by the same number. Each has standard deviations of its own: "
            "those of its row and of its column.",
            lambda i: i["P"][PLAIN],
            _divided(lambda d: d.max(axis=1)[:, None, None]),
            _divided(lambda d: d.sum(axis=1)[:, None, None]),
            lambda i: i["P"][PLAIN] / np.abs(i["P"][PLAIN]).max(axis=(1, 2), keepdims=True),
            lambda i: i["P"][PLAIN] / np.linalg.norm(i["P"][PLAIN], axis=(1, 2), keepdims=True),
            **_on_plain,
        ),
        mistake(
            "corrcoef-of-P",
            "np.corrcoef wants samples; it took the rows of P for them. P is the covariance "
            "already: it only needs the right divisors.",
            lambda i: np.array([np.corrcoef(P) for P in i["P"][PLAIN]]),
            **_on_plain,
        ),
        mistake(
            "sign-lost",
            "The signs are gone. That one errs to the left where another errs to the right is "
            "knowledge, too: ρ goes from −1 to 1.",
            lambda i: np.abs(_right(i)),
            lambda i: _right(i) ** 2,
            **_on_plain,
        ),
        Diagnosis(
            "zero-over-zero",
            "A robot at its start has P_rr = 0, and you divide 0 by 0. What is certain shares no "
            "error with anyone: put 0 there (np.where, or np.divide with where= and out=).",
            _undefined,
        ),
        Diagnosis(
            "certain-not-zero",
            "Where all variances are positive you are right. Where one is 0, all of its row and "
            "column beside the diagonal must be 0: nothing errs with what does not err.",
            _not_zero,
        ),
    ),
)
