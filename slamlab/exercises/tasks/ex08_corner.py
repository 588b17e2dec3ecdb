"""Exercise 08, corners: on both lines, as unsure as samples are, and consistent over many scans."""

import numpy as np

from slamlab.exercises.drives.ex08 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex08_corner_mistakes import DIAGNOSES, ONE_BY_ONE, ROWS, close, meeting
from slamlab.exercises.tasks.ex08_lines import direction

PAIRS = 50
SAME_CORNER = slice(ROWS, None)
NARROW = 0.1  # of the standard deviations: there the corner moves straight
BAND = 1.8, 2.2
"""Of the mean squared error: the samples' moments are exact, so it is off 2 by curvature only."""


def _white(rng, pairs, k):
    """Samples with mean 0 and covariance 1, both exact: mirrored, then scaled."""
    half = rng.standard_normal((pairs, k))
    half = half @ np.linalg.inv(np.linalg.cholesky(half.T @ half / pairs)).T
    return np.vstack([half, -half])


WHITE = _white(np.random.default_rng(8), PAIRS, 4)


def _covariances(rng, count):
    sigma = np.stack([rng.uniform(0.008, 0.03, count), rng.uniform(0.006, 0.02, count)], axis=-1)
    tie = rng.choice([-1.0, 1.0], count) * rng.uniform(0.4, 0.8, count)
    R = sigma[:, :, None] * sigma[:, None, :]
    R[:, 0, 1] *= tie
    R[:, 1, 0] *= tie
    return R


def lines(rng):
    """Pairs of lines; at the end one pair over and over, with the noise its covariances say."""
    count = ROWS + 1
    first = np.column_stack([rng.uniform(0.8, 4, count), rng.uniform(-np.pi, np.pi, count)])
    apart = rng.choice([-1.0, 1.0], count) * rng.uniform(0.7, 1.3, count)
    second = np.column_stack([rng.uniform(0.8, 4, count), first[:, 1] + apart])
    R1, R2 = _covariances(rng, count), _covariances(rng, count)
    last = np.concatenate([np.arange(ROWS), np.full(len(WHITE), ROWS)])
    z1, R1, z2, R2 = (a[last] for a in (first, R1, second, R2))
    z1[SAME_CORNER] += WHITE[:, :2] @ np.linalg.cholesky(R1[-1]).T
    z2[SAME_CORNER] += WHITE[:, 2:] @ np.linalg.cholesky(R2[-1]).T
    return {"z1": z1, "R1": R1, "z2": z2, "R2": R2}


def sampled(inputs):
    """(ROWS, 2, 2) covariances of corners whose lines err as R1 and R2 say."""
    found = []
    for z1, R1, z2, R2 in zip(
        *(inputs[k][ONE_BY_ONE] for k in ("z1", "R1", "z2", "R2")), strict=True
    ):
        first = z1 + NARROW * WHITE[:, :2] @ np.linalg.cholesky(R1).T
        second = z2 + NARROW * WHITE[:, 2:] @ np.linalg.cholesky(R2).T
        found.append(np.cov(meeting(first, second).T, bias=True) / NARROW**2)
    return np.array(found)


def _on_both(inputs, outputs):
    off = [
        np.einsum("ni,ni->n", direction(z[:, 1]), outputs["p"]) - z[:, 0]
        for z in (inputs["z1"], inputs["z2"])
    ]
    return np.abs(off).max(axis=0) < 1e-6


def _covariance(inputs, outputs):
    return close(outputs["P"][ONE_BY_ONE], sampled(inputs))


def _consistent(inputs, outputs):
    truth = meeting(*(inputs[k][SAME_CORNER].mean(axis=0) for k in ("z1", "z2")))
    error, P = outputs["p"][SAME_CORNER] - truth, outputs["P"][SAME_CORNER]
    if (np.linalg.eigvalsh((P + P.transpose(0, 2, 1)) / 2)[:, 0] <= 0).any():
        return False
    size = np.einsum("ni,ni->n", error, np.linalg.solve(P, error[..., None])[..., 0]).mean()
    return BAND[0] < size < BAND[1]


CORNER = Task(
    id="08-corner",
    title="Where two walls meet",
    drive=DRIVES["08-corner"],
    inputs=lines,
    shapes={"p": (ROWS + 2 * PAIRS, 2), "P": (ROWS + 2 * PAIRS, 2, 2)},
    laws=(
        Law("place", 1, "p lies on both lines", _on_both),
        Law(
            "covariance",
            2,
            "P is the covariance of the corners of sampled lines",
            _covariance,
        ),
        Law(
            "consistent",
            1,
            "over 100 scans of one corner the squared error in units of P is 2 on average",
            _consistent,
        ),
    ),
    diagnoses=DIAGNOSES,
)
