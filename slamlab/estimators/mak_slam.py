"""EKF-SLAM (the MAK filter) as an estimator: odometry predicts, landmarks correct."""

import numpy as np

from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.landmark_observations import (
    DataAssociation,
    observed_landmarks,
    require_landmarks,
)
from slamlab.estimators.sufficiency import hardly_surer, single_landmark, wider_than_map
from slamlab.filters.data_association import (
    compatible_corners,
    gated_nearest_neighbours,
    squared_distances,
)
from slamlab.filters.mak import MAK
from slamlab.geometry import compose, wrap
from slamlab.layers import Ellipses, Points, Poses
from slamlab.models import noise
from slamlab.models.observation import g

CLOSEST_CORNERS = 0.08  # m, from a known corner within which another is held for a phantom of it
# the same of one that opens alike: it is the known one, seen by who is farther off than sure
CLOSEST_ALIKE = 0.2  # m


class MakSlam(Estimator):
    """EKF-SLAM with point landmarks: those the source names, else the corners of its scans.

    Data association without names: the nearest landmark by Mahalanobis distance, inside the gate;
    of corners the nearest that opens alike, see :func:`compatible_corners`.

    Parameters
    ----------
    robot : RobotModel, how wrong the odometry is
    sensor : SensorModel, how wrong a range and a bearing are
    first_estimates : bool, take every Jacobian at the first estimate, see :class:`MAK`
    smoothing : float from 0 to below 1, share of the last shown pose that the next one keeps: the
        recursive filter behind the update of the EKF note. The filter's own state is left alone.
    landmark_smoothing : float from 0 to below 1, the same of each shown landmark
    rng : numpy.random.Generator, for RANSAC; seed 0 when None

    Raises
    ------
    ValueError : a smoothing outside
    """

    def __init__(
        self, robot, sensor, first_estimates=False, smoothing=0.0, rng=None, landmark_smoothing=0.0
    ):
        super().__init__()
        for share in (smoothing, landmark_smoothing):
            if not 0 <= share < 1:
                raise ValueError(f"smoothing is from 0 (none) to below 1, not {share}")
        self.robot, self.sensor, self.smoothing = robot, sensor, smoothing
        self.landmark_smoothing = landmark_smoothing
        self._shown: dict[int, np.ndarray] = {}  # landmarks, where they are smoothed
        # the first pose is where the map's frame is laid: nothing about it is uncertain
        self.filter = MAK(np.zeros(3), np.zeros((3, 3)), first_estimates=first_estimates)
        self._alone, self._steps = MAK(np.zeros(3), np.zeros((3, 3)), capacity=0), 0
        self.rng = np.random.default_rng(0) if rng is None else rng
        self.association = DataAssociation()
        self.observations, self.named = None, {}  # of the last reading, {id: row of them}
        self._openings = {}  # of each corner when first seen: bisector in the map, whether convex

    def step(self, reading):
        """Process a reading: predict by odometry, correct by known landmarks, augment by new ones.

        Parameters
        ----------
        reading : Reading
        """
        reading = self.usable(reading)
        odometry = predict(self.filter, reading, self.robot)
        predict(self._alone, reading, self.robot)
        self._steps += 1
        self.observations = observed_landmarks(reading, self.sensor, self.rng)
        self.named = {}
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
        """What it says where its landmarks correct hardly anything: list of sentences."""
        P = self.filter.block([0, 1])
        return [
            *hardly_surer(P, self._alone, self._steps),
            *single_landmark(self.filter.landmarks(), self._steps),
            *wider_than_map(P, self.filter.landmarks(), self._steps),
        ]

    def layers(self):
        """Landmarks and robot with their 95 % covariance ellipses, the trajectory."""
        P_rr, _, P_ii = self.filter.blocks()
        landmarks = self.landmarks()
        return [
            Points("landmark", landmarks),
            Ellipses("landmark", landmarks, P_ii),
            Poses("corrected", self.trajectory().poses),
            Ellipses("robot", self.pose[None, :2], P_rr[None, :2, :2]),
        ]

    def landmarks(self):
        """(N, 2) landmarks to show, in the order of the filter's ids: estimates, smoothed [m]."""
        estimates = zip(self.filter.ids, self.filter.landmarks(), strict=True)
        return np.reshape([self._shown.get(i, p) for i, p in estimates], (-1, 2))

    def _correct(self, observations):
        """Update by observations of known landmarks, augment the state by new ones."""
        self.named = rows = self.association.associate(
            observations, self.filter.ids, self._associate
        )
        known = set(self.filter.ids)
        for correct_or_add, is_known in ((self.filter.update, True), (self.filter.add, False)):
            ids = [i for i in rows if (i in known) == is_known]
            if ids:
                k = [rows[i] for i in ids]
                correct_or_add(ids, observations.z[k], observations.R[k])
        if observations.bisectors is not None:
            absolute = observations.bisectors + self.filter.pose[2]
            for i, k in rows.items():
                self._openings.setdefault(i, (absolute[k], observations.convex[k]))

    def _associate(self, seen):
        """Nearest neighbours; of corners only among those that open alike."""
        d2 = squared_distances(self.filter, seen.z, seen.R)
        if seen.bisectors is None:
            return gated_nearest_neighbours(d2)
        known = [self._openings.get(i, (np.nan, False)) for i in self.filter.ids]
        bisectors, convex = np.reshape(known, (-1, 2)).T
        absolute = seen.bisectors + self.filter.pose[2]
        alike = compatible_corners(absolute, seen.convex, bisectors, convex)
        d2[~alike] = np.inf
        pairs, new = gated_nearest_neighbours(d2)
        off = g(self.filter.pose, seen.z)[:, None] - self.filter.landmarks()
        least = np.where(alike, CLOSEST_ALIKE, CLOSEST_CORNERS)
        crowded = least > np.hypot(*off.T).T
        return pairs, [k for k in new if not crowded[k].any()]

    def _smoothed(self, odometry):
        """The pose to show: s ← s ⊕ odometry, then (1 − smoothing) of the way to the estimate.

        Equation (06.10).
        """
        back = compose(self.pose, odometry) - self.filter.pose
        back[2] = wrap(back[2])
        shown = self.filter.pose + self.smoothing * back
        shown[2] = wrap(shown[2])
        return shown

    def _smooth_landmarks(self):
        """The landmarks to show: (1 − smoothing) of the way to the estimate; new ones are there."""
        estimates = dict(zip(self.filter.ids, self.filter.landmarks(), strict=True))
        keep = self.landmark_smoothing
        self._shown = {i: p + keep * (self._shown.get(i, p) - p) for i, p in estimates.items()}


def predict(filter, reading, robot):
    """Predict a MAK filter by a reading's odometry increment; standing still changes nothing.

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
    """Process noise of odometry: covariance of an arc in error by length and turn, Q = W C Wᵀ.

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


def mak(source, first_estimates=False, smoothing=0.0):
    """Make the EKF-SLAM (MAK) estimator for a source.

    Parameters
    ----------
    source : Source
    first_estimates : bool
    smoothing : float

    Returns
    -------
    MakSlam

    Raises
    ------
    ValueError : no reading holds landmarks or a scan
    """
    require_landmarks(source, "mak")
    return MakSlam(source.robot, source.sensor, first_estimates, smoothing)
