"""EKF-SLAM (the MAK filter) as an estimator."""

import numpy as np

from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.estimate_warnings import (
    little_better_than_odometry,
    single_landmark,
    uncertainty_wider_than_map,
)
from slamlab.estimators.landmark_observations import (
    DataAssociation,
    correct_or_add,
    observed_landmarks,
    require_landmarks_or_scans,
)
from slamlab.filters.data_association import (
    compatible_corners,
    gated_nearest_neighbours,
    squared_distances,
)
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.geometry import compose, wrap
from slamlab.layers import Ellipses, Points, Poses
from slamlab.models import noise
from slamlab.models.observation import g

# a new corner closer to a known one is a duplicate; larger for compatible corners, which appear
# beside the known one if the pose error is large [m]
DUPLICATE_CORNER_DISTANCE, DUPLICATE_COMPATIBLE_DISTANCE = 0.08, 0.2


class EkfSlam(Estimator):
    """EKF-SLAM with point landmarks: those of the source, or corners of its scans.

    Points are associated with the nearest landmark, corners with the nearest compatible landmark.
    Raises ValueError.

    Parameters
    ----------
    robot : RobotModel
    sensor : SensorModel
    first_estimates : bool, see :class:`MAK`
    smoothing : float in [0, 1), exponential smoothing of the displayed pose [1]
    landmark_smoothing : float in [0, 1), exponential smoothing of displayed landmarks [1]
    rng : numpy.random.Generator, for RANSAC; seed 0 when None
    """

    def __init__(
        self, robot, sensor, first_estimates=False, smoothing=0.0, rng=None, landmark_smoothing=0.0
    ):
        super().__init__()
        for share in (smoothing, landmark_smoothing):
            if not 0 <= share < 1:
                raise ValueError(f"smoothing must be from 0 (none) to below 1, not {share}")
        self.robot, self.sensor, self.smoothing = robot, sensor, smoothing
        self.landmark_smoothing = landmark_smoothing
        self._shown: dict[int, np.ndarray] = {}  # smoothed landmarks
        # the first pose defines the map frame, so it is certain
        self.filter = MAK(np.zeros(3), np.zeros((3, 3)), first_estimates=first_estimates)
        self._odometry_only, self._steps = MAK(np.zeros(3), np.zeros((3, 3)), capacity=0), 0
        self.rng = np.random.default_rng(0) if rng is None else rng
        self.association = DataAssociation()
        self.observations, self.associated = None, {}  # of the last reading, {id: row of them}
        self._openings = {}  # first observation of each corner: bisector in the map, whether convex

    def step(self, reading):
        """Predict by odometry, correct by known landmarks, and add new landmarks to the state."""
        reading = self.usable(reading)
        odometry = predict(self.filter, reading, self.robot)
        predict(self._odometry_only, reading, self.robot)
        self._steps += 1
        self.observations = observed_landmarks(reading, self.sensor, self.rng)
        self.associated = {}
        if len(self.observations.z):
            self._correct(self.observations)
        self.pose = self._smoothed(odometry)
        if self.landmark_smoothing:
            self._smooth_landmarks()
        self.record(reading.time)
        landmarks, ambiguous = len(self.filter.ids), self.association.ambiguous
        self.status = self.status_line(
            counted(landmarks, "landmark"), counted(ambiguous, "ambiguous observation")
        )

    @property
    def warnings(self):
        P = self.filter.block([0, 1])
        return [
            *little_better_than_odometry(P, self._odometry_only, self._steps),
            *single_landmark(self.filter.landmarks(), self._steps),
            *uncertainty_wider_than_map(P, self.filter.landmarks(), self._steps),
        ]

    def layers(self):
        P_rr, _, P_ii = self.filter.blocks()
        landmarks = self.landmarks()
        return [
            Points("landmark", landmarks),
            Ellipses("landmark", landmarks, P_ii),
            Poses("corrected", self.trajectory().poses),
            Ellipses("robot", self.pose[None, :2], P_rr[None, :2, :2]),
        ]

    def landmarks(self):
        """Return the displayed landmarks (N, 2) [m], in the order of the filter's ids."""
        estimates = zip(self.filter.ids, self.filter.landmarks(), strict=True)
        return np.reshape([self._shown.get(i, p) for i, p in estimates], (-1, 2))

    def _correct(self, observations):
        ids = self.filter.ids
        self.associated = self.association.associate(observations, ids, self._associate)
        correct_or_add(self.filter, self.associated, observations)
        if observations.bisectors is not None:
            absolute = observations.bisectors + self.filter.pose[2]
            for i, k in self.associated.items():
                self._openings.setdefault(i, (absolute[k], observations.convex[k]))

    def _associate(self, seen):
        """Associate observations with landmarks by the validation gate."""
        d2 = squared_distances(self.filter, seen.z, seen.R)
        if seen.bisectors is None:
            return gated_nearest_neighbours(d2)
        known = [self._openings.get(i, (np.nan, False)) for i in self.filter.ids]
        bisectors, convex = np.reshape(known, (-1, 2)).T
        absolute = seen.bisectors + self.filter.pose[2]
        compatible = compatible_corners(absolute, seen.convex, bisectors, convex)
        d2[~compatible] = np.inf
        pairs, new = gated_nearest_neighbours(d2)
        off = g(self.filter.pose, seen.z)[:, None] - self.filter.landmarks()
        least = np.where(compatible, DUPLICATE_COMPATIBLE_DISTANCE, DUPLICATE_CORNER_DISTANCE)
        duplicate = least > np.hypot(*off.T).T
        return pairs, [k for k in new if not duplicate[k].any()]

    def _smoothed(self, odometry):
        """Return the displayed pose s: s ← s ⊕ odometry, then moved towards the estimate by
        (1 − smoothing) times their difference. Equation (06.10)."""
        back = compose(self.pose, odometry) - self.filter.pose
        back[2] = wrap(back[2])
        shown = self.filter.pose + self.smoothing * back
        shown[2] = wrap(shown[2])
        return shown

    def _smooth_landmarks(self):
        estimates = dict(zip(self.filter.ids, self.filter.landmarks(), strict=True))
        keep = self.landmark_smoothing
        self._shown = {i: p + keep * (self._shown.get(i, p) - p) for i, p in estimates.items()}


def predict(filter, reading, robot):
    """Predict a MAK filter by the odometry (3,) of a reading, and return this odometry."""
    pose, odometry = filter.pose, np.asarray(reading.odometry, dtype=float)
    if odometry.any():
        filter.predict(compose(pose, odometry), Q_arc(pose, odometry, robot))
    return odometry


def Q_arc(pose, odometry, robot):
    """Compute Q (3, 3) of an odometry arc (3,) [m, m, rad] whose length and turn have errors:
    Q = W C Wᵀ, W = [c/d  ½ c⊥; 0  1] for the chord c, at half the turn from the heading."""
    d, turn = np.hypot(odometry[0], odometry[1]), odometry[2]
    # wheel slip during a turn on the spot moves the robot along the chord
    direction = pose[2] + (np.arctan2(odometry[1], odometry[0]) if d > 0 else turn / 2)
    c, s = np.cos(direction), np.sin(direction)
    W = np.array([[c, -d / 2 * s], [s, d / 2 * c], [0, 1]])
    C = noise.C_odometry((d, turn), robot.distance_error, robot.turn_error, robot.turn_per_metre)
    return noise.Q(W, C + noise.C_wheels((d, turn), robot.slip, robot.base))


def mak(source, first_estimates=False, smoothing=0.0):
    """Return an EkfSlam for a source. Raises ValueError without landmarks and scans."""
    require_landmarks_or_scans(source, "mak")
    return EkfSlam(source.robot, source.sensor, first_estimates, smoothing)
