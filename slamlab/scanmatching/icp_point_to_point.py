"""Point-to-point ICP (iterative closest point): Tuček §3.1 and listing icp.py, corrected."""

import numpy as np

from slamlab.geometry import compose, transform
from slamlab.scanmatching.centroids import Centroids
from slamlab.scanmatching.match_result import Iteration, Match, check_arguments
from slamlab.scanmatching.nearest_neighbours import NearestNeighbours


def rigid_fit(source, target):
    """Align corresponding points rigidly by least squares (Procrustes, Kabsch/Umeyama: SVD).

    M = Σ (a_i − ā)(b_i − b̄)ᵀ = U D Vᵀ,  Rot = V diag(1, det V Uᵀ) Uᵀ,  t = b̄ − Rot ā (Tuček §3.1
    steps 2-4). Equations (13.2), (13.11) and (13.13).

    source, target : (k, 2) corresponding points [m]. Returns the pose (3,) of the source's frame in
    the target's [m, m, rad].
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
    max_iterations=500,
    keep=1.0,
    history=False,
):
    """Point-to-point ICP repeats nearest-neighbour matching and rigid alignment (Tuček §3.1).

    Convergence is tested by the change of the mean distance, as in the thesis' listing, although
    only the sum of squares is guaranteed not to increase, (13.5). Returns a Match. Raises
    ValueError for unusable points or limits.

    Parameters
    ----------
    source, target : (n, 2), (m, 2) points [m]
    initial : (3,) initial guess of the source's frame in the target's [m, m, rad]
    tolerance : float, of the change of the mean distance [m]
    max_iterations : int
    keep : float, share of the correspondences to fit (trimmed ICP); 1 in the thesis [1]
    history : bool, keep an Iteration for the initial guess and each fit
    """
    source, target, pose = check_arguments(source, target, initial, tolerance, max_iterations, keep)
    centres = Centroids.of(source, target)
    source, target, pose = source - centres.source, target - centres.target, centres.inward(pose)
    nearest, kept = NearestNeighbours(target), max(3, round(keep * len(source)))
    iterations_kept, last, converged = [], np.inf, False
    for iterations in range(max_iterations + 1):
        moved = transform(pose, source)
        distances, indices = nearest(moved)
        used = _trimmed(distances, kept)
        error = distances[used].mean()
        if history:
            pairs = np.column_stack([used, indices[used]])
            iterations_kept.append(Iteration(centres.outward(pose), float(error), pairs))
        if converged or iterations == max_iterations:
            break
        converged = bool(abs(last - error) < tolerance)
        last = error
        # the step is in the target's frame: it is composed from the left
        pose = compose(rigid_fit(moved[used], target[indices[used]]), pose)
    verdict = (
        "the error stands still" if converged else f"still moving after {iterations} iterations"
    )
    share = len(used) / len(source)
    pose = centres.outward(pose)
    return Match(pose, iterations, float(error), share, converged, verdict, tuple(iterations_kept))


def _trimmed(distances, count):
    if count >= len(distances):
        return np.arange(len(distances))
    return np.sort(np.argpartition(distances, count - 1)[:count])
