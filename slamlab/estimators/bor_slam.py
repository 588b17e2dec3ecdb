"""Set-membership SLAM (the BOR filter) as an estimator: boxes that hold robot and landmarks."""

from contextlib import contextmanager

import numpy as np

from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.corner_names import CornerNames
from slamlab.estimators.landmark_observations import require_landmarks
from slamlab.estimators.mak_slam import predict
from slamlab.estimators.sufficiency import box_too_wide, mostly_ambiguous
from slamlab.filters.bor.bor import BOR
from slamlab.filters.bor.contraction import EmptyIntersection
from slamlab.filters.bor.prediction import odometry
from slamlab.filters.mak import MAK
from slamlab.layers import Boxes, Points, Poses
from slamlab.models import noise

BOUNDS = {
    "honest": {"sigmas": 4.5, "way_sigmas": 4.5},
    "tuned": {"sigmas": 1.5, "motion_sigmas": 0.1},
}
"""Bounds by name. Honest ones hold but for a chance: in the arena, 80 drives of some 350 scans, the
way's error went beyond 3.5σ in two, beyond 4.5σ in none. Tuned ones were chosen by results, on
drives that are in no table: errors of many steps add up like a root, bounds as they are, so a tenth
of a step's deviation is near to what many steps come to. They guarantee nothing."""

UNMODELLED = 0.002  # m, by which the way is off besides: turns to and fro in one step, whole ticks


class BorSlam(Estimator):
    """Set-membership SLAM by bounding boxes on landmarks: named ones, else corners of scans.

    The pose is the middle of the robot's box. No Gaussian stays inside a bound for ever: the more
    sigmas, the wider the boxes and the later one is broken. An observation whose intersection with
    the map is empty is rejected; from then on the estimate is ``lost``: it guarantees nothing more.

    Bounds of n steps add up to n times one, errors to √n times. So there is a second prediction:
    the whole way from the start, within ``way_sigmas`` of its own covariance as EKF-SLAM predicts
    it. The box is the intersection of both. Equation (12.5). That bound is honest with a
    probability only: were the pose a Gaussian, each of its numbers would be beyond 3.5 sigmas once
    in two thousand scans.

    Parameters
    ----------
    robot : RobotModel, how wrong the odometry is
    sensor : SensorModel, how wrong a range and a bearing are
    rng : numpy.random.Generator, for RANSAC; seed 0 when None
    sigmas : float, above 0, standard deviations that a bound is
    boxes : {id: (4,) x_min, x_max, y_min, y_max}, a map that is known beforehand, or None [m]
    motion_sigmas : float, the same for a step's odometry; ``sigmas`` when None
    way_sigmas : float, the same for the whole way from the start; unbounded when None
    names : str, who names corners, see :class:`CornerNames`; of a map known beforehand "own"

    Raises
    ------
    ValueError
    """

    def __init__(
        self,
        robot,
        sensor,
        rng=None,
        sigmas=3.0,
        boxes=None,
        motion_sigmas=None,
        way_sigmas=None,
        names="own",
    ):
        super().__init__()
        motion_sigmas = sigmas if motion_sigmas is None else motion_sigmas
        for name, value in (("", sigmas), ("motion_", motion_sigmas), ("way_", way_sigmas)):
            if value is not None and not 0 < value < np.inf:
                raise ValueError(f"{name}sigmas is a number above 0, not {value}")
        if boxes and names != "own":
            raise ValueError('a map known beforehand has names of its own: say names="own"')
        self.robot, self.sensor = robot, sensor
        self.sigmas, self.motion_sigmas, self.way_sigmas = sigmas, motion_sigmas, way_sigmas
        rng = np.random.default_rng(0) if rng is None else rng
        self.names = CornerNames(names, robot, sensor, rng)
        # the first pose is where the map's frame is laid: nothing about it is uncertain
        self.filter = BOR(np.zeros(4), np.zeros(2), boxes)
        self._alone = MAK(np.zeros(3), np.zeros((3, 3)), capacity=0)
        self.lost = ""
        self.contradictions, self._steps, self._seen = 0, 0, 0

    def step(self, reading):
        """Process a reading: predict by odometry, clip by each known landmark, add the new ones.

        Parameters
        ----------
        reading : Reading
        """
        reading = self.usable(reading)
        motion = np.asarray(reading.odometry, dtype=float)
        if motion.any():
            self.filter.predict(*odometry(motion, *bounds(motion, self.robot, self.motion_sigmas)))
            predict(self._alone, reading, self.robot)
        self._steps += 1
        found = self.names.observe(reading)
        if self.way_sigmas is not None:
            with self._watched(reading.time):
                self.filter.restrict(*self._bounds_of_way())
        for z, R, i in zip(found.z, found.R, found.ids.tolist(), strict=True):
            with self._watched(reading.time):
                self._update(i, z, self.sigmas * np.sqrt(np.diag(R)))
        self._seen += len(found.z)
        self.pose = self.filter.pose
        self.record(reading.time)
        self.status = self.status_line(
            counted(len(self.filter), "landmark"), counted(self.ambiguous, "ambiguous observation")
        )

    def layers(self):
        """Middles and boxes of the landmarks, the trajectory, the robot's box."""
        boxes = self.filter.boxes()
        return [
            Points("landmark", boxes.reshape(-1, 2, 2).mean(axis=2)),
            Boxes("landmark", boxes),
            Poses("corrected", self.trajectory().poses),
            Boxes("robot", self.filter.robot[None]),
        ]

    @property
    def ambiguous(self):
        """int, ambiguous observations that were ignored."""
        return self.filter.ambiguous + self.names.ambiguous

    @property
    def warnings(self):
        """What it says where its boxes are broken, or too wide to be of use: list of sentences."""
        lost = [f"{self.lost}, {self.contradictions} contradictions"] if self.lost else []
        return [
            *lost,
            *box_too_wide(self.filter, self._alone, self._steps),
            *mostly_ambiguous(self.ambiguous, self._seen + self.names.ambiguous),
        ]

    def _update(self, i, z, bounds):
        if i < 0:
            self.filter.take(z, bounds)
        elif i in self.filter:
            self.filter.update(i, z, bounds)
        else:
            self.filter.add(i, z, bounds)

    @contextmanager
    def _watched(self, time):
        """Whatever contradicts the boxes is left out, and counted."""
        try:
            yield
        except EmptyIntersection as error:
            self.contradictions += 1
            self.lost = self.lost or f"lost at {time:g} s: {error}"

    def _bounds_of_way(self):
        """Box (4,) and heading (2,) by the whole way from the start, all odometry added up."""
        x, y, theta = self._alone.pose
        off = self.way_sigmas * np.sqrt(np.diag(self._alone.P)) + [UNMODELLED, UNMODELLED, 0.0]
        return (x - off[0], x + off[0], y - off[1], y + off[1]), (theta - off[2], theta + off[2])


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


def bor(source, bounds="honest", names="mak"):
    """Make the set-membership SLAM (BOR) estimator for a source.

    Parameters
    ----------
    source : Source
    bounds : str, one of BOUNDS
    names : str, who names corners, see :class:`CornerNames`

    Returns
    -------
    BorSlam

    Raises
    ------
    ValueError : no reading holds landmarks or a scan, or there are no such bounds
    """
    require_landmarks(source, "bor")
    if bounds not in BOUNDS:
        raise ValueError(f"bounds is {' or '.join(BOUNDS)}, not {bounds!r}")
    return BorSlam(source.robot, source.sensor, names=names, **BOUNDS[bounds])
