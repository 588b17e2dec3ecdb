"""EKF-SLAM as an estimator: odometry predicts, landmarks correct, named ones or corners."""

import numpy as np

from slamlab import noise
from slamlab.estimators.base import Estimator
from slamlab.estimators.seen import Names, need_landmarks, seen
from slamlab.filters.association import paired, squared_distances
from slamlab.filters.mak import MAK
from slamlab.geometry import compose, wrap
from slamlab.layers import Ellipses, Points, Poses


class MakSlam(Estimator):
    """The MAK filter on a source's landmarks: those it names, else the corners of its scans.

    A landmark without a name is the nearest one by Mahalanobis distance, if it is inside the gate.

    Parameters
    ----------
    robot : RobotModel, how wrong the odometry is
    sensor : SensorModel, how wrong a range and a bearing are
    first_estimates : bool, take every Jacobian at the first estimate, see :class:`MAK`
    smoothing : float from 0 to below 1, share of the last shown pose that the next one keeps: the
        recursive filter behind the update of the EKF note. The filter's own state is left alone.
    rng : numpy.random.Generator, for RANSAC; seed 0 when None

    Raises
    ------
    ValueError : a smoothing outside
    """

    def __init__(self, robot, sensor, first_estimates=False, smoothing=0.0, rng=None):
        super().__init__()
        if not 0 <= smoothing < 1:
            raise ValueError(f"smoothing is from 0 (none) to below 1, not {smoothing}")
        self.robot, self.sensor, self.smoothing = robot, sensor, smoothing
        # the first pose is where the map's frame is laid: nothing about it is uncertain
        self.filter = MAK(np.zeros(3), np.zeros((3, 3)), first_estimates=first_estimates)
        self.rng = np.random.default_rng(0) if rng is None else rng
        self.names = Names()

    def step(self, reading):
        """Take a reading in: predict by odometry, correct by landmarks, add the new ones.

        Parameters
        ----------
        reading : Reading
        """
        odometry = predict(self.filter, reading, self.robot)
        found = seen(reading, self.sensor, self.rng)
        if len(found.z):
            self._see(found)
        self.pose = self._smoothed(odometry)
        self.record(reading.time)
        self.status = f"{len(self.filter.ids)} landmarks, {self.names.unclear} sightings unclear"

    def layers(self):
        """Landmarks, their 95 % ellipses and the robot's, the track."""
        P_rr, _, P_ii = self.filter.blocks()
        landmarks = self.filter.landmarks()
        return [
            Points("landmark", landmarks),
            Ellipses("landmark", landmarks, P_ii),
            Poses("corrected", self.trajectory().poses),
            Ellipses("robot", self.pose[None, :2], P_rr[None, :2, :2]),
        ]

    def _see(self, found):
        """Correct by the known among the sightings, add the new ones."""
        names = self.names.of(found, self.filter.ids, self._paired)
        known = set(self.filter.ids)
        for take, is_known in ((self.filter.update, True), (self.filter.add, False)):
            ids = [i for i in names if (i in known) == is_known]
            if ids:
                rows = [names[i] for i in ids]
                take(ids, found.z[rows], found.R[rows])

    def _paired(self, z, R):
        return paired(squared_distances(self.filter, z, R))

    def _smoothed(self, odometry):
        """The pose to show: s ← s ⊕ odometry, then (1 − smoothing) of the way to the estimate."""
        back = compose(self.pose, odometry) - self.filter.pose
        back[2] = wrap(back[2])
        shown = self.filter.pose + self.smoothing * back
        shown[2] = wrap(shown[2])
        return shown


def predict(filter, reading, robot):
    """Move a MAK filter by a reading's odometry; standing still changes nothing.

    Parameters
    ----------
    filter : MAK
    reading : Reading
    robot : RobotModel

    Returns
    -------
    (3,) the odometry [m, m, rad]
    """
    pose, odometry = filter.pose, np.asarray(reading.odometry, dtype=float)
    if odometry.any():
        filter.predict(compose(pose, odometry), Q_arc(pose, odometry, robot))
    return odometry


def Q_arc(pose, odometry, robot):
    """Covariance of the pose after an arc whose length and turn are in error: Q = W C Wᵀ.

    An arc's chord points half the turn off the old heading, so a turn in error swings it by half:
    W = [c/d  ½ c⊥; 0  1], c being the chord.

    Parameters
    ----------
    pose : (3,) before [m, m, rad]
    odometry : (3,) motion in the frame of that pose [m, m, rad]
    robot : RobotModel

    Returns
    -------
    (3, 3) [m², m², rad²]
    """
    d, turn = np.hypot(odometry[0], odometry[1]), odometry[2]
    # who turns on the spot and slips goes where the arc would have led
    direction = pose[2] + (np.arctan2(odometry[1], odometry[0]) if d > 0 else turn / 2)
    c, s = np.cos(direction), np.sin(direction)
    W = np.array([[c, -d / 2 * s], [s, d / 2 * c], [0, 1]])
    C = noise.C_odometry((d, turn), robot.distance_error, robot.turn_error, robot.turn_per_metre)
    return noise.Q(W, C + noise.C_wheels((d, turn), robot.slip, robot.base))


def mak(source, first_estimates=False):
    """The MAK estimator for a source, or an error where it has nothing to see.

    Parameters
    ----------
    source : Source
    first_estimates : bool

    Returns
    -------
    MakSlam

    Raises
    ------
    ValueError : no reading holds landmarks or a scan
    """
    need_landmarks(source, "mak")
    return MakSlam(source.robot, source.sensor, first_estimates)
