"""Relocalisation in a map of walls, after the wheels slipped: Monte Carlo localisation beside EKF.

A scan of unknown walls alone may show new walls, or known ones from elsewhere than the robot
believes to stand. EKF-SLAM goes on as if they were new. Beside it particles, spread as far as a
slip may throw the robot, are weighted by the scans in the map as it was. Where they explain every
scan, the filter's own pose explains less, and few beams would go through walls, the wheels have
slipped: the map of before is taken again, with the slip in it as a motion of its own, and from
there on it is the EKF again.

``relocalisation`` is the pose graph's: it matches scans of a robot that was carried anywhere.
"""

from copy import deepcopy

import numpy as np

from slamlab.estimators.wall_map_fit import (
    BLUR,
    MAX_ERROR,
    map_pieces,
    share_through_walls,
    wall_errors,
)
from slamlab.filters.montecarlo.motion_sampling import sample_motion
from slamlab.filters.montecarlo.particles import RESAMPLING_THRESHOLD, ParticleSet
from slamlab.geometry import compose

SLIP_TURN = np.radians(60)  # the most that a slip turns the robot; it moves it by its own width
PARTICLES = 500
BEAMS = 20  # of each scan, all round
INDEPENDENT = 0.25  # share of them that tells something of its own: one wall's hits err together
SPACING = np.array([BLUR, BLUR, np.radians(2)])  # between particles [m, m, rad]
JITTER = 0.25  # of resampled particles, in spacings
EXPLAINED = 0.5  # share of every scan's points that walls must explain
MARGIN = 0.3  # by how much less of them they must explain from the filter's own pose
MAX_THROUGH = 0.1  # share of beams that may go through walls, or as many as from its own pose
MIN_SCANS = 15  # in a row before the robot is relocalised
SUSPICIOUS = 5  # in a row before it says that it may have slipped
RELOCALISATIONS = "relocalisations"


class WallRelocalisation:
    """Relocalisation of EKF-SLAM with walls: whether its wheels slipped, and where to.

    Parameters
    ----------
    slam : WallSlam; its filter and map are those of before the slip again when that is found
    rng : numpy.random.Generator
    """

    def __init__(self, slam, rng):
        self.slam, self.rng = slam, rng
        self.search = None
        self._before = None

    def predict(self, odometry):
        """Move the particles, if there are any, by odometry (3,) [m, m, rad]."""
        if self.search is not None:
            self.search.predict(odometry)

    def update(self, scan, lost):
        """Follow the robot that may have slipped; relocalise the filter where it surely has.

        Parameters
        ----------
        scan : Scan, with something in it, before the filter was updated by it
        lost : bool, whether the scan shows unknown walls alone

        Returns
        -------
        bool, whether the filter stands elsewhere now
        """
        slam = self.slam
        if self.search is None and lost:
            self._before = deepcopy((slam.filter, slam.extents, slam.tentative, slam.points))
            pieces = map_pieces(slam.filter, slam.extents)
            self.search = SlipSearch(slam.filter, pieces, slam.robot, slam.sensor, self.rng)
        search = self.search
        if search is None:
            return False
        search.update(scan, slam.filter.pose)
        if search.over:
            self.search = None
        if search.found:
            self._relocalise(search.cloud.moments)
        return search.found

    @property
    def warnings(self):
        """What it says while the robot may have slipped: list of sentences."""
        if self.search is None or not self.search.plausible or self.search.scans < SUSPICIOUS:
            return []
        return ["the wheels may have slipped: the scans fit the map better from near by"]

    def _relocalise(self, found):
        """Go back to the map of before; P_rr ← A P_rr Aᵀ + P of the particles, P_ri ← A P_ri."""
        slam = self.slam
        slam.filter, slam.extents, slam.tentative, slam.points = self._before
        slam.filter.predict(found.x, found.P + np.diag(SPACING**2))
        slam.counts[RELOCALISATIONS] += 1


class SlipSearch:
    """Monte Carlo localisation of a robot that may have slipped, in a map of walls.

    Particles begin anywhere within the robot's width and SLIP_TURN of the filter's pose and its
    covariance.

    Parameters
    ----------
    filter : MAK, where the robot would stand without a slip
    pieces : (k, 4) of walls, see :func:`map_pieces`
    robot : RobotModel
    sensor : SensorModel
    rng : numpy.random.Generator

    ``cloud`` is the ParticleSet of poses, ``scans`` how many it was weighted by.
    """

    def __init__(self, filter, pieces, robot, sensor, rng):
        self.pieces, self.robot, self.sensor, self.rng = pieces, robot, sensor, rng
        poses = rng.multivariate_normal(filter.pose, filter.block([0, 1, 2]), PARTICLES)
        direction = rng.uniform(-np.pi, np.pi, PARTICLES)
        # as many on every bit of the disc
        way = 2 * robot.radius * np.sqrt(rng.random(PARTICLES))
        turn = rng.uniform(-SLIP_TURN, SLIP_TURN, PARTICLES)
        slip = np.column_stack([way * np.cos(direction), way * np.sin(direction), turn])
        self.cloud = ParticleSet.unweighted(compose(poses, slip))
        # shares of every scan, by the particles' mean and by the filter's own pose
        self._explained, self._through = [], np.zeros(2)

    scans = property(lambda self: len(self._explained))

    def predict(self, odometry):
        """Sample the motion model for every particle, by odometry (3,) [m, m, rad]."""
        if np.any(odometry):
            rows = sample_motion(self.cloud.rows, odometry, self.robot, self.rng)
            self.cloud = ParticleSet(rows, self.cloud.weights)

    def update(self, scan, own):
        """Reweight by a scan: w ← w exp(−κ/2 Σ min(e/σ, MAX_ERROR)²), e of a hit from the walls.

        A likelihood field (Thrun, Burgard, Fox 2005, 6.4), tempered by κ = INDEPENDENT.

        Parameters
        ----------
        scan : Scan
        own : (3,) the filter's own pose [m, m, rad]
        """
        points = scan.points()
        points = points[np.linspace(0, len(points) - 1, min(BEAMS, len(points))).astype(int)]
        sigma = np.hypot(self.sensor.sigma(np.hypot(*points.T)), BLUR)
        errors = wall_errors(self.cloud.rows, points, self.pieces) / sigma
        squares = (np.minimum(errors, MAX_ERROR) ** 2).sum(axis=1)
        cloud, _ = self.cloud.reweighted(-0.5 * INDEPENDENT * squares)
        both = np.array([cloud.moments.x, own])
        errors = wall_errors(both, points, self.pieces) / sigma
        self._explained.append((errors < MAX_ERROR).mean(axis=1))
        self._through += [share_through_walls(x, scan, self.pieces, self.sensor) for x in both]
        if cloud.effective_sample_size < RESAMPLING_THRESHOLD * PARTICLES:
            rows = cloud.resampled(self.rng).rows
            rows += JITTER * SPACING * self.rng.standard_normal(rows.shape)
            cloud = ParticleSet.unweighted(rows)
        self.cloud = cloud

    @property
    def over(self):
        """bool, whether the particles could not explain the last scan, or all of enough scans."""
        return self._explained[-1][0] < EXPLAINED or self.scans >= MIN_SCANS

    @property
    def plausible(self):
        """bool, whether the particles fit every scan, and the filter's own pose fits them less."""
        there, own = np.array(self._explained).T
        explains_more = there.min() >= EXPLAINED and there.mean() - own.mean() > MARGIN
        through, own_through = self._through / self.scans
        return bool(explains_more and through <= max(MAX_THROUGH, own_through))

    @property
    def found(self):
        """bool, whether that is so for enough scans: the wheels have slipped."""
        return self.plausible and self.scans >= MIN_SCANS
