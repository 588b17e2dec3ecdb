"""Set-membership SLAM (BOR) with violated error bounds, compared with EKF-SLAM and odometry (lesson
10)."""

from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from course.studies.box_containment import BoundedNoise, BoundedRun
from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.ekf_slam import EkfSlam
from slamlab.estimators.set_membership_slam import SetMembershipSlam, bounds
from slamlab.evaluation.containment import outside
from slamlab.filters.set_membership.bor_filter import BOR
from slamlab.filters.set_membership.contraction import EmptyIntersection
from slamlab.filters.set_membership.half_planes import sector_edges
from slamlab.geometry import between, compose, wrap
from slamlab.models.observation import h
from slamlab.readings import Reading

OUTLIER_STEP = 20  # step in which the error of a range exceeds its bound
SIGMAS_95 = 2.4477  # Mahalanobis radius that contains 95 % of a Gaussian in the plane
SETTLING = 10  # first steps, in which P is nearly zero and NEES is meaningless


def cut_off(d_r, d_abs, r=2.0, n=4000):
    """Return the share of the positions allowed by an observation (bounds d_r [m], d_abs [rad])
    that the observation's four edges would exclude if edges were used for every d_abs."""
    rng = np.random.default_rng(7)
    ranges = np.sqrt(rng.uniform((r - d_r) ** 2, (r + d_r) ** 2, n))  # uniform over the area
    angles = rng.uniform(-d_abs, d_abs, n)
    places = ranges * np.array([np.cos(angles), np.sin(angles)])
    lines = np.array(sector_edges(r, d_r, 0.0, d_abs))
    return float((lines[:, :2] @ places > lines[:, 2:] + 1e-9).any(axis=0).mean())


def one_bad_range(seed, times):
    """Localise in a known map with one range that is too long by ``times`` times its bound.

    Returns the number of steps until the filter reports an empty intersection (or None), and the
    number of steps in which the truth was outside the filter's box.
    """
    run = BoundedRun(BoundedNoise(share=0.5), np.random.default_rng(seed), 2 * OUTLIER_STEP)
    start, (d_r, d_beta) = run.filter(), run.world.seeing
    known = {i: (x, x, y, y) for i, (x, y) in enumerate(run.objects)}
    bor, reported, steps_out, outliers = (
        BOR(start.robot, start.heading, known),
        [],
        0,
        [times * d_r],
    )
    for k, (motion, seen) in enumerate(run):
        bor.predict(*motion)
        for i, (r, bearing) in seen:
            if k >= OUTLIER_STEP and outliers:
                r = float(h(run.pose, run.objects[i])[0]) + outliers.pop()
            try:
                bor.update(i, (r, bearing), (d_r, d_beta))
            except EmptyIntersection:
                reported.append(k - OUTLIER_STEP)
        steps_out += bool(outside(bor, run.pose, run.objects))
    return reported[0] if reported else None, steps_out


def beyond_bounds(run, sigmas):
    """Count the errors of odometry (length and turn) and observations (range and bearing) of a
    LandmarkRun that exceed ``sigmas`` standard deviations; return this count and the total."""
    poses, sensor, errors = run.truth.poses, run.sensor, []
    for k, reading in enumerate(run):
        seen = reading.observations
        v = seen.z - h(poses[k], run.landmarks[seen.ids])
        v[:, 1] = wrap(v[:, 1])
        errors.append(np.abs(v / [sensor.range_sigma, sensor.bearing_sigma]).ravel())
        if k:
            measured, true = map(arc_of, (reading.odometry, between(poses[k - 1], poses[k])))
            errors.append(np.abs(measured - true) / bounds(reading.odometry, run.robot, 1.0))
    errors = np.concatenate(errors)
    return int(np.count_nonzero(errors > sigmas)), len(errors)


def arc_of(motion):
    """Return the length and turn (2,) of an arc from an odometry increment (3,) [m, rad]."""
    half = motion[2] / 2
    return np.array([np.hypot(*motion[:2]) / np.sinc(half / np.pi), motion[2]])


def count_landmarks(seed, add_ambiguous):
    """Count the landmarks in the map after 60 steps in a world of six landmarks without ids.

    An observation that overlaps several boxes adds another landmark (MAK thesis 5.2.10) if
    ``add_ambiguous``; otherwise it is ignored.
    """
    world = BoundedNoise(moving=(0.03, 0.03))
    run = BoundedRun(world, np.random.default_rng(seed), 60)
    bor = run.filter()
    for motion, seen in run:
        bor.predict(*motion)
        for _, z in seen:
            if add_ambiguous and len(bor.overlapping(z, world.seeing)) > 1:
                bor.add(len(bor), z, world.seeing)
                continue
            with suppress(EmptyIntersection):
                bor.associate_and_update(z, world.seeing)
    return len(bor)


@dataclass(frozen=True)
class FilterRun:
    """Results of BOR, EKF-SLAM and odometry on the same readings.

    ``errors`` {"box", "ellipse", "wheels": (n,)} [m]; ``half_side`` of the box (n,) [m];
    ``box_share``, ``ellipse_share``: errors as shares of box and ellipse (n,), NaN in the first
    steps; ``outside`` (n,): whether any true position is outside its box.
    """

    errors: dict
    half_side: np.ndarray
    box_share: np.ndarray
    ellipse_share: np.ndarray
    outside: np.ndarray
    box: SetMembershipSlam
    ellipse: EkfSlam

    def rms(self):
        """Return the root mean square errors by name [m]."""
        return {name: float(np.sqrt(np.mean(e**2))) for name, e in self.errors.items()}


def compare_filters(run, sigmas=3.0, robot=None, bias=0.0):
    """Run BOR and EKF-SLAM on a LandmarkRun with an odometry heading error of ``bias`` per step
    [rad].

    A bound is ``sigmas`` standard deviations of ``robot``.
    """
    robot = run.robot if robot is None else robot
    box, rows = SetMembershipSlam(robot, run.sensor, sigmas=sigmas), []
    for reading, pose in zip(run, run.truth.poses, strict=True):
        box.step(_turned(reading, bias))
        off, half = np.abs(box.pose - pose)[:2], np.diff(box.filter.robot)[::2] / 2
        share = (off / np.maximum(half, 1e-9)).max() if rows else np.nan
        rows.append(
            [np.hypot(*off), half.mean(), share, bool(outside(box.filter, pose, run.landmarks))]
        )
    of_box, half_side, box_share, out = np.transpose(rows)
    of_ellipse, of_wheels, ellipse_share, ellipse = _beside_the_box(run, robot, bias)
    errors = {"box": of_box, "ellipse": of_ellipse, "wheels": of_wheels}
    return FilterRun(errors, half_side, box_share, ellipse_share, out > 0, box, ellipse)


@lru_cache(maxsize=32)  # independent of the box's bounds
def _beside_the_box(run, robot, bias):
    """Return errors of EKF-SLAM and odometry [m], EKF-SLAM's errors as shares, and the EkfSlam."""
    ellipse, wheels, rows = EkfSlam(robot, run.sensor), DeadReckoning(), []
    for reading, pose in zip(run, run.truth.poses, strict=True):
        turned = _turned(reading, bias)
        off = []
        for slam in (ellipse, wheels):
            slam.step(turned)
            off.append((slam.pose - pose)[:2])
        late = len(rows) > SETTLING
        share = _share(off[0], ellipse.filter.block([0, 1])) if late else np.nan
        rows.append([*np.hypot(*np.transpose(off)), share])
    return *np.transpose(rows), ellipse


def _turned(reading, bias):
    if not bias or not reading.odometry.any():
        return reading
    motion = compose(reading.odometry, [0.0, 0.0, bias])
    return Reading(reading.time, motion, None, reading.observations)


def _share(off, P):
    return float(np.sqrt(off @ np.linalg.solve(P, off)) / SIGMAS_95)
