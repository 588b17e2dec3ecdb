"""EKF-SLAM with line landmarks: walls observed as (ρ, α) (Hessian normal form)."""

import numpy as np

from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.ekf_slam import predict
from slamlab.estimators.estimate_warnings import (
    little_better_than_odometry,
    mostly_unknown_walls,
    uncertainty_wider_than_map,
)
from slamlab.estimators.landmark_observations import SHORT_RANGE, SHORT_RANGE_RANSAC
from slamlab.estimators.laser_odometry import LaserOdometry
from slamlab.estimators.slip_relocalisation import SlipRelocalisation
from slamlab.estimators.wall_merging import ends_of, merge_same_wall_landmarks
from slamlab.filters.data_association import squared_distances
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.landmark_models import LINES
from slamlab.geometry import transform
from slamlab.landmarks.downsampling import DownsampledPoints
from slamlab.landmarks.ransac import lines
from slamlab.landmarks.sonar_lines import slant, sonar_lines
from slamlab.landmarks.track_management import TrackManager, extent, overlap
from slamlab.landmarks.wall_segments import hull, split_at_gaps, union
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.models.observation import g_line

GATE = 13.8  # χ² gate, 2 degrees of freedom: 99.9 % of the true pairs pass
UNKNOWN_WALLS_ONLY = "scans with only unknown walls"
AMBIGUITY_GATE = 4 * GATE  # χ²: between both gates an observation is ambiguous and ignored


class WallSlam(Estimator):
    """EKF-SLAM (MAK) with line landmarks: the walls that the scans show.

    A landmark is one side of a wall. :mod:`slamlab.estimators.wall_merging` merges duplicates, and
    :mod:`slamlab.estimators.slip_relocalisation` relocalises the robot after wheel slip.

    Parameters
    ----------
    robot : RobotModel
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    ransac : Ransac; when None, chosen for the sensor
    min_observations : int, observations that confirm a landmark; when None, 3, or 2 for a sonar
    max_misses : int, scans in a row without an observation that delete a tentative landmark
    first_estimates : bool, see :class:`MAK`; without it the heading becomes overconfident
    relocalise : bool, whether to relocalise after wheel slip; not with a sonar
    """

    def __init__(
        self,
        robot,
        sensor,
        rng,
        ransac=None,
        min_observations=None,
        max_misses=3,
        first_estimates=True,
        relocalise=True,
    ):
        super().__init__()
        self.robot, self.sensor, self.rng, self.ransac = robot, sensor, rng, ransac
        self.filter = MAK(
            np.zeros(3), np.zeros((3, 3)), kind=LINES, first_estimates=first_estimates
        )
        if min_observations is None:  # a sonar observes few walls, which are rarely false
            min_observations = 2 if sensor.half_cone else 3
        self.tentative = TrackManager(min_observations, max_misses)
        self.extents: dict[int, np.ndarray] = {}  # stretches of each wall, along its line [m]
        self.points = DownsampledPoints()
        self.ambiguous = self.merged = 0
        self.relocalise = relocalise and not sensor.half_cone
        self.relocalisation = SlipRelocalisation(self, rng.spawn(1)[0])
        self.laser_odometry = None if sensor.half_cone else LaserOdometry()
        self._odometry_only = MAK(np.zeros(3), np.zeros((3, 3)), capacity=0)
        self._started, self._next, self._steps, self._scans = False, 0, 0, 0

    def step(self, reading):
        """Predict by odometry, correct by confirmed walls, confirm or delete tentative walls."""
        reading = self.usable(reading)
        for each in (self.filter, self._odometry_only):
            predict(each, reading, self.robot)
        self.relocalisation.predict(reading.odometry)
        self._steps += 1
        if reading.scan is None or not reading.scan.valid.any():
            self.skipped += 1
        else:
            self._scans += 1
            self._take_in(reading)
        self.pose = self.filter.pose
        self.record(reading.time)
        self.status = self.status_line(
            f"{counted(len(self.filter.ids), 'wall')}, {len(self.tentative.tentative)} tentative",
            f"{self.merged} merged",
            counted(self.ambiguous, "ambiguous observation"),
        )

    @property
    def warnings(self):
        P = self.filter.block([0, 1])
        uncertain = little_better_than_odometry(P, self._odometry_only, self._steps)
        if uncertain:  # listing all walls costs a tenth of a step
            uncertain += uncertainty_wider_than_map(P, self.walls().reshape(-1, 2), self._steps)
        return [
            *uncertain,
            *mostly_unknown_walls(self.counts[UNKNOWN_WALLS_ONLY], self._scans),
            *self.relocalisation.warnings,
        ]

    def layers(self):
        P_rr, _, _ = self.filter.blocks()
        return [
            Points("scan", self.points.xy),
            Segments("landmark", self.walls()),
            Poses("corrected", self.trajectory().poses),
            Ellipses("robot", self.pose[None, :2], P_rr[None, :2, :2]),
        ]

    def walls(self):
        """Return the observed segments (k, 4) of the map's walls: x1 y1 x2 y2 [m]."""
        pieces = [ends_of(line, self.extents[i]) for i, line in self._map_lines().items()]
        return np.concatenate([np.empty((0, 2, 2)), *pieces]).reshape(-1, 4)

    def _map_lines(self):
        return dict(zip(self.filter.ids, self.filter.landmarks(), strict=True))

    def _take_in(self, reading):
        found = observed_walls(reading.scan, self.sensor, self.rng, self.ransac)
        known, new = self._associate(found)
        lost = bool(self._started and new and not known)  # the wheels may have slipped
        self.counts.update([UNKNOWN_WALLS_ONLY] * lost)
        if self.relocalisation.update(reading.scan, self.relocalise and lost):
            known, new = self._associate(found)
        self._update(reading.scan, known, new)
        self.merged += merge_same_wall_landmarks(self.filter, self.extents)
        self.points.add(transform(self.filter.pose, reading.scan.points()))

    def _associate(self, found):
        """Associate the observed Lines: return {id: Line} of confirmed walls, and the new Lines."""
        if not found or not self.filter.ids:
            return {}, found
        z, R = (np.array([getattr(line, name) for line in found]) for name in "zR")
        d2 = squared_distances(self.filter, z, R)
        walls, known, new = self._map_lines(), {}, []
        for line, row in sorted(zip(found, d2, strict=True), key=lambda pair: pair[1].min()):
            ends = transform(self.filter.pose, line.ends)
            near = [
                (distance, i)
                for distance, i in zip(row, walls, strict=True)
                if distance < AMBIGUITY_GATE
                and overlap(hull(self.extents[i]), extent(walls[i], ends))
            ]
            distance, i = min(near, default=(np.inf, None))
            if i is None:
                new.append(line)
            elif distance <= GATE and i not in known:
                known[i] = line
            else:  # a second segment of the wall, or outside the gate
                self.ambiguous += 1
        return known, new

    def _update(self, scan, known, new):
        if known:
            z, R = (np.array([getattr(line, name) for line in known.values()]) for name in "zR")
            self.filter.update(list(known), z, R)
        pose = self.filter.pose
        placed = [(g_line(pose, line.z), transform(pose, line.ends)) for line in new]
        # the first scan defines the map frame, so its walls are confirmed at once
        first, self._started = not self._started, True
        confirmed = [True] * len(new) if first else self.tentative.update(placed)
        for line, due in zip(new, confirmed, strict=True):
            if due:
                i, self._next = self._next, self._next + 1
                self.filter.add([i], line.z[None], line.R)
                known[i], self.extents[i] = line, np.empty((0, 2))
        walls, half_cone = self._map_lines(), self.sensor.half_cone
        for i, line in known.items():
            r, u = scan.ranges[line.beams], slant(scan.angles[line.beams], line.z[1], half_cone)
            beta = pose[2] + line.z[1] + u
            hits = pose[:2] + r[:, None] * np.column_stack([np.cos(beta), np.sin(beta)])
            along = hits @ [-np.sin(walls[i][1]), np.cos(walls[i][1])]
            self.extents[i] = union(self.extents[i], split_at_gaps(along))


def observed_walls(scan, sensor, rng, ransac=None):
    """Extract the Lines of a scan by RANSAC or by a sonar's cone model; most points first."""
    if sensor.half_cone:
        return sonar_lines(scan, sensor)
    if ransac is None and sensor.range_max < SHORT_RANGE:
        ransac = SHORT_RANGE_RANSAC
    return lines(scan, sensor, rng, ransac)


def for_source(slam, source, rng=None):
    """Return the estimator ``slam(robot, sensor, rng)`` for a source that has scans."""
    if len(source) and all(reading.scan is None for reading in source):
        raise ValueError(f"{source.name} has no scans to find walls in; sim:situation-1 has scans")
    return slam(source.robot, source.sensor, rng or np.random.default_rng(0))
