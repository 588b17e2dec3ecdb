"""ICP point to line: the distance that counts is the one across the wall (Censi 2008)."""

import numpy as np

from slamlab.geometry import transform, wrap
from slamlab.scanmatching.nearest import Nearest
from slamlab.scanmatching.normals import normals
from slamlab.scanmatching.result import Match, Round, checked, limits

STILL = "the steps are below the tolerance"
LOST = "too few pairs agree: too little overlap or too poor a first guess"
CALM = 20  # rounds after which steps are damped
LEAST = 0.1  # share of the source that must find pairs
FLOOR = 0.02  # a residual below this is never an outlier [m]
UNSEEN = 1e-4  # an eigenvalue under this share of the largest counts as not fixed


def point_to_line(
    source,
    target,
    initial=(0.0, 0.0, 0.0),
    *,
    tolerance=1e-4,
    max_rounds=60,
    keep=1.0,
    gate=(1.0, 0.1),
    normal_gate=0.7,
    trust=None,
    history=False,
):
    """Lay a source cloud over the walls that a target cloud shows.

    Each round pairs nearest points, drops pairs too far apart or whose walls point elsewhere,
    keeps the share that lies best, weighs it by Cauchy's function and takes a Gauss-Newton step on
    Σ w_i (n_i·(R p_i + t − q_i))² / c² + eᵀ Σ⁻¹ e, with e the way from the first guess and Σ its
    covariance, where it has one: along a corridor, which no wall fixes, the guess then stands. The
    longest pair shrinks from round to round. Stops when a step moves no point by the tolerance.

    Parameters
    ----------
    source : (n, 2) points [m]
    target : (m, 2) points [m]
    initial : (3,) first guess of the source's frame in the target's [m, m, rad]
    tolerance : float [m]
    max_rounds : int
    keep : float, share of the agreeing pairs to fit
    gate : (2,) longest pair in the first and in the last rounds [m]
    normal_gate : float, largest angle between the two walls of a pair [rad]
    trust : (3,) standard deviations of the first guess [m, m, rad], or None to trust it nothing
    history : bool, keep a Round for the start and after each fit

    Returns
    -------
    Match, its error the mean distance across the walls

    Raises
    ------
    ValueError : fewer than 3 points, wrong shapes, NaN, senseless limits
    """
    source, target, pose = checked(source, target, initial)
    limits(tolerance, max_rounds, keep)
    nearest = Nearest(target)
    n_source, n_target = normals(source), normals(target)
    start, information = pose, np.zeros(3) if trust is None else 1 / np.asarray(trust) ** 2
    reach = np.hypot(*source.T).max()
    past, width, verdict = [], max(gate), ""
    for rounds in range(max_rounds + 1):
        moved = transform(pose, source)
        distances, indices = nearest(moved)
        n = n_target[indices]
        used = np.flatnonzero((distances <= width) & walls_agree(n, n_source, pose[2], normal_gate))
        residuals = np.einsum("ij,ij->i", n[used], (moved - target[indices])[used])
        if len(used) < max(3, LEAST * len(source)):
            verdict = LOST
        elif keep < 1:
            best = np.abs(residuals) <= np.quantile(np.abs(residuals), keep)
            used, residuals = used[best], residuals[best]
        error = float(np.abs(residuals).mean()) if len(used) else np.nan
        if history:
            past.append(Round(pose, error, np.column_stack([used, indices[used]])))
        if verdict or rounds == max_rounds:
            break
        c = max(FLOOR, width / 10, 1.4826 * np.median(np.abs(residuals)))
        guess = pose - start
        guess[2] = wrap(guess[2])
        step = gauss_newton(n[used], moved[used] - pose[:2], residuals, c, information, guess)
        # pairs that flip to and fro would never let it rest: late steps are damped
        step *= 0.9 ** max(0, rounds - CALM)
        pose = np.array([*(pose + step)[:2], wrap(pose[2] + step[2])])
        if width <= min(gate) and np.hypot(*step[:2]) + reach * abs(step[2]) < tolerance:
            verdict = STILL
        width = max(min(gate), 0.8 * width)
    return Match(
        pose,
        rounds,
        error,
        len(used) / len(source),
        verdict == STILL,
        verdict or f"still moving after {rounds} rounds",
        tuple(past),
    )


def walls_agree(n, n_source, turn, limit):
    """(k,) bool: the normals of both points are known and, turned, differ by less than the limit.

    A normal has no front: opposite ones count as the same.
    """
    cosine = np.abs(np.einsum("ij,ij->i", n, transform([0.0, 0.0, turn], n_source)))
    with np.errstate(invalid="ignore"):
        return cosine > np.cos(limit)


def gauss_newton(n, arm, residuals, c, information, guess):
    """The step (dx, dy, dθ) that lowers Σ w r² / c² + eᵀ diag(information) e.

    r has the derivative [n_x, n_y, arm × n]; Cauchy's weight is w = 1 / (1 + (r/c)²). A direction
    that neither the walls nor the first guess fix is left as it was.

    Parameters
    ----------
    n : (k, 2) unit normals
    arm : (k, 2) points seen from the robot, in the target's directions [m]
    residuals : (k,) distances across the walls [m]
    c : float, residual at which a pair counts half [m]
    information : (3,) of the first guess [1/m², 1/m², 1/rad²]
    guess : (3,) e, how far the pose is from the first guess [m, m, rad]

    Returns
    -------
    (3,) [m, m, rad]
    """
    w = 1 / (1 + (residuals / c) ** 2)
    # angles count as the way a point at the middling distance goes
    scale = np.array([1, 1, 1 / max(1e-9, np.sqrt(np.mean(arm**2)))])
    J = np.column_stack([n, arm[:, 0] * n[:, 1] - arm[:, 1] * n[:, 0]]) * scale
    prior = c**2 * information * scale
    A = J.T @ (w[:, None] * J) + np.diag(prior * scale)
    eigenvalues, axes = np.linalg.eigh(A)
    fixed = eigenvalues > UNSEEN * eigenvalues[-1]
    downhill = axes.T @ -(J.T @ (w * residuals) + prior * guess)
    return scale * (axes[:, fixed] @ (downhill[fixed] / eigenvalues[fixed]))
