"""Set-membership SLAM (the BOR filter) as an estimator."""

from contextlib import contextmanager

import numpy as np

from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.corner_association import CornerAssociation
from slamlab.estimators.ekf_slam import predict
from slamlab.estimators.estimate_warnings import box_too_wide, mostly_ambiguous
from slamlab.estimators.landmark_observations import require_landmarks_or_scans
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.set_membership.bor_filter import BOR
from slamlab.filters.set_membership.contraction import EmptyIntersection
from slamlab.filters.set_membership.prediction import odometry
from slamlab.layers import Boxes, Points, Poses
from slamlab.models import noise

BOUNDS = {
    "conservative": {"sigmas": 4.5, "accumulated_sigmas": 4.5},
    "tuned": {"sigmas": 1.5, "motion_sigmas": 0.1},
}
"""Error bounds by name. In 80 runs of about 350 scans in the arena, the accumulated odometry error
exceeded 3.5σ in two runs and 4.5σ in none. Tuned bounds guarantee nothing: the standard deviation
of the accumulated error grows with the square root of the number of steps, its bound linearly."""

# further error of the accumulated odometry: turns back and forth in one step, whole ticks [m, rad]
UNMODELLED = np.array([0.002, 0.002, 0.0])


class SetMembershipSlam(Estimator):
    """Set-membership SLAM: bounding boxes contain the source's landmarks or the scans' corners.

    The robot's box is the intersection of two predictions: one proceeds step by step, one from the
    start by the covariance of the accumulated odometry. Equation (12.5). An observation that
    contradicts the map is rejected, and the estimate is ``lost``. Raises ValueError.

    Parameters
    ----------
    robot : RobotModel
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC; seed 0 when None
    sigmas : float, standard deviations in an error bound [1]
    boxes : {id: (4,) x_min, x_max, y_min, y_max}, a known map, or None [m]
    motion_sigmas : float, for a step's odometry; ``sigmas`` when None [1]
    accumulated_sigmas : float, for the odometry since the start; unbounded when None [1]
    association : str, see :class:`CornerAssociation`; with ``boxes`` "own"
    """

    def __init__(
        self,
        robot,
        sensor,
        rng=None,
        sigmas=3.0,
        boxes=None,
        motion_sigmas=None,
        accumulated_sigmas=None,
        association="own",
    ):
        super().__init__()
        motion_sigmas = sigmas if motion_sigmas is None else motion_sigmas
        named = ("", sigmas), ("motion_", motion_sigmas), ("accumulated_", accumulated_sigmas)
        for name, value in named:
            if value is not None and not 0 < value < np.inf:
                raise ValueError(f"{name}sigmas must be a number above 0, not {value}")
        if boxes and association != "own":
            raise ValueError('a known map has its own landmark ids: use association="own"')
        self.robot, self.sensor = robot, sensor
        self.sigmas, self.motion_sigmas = sigmas, motion_sigmas
        self.accumulated_sigmas = accumulated_sigmas
        rng = np.random.default_rng(0) if rng is None else rng
        self.corner_association = CornerAssociation(association, robot, sensor, rng)
        # the first pose defines the map frame, so it is certain
        self.filter = BOR(np.zeros(4), np.zeros(2), boxes)
        self._odometry_only = MAK(np.zeros(3), np.zeros((3, 3)), capacity=0)
        self.lost = ""
        self.contradictions, self._steps, self._seen = 0, 0, 0

    def step(self, reading):
        """Predict by odometry, contract boxes by known landmarks, and initialise new landmarks."""
        reading = self.usable(reading)
        motion = np.asarray(reading.odometry, dtype=float)
        if motion.any():
            self.filter.predict(*odometry(motion, *bounds(motion, self.robot, self.motion_sigmas)))
            predict(self._odometry_only, reading, self.robot)
        self._steps += 1
        found = self.corner_association.observe(reading)
        if self.accumulated_sigmas is not None:
            with self._watched(reading.time):
                off = self.accumulated_sigmas * np.sqrt(np.diag(self._odometry_only.P)) + UNMODELLED
                pose = self._odometry_only.pose
                (x0, y0, theta0), (x1, y1, theta1) = pose - off, pose + off
                self.filter.restrict((x0, x1, y0, y1), (theta0, theta1))
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
        boxes = self.filter.boxes()
        return [
            Points("landmark", boxes.reshape(-1, 2, 2).mean(axis=2)),
            Boxes("landmark", boxes),
            Poses("corrected", self.trajectory().poses),
            Boxes("robot", self.filter.robot[None]),
        ]

    @property
    def ambiguous(self):
        return self.filter.ambiguous + self.corner_association.ambiguous

    @property
    def warnings(self):
        lost = [f"{self.lost}, {self.contradictions} contradictions"] if self.lost else []
        return [
            *lost,
            *box_too_wide(self.filter, self._odometry_only, self._steps),
            *mostly_ambiguous(self.ambiguous, self._seen + self.corner_association.ambiguous),
        ]

    def _update(self, i, z, bounds):
        if i < 0:
            self.filter.associate_and_update(z, bounds)
        elif i in self.filter:
            self.filter.update(i, z, bounds)
        else:
            self.filter.add(i, z, bounds)

    @contextmanager
    def _watched(self, time):
        try:
            yield
        except EmptyIntersection as error:
            self.contradictions += 1
            self.lost = self.lost or f"lost at {time:g} s: {error}"


def bounds(motion, robot, sigmas):
    """Return the error bounds (2,) of the length and turn of an odometry arc [m, rad]."""
    u = np.hypot(motion[0], motion[1]), motion[2]
    C = noise.C_odometry(u, robot.distance_error, robot.turn_error, robot.turn_per_metre)
    return sigmas * np.sqrt(np.diag(C + noise.C_wheels(u, robot.slip, robot.base)))


def bor(source, bounds="conservative", association="ekf"):
    """Return a SetMembershipSlam. Raises ValueError if it cannot use the source or the bounds."""
    require_landmarks_or_scans(source, "bor")
    if bounds not in BOUNDS:
        raise ValueError(f"bounds must be {' or '.join(BOUNDS)}, not {bounds!r}")
    return SetMembershipSlam(source.robot, source.sensor, association=association, **BOUNDS[bounds])
