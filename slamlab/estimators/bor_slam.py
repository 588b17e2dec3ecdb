"""Set-membership SLAM (the BOR filter) as an estimator: boxes that hold robot and landmarks."""

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.landmark_observations import observed_landmarks, require_landmarks
from slamlab.filters.bor.bor import BOR
from slamlab.filters.bor.contraction import EmptyIntersection
from slamlab.filters.bor.prediction import odometry
from slamlab.layers import Boxes, Points, Poses
from slamlab.models import noise


class BorSlam(Estimator):
    """Set-membership SLAM by bounding boxes on landmarks: named ones, else corners of scans.

    The pose is the middle of the robot's box. No Gaussian stays inside a bound for ever: the more
    sigmas, the wider the boxes and the later one is broken. An observation whose intersection with
    the map is empty is rejected; from then on the estimate is ``lost``: it guarantees nothing more.

    Parameters
    ----------
    robot : RobotModel, how wrong the odometry is
    sensor : SensorModel, how wrong a range and a bearing are
    rng : numpy.random.Generator, for RANSAC; seed 0 when None
    sigmas : float, above 0, standard deviations that a bound is
    boxes : {id: (4,) x_min, x_max, y_min, y_max}, a map that is known beforehand, or None [m]

    Raises
    ------
    ValueError
    """

    def __init__(self, robot, sensor, rng=None, sigmas=3.0, boxes=None):
        super().__init__()
        if not 0 < sigmas < np.inf:
            raise ValueError(f"sigmas is a number above 0, not {sigmas}")
        self.robot, self.sensor, self.sigmas = robot, sensor, sigmas
        self.rng = np.random.default_rng(0) if rng is None else rng
        # the first pose is where the map's frame is laid: nothing about it is uncertain
        self.filter = BOR(np.zeros(4), np.zeros(2), boxes)
        self.lost = ""
        self.contradictions = 0

    def step(self, reading):
        """Process a reading: predict by odometry, clip by each known landmark, add the new ones.

        Parameters
        ----------
        reading : Reading
        """
        motion = np.asarray(reading.odometry, dtype=float)
        if motion.any():
            self.filter.predict(*odometry(motion, *bounds(motion, self.robot, self.sigmas)))
        found = observed_landmarks(reading, self.sensor, self.rng)
        for z, R, i in zip(found.z, found.R, found.ids.tolist(), strict=True):
            self._update(i, z, self.sigmas * np.sqrt(np.diag(R)), reading.time)
        self.pose = self.filter.pose
        self.record(reading.time)
        self.status = self._status_text()

    def layers(self):
        """Middles and boxes of the landmarks, the trajectory, the robot's box."""
        boxes = self.filter.boxes()
        return [
            Points("landmark", boxes.reshape(-1, 2, 2).mean(axis=2)),
            Boxes("landmark", boxes),
            Poses("corrected", self.trajectory().poses),
            Boxes("robot", self.filter.robot[None]),
        ]

    def _update(self, i, z, bounds, time):
        try:
            if i < 0:
                self.filter.take(z, bounds)
            elif i in self.filter:
                self.filter.update(i, z, bounds)
            else:
                self.filter.add(i, z, bounds)
        except EmptyIntersection as error:
            self.contradictions += 1
            self.lost = self.lost or f"lost at {time:g} s: {error}"

    def _status_text(self):
        counted = f"{len(self.filter)} landmarks, {self.filter.ambiguous} ambiguous observations"
        if not self.lost:
            return counted
        return f"{counted}, {self.contradictions} contradictions; {self.lost}"


def bounds(motion, robot, sigmas):
    """Error bounds of an odometry arc's length and turn: so many standard deviations.

    Parameters
    ----------
    motion : (3,) odometry [m, m, rad]
    robot : RobotModel
    sigmas : float

    Returns
    -------
    (2,) [m, rad]
    """
    u = np.hypot(motion[0], motion[1]), motion[2]
    C = noise.C_odometry(u, robot.distance_error, robot.turn_error, robot.turn_per_metre)
    return sigmas * np.sqrt(np.diag(C + noise.C_wheels(u, robot.slip, robot.base)))


def bor(source):
    """Make the set-membership SLAM (BOR) estimator for a source.

    Parameters
    ----------
    source : Source

    Returns
    -------
    BorSlam

    Raises
    ------
    ValueError : no reading holds landmarks or a scan
    """
    require_landmarks(source, "bor")
    return BorSlam(source.robot, source.sensor)
