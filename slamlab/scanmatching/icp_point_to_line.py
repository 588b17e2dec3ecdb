"""Point-to-line ICP (iterative closest point), PLICP (2008); in 3-D, point-to-plane ICP."""

import numpy as np

from slamlab.geometry import transform, wrap
from slamlab.scanmatching.centroids import Centroids
from slamlab.scanmatching.match_result import Iteration, Match, check_arguments
from slamlab.scanmatching.nearest_neighbours import NearestNeighbours
from slamlab.scanmatching.normals import normals
from slamlab.scanmatching.quantiles import median

# verdicts of a match
CONVERGED = "the steps are below the tolerance"
LOST = "too few correspondences: too little overlap, or a poor initial guess"
DAMP_AFTER = 20  # iterations after which steps are damped
MIN_MATCHED_SHARE = 0.1  # least share of source points with a correspondence [1]
MIN_KERNEL_WIDTH = 0.02  # robust kernel's least width: a smaller residual is no outlier [m]
MAX_RANGE_FACTOR = 100.0  # ranges are limited to so many median ranges [1]
DEGENERATE_SHARE = 1e-4  # an eigenvalue under this share of the largest is degenerate [1]


def point_to_line(
    source,
    target,
    initial=(0.0, 0.0, 0.0),
    *,
    tolerance=1e-4,
    max_iterations=60,
    keep=1.0,
    gate=(1.0, 0.1),
    normal_gate=0.7,
    prior_sigmas=None,
    history=False,
):
    """Point-to-line ICP: register a source point cloud to the walls of a target cloud.

    Each iteration finds correspondences (nearest neighbours inside shrinking gates) and makes a
    Gauss-Newton step on the cost Σ w_i e_i² / c² + δᵀ P⁻¹ δ, with e_i of Equation (13.6), Cauchy's
    robust kernel w_i, the difference δ from the initial guess, and its covariance P. Returns a
    Match whose error is the mean point-to-line distance. Raises ValueError for unusable points or
    limits.

    Parameters
    ----------
    source, target : (n, 2), (m, 2) points [m]
    initial : (3,) initial guess of the source's frame in the target's [m, m, rad]
    tolerance : float, of the largest motion of a point [m]
    max_iterations : int
    keep : float, share of the correspondences to fit (trimmed ICP) [1]
    gate : (2,) largest distance of a correspondence in the first and the last iterations [m]
    normal_gate : float, largest angle between the normals of a correspondence [rad]
    prior_sigmas : (3,) standard deviations of the initial guess [m, m, rad], or None; for clouds
        far from the origin, of the source's centroid
    history : bool, keep an Iteration for the initial guess and each step
    """
    source, target, pose = check_arguments(source, target, initial, tolerance, max_iterations, keep)
    centres = Centroids.of(source, target)
    source, target, pose = source - centres.source, target - centres.target, centres.inward(pose)
    nearest = NearestNeighbours(target)
    n_source, n_target = normals(source), normals(target)
    start = pose
    information = np.zeros(3) if prior_sigmas is None else 1 / np.asarray(prior_sigmas) ** 2
    ranges = np.hypot(*source.T)
    reach = min(ranges.max(), MAX_RANGE_FACTOR * median(ranges))
    iterations_kept, width, verdict = [], max(gate), ""
    for iterations in range(max_iterations + 1):
        moved = transform(pose, source)
        distances, indices = nearest(moved)
        n = n_target[indices]
        agree = _normals_agree(n, n_source, pose[2], normal_gate)
        used = np.flatnonzero((distances <= width) & agree)
        residuals = np.einsum("ij,ij->i", n[used], (moved - target[indices])[used])
        if len(used) < max(3, MIN_MATCHED_SHARE * len(source)):
            verdict, pose = LOST, np.array([*pose[:2], wrap(pose[2])])
        elif keep < 1:
            best = np.abs(residuals) <= np.quantile(np.abs(residuals), keep)
            used, residuals = used[best], residuals[best]
        error = float(np.abs(residuals).mean()) if len(used) else np.nan
        if history:
            pairs = np.column_stack([used, indices[used]])
            iterations_kept.append(Iteration(centres.outward(pose), error, pairs))
        if verdict or iterations == max_iterations:
            break
        c = max(MIN_KERNEL_WIDTH, width / 10, 1.4826 * np.median(np.abs(residuals)))
        guess = pose - start
        guess[2] = wrap(guess[2])
        step = _gauss_newton_step(n[used], moved[used] - pose[:2], residuals, c, information, guess)
        # alternating correspondences can prevent convergence: late steps are damped
        step *= 0.9 ** max(0, iterations - DAMP_AFTER)
        pose = np.array([*(pose + step)[:2], wrap(pose[2] + step[2])])
        if width <= min(gate) and np.hypot(*step[:2]) + reach * abs(step[2]) < tolerance:
            verdict = CONVERGED
        width = max(min(gate), 0.8 * width)
    return Match(
        centres.outward(pose),
        iterations,
        error,
        len(used) / len(source),
        verdict == CONVERGED,
        verdict or f"still moving after {iterations} iterations",
        tuple(iterations_kept),
    )


def _normals_agree(n, n_source, turn, limit):
    """Return (k,) whether both normals are known and, after rotation, parallel up to the limit."""
    cosine = np.abs(np.einsum("ij,ij->i", n, transform([0.0, 0.0, turn], n_source)))
    with np.errstate(invalid="ignore"):
        return cosine > np.cos(limit)


def _gauss_newton_step(n, arm, residuals, c, information, guess):
    """Compute a Gauss-Newton step (dx, dy, dθ) by the normal equations of Σ w e² / c² + δᵀ
    diag(information) δ, Equations (13.7) and (13.8), w = 1 / (1 + (e/c)²); zero in an unconstrained
    direction. ``arm`` (k, 2): points relative to the robot, rotated to the target's frame."""
    w = 1 / (1 + (residuals / c) ** 2)
    # rotation is scaled to metres by the root mean square distance
    scale = np.array([1, 1, 1 / max(1e-9, np.sqrt(np.mean(arm**2)))])
    J = np.column_stack([n, arm[:, 0] * n[:, 1] - arm[:, 1] * n[:, 0]]) * scale
    prior = c**2 * information * scale
    A = J.T @ (w[:, None] * J) + np.diag(prior * scale)
    eigenvalues, axes = np.linalg.eigh(A)
    fixed = eigenvalues > DEGENERATE_SHARE * eigenvalues[-1]
    descent = axes.T @ -(J.T @ (w * residuals) + prior * guess)
    return scale * (axes[:, fixed] @ (descent[fixed] / eigenvalues[fixed]))
