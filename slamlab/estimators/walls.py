"""EKF-SLAM with walls: lines of a scan, observed as (ρ, α) from the robot, in the MAK filter.

Smolec's system with its landmark mended: a wall's distance and direction as seen from the robot are
a measurement of their own, whereas the foot of the perpendicular is computed through the pose.
"""

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.mak import predict
from slamlab.filters.association import squared_distances
from slamlab.filters.kinds import LINES
from slamlab.filters.mak import MAK
from slamlab.geometry import transform
from slamlab.landmarks.candidates import Candidates, overlap, stretch
from slamlab.landmarks.pieces import pieces, union
from slamlab.landmarks.ransac import lines
from slamlab.landmarks.thinned import Thinned
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.models import g_line

GATE = 13.8  # χ² of 2 degrees: a true pairing fails it once in a thousand
DOUBT = 4 * GATE  # beyond the gate and below this it may be the wall: neither used nor new


class WallSlam(Estimator):
    """The MAK filter on the walls that RANSAC finds in each scan.

    Parameters
    ----------
    robot : RobotModel
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    ransac : Ransac, its defaults when None
    sightings : int, how often a wall is seen before it is used, but for those of the first scan
    lives : int, how many scans a wall on trial survives unseen
    first_estimates : bool, see :class:`MAK`; without, a map of lines soon believes it knows north
    """

    def __init__(self, robot, sensor, rng, ransac=None, sightings=3, lives=3, first_estimates=True):
        super().__init__()
        self.robot, self.sensor, self.rng, self.ransac = robot, sensor, rng, ransac
        self.filter = MAK(
            np.zeros(3), np.zeros((3, 3)), kind=LINES, first_estimates=first_estimates
        )
        self.candidates = Candidates(sightings, lives)
        self.seen: dict[int, np.ndarray] = {}  # pieces of each wall, along its line [m]
        self.points = Thinned()
        self.doubtful = 0
        self._begun = False

    def step(self, reading):
        """Take a reading in: predict by odometry, correct by known walls, put new ones on trial.

        Parameters
        ----------
        reading : Reading
        """
        predict(self.filter, reading, self.robot)
        if reading.scan is None or not reading.scan.valid.any():
            self.skipped += 1
        else:
            found = lines(reading.scan, self.sensor, self.rng, self.ransac)
            known, new = self._associated(found)
            if self._begun and new and not known:  # the robot may have been carried
                self.counts["scans of unknown walls only"] += 1
            self._update(reading.scan, known, new)
            self.points.add(transform(self.filter.pose, reading.scan.points()))
        self.pose = self.filter.pose
        self.record(reading.time)
        self.status = self.told(
            f"{len(self.filter.ids)} walls, {len(self.candidates.waiting)} on trial",
            f"{self.doubtful} doubtful sightings left out",
        )

    def layers(self):
        """Points, walls as far as they were seen, the track, the robot's 95 % ellipse."""
        P_rr, _, _ = self.filter.blocks()
        return [
            Points("scan", self.points.xy),
            Segments("landmark", self.walls()),
            Poses("corrected", self.trajectory().poses),
            Ellipses("robot", self.pose[None, :2], P_rr[None, :2, :2]),
        ]

    def walls(self):
        """(k, 4) the pieces of wall that were seen, doors left open: rows x1 y1 x2 y2 [m]."""
        rows = []
        for i, (rho, alpha) in self._in_map().items():
            normal, way = (np.array([np.cos(a), np.sin(a)]) for a in (alpha, alpha + np.pi / 2))
            rows += [
                [*(rho * normal + a * way), *(rho * normal + b * way)] for a, b in self.seen[i]
            ]
        return np.array(rows).reshape(-1, 4)

    def _in_map(self):
        """The walls of the filter as they are believed now: id to (ρ, α)."""
        return dict(zip(self.filter.ids, self.filter.landmarks(), strict=True))

    def _associated(self, found):
        """Sightings of walls in the filter, as id to Line, and those of none."""
        if not found or not self.filter.ids:
            return {}, found
        z, R = (np.array([getattr(line, name) for line in found]) for name in "zR")
        d2 = squared_distances(self.filter, z, R)
        walls, known, new = self._in_map(), {}, []
        for line, row in sorted(zip(found, d2, strict=True), key=lambda pair: pair[1].min()):
            ends = transform(self.filter.pose, line.ends)
            near = [
                (distance, i)
                for distance, i in zip(row, walls, strict=True)
                if distance < DOUBT and overlap(_hull(self.seen[i]), stretch(walls[i], ends))
            ]
            distance, i = min(near, default=(np.inf, None))
            if i is None:
                new.append(line)
            elif distance <= GATE and i not in known:
                known[i] = line
            else:  # a second piece of the wall, or one that fits it badly
                self.doubtful += 1
        return known, new

    def _update(self, scan, known, new):
        if known:
            z, R = (np.array([getattr(line, name) for line in known.values()]) for name in "zR")
            self.filter.update(list(known), z, R)
        pose = self.filter.pose
        placed = [(g_line(pose, line.z), transform(pose, line.ends)) for line in new]
        # the first scan lays the map's frame: what it shows is surest there, without any drift
        first, self._begun = not self._begun, True
        for line, due in zip(new, self.candidates.sight(placed), strict=True):
            if due or first:
                i = len(self.seen)
                self.filter.add([i], line.z[None], line.R)
                known[i], self.seen[i] = line, np.empty((0, 2))
        walls = self._in_map()
        for i, line in known.items():
            r, beta = scan.ranges[line.beams], scan.angles[line.beams] + pose[2]
            hits = pose[:2] + r[:, None] * np.column_stack([np.cos(beta), np.sin(beta)])
            along = hits @ [-np.sin(walls[i][1]), np.cos(walls[i][1])]
            self.seen[i] = union(self.seen[i], pieces(along))


def _hull(parts):
    """(2,) from the first to the last of some pieces [m]."""
    return np.array([parts[0, 0], parts[-1, 1]]) if len(parts) else np.array([np.inf, -np.inf])


def of_scans(slam, source, rng=None):
    """A wall estimator for a source, or an error where it has nothing to see.

    Parameters
    ----------
    slam : WallSlam or FootSlam, the class
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
