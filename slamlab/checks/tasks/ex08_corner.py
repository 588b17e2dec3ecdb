"""Exercise 08, corners: on both lines, as unsure as samples are, and consistent over many scans."""

import numpy as np

from slamlab.checks.drives.ex08 import DRIVES
from slamlab.checks.task import Diagnosis, Law, Task
from slamlab.checks.tasks.ex08_fit import direction

ROWS, PAIRS = 14, 50
ONE_BY_ONE, SAME_CORNER = slice(0, ROWS), slice(ROWS, None)
NARROW = 0.1  # of the standard deviations: there the corner moves straight
TOLERANCE = 0.01
BAND = 1.8, 2.2
"""Of the mean squared error: the samples' moments are exact, so it is off 2 by curvature only."""

QUARTER = np.array([0, np.pi / 2])


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


def meeting(z1, z2):
    """(..., 2) where lines (..., 2) meet."""
    across = np.sin(z2[..., 1] - z1[..., 1])
    (c1, s1), (c2, s2) = (np.moveaxis(direction(z[..., 1]), -1, 0) for z in (z1, z2))
    rho1, rho2 = z1[..., 0], z2[..., 0]
    return np.stack([rho1 * s2 - rho2 * s1, rho2 * c1 - rho1 * c2], axis=-1) / across[..., None]


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


def close(got, want):
    """(n,) whether covariances agree, in units of the standard deviations."""
    # a wrong formula may have a diagonal below zero
    sigma = np.sqrt(np.abs(np.diagonal(want, axis1=1, axis2=2)))
    scale = sigma[:, :, None] * sigma[:, None, :]
    return (np.abs(got - want) <= TOLERANCE * scale).all(axis=(1, 2))


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


# ---- mistakes: the covariance with another slope, or from other R ----------------------------


def carried(inputs, lever=-1.0, back=np.linalg.inv, of=lambda R: R, signs=(1, 1), rho_only=False):
    """P as some formula has it; by default as it should be."""
    z = [inputs[k][ONE_BY_ONE] for k in ("z1", "z2")]
    N = np.stack([direction(one[:, 1]) for one in z], axis=1)
    p, columns, P = meeting(*z), back(N), 0.0
    for k, name in enumerate(("R1", "R2")):
        arm = lever * np.einsum("ni,ni->n", N[:, k, ::-1] * [-1, 1], p)
        if lever == 0:
            arm = np.full(len(p), -1.0)
        inner = np.stack([np.ones(len(p)), np.zeros(len(p)) if rho_only else arm], axis=-1)
        J = columns[:, :, k, None] * inner[:, None, :]
        P = P + signs[k] * J @ of(inputs[name][ONE_BY_ONE]) @ J.transpose(0, 2, 1)
    return P


def covariance_is(name, hint, *wrongs):
    """A diagnosis: P is what one of these formulas gives."""
    return Diagnosis(
        name, hint, lambda i, o: any(close(o["P"][ONE_BY_ONE], w(i)).all() for w in wrongs)
    )


def place_is(name, hint, *wrongs):
    """A diagnosis: p is what one of these formulas gives."""

    def matches(inputs, outputs):
        z = inputs["z1"], inputs["z2"]
        return any(np.allclose(outputs["p"], wrong(*z), atol=1e-6) for wrong in wrongs)

    return Diagnosis(name, hint, matches)


def _polar(z1, z2):
    p = meeting(z1, z2)
    return np.column_stack([np.hypot(*p.T), np.arctan2(p[:, 1], p[:, 0])])


def _transposed(z1, z2):
    N = np.stack([direction(z1[:, 1]), direction(z2[:, 1])], axis=2)
    return np.linalg.solve(N, np.stack([z1[:, 0], z2[:, 0]], axis=-1)[..., None])[..., 0]


def _diagonal(R):
    return R * np.eye(2)


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
    diagnoses=(
        place_is(
            "polar",
            "p is range and bearing: here it is x and y.",
            _polar,
        ),
        place_is(
            "N-transposed",
            "N stands transposed: each line is a row, n₁·p = ρ₁ and n₂·p = ρ₂.",
            _transposed,
        ),
        place_is(
            "direction-for-normal",
            "α is the direction of the wall's normal, (cos α, sin α), not of the wall.",
            lambda z1, z2: meeting(z1 + QUARTER, z2 + QUARTER),
            lambda z1, z2: meeting(z1 - QUARTER, z2 - QUARTER),
        ),
        place_is(
            "sum-of-feet",
            "The feet of the perpendiculars were added up. That is the corner only where the walls "
            "meet at a right angle; solve n₁·p = ρ₁, n₂·p = ρ₂.",
            lambda z1, z2: sum(z[:, :1] * direction(z[:, 1]) for z in (z1, z2)),
        ),
        covariance_is(
            "alpha-ignored",
            "P has only the doubt in ρ in it. When α is wrong the wall turns, and the corner "
            "slides: n·dp = dρ − (n′·p) dα.",
            lambda i: carried(i, rho_only=True),
        ),
        covariance_is(
            "no-lever",
            "An error dα moves the wall at the corner by (n′·p) dα: the farther the corner, the "
            "more. The factor n′·p is missing.",
            lambda i: carried(i, lever=0),
        ),
        covariance_is(
            "lever-sign",
            "The sign before (n′·p) dα: n·dp = dρ − (n′·p) dα. It matters because the errors of ρ "
            "and α hang together.",
            lambda i: carried(i, lever=1.0),
        ),
        covariance_is(
            "tie-ignored",
            "The errors of ρ and α hang together: R is not diagonal. Use the whole of it.",
            lambda i: carried(i, of=_diagonal),
        ),
        covariance_is(
            "one-line",
            "P has only one of the two lines' doubts in it. Both err, independently: their shares "
            "add up.",
            lambda i: carried(i, signs=(1, 0)),
            lambda i: carried(i, signs=(0, 1)),
        ),
        covariance_is(
            "difference",
            "The two shares of P are subtracted. Independent errors add their covariances.",
            lambda i: carried(i, signs=(1, -1)),
            lambda i: carried(i, signs=(-1, 1)),
        ),
        covariance_is(
            "standard-deviation",
            "R1 and R2 hold variances already: look where you take a root or a square of them.",
            lambda i: carried(i, of=lambda R: R @ R),
            lambda i: carried(i, of=lambda R: R * R),
            lambda i: carried(i, of=lambda R: np.sqrt(np.abs(R))),
        ),
        covariance_is(
            "N-for-its-inverse",
            "N · dp = …, so dp = N⁻¹ · …: the slopes need the inverse of N (its columns), not N.",
            lambda i: carried(i, back=lambda N: N),
            lambda i: carried(i, back=lambda N: N.transpose(0, 2, 1)),
            lambda i: carried(i, back=lambda N: np.linalg.inv(N).transpose(0, 2, 1)),
        ),
    ),
)
