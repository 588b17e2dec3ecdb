"""Exercise 08, classic mistakes with corners: another slope, or other covariances put in."""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex08_lines import direction

ROWS = 14
ONE_BY_ONE = slice(0, ROWS)  # the others are of one corner, over and over
TOLERANCE = 0.01  # of a covariance, as a share of the standard deviations
QUARTER = np.array([0, np.pi / 2])


def meeting(z1, z2):
    """(..., 2) where lines (..., 2) meet."""
    across = np.sin(z2[..., 1] - z1[..., 1])
    (c1, s1), (c2, s2) = (np.moveaxis(direction(z[..., 1]), -1, 0) for z in (z1, z2))
    rho1, rho2 = z1[..., 0], z2[..., 0]
    return np.stack([rho1 * s2 - rho2 * s1, rho2 * c1 - rho1 * c2], axis=-1) / across[..., None]


def close(got, want):
    """(n,) whether covariances agree, in units of the standard deviations."""
    # a wrong formula may have a diagonal below zero
    sigma = np.sqrt(np.abs(np.diagonal(want, axis1=1, axis2=2)))
    scale = sigma[:, :, None] * sigma[:, None, :]
    return (np.abs(got - want) <= TOLERANCE * scale).all(axis=(1, 2))


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


DIAGNOSES = (
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
)
