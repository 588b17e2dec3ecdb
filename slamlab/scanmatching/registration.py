"""Scan registration: point-to-line ICP by Gauss-Newton with a robust kernel (iteratively reweighted
least squares)."""

from math import sqrt

import numpy as np
from scipy.linalg import lapack

from slamlab.scanmatching.correspondences import find_correspondences
from slamlab.scanmatching.quantiles import median

KERNEL_SHRINK = 0.7  # factor of the robust kernel's width, from iteration to iteration, at most [1]
MIN_CORRESPONDENCES = 10  # or a tenth of the points if that is more
DEGENERATE_SHARE = 1e-4  # an eigenvalue below this share of their sum is degenerate [1]
SPURIOUS_INFORMATION = 3.0  # least information, in spurious information by the normals' noise [1]
# oscillation counts as converged: so many iterations moved the pose by less than this share of the
# noise
OSCILLATION_ITERATIONS, OSCILLATION_STEP = 10, 0.5
RENEWAL_STEP = 0.5  # motion of the pose, a share of the noise, before a new data association [1]
STEP_TOLERANCE = 0.2  # converged when a step is below this share of the pose's standard deviation


def align(source, target, pose, iterations, callback=None):
    """Register by Gauss-Newton steps until they are smaller than the noise. The weights w = 1 / (v
    (1 + (r/c)²)²) belong to a Geman-McClure kernel: v is the variance of r, and c decreases with
    the residuals (graduated non-convexity). Returns the last Correspondences, the iterations,
    whether they converged, c, and whether no direction is degenerate. Every iteration calls
    ``callback(Correspondences)``."""
    pose = tuple(map(float, pose))
    noise = sqrt(source.sigma**2 + target.sigma**2)
    required, reach = min_correspondences(source), source.reach
    association = associated_at = None
    kernel_width, converged, well_constrained, past_poses = np.inf, False, False, []
    for done in range(iterations + 1):
        if association and step_length(pose, associated_at, reach) > RENEWAL_STEP * noise:
            association = None
        correspondences = find_correspondences(source, target, pose, association)
        if association is None:
            association, associated_at = correspondences.association, pose
        if callback is not None:
            callback(correspondences)
        sizes = np.abs(correspondences.residuals[association.used])
        if converged or done == iterations or len(sizes) < required:
            return correspondences, done, converged, kernel_width, well_constrained
        robust_sigma = 1.4826 * median(sizes)  # median absolute deviation
        if done >= OSCILLATION_ITERATIONS:  # motion distortion makes residuals above the noise
            noise = max(noise, robust_sigma)
        kernel_width = max(2 * noise, min(KERNEL_SHRINK * kernel_width, 2 * robust_sigma))
        kernel, fine = robust_kernel(correspondences, kernel_width), kernel_width < 6 * noise
        w = robust_weights(correspondences, kernel, fine)
        step, well_constrained = gauss_newton_step(correspondences, w, target)
        if fine:
            step *= over_relaxation(kernel, w)
        step = step.tolist()  # Python's floats are faster than numpy's
        past_poses.append(pose)
        pose = pose[0] + step[0], pose[1] + step[1], pose[2] + step[2] / reach
        limit = STEP_TOLERANCE * noise / sqrt(len(sizes))
        small = step_length(pose, past_poses[-1], reach) < limit
        # alternating correspondences make the pose oscillate; slow convergence does not
        oscillates = (
            done >= OSCILLATION_ITERATIONS
            and step_length(pose, past_poses[-OSCILLATION_ITERATIONS], reach)
            < OSCILLATION_STEP * noise
        )
        converged = (small or oscillates) and kernel_width <= 2.5 * noise + 1.5 * robust_sigma
    raise AssertionError("the last iteration returns")


def step_length(a, b, reach):
    """Return the largest of the steps along x, along y and by rotation (scaled by reach) [m]."""
    return max(abs(a[0] - b[0]), abs(a[1] - b[1]), reach * abs(a[2] - b[2]))


def min_correspondences(source):
    """Return the least number of correspondences of a registration."""
    return min(max(MIN_CORRESPONDENCES, len(source) // 10), len(source))


def robust_kernel(correspondences, kernel_width):
    """Compute the robust kernel q = 1 / (1 + (r/c)²), (n,), of residuals r for the width c."""
    return 1.0 / (1.0 + (correspondences.residuals / kernel_width) ** 2)


def robust_weights(correspondences, kernel, fine):
    """Compute the robust weights w = used q² / v, (n,); v = 1 in the coarse iterations."""
    w = correspondences.association.used * kernel**2
    return w / correspondences.association.variance if fine else w


def over_relaxation(kernel, w):
    """Return the ratio of Newton's step to the reweighted step, from 1 to 2. The second derivative
    of the cost is Σ w (4q − 3), and that of its reweighted majorant is Σ w."""
    share = (kernel @ w) / max(w.sum(), 1e-300)
    return 1 / max(4 * float(share) - 3, 0.5)


def gauss_newton_step(correspondences, w, target):
    """Return the Gauss-Newton step (3,) in [x, y, θ reach] [m] by the normal equations of Σ w r²,
    zero in a degenerate direction, and whether no direction is degenerate."""
    equations = (correspondences.J * w) @ correspondences.system.T
    A, b = equations[:, :3], equations[:, 3]
    floor = information_floor(correspondences, w, target, A[0, 0] + A[1, 1] + A[2, 2])
    if all_above(A, floor):
        return -lapack.dposv(A, b)[1], True
    values, axes = np.linalg.eigh(A)
    axes, values = axes[:, values > floor], values[values > floor]
    return -axes @ (axes.T @ b / values), False


def all_above(A, floor):
    """Whether all eigenvalues of a symmetric A (3, 3) are above a floor: all leading minors of A −
    floor I are positive (Sylvester)."""
    (a, b, c), (_, d, e), (_, _, f) = A.tolist()
    a, d, f = a - floor, d - floor, f - floor
    minor = a * d - b * b
    return a > 0 and minor > 0 and minor * f + 2 * b * c * e > a * e * e + d * c * c


def information_floor(correspondences, w, target, trace):
    """Return the eigenvalue below which a direction is degenerate. If a normal has an error ε, a
    motion along the wall changes the residual by sin ε, which is spurious information."""
    spurious = float(w @ target.fits.normal_variance[correspondences.association.target_index])
    return max(DEGENERATE_SHARE * trace, SPURIOUS_INFORMATION * spurious)
