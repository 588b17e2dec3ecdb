"""Scan registration: point-to-line ICP by robust, reweighted Gauss-Newton from an initial guess."""

from math import sqrt

import numpy as np
from scipy.linalg import lapack

from slamlab.scanmatching.correspondences import find_correspondences
from slamlab.scanmatching.local_line_fits import median

KERNEL_SHRINK = 0.7  # factor of the robust kernel's width, from iteration to iteration, at most [1]
MIN_PAIRS = 10  # correspondences, or a tenth of the points where that is more
DEGENERATE_SHARE = 1e-4  # an eigenvalue below this share of their sum is degenerate [1]
SPURIOUS_INFORMATION = 3.0  # times the information that the normals' noise feigns: more is real [1]
# pairs flip: converged when so many iterations moved it by less than this share of the noise
OSCILLATION_ROUNDS, OSCILLATION_STEP = 10, 0.5
RENEWAL_STEP = 0.5  # share of the noise by which the pose moves before pairs are found anew [1]
STEP_TOLERANCE = 0.2  # converged when a step is below this share of the pose's standard deviation


def align(source, target, pose, rounds, callback=None):
    """Align a surface to another: iterate Gauss-Newton until the steps are lost in the noise.

    Each round weighs the pairs by w = 1 / (v (1 + (r/c)²)²), v the variance that noise gives r, and
    takes the Gauss-Newton step on Σ w r², near the end lengthened to Newton's. The width c follows
    the residuals down to the noise. The association is kept as long as the pose moves by less than
    half the noise.

    Parameters
    ----------
    source, target : Surface
    pose : (3,) initial guess [m, m, rad]
    rounds : int, iterations at most
    callback : callable(Pairs) or None, called in every iteration

    Returns
    -------
    Pairs at the last pose; int, rounds done; bool, converged; float, the last kernel width c; bool,
    whether no direction is degenerate
    """
    pose = tuple(map(float, pose))
    noise = sqrt(source.sigma**2 + target.sigma**2)
    required, reach = min_pairs(source), source.reach
    association = associated_at = None
    kernel_width, converged, well_constrained, past_poses = np.inf, False, False, []
    for done in range(rounds + 1):
        if association and step_length(pose, associated_at, reach) > RENEWAL_STEP * noise:
            association = None
        pairs = find_correspondences(source, target, pose, association)
        if association is None:
            association, associated_at = pairs.association, pose
        if callback is not None:
            callback(pairs)
        sizes = np.abs(pairs.residuals[association.used])
        if converged or done == rounds or len(sizes) < required:
            return pairs, done, converged, kernel_width, well_constrained
        spread = 1.4826 * median(sizes)
        if done >= OSCILLATION_ROUNDS:  # residuals above the noise: a scan taken on the move
            noise = max(noise, spread)
        kernel_width = max(2 * noise, min(KERNEL_SHRINK * kernel_width, 2 * spread))
        kernel, fine = robust_kernel(pairs, kernel_width), kernel_width < 6 * noise
        w = robust_weights(pairs, kernel, fine)
        step, well_constrained = gauss_newton_step(pairs, w, target)
        if fine:
            step *= over_relaxation(kernel, w)
        step = step.tolist()  # Python's floats are quicker than numpy's
        past_poses.append(pose)
        pose = pose[0] + step[0], pose[1] + step[1], pose[2] + step[2] / reach
        limit = STEP_TOLERANCE * noise / sqrt(len(sizes))
        small = step_length(pose, past_poses[-1], reach) < limit
        # pairs that flip to and fro keep it moving on the spot; who creeps along a wall gets away
        oscillates = (
            done >= OSCILLATION_ROUNDS
            and step_length(pose, past_poses[-OSCILLATION_ROUNDS], reach) < OSCILLATION_STEP * noise
        )
        converged = (small or oscillates) and kernel_width <= 2.5 * noise + 1.5 * spread
    raise AssertionError("the last round returns")


def step_length(a, b, reach):
    """Step length between two poses: the largest of those along x, along y and by turning [m]."""
    return max(abs(a[0] - b[0]), abs(a[1] - b[1]), reach * abs(a[2] - b[2]))


def min_pairs(source):
    """How many correspondences a registration needs to go on."""
    return min(max(MIN_PAIRS, len(source) // 10), len(source))


def robust_kernel(pairs, kernel_width):
    """Robust kernel q = 1 / (1 + (r/c)²), (n,): one on the line, a half at the kernel's width c."""
    return 1.0 / (1.0 + (pairs.residuals / kernel_width) ** 2)


def robust_weights(pairs, kernel, fine):
    """Robust weights w = used q² / v, (n,); v = 1 while the fit is not fine."""
    w = pairs.association.used * kernel**2
    return w / pairs.association.variance if fine else w


def over_relaxation(kernel, w):
    """Over-relaxation of a reweighted step: how much longer Newton's is, from 1 to 2.

    The reweighted parabola lies above the cost, and bends by Σ w where the cost bends by
    Σ w (4q − 3): alone, its steps come to the minimum by a share of the way each. Since it lies
    above, a step of up to twice its own still descends.

    Parameters
    ----------
    kernel : (n,) q
    w : (n,) weights

    Returns
    -------
    float
    """
    share = (kernel @ w) / max(w.sum(), 1e-300)
    return 1 / max(4 * float(share) - 3, 0.5)


def gauss_newton_step(pairs, w, target):
    """Gauss-Newton step that lowers Σ w r², zero in a degenerate direction.

    Parameters
    ----------
    pairs : Pairs
    w : (n,) weights [1]
    target : Surface

    Returns
    -------
    (3,) step in [x, y, θ reach] [m]; bool, whether no direction is degenerate
    """
    equations = (pairs.J * w) @ pairs.system.T
    A, b = equations[:, :3], equations[:, 3]
    floor = information_floor(pairs, w, target, A[0, 0] + A[1, 1] + A[2, 2])
    if all_above(A, floor):
        return -lapack.dposv(A, b)[1], True
    values, axes = np.linalg.eigh(A)
    axes, values = axes[:, values > floor], values[values > floor]
    return -axes @ (axes.T @ b / values), False


def all_above(A, floor):
    """Whether all eigenvalues of a symmetric A (3, 3) are above a floor.

    A less the floor is positive definite then: its leading minors are above zero (Sylvester).
    """
    (a, b, c), (_, d, e), (_, _, f) = A.tolist()
    a, d, f = a - floor, d - floor, f - floor
    minor = a * d - b * b
    return a > 0 and minor > 0 and minor * f + 2 * b * c * e > a * e * e + d * c * c


def information_floor(pairs, w, target, trace):
    """Threshold of the information matrix's eigenvalues: below it a direction is degenerate.

    A normal off by ε sees a motion along its wall as sin ε of one across it: the variances of the
    normals, weighed as the pairs are, sum up to information that nobody has.
    """
    spurious = float(w @ target.fits.normal_variance[pairs.association.target_index])
    return max(DEGENERATE_SHARE * trace, SPURIOUS_INFORMATION * spurious)
