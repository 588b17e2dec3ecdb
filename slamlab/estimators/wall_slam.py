"""EKF-SLAM with line landmarks: walls of a scan, observed as (ρ, α), in the MAK filter.

Smolec's system with its landmark mended: a wall's distance and direction as seen from the robot are
a measurement of their own, whereas the foot of the perpendicular is computed through the pose.
"""

import numpy as np

from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.mak_slam import predict
from slamlab.estimators.sufficiency import hardly_surer, mostly_unknown, wider_than_map
from slamlab.estimators.wall_merging import ends_of, merge_pieces
from slamlab.estimators.wall_observations import observed_walls
from slamlab.estimators.wall_relocalisation import WallRelocalisation
from slamlab.filters.data_association import squared_distances
from slamlab.filters.landmark_models import LINES
from slamlab.filters.mak import MAK
from slamlab.geometry import transform
from slamlab.landmarks.downsampling import DownsampledPoints
from slamlab.landmarks.sonar_lines import slant
from slamlab.landmarks.tentative_walls import TentativeWalls, extent, overlap
from slamlab.landmarks.wall_segments import hull, split_at_gaps, union
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.models.observation import g_line

GATE = 13.8  # χ² gate, 2 degrees of freedom: a true pairing fails it once in a thousand
ONLY_NEW = "scans of only new walls"
AMBIGUITY_GATE = 4 * GATE  # χ²: beyond the gate and below this ambiguous, neither used nor new


class WallSlam(Estimator):
    """EKF-SLAM (MAK) on line landmarks: the walls of each scan, found as its sensor asks for.

    A landmark is one side of one wall, without what stands beyond a door: pieces of it that were
    found apart and have grown together are merged, see :mod:`slamlab.estimators.wall_merging`. A
    robot whose wheels slip is found again, see :mod:`slamlab.estimators.wall_relocalisation`.

    Parameters
    ----------
    robot : RobotModel
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    ransac : Ransac, what the sensor asks for when None
    sightings : int, observations that confirm a tentative landmark, 3 when None, of a sonar 2; the
        first scan's are at once
    lives : int, how many scans a tentative landmark survives unseen
    first_estimates : bool, see :class:`MAK`; without, a map of lines soon believes it knows north
    relocalise : bool, whether it looks for the robot where a slip may have put it; a sonar's scans
        are too coarse for that
    """

    def __init__(
        self,
        robot,
        sensor,
        rng,
        ransac=None,
        sightings=None,
        lives=3,
        first_estimates=True,
        relocalise=True,
    ):
        super().__init__()
        self.robot, self.sensor, self.rng, self.ransac = robot, sensor, rng, ransac
        self.filter = MAK(
            np.zeros(3), np.zeros((3, 3)), kind=LINES, first_estimates=first_estimates
        )
        if sightings is None:  # a sonar hears few walls, and each has shown a slope
            sightings = 2 if sensor.half_cone else 3
        self.tentative = TentativeWalls(sightings, lives)
        self.extents: dict[int, np.ndarray] = {}  # stretches of each wall, along its line [m]
        self.points = DownsampledPoints()
        self.ambiguous = self.merged = 0
        self.relocalise = relocalise and not sensor.half_cone
        self.relocalisation = WallRelocalisation(self, rng.spawn(1)[0])
        self._alone = MAK(np.zeros(3), np.zeros((3, 3)), capacity=0)
        self._started, self._next, self._steps, self._scans = False, 0, 0, 0

    def step(self, reading):
        """Process a reading: predict by odometry, correct by confirmed walls, queue tentative ones.

        Parameters
        ----------
        reading : Reading
        """
        reading = self.usable(reading)
        for each in (self.filter, self._alone):
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
        """What it says where it sees too little, or too little again: list of sentences."""
        P = self.filter.block([0, 1])
        unsure = hardly_surer(P, self._alone, self._steps)
        if unsure:  # to lay out all walls costs a tenth of a step
            unsure += wider_than_map(P, self.walls().reshape(-1, 2), self._steps)
        return [
            *unsure,
            *mostly_unknown(self.counts[ONLY_NEW], self._scans),
            *self.relocalisation.warnings,
        ]

    def layers(self):
        """Points, walls as far as seen, the trajectory, the robot's 95 % covariance ellipse."""
        P_rr, _, _ = self.filter.blocks()
        return [
            Points("scan", self.points.xy),
            Segments("landmark", self.walls()),
            Poses("corrected", self.trajectory().poses),
            Ellipses("robot", self.pose[None, :2], P_rr[None, :2, :2]),
        ]

    def walls(self):
        """(k, 4) line segments of the map, where walls were seen, doors open: x1 y1 x2 y2 [m]."""
        pieces = [ends_of(line, self.extents[i]) for i, line in self._map_lines().items()]
        return np.concatenate([np.empty((0, 2, 2)), *pieces]).reshape(-1, 4)

    def _map_lines(self):
        """The line landmarks of the map as estimated now: id to (ρ, α)."""
        return dict(zip(self.filter.ids, self.filter.landmarks(), strict=True))

    def _take_in(self, reading):
        """Find the walls of a scan, tell which they are and whether the wheels slipped; learn."""
        found = observed_walls(reading.scan, self.sensor, self.rng, self.ransac)
        known, new = self._associate(found)
        lost = bool(self._started and new and not known)  # the wheels may have slipped
        self.counts.update([ONLY_NEW] * lost)
        if self.relocalisation.update(reading.scan, self.relocalise and lost):
            known, new = self._associate(found)
        self._update(reading.scan, known, new)
        self.merged += merge_pieces(self.filter, self.extents)
        self.points.add(transform(self.filter.pose, reading.scan.points()))

    def _associate(self, found):
        """Data association: observations of confirmed walls, as id to Line, and the others."""
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
            else:  # a second piece of the wall, or one that fits it badly
                self.ambiguous += 1
        return known, new

    def _update(self, scan, known, new):
        """Correct by known walls, augment by newly confirmed ones, extend what was seen of each."""
        if known:
            z, R = (np.array([getattr(line, name) for line in known.values()]) for name in "zR")
            self.filter.update(list(known), z, R)
        pose = self.filter.pose
        placed = [(g_line(pose, line.z), transform(pose, line.ends)) for line in new]
        # the first scan lays the map's frame: what it shows is surest there, and waits for nothing
        first, self._started = not self._started, True
        confirmed = [True] * len(new) if first else self.tentative.sight(placed)
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


def for_source(slam, source, rng=None):
    """Make an EKF-SLAM estimator with walls for a source.

    Parameters
    ----------
    slam : callable(robot, sensor, rng), such as WallSlam or FootSlam
    source : Source
    rng : numpy.random.Generator, seed 0 when None

    Returns
    -------
    Estimator

    Raises
    ------
    ValueError : no reading holds a scan
    """
    if len(source) and all(reading.scan is None for reading in source):
        raise ValueError(f"{source.name} holds no scans, which walls need; sim:situation-1 does")
    return slam(source.robot, source.sensor, rng or np.random.default_rng(0))


DOUBT = AMBIGUITY_GATE  # name in the first edition
