"""EKF-SLAM of Smolec's thesis: the landmarks are the foot points of walls, that is, the closest
points of the walls' lines to the world's origin."""

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.ekf_slam import predict as predict_by_odometry
from slamlab.estimators.estimate_warnings import (
    contradicts_odometry,
    little_better_than_odometry,
    mostly_unknown_walls,
    uncertainty_wider_than_map,
)
from slamlab.estimators.foot_point_corrections import checked
from slamlab.estimators.foot_point_formulas import R_foot_points, make_filter, predict
from slamlab.estimators.wall_slam import UNKNOWN_WALLS_ONLY
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.geometry import transform
from slamlab.landmarks.downsampling import DownsampledPoints
from slamlab.landmarks.line_fitting import total_least_squares
from slamlab.landmarks.ransac import THESIS, lines
from slamlab.landmarks.thesis_line_extraction import ordinary_least_squares, sampled_lines
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.models.observation import g_line, h

ASSOCIATION_DISTANCE = 0.5  # LANDMARKOFFSET: a foot point farther from all landmarks is new [m]
SAMPLES = 40  # RANSAC_SAMPLE: random points of a scan at which a line is fitted
START = np.diag([0.01, 0.01, np.radians(1)]) ** 2  # initial P, as printed
MIN_RANGE = 0.05  # a foot point nearer to the robot has no useful bearing [m]


class FootPointSlam(Estimator):
    """EKF-SLAM with foot points of walls, as printed by Smolec or corrected
    (:mod:`slamlab.estimators.foot_point_corrections`).

    A foot point is a pseudo-observation: it is computed from the estimated pose, but treated as
    measured. A landmark is initialised at its first observation. It becomes a confirmed landmark,
    which corrects the pose, at its N-th observation (5 in the thesis). Raises ValueError.

    Parameters
    ----------
    robot : RobotModel
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    ransac : Ransac; region growing needs the corrections "distinct-lines" and "orthogonal-fit"
    min_observations : int, number of observations that confirms a landmark
    max_misses : int, number of scans in a row without an observation that deletes a landmark
    offset : float, LANDMARKOFFSET: a foot point farther from every landmark is new [m]
    samples : int, RANSAC_SAMPLE: random points, unless "distinct-lines"
    c : float, of Q as printed: variance as a share of the squared step [1]
    corrections : collection of names of CORRECTIONS
    """

    def __init__(
        self,
        robot,
        sensor,
        rng,
        ransac=THESIS,
        min_observations=5,
        max_misses=40,
        *,
        offset=ASSOCIATION_DISTANCE,
        samples=SAMPLES,
        c=0.01,
        corrections=(),
    ):
        super().__init__()
        self.corrections = checked(corrections)
        _check(ransac, self.corrections, min_observations, max_misses, samples, offset, c)
        self.robot, self.sensor, self.rng, self.ransac = robot, sensor, rng, ransac
        self.min_observations, self.max_misses, self.samples = min_observations, max_misses, samples
        self.offset, self.c = offset, c
        start = np.zeros((3, 3)) if "exact-start" in self.corrections else START
        self.filter = make_filter(self.corrections, start)
        self._odometry_only = MAK(np.zeros(3), np.zeros((3, 3)), capacity=0)
        self._steps = self._scans = 0
        self.observed: dict[int, int] = {}
        self.misses_left: dict[int, int] = {}
        self.points = DownsampledPoints()
        self._next = 0

    def step(self, reading):
        """Observe and associate foot points, predict, correct, add and delete landmarks."""
        reading = self.usable(reading)
        self._steps += 1
        predict_by_odometry(self._odometry_only, reading, self.robot)
        seen = reading.scan is not None and reading.scan.valid.any()
        if "predict-first" in self.corrections or not seen:
            self._predict(reading)
        if not seen:
            self.skipped += 1
        else:
            self._scans += 1
            paired, new = self._associate(self._foot_points(reading.scan))
            self.counts.update([UNKNOWN_WALLS_ONLY] * bool(self.filter.ids and new and not paired))
            z = {i: h(self.filter.pose, point) for i, point in paired.items()}
            if "predict-first" not in self.corrections:
                self._predict(reading)
            self._update(z)
            self._augment(new)
            self._prune({*paired, *self.filter.ids[len(self.filter.ids) - len(new) :]})
            self.points.add(transform(self.filter.pose, reading.scan.points()))
        self.pose = self.filter.pose
        self.record(reading.time)
        self.status = self.status_line(
            f"{len(self.confirmed())} confirmed of {len(self.observed)} landmarks"
        )

    def confirmed(self):
        """Return the foot points (k, 2) [m] of the confirmed landmarks."""
        used = [self.observed[i] >= self.min_observations for i in self.filter.ids]
        return self.filter.landmarks()[np.array(used, dtype=bool)]

    @property
    def warnings(self):
        P = self.filter.block([0, 1])
        return [
            *little_better_than_odometry(P, self._odometry_only, self._steps),
            *contradicts_odometry(self.pose, self._odometry_only, self._steps),
            *uncertainty_wider_than_map(P, self.confirmed(), self._steps),
            *mostly_unknown_walls(self.counts[UNKNOWN_WALLS_ONLY], self._scans),
        ]

    def layers(self):
        P_rr, _, _ = self.filter.blocks()
        points = self.confirmed()
        return [
            Points("scan", self.points.xy),
            Segments("perpendicular", np.hstack([np.zeros_like(points), points])),
            Points("landmark", points),
            Poses("corrected", self.trajectory().poses),
            Ellipses("robot", self.pose[None, :2], P_rr[None, :2, :2]),
        ]

    def _predict(self, reading):
        predict(self.filter, reading.odometry, self.robot, self.c, self.corrections)

    def _foot_points(self, scan):
        found = self._lines(scan)
        if not len(found):
            return np.empty((0, 2))
        rho, alpha = np.transpose(found)
        points = np.column_stack([rho * np.cos(alpha), rho * np.sin(alpha)])
        return points[np.hypot(*(points - self.filter.pose[:2]).T) > MIN_RANGE]

    def _lines(self, scan):
        pose, orthogonal = self.filter.pose, "orthogonal-fit" in self.corrections
        fit = total_least_squares if orthogonal else ordinary_least_squares
        if "distinct-lines" not in self.corrections:
            points = transform(pose, scan.points())
            return sampled_lines(points, self.rng, self.ransac, self.samples, fit)
        found = lines(scan, self.sensor, self.rng, self.ransac)
        if orthogonal:
            return [g_line(pose, line.z) for line in found]
        points, beams = transform(pose, scan.points()), np.flatnonzero(scan.valid)
        return [fit(points[np.isin(beams, line.beams)]) for line in found]

    def _associate(self, points):
        """Associate foot points; return {landmark id: foot point} and unassociated foot points."""
        paired, new = {}, []
        for point in points:
            off = np.hypot(*(self.filter.landmarks() - point).T)
            within = np.flatnonzero(off <= self.offset)
            if not len(within):
                new.append(point)
            else:
                k = off.argmin() if "nearest" in self.corrections else within[0]
                paired.setdefault(self.filter.ids[int(k)], point)
        return paired, new

    def _update(self, z):
        for i in z:
            self.observed[i] += 1
        used = {i: seen for i, seen in z.items() if self.observed[i] >= self.min_observations}
        together = [list(used)] if "joint-update" in self.corrections else [[i] for i in used]
        for ids in together if used else []:
            rows = np.array([used[i] for i in ids])
            self.filter.update(ids, rows, R_foot_points(self.sensor, rows[:, 0], self.corrections))

    def _augment(self, new):
        for point in new:
            i, self._next = self._next, self._next + 1
            z = h(self.filter.pose, point)[None]
            self.filter.add([i], z, R_foot_points(self.sensor, z[:, 0], self.corrections))
            self.observed[i] = 1

    def _prune(self, observed):
        for i in list(self.observed):
            self.misses_left[i] = self.max_misses if i in observed else self.misses_left[i] - 1
            if self.misses_left[i] <= 0:
                self.filter.remove([i])
                del self.observed[i], self.misses_left[i]


def _check(ransac, corrections, min_observations, max_misses, samples, offset, c):
    counts = {"min_observations": min_observations, "max_misses": max_misses, "samples": samples}
    for name, count in counts.items():
        if count < 1:
            raise ValueError(f"{name} must be at least 1, not {count}")
    if not offset > 0 or not c > 0:
        raise ValueError(f"offset and c must be above zero, not {offset} and {c}")
    if not corrections >= {"distinct-lines", "orthogonal-fit"} and (
        ransac.grow or ransac.band is None
    ):
        raise ValueError(
            "without an inlier band, or with region growing, use the corrections 'distinct-lines' "
            "and 'orthogonal-fit'; otherwise use THESIS"
        )
