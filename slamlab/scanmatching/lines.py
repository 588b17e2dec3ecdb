"""ICP point to line: the distance that counts is the one across the wall (Censi 2008)."""

import numpy as np

from slamlab.geometry import transform, wrap
from slamlab.scanmatching.match import Match, Round, checked, limits
from slamlab.scanmatching.nearest import Nearest
from slamlab.scanmatching.normals import normals

STILL = "the steps are below the tolerance"
LOST = "too few pairs agree: too little overlap or too poor a first guess"
ALONG = 1.0  # longest pair along the wall: far points stand wide apart [m]
CALM = 20  # rounds after which steps are damped
LEAST = 0.1  # share of the source that must find pairs


def point_to_line(
    source,
    target,
    initial=(0.0, 0.0, 0.0),
    *,
    tolerance=1e-4,
    max_rounds=60,
    keep=0.9,
    gate=(1.0, 0.1),
    normal_gate=0.7,
    source_normals=None,
    target_normals=None,
    history=False,
):
    """Lay a source cloud over the walls that a target cloud shows.

    Each round pairs nearest points, drops pairs too far apart or whose walls point elsewhere,
    keeps the share that lies best, weighs it by Cauchy's function and takes a Gauss-Newton step on
    Σ w_i (n_i·(R p_i + t − q_i))². The distance allowed across the wall shrinks
    from round to round. Stops when a step moves no point of the source by the tolerance.

    Parameters
    ----------
    source : (n, 2) points [m]
    target : (m, 2) points [m]
    initial : (3,) first guess of the source's frame in the target's [m, m, rad]
    tolerance : float [m]
    max_rounds : int
    keep : float, share of the agreeing pairs to fit
    gate : (2,) longest pair across the wall in the first and in the last rounds [m]
    normal_gate : float, largest angle between the two walls of a pair [rad]
    source_normals, target_normals : (n, 2), (m, 2) where known already; NaN where there is none
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
    n_source = normals(source) if source_normals is None else source_normals
    n_target = normals(target) if target_normals is None else target_normals
    reach = np.hypot(*source.T).max()
    past, width, verdict = [], max(gate), ""
    for rounds in range(max_rounds + 1):
        moved = transform(pose, source)
        distances, indices = nearest(moved)
        n = n_target[indices]
        residuals = np.einsum("ij,ij->i", n, moved - target[indices])
        agree = walls_agree(n, n_source, pose[2], normal_gate)
        agree &= (distances <= ALONG) & (np.abs(residuals) <= width)
        used = np.flatnonzero(agree)
        if len(used) < max(3, LEAST * len(source)):
            verdict = LOST
        elif keep < 1:
            used = used[np.abs(residuals[used]) <= np.quantile(np.abs(residuals[used]), keep)]
        error = float(np.abs(residuals[used]).mean()) if len(used) else np.nan
        if history:
            past.append(Round(pose, error, np.column_stack([used, indices[used]])))
        if verdict or rounds == max_rounds:
            break
        step = gauss_newton(n[used], moved[used] - pose[:2], residuals[used])
        # pairs that flip to and fro would never let it rest: late steps are damped
        step *= 0.9 ** max(0, rounds - CALM)
        pose = np.array([*(pose + step)[:2], wrap(pose[2] + step[2])])
        if width <= min(gate) and np.hypot(*step[:2]) + reach * abs(step[2]) < tolerance:
            verdict = STILL
        width = max(min(gate), 0.7 * width)
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


def gauss_newton(n, arm, residuals, floor=0.005, unseen=1e-3):
    """The step (dx, dy, dθ) that lowers Σ w r², with r's derivative [n_x, n_y, arm × n].

    Cauchy's weight is w = 1 / (1 + (r/c)²), with c from the residuals' median. A direction that
    the walls do not fix, such as along a corridor, is left as it was.

    Parameters
    ----------
    n : (k, 2) unit normals
    arm : (k, 2) points seen from the robot, in the target's directions [m]
    residuals : (k,) distances across the walls [m]
    floor : float, least c [m]
    unseen : float, eigenvalue under this share of the largest counts as not fixed [1]

    Returns
    -------
    (3,) [m, m, rad]
    """
    c = max(floor, 1.4826 * np.median(np.abs(residuals)))
    w = 1 / (1 + (residuals / c) ** 2)
    # angles count as the way a point at the middling distance goes
    reach = max(1e-9, np.sqrt(np.mean(arm**2)))
    J = np.column_stack([n, (arm[:, 0] * n[:, 1] - arm[:, 1] * n[:, 0]) / reach])
    A, b = J.T @ (w[:, None] * J), -J.T @ (w * residuals)
    eigenvalues, axes = np.linalg.eigh(A)
    fixed = eigenvalues > unseen * eigenvalues[-1]
    step = axes[:, fixed] @ ((axes[:, fixed].T @ b) / eigenvalues[fixed])
    return np.array([step[0], step[1], step[2] / reach])
