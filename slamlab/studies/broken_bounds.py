"""BOR beyond its conditions, and beside EKF-SLAM and the wheels: the experiments of lesson 10."""

from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from slamlab.estimators.bor_slam import BorSlam
from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.mak_slam import MakSlam
from slamlab.filters.bor.bor import BOR
from slamlab.filters.bor.contraction import EmptyIntersection
from slamlab.filters.bor.half_planes import sector_edges
from slamlab.geometry import compose
from slamlab.readings import Reading
from slamlab.studies.boxes import BoundedNoise, BoundedRun, outside

LIE_AT = 20  # step in which a range is off by more than its bound
SIGMAS_95 = 2.4477  # that many deviations hold 95 % of a Gaussian in the plane
SETTLING = 10  # first steps, of which P is nearly zero and tells nothing


def cut_off(d_r, d_abs, r=2.0, n=4000):
    """Share of the places that a sighting allows, but its four edges, drawn at any d_abs, do not.

    Parameters
    ----------
    d_r, d_abs : float, bounds of the range and of the absolute bearing [m, rad]
    r : float, range [m]
    n : int, places tried

    Returns
    -------
    float [1]
    """
    rng = np.random.default_rng(7)
    ranges, angles = rng.uniform(r - d_r, r + d_r, n), rng.uniform(-d_abs, d_abs, n)
    places = ranges * np.array([np.cos(angles), np.sin(angles)])
    lines = np.array(sector_edges(r, d_r, 0.0, d_abs))
    return float((lines[:, :2] @ places > lines[:, 2:] + 1e-9).any(axis=0).mean())


def one_bad_range(seed, times):
    """A robot with a known map, one of whose ranges is off by some times its bound.

    Parameters
    ----------
    seed : int
    times : float, how many bounds that range is too long

    Returns
    -------
    int or None, steps until a contradiction is reported; bool, whether the truth was ever outside
    """
    run = BoundedRun(BoundedNoise(share=0.5), np.random.default_rng(seed), 2 * LIE_AT)
    start, (d_r, d_beta) = run.filter(), run.world.seeing
    known = {i: (x, x, y, y) for i, (x, y) in enumerate(run.objects)}
    bor, reported, ever_out, lies = BOR(start.robot, start.heading, known), [], False, [times * d_r]
    for k, (motion, seen) in enumerate(run):
        bor.predict(*motion)
        for i, (r, bearing) in seen:
            lie = lies.pop() if k >= LIE_AT and lies else 0.0
            try:
                bor.update(i, (r + lie, bearing), (d_r, d_beta))
            except EmptyIntersection:
                reported.append(k - LIE_AT)
        ever_out |= bool(outside(bor, run.pose, run.objects))
    return reported[0] if reported else None, ever_out


def objects_made(seed, several_are_new):
    """Objects in the map of a robot among six that nobody names, after 60 steps.

    Parameters
    ----------
    seed : int
    several_are_new : bool, whether a sighting that overlaps several objects adds another one, as
        in MAK thesis 5.2.10; else it is ignored

    Returns
    -------
    int
    """
    world = BoundedNoise(moving=(0.03, 0.03))
    run = BoundedRun(world, np.random.default_rng(seed), 60)
    bor = run.filter()
    for motion, seen in run:
        bor.predict(*motion)
        for _, z in seen:
            if several_are_new and len(bor.overlapping(z, world.seeing)) > 1:
                bor.add(len(bor), z, world.seeing)
                continue
            with suppress(EmptyIntersection):
                bor.take(z, world.seeing)
    return len(bor)


@dataclass(frozen=True)
class Race:
    """BOR, EKF-SLAM and the wheels alone over the same readings.

    Parameters
    ----------
    errors : {"box", "ellipse", "wheels": (n,)} how far the position is off [m]
    half_side : (n,) mean half side of the robot's box [m]
    box_share, ellipse_share : (n,) by how much of its claim the position is off, above 1 outside;
        NaN at first, where the claim is nearly zero
    outside : (n,) bool, whether anything true is outside its box
    box, ellipse : BorSlam, MakSlam at the end
    """

    errors: dict
    half_side: np.ndarray
    box_share: np.ndarray
    ellipse_share: np.ndarray
    outside: np.ndarray
    box: BorSlam
    ellipse: MakSlam

    def rms(self):
        """Root mean squares of the errors by name [m]."""
        return {name: float(np.sqrt(np.mean(e**2))) for name, e in self.errors.items()}


def race(run, sigmas=3.0, robot=None, bias=0.0):
    """Run box and ellipse over the readings of a run, whose odometry may turn too far.

    Parameters
    ----------
    run : LandmarkRun
    sigmas : float, standard deviations that a bound of the box is
    robot : RobotModel that both are told, the run's own when None
    bias : float, added to the turn of every step [rad]

    Returns
    -------
    Race
    """
    robot = run.robot if robot is None else robot
    box, rows = BorSlam(robot, run.sensor, sigmas=sigmas), []
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
    return Race(errors, half_side, box_share, ellipse_share, out > 0, box, ellipse)


@lru_cache(maxsize=32)  # the same beside a box of any bounds
def _beside_the_box(run, robot, bias):
    """Errors of ellipse and wheels [m], how much of its claim the ellipse is off, and MakSlam."""
    ellipse, wheels, rows = MakSlam(robot, run.sensor), DeadReckoning(), []
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
