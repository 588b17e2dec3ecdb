"""How exercise 16, your own SLAM, is driven: short drives, a new estimator for each."""

from functools import partial

import numpy as np

from slamlab.exercises.drives import Drive, StudentError
from slamlab.exercises.drives.student_estimator import StudentEstimator
from slamlab.geometry import compose
from slamlab.readings import Reading, Scan

NAME = "MySlam"
RANGE_MIN, RANGE_MAX = 0.1, 8.0  # of the lidar [m]
SHORT_RANGE = 5.0  # of the one in the ring, which after a gap sees next to nothing of before [m]
WHEELS_ONLY = "MySlam still believes the wheels alone: its poses are those of odometry"
NO_CLAIM = "MySlam claims no covariance: not attempted yet"
SECONDS = 20.0


def _driven(functions, inputs, range_max=RANGE_MAX):
    """All poses as believed at the end of each drive."""
    found = []
    for odometry, ranges in zip(inputs["odometry"], inputs["ranges"], strict=True):
        estimator, online, _ = _drive(functions[NAME], odometry, ranges, range_max)
        told = estimator.trajectory(len(odometry))
        trajectory = online if told is None else told
        if np.isfinite(trajectory).all():  # else the map can be none, and is not what is wrong
            _look_at_map(estimator)
        if np.allclose(trajectory, by_wheels(odometry), atol=1e-6):
            raise StudentError("not attempted", WHEELS_ONLY)
        found.append(trajectory)
    return {"trajectory": np.array(found)}


def _look_at_map(estimator):
    """Raise StudentError where there is a map, and it is none; it may still be to come."""
    try:
        estimator.map()
    except StudentError as error:
        if error.kind != "not attempted":
            raise


def _claimed(functions, inputs):
    """The pose and the covariance given right after each reading."""
    drives = [
        _drive(functions[NAME], odometry, ranges)[1:]
        for odometry, ranges in zip(inputs["odometry"], inputs["ranges"], strict=True)
    ]
    online, covariances = (np.array(arrays) for arrays in zip(*drives, strict=True))
    if np.isnan(covariances).all():
        raise StudentError("not attempted", NO_CLAIM)
    wheels = [by_wheels(odometry) for odometry in inputs["odometry"]]
    if np.allclose(online, wheels, atol=1e-6):
        raise StudentError("not attempted", WHEELS_ONLY)
    return {"pose": online, "covariance": covariances}


def _drive(make, odometry, ranges, range_max=RANGE_MAX):
    """Drive a new estimator: it, and the poses (n, 3) and P (n, 3, 3) given on the way."""
    estimator, angles = StudentEstimator(make), np.linspace(-np.pi, np.pi, ranges.shape[1] + 1)
    answers = [
        estimator.step(
            Reading(0.5 * k, u.copy(), Scan(angles[:-1], r.copy(), range_max, RANGE_MIN))
        )
        for k, (u, r) in enumerate(zip(odometry, ranges, strict=True))
    ]
    online, covariances = (np.array(arrays) for arrays in zip(*answers, strict=True))
    return estimator, online, covariances


def by_wheels(increments):
    """Where increments of odometry lead from the origin.

    Parameters
    ----------
    increments : (n, 3) [m, m, rad]

    Returns
    -------
    (n, 3)
    """
    poses = [np.zeros(3)]
    for increment in increments:
        poses.append(compose(poses[-1], increment))
    return np.array(poses[1:])


DRIVES = {
    "16-corridor": Drive((NAME,), _driven, SECONDS),
    "16-loop": Drive((NAME,), partial(_driven, range_max=SHORT_RANGE), SECONDS),
    "16-sure": Drive((NAME,), _claimed, SECONDS),
}
