"""Rounds of Gauss-Newton steps that lay a surface over another from a first guess."""

from dataclasses import dataclass
from math import cos, sin

import numpy as np
from scipy.linalg import lapack

from slamlab.scanmatching.fits import median

SHRINK = 0.7  # the width of what counts as near, from round to round, at most
AGREE = 0.7  # cosine of the largest angle between the walls of a pair
BESIDE = 4.0  # times the spacing: so far along a wall its next point may be
LEAST = 10  # pairs, or a tenth of the points where that is more
UNSEEN = 1e-4  # an eigenvalue below this share of their sum is none
PRETENDED = 3.0  # times the information that the normals' noise makes up: more is real
CALM, SPOT = 10, 0.5  # who got no farther in so many rounds than this share of the noise may rest
UNIT = np.eye(3)
REST = 0.2  # of the standard deviation that noise leaves: a step below it changes nothing


@dataclass
class Pairs:
    """The source's points on the target's lines, at one pose.

    Parameters
    ----------
    pose : (3,) [m, m, rad]
    place : (n,) int, the target's point for each of the source
    seen : (n,) bool, the target was seen there
    use : (n,) bool, seen, both lines known and alike
    ranges : (n,) of the source's points from the target's origin [m]
    residuals : (n,) r, distances across the target's line [m]
    J : (3, n) derivative of r with respect to [x, y, θ reach]: all in metres
    variance : (n,) of r by the noise of both clouds [m²]
    """

    pose: np.ndarray
    place: np.ndarray
    seen: np.ndarray
    use: np.ndarray
    ranges: np.ndarray
    residuals: np.ndarray
    J: np.ndarray
    variance: np.ndarray


def paired(source, target, pose):
    """Lay the source's points on the target's lines.

    r = n · (R p + t − c), with c and n of the line that faces p in the target.

    Parameters
    ----------
    source, target : Surface
    pose : (3,) floats [m, m, rad]

    Returns
    -------
    Pairs
    """
    tx, ty, theta = pose
    c, s = cos(theta), sin(theta)
    arm_x, arm_y = c * source.x - s * source.y, s * source.x + c * source.y
    px, py = arm_x + tx, arm_y + ty
    place, seen = target.facing(px, py)
    fits, own = target.fits, source.fits
    nx, ny = fits.nx[place], fits.ny[place]
    residuals = nx * px + ny * py - fits.offset[place]
    cosine = nx * (c * own.nx - s * own.ny) + ny * (s * own.nx + c * own.ny)
    if not (source.fronts and target.fronts):
        cosine = np.abs(cosine)
    if target.bearings is None:  # beyond a wall's end there is nothing to be laid on
        away = (px - target.x[place]) ** 2 + (py - target.y[place]) ** 2
        seen = away <= (np.abs(residuals) + BESIDE * target.spacing) ** 2
    use = seen & fits.good[place] & own.good & (cosine > AGREE)
    J = np.empty((3, len(px)))
    J[0], J[1], J[2] = nx, ny, (arm_x * ny - arm_y * nx) / source.reach
    variance = fits.across[place] + own.across + (source.sigma**2 + target.sigma**2)
    ranges = np.sqrt(px * px + py * py)
    return Pairs(pose, place, seen, use, ranges, residuals, J, variance)


def align(source, target, pose, rounds, watch=None):
    """Step until the steps are lost in the noise.

    Each round weighs the pairs by w = 1 / (v (1 + (r/c)²)²), v the variance that noise gives r, and
    takes the Gauss-Newton step on Σ w r². The width c follows the residuals down to the noise.

    Parameters
    ----------
    source, target : Surface
    pose : (3,) first guess [m, m, rad]
    rounds : int, at most
    watch : callable(Pairs) or None, called with every look

    Returns
    -------
    Pairs at the last pose; int, rounds done; bool, at rest; float, the last width c; bool, whether
    walls fix every direction
    """
    pose = tuple(map(float, pose))
    noise = np.sqrt(source.sigma**2 + target.sigma**2)
    enough = least(source)
    width, rest, fixed, before = np.inf, False, False, []
    for done in range(rounds + 1):
        pairs = paired(source, target, pose)
        if watch is not None:
            watch(pairs)
        sizes = np.abs(pairs.residuals[pairs.use])
        if rest or done == rounds or len(sizes) < enough:
            return pairs, done, rest, width, fixed
        spread = 1.4826 * median(sizes)
        if done >= CALM:  # what does not settle is not as sharp as its noise: a scan on the move
            noise = max(noise, spread)
        width = max(2 * noise, min(SHRINK * width, 2 * spread))
        w = weights(pairs, width, width < 6 * noise)
        step, fixed = gauss_newton(pairs, w, target)
        before.append(pose)
        pose = pose[0] + step[0], pose[1] + step[1], pose[2] + step[2] / source.reach
        still = way(pose, before[-1], source.reach) < REST * noise / np.sqrt(len(sizes))
        # pairs that flip to and fro keep it moving on the spot; who creeps along a wall gets away
        flips = done >= CALM and way(pose, before[-CALM], source.reach) < SPOT * noise
        rest = (still or flips) and width <= 2.5 * noise + 1.5 * spread
    raise AssertionError("the last round returns")


def way(a, b, reach):
    """The largest of the ways along x, along y and by turning, from pose to pose [m]."""
    return max(abs(a[0] - b[0]), abs(a[1] - b[1]), reach * abs(a[2] - b[2]))


def least(source):
    """How many pairs it takes to go on."""
    return min(max(LEAST, len(source) // 10), len(source))


def weights(pairs, width, fine):
    """w = use / (v (1 + (r/c)²)²); v = 1 as long as the residuals are far above the noise."""
    w = pairs.use / (1 + (pairs.residuals / width) ** 2) ** 2
    return w / pairs.variance if fine else w


def gauss_newton(pairs, w, target):
    """The step that lowers Σ w r², what no wall fixes left as it is.

    Parameters
    ----------
    pairs : Pairs
    w : (n,) weights [1]
    target : Surface

    Returns
    -------
    (3,) step in [x, y, θ reach] [m]; bool, whether every direction is fixed
    """
    JW = pairs.J * w
    A, b = JW @ pairs.J.T, JW @ pairs.residuals
    floor = least_information(pairs, w, target, A[0, 0] + A[1, 1] + A[2, 2])
    # every eigenvalue above the floor: A less the floor is still positive definite
    if lapack.dpotrf(A - floor * UNIT)[1] == 0:
        return -lapack.dposv(A, b)[1], True
    values, axes = np.linalg.eigh(A)
    fixed = values > floor
    return -axes[:, fixed] @ (axes[:, fixed].T @ b / values[fixed]), False


def least_information(pairs, w, target, trace):
    """The eigenvalue below which a direction counts as not fixed by any wall.

    A normal off by ε sees a motion along its wall as sin ε of one across it: the variances of the
    normals, weighed as the pairs are, sum up to information that nobody has.
    """
    return max(UNSEEN * trace, PRETENDED * float(w @ target.fits.tilt[pairs.place]))
