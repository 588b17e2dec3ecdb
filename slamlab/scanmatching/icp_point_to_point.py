"""Point-to-point ICP (iterative closest point): Tuček §3.1 and listing icp.py, mended."""

import numpy as np

from slamlab.geometry import compose, transform
from slamlab.scanmatching.match_result import Match, Round, check_clouds, check_limits
from slamlab.scanmatching.nearest_neighbours import NearestNeighbours


def rigid_fit(source, target):
    """Rigid transformation (Kabsch, by SVD) of paired points with the least sum of squares.

    M = Σ (a_i − ā)(b_i − b̄)ᵀ = U D Vᵀ,  Rot = V diag(1, det V Uᵀ) Uᵀ,  t = b̄ − Rot ā
    (Tuček §3.1 steps 2-4; the diagonal turns the best reflection into the best rotation).
    Equations (13.2), (13.11) and (13.13).

    Parameters
    ----------
    source, target : (k, 2) points, paired by row [m]

    Returns
    -------
    (3,) pose of the source's frame in the target's [m, m, rad]
    """
    a_mean, b_mean = source.mean(axis=0), target.mean(axis=0)
    M = (source - a_mean).T @ (target - b_mean)
    U, _, Vt = np.linalg.svd(M)
    if np.linalg.det(U) * np.linalg.det(Vt) < 0:
        Vt[1] *= -1
    Rot = Vt.T @ U.T
    x, y = b_mean - Rot @ a_mean
    return np.array([x, y, np.arctan2(Rot[1, 0], Rot[0, 0])])


def point_to_point(
    source,
    target,
    initial=(0.0, 0.0, 0.0),
    *,
    tolerance=1e-6,
    max_rounds=500,
    keep=1.0,
    history=False,
):
    """Point-to-point ICP: pair nearest neighbours, fit a rigid transformation, repeat (Tuček §3.1).

    Stops when the mean distance of the pairs changes by less than the tolerance from one round to
    the next, as the thesis' listing does; its text stops on the distance itself. What never grows
    is the sum of squares, (13.5), and not this mean.

    Parameters
    ----------
    source : (n, 2) points [m]
    target : (m, 2) points [m]
    initial : (3,) initial guess of the source's frame in the target's [m, m, rad]
    tolerance : float [m]
    max_rounds : int, iterations at most
    keep : float, share of the pairs to fit, the shortest ones (trimmed ICP); 1 is the thesis' way
    history : bool, keep a Round for the start and after each fit

    Returns
    -------
    Match

    Raises
    ------
    ValueError : fewer than 3 points, wrong shapes, NaN, senseless limits
    """
    source, target, pose = check_clouds(source, target, initial)
    check_limits(tolerance, max_rounds, keep)
    nearest, kept = NearestNeighbours(target), max(3, round(keep * len(source)))
    rounds_kept, last, converged = [], np.inf, False
    for rounds in range(max_rounds + 1):
        moved = transform(pose, source)
        distances, indices = nearest(moved)
        used = _trimmed(distances, kept)
        error = distances[used].mean()
        if history:
            rounds_kept.append(Round(pose, float(error), np.column_stack([used, indices[used]])))
        if converged or rounds == max_rounds:
            break
        converged = bool(abs(last - error) < tolerance)
        last = error
        # the step is seen from the target's frame: it goes onto the left
        pose = compose(rigid_fit(moved[used], target[indices[used]]), pose)
    verdict = "the error stands still" if converged else f"still moving after {rounds} rounds"
    share = len(used) / len(source)
    return Match(pose, rounds, float(error), share, converged, verdict, tuple(rounds_kept))


def _trimmed(distances, count):
    """Trim outliers: (count,) indices of the smallest distances, in order."""
    if count >= len(distances):
        return np.arange(len(distances))
    return np.sort(np.argpartition(distances, count - 1)[:count])
