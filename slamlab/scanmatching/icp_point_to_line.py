"""Point-to-line ICP: point to line distances (Censi 2008); in space it is point-to-plane."""

import numpy as np

from slamlab.geometry import transform, wrap
from slamlab.scanmatching.match_result import Match, Round, check_clouds, check_limits
from slamlab.scanmatching.nearest_neighbours import NearestNeighbours
from slamlab.scanmatching.normals import normals

# status words of a match
CONVERGED = "the steps are below the tolerance"
LOST = "too few pairs agree: too little overlap or too poor a first guess"
DAMP_AFTER = 20  # iterations after which steps are damped
MIN_PAIRED_SHARE = 0.1  # least share of the source in correspondences [1]
MIN_KERNEL_WIDTH = 0.02  # robust kernel's least width: a residual below is never an outlier [m]
DEGENERATE_SHARE = 1e-4  # an eigenvalue under this share of the largest is degenerate [1]


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
    """Point-to-line ICP: register a source point cloud to the walls that a target cloud shows.

    Each round pairs nearest points, drops pairs too far apart or whose walls point elsewhere,
    keeps the share that lies best, weighs it by Cauchy's function and takes a Gauss-Newton step on
    Σ w_i e_i² / c² + δᵀ P⁻¹ δ, with e_i of Equation (13.6), δ the way from the first guess and P
    its covariance, where it has one: along a corridor, which no wall fixes, the guess then stands.
    The longest pair shrinks from round to round. Stops when a step moves no point by the tolerance.

    Parameters
    ----------
    source : (n, 2) points [m]
    target : (m, 2) points [m]
    initial : (3,) initial guess of the source's frame in the target's [m, m, rad]
    tolerance : float [m]
    max_rounds : int, iterations at most
    keep : float, share of the agreeing pairs to fit (trimmed ICP); the others are outliers
    gate : (2,) gate: longest pair in the first and in the last rounds [m]
    normal_gate : float, largest angle between the two walls of a pair [rad]
    trust : (3,) standard deviations of the initial guess as a prior [m, m, rad], or None
    history : bool, keep a Round for the start and after each fit

    Returns
    -------
    Match, its error the mean distance across the walls

    Raises
    ------
    ValueError : fewer than 3 points, wrong shapes, NaN, senseless limits
    """
    source, target, pose = check_clouds(source, target, initial)
    check_limits(tolerance, max_rounds, keep)
    nearest = NearestNeighbours(target)
    n_source, n_target = normals(source), normals(target)
    start, information = pose, np.zeros(3) if trust is None else 1 / np.asarray(trust) ** 2
    reach = np.hypot(*source.T).max()
    rounds_kept, width, verdict = [], max(gate), ""
    for rounds in range(max_rounds + 1):
        moved = transform(pose, source)
        distances, indices = nearest(moved)
        n = n_target[indices]
        agree = _normals_agree(n, n_source, pose[2], normal_gate)
        used = np.flatnonzero((distances <= width) & agree)
        residuals = np.einsum("ij,ij->i", n[used], (moved - target[indices])[used])
        if len(used) < max(3, MIN_PAIRED_SHARE * len(source)):
            verdict = LOST
        elif keep < 1:
            best = np.abs(residuals) <= np.quantile(np.abs(residuals), keep)
            used, residuals = used[best], residuals[best]
        error = float(np.abs(residuals).mean()) if len(used) else np.nan
        if history:
            rounds_kept.append(Round(pose, error, np.column_stack([used, indices[used]])))
        if verdict or rounds == max_rounds:
            break
        c = max(MIN_KERNEL_WIDTH, width / 10, 1.4826 * np.median(np.abs(residuals)))
        guess = pose - start
        guess[2] = wrap(guess[2])
        step = _gauss_newton_step(n[used], moved[used] - pose[:2], residuals, c, information, guess)
        # pairs that flip to and fro would never let it rest: late steps are damped
        step *= 0.9 ** max(0, rounds - DAMP_AFTER)
        pose = np.array([*(pose + step)[:2], wrap(pose[2] + step[2])])
        if width <= min(gate) and np.hypot(*step[:2]) + reach * abs(step[2]) < tolerance:
            verdict = CONVERGED
        width = max(min(gate), 0.8 * width)
    return Match(
        pose,
        rounds,
        error,
        len(used) / len(source),
        verdict == CONVERGED,
        verdict or f"still moving after {rounds} rounds",
        tuple(rounds_kept),
    )


def _normals_agree(n, n_source, turn, limit):
    """Gate by normals: (k,) bool, both are known and, turned, differ by less than the limit.

    A normal has no front: opposite ones count as the same.
    """
    cosine = np.abs(np.einsum("ij,ij->i", n, transform([0.0, 0.0, turn], n_source)))
    with np.errstate(invalid="ignore"):
        return cosine > np.cos(limit)


def _gauss_newton_step(n, arm, residuals, c, information, guess):
    """Gauss-Newton step (dx, dy, dθ) that lowers Σ w e² / c² + δᵀ diag(information) δ.

    Equations (13.7) and (13.8), with Cauchy's weight w = 1 / (1 + (e/c)²). A degenerate
    direction, which neither the walls nor the first guess fix, is left as it was.

    Parameters
    ----------
    n : (k, 2) unit normals
    arm : (k, 2) points seen from the robot, in the target's directions [m]
    residuals : (k,) e, distances across the walls [m]
    c : float, residual at which a pair counts half [m]
    information : (3,) of the first guess [1/m², 1/m², 1/rad²]
    guess : (3,) δ, how far the pose is from the first guess [m, m, rad]

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
    fixed = eigenvalues > DEGENERATE_SHARE * eigenvalues[-1]
    downhill = axes.T @ -(J.T @ (w * residuals) + prior * guess)
    return scale * (axes[:, fixed] @ (downhill[fixed] / eigenvalues[fixed]))
