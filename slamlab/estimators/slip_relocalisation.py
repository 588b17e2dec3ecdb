"""Relocalisation after wheel slip, by a particle filter (likelihood field) around the EKF's pose.

If the particles, but not the EKF, explain all scans by the old map, the old map is restored and the
pose is set to the mean of the particles.
"""

from copy import deepcopy

import numpy as np

from slamlab.estimators.wall_map_fit import (
    BLUR,
    MAX_ERROR,
    distances_to_walls,
    fraction_through_walls,
    map_segments,
)
from slamlab.filters.particle_filters.motion_sampling import sample_motion
from slamlab.filters.particle_filters.particle_set import RESAMPLING_THRESHOLD, ParticleSet
from slamlab.geometry import compose

SLIP_TURN = np.radians(60)  # largest turn by slip; the largest translation is the robot's width
PARTICLES = 500
BEAMS = 20  # of each scan, in all directions
INDEPENDENT = 0.25  # share of independent beams: errors of one wall's hits are correlated
SPACING = np.array([BLUR, BLUR, np.radians(2)])  # between particles [m, m, rad]
JITTER = 0.25  # roughening of resampled particles, in spacings
EXPLAINED = 0.5  # least share of each scan's points that the map must explain
MARGIN = 0.3  # least difference of this share to that at the filter's pose
MAX_THROUGH = 0.1  # largest share of beams through walls, if it is not larger at the filter's pose
MIN_SCANS = 15  # scans in a row before the robot is relocalised
SUSPICIOUS = 5  # scans in a row before a warning
RELOCALISATIONS = "relocalisations"


class SlipRelocalisation:
    """Detects wheel slip while a WallSlam runs, and relocalises the robot."""

    def __init__(self, slam, rng):
        self.slam, self.rng = slam, rng
        self.search = None
        self._before = None

    def predict(self, odometry):
        """Move the particles by odometry (3,) [m, m, rad], each with its own sampled noise."""
        if self.search is not None:
            self.search.predict(odometry)

    def update(self, scan, lost):
        """Continue the search by a scan that the filter has not yet used; return whether this
        relocalised the filter. ``lost``: whether the scan contains only unknown walls."""
        slam = self.slam
        if self.search is None and lost:
            self._before = deepcopy((slam.filter, slam.extents, slam.tentative, slam.points))
            segments = map_segments(slam.filter, slam.extents)
            self.search = SlipSearch(slam.filter, segments, slam.robot, slam.sensor, self.rng)
        search = self.search
        if search is None:
            return False
        search.update(scan, slam.filter.pose)
        if search.over:
            self.search = None
        if search.found:
            self._relocalise(search.particles.moments)
        return search.found

    @property
    def warnings(self):
        if self.search is None or not self.search.plausible or self.search.scans < SUSPICIOUS:
            return []
        return ["the wheels may have slipped: the scans fit the map better from a nearby pose"]

    def _relocalise(self, found):
        """Restore the map and set the pose to the particles' mean: P_rr ← A P_rr Aᵀ + P of the
        particles, P_ri ← A P_ri."""
        slam = self.slam
        slam.filter, slam.extents, slam.tentative, slam.points = self._before
        slam.filter.predict(found.x, found.P + np.diag(SPACING**2))
        slam.counts[RELOCALISATIONS] += 1


class SlipSearch:
    """Monte Carlo localisation by the ParticleSet ``particles`` in a map of walls ``segments``
    (k, 4), for a robot that may have slipped."""

    def __init__(self, filter, segments, robot, sensor, rng):
        self.segments, self.robot, self.sensor, self.rng = segments, robot, sensor, rng
        poses = rng.multivariate_normal(filter.pose, filter.block([0, 1, 2]), PARTICLES)
        direction = rng.uniform(-np.pi, np.pi, PARTICLES)
        # uniform on the disc
        shift = 2 * robot.radius * np.sqrt(rng.random(PARTICLES))
        turn = rng.uniform(-SLIP_TURN, SLIP_TURN, PARTICLES)
        slip = np.column_stack([shift * np.cos(direction), shift * np.sin(direction), turn])
        self.particles = ParticleSet.unweighted(compose(poses, slip))
        # shares of each scan, at the particles' mean and at the filter's pose
        self._explained, self._through = [], np.zeros(2)

    scans = property(lambda self: len(self._explained))

    def predict(self, odometry):
        if np.any(odometry):
            rows = sample_motion(self.particles.rows, odometry, self.robot, self.rng)
            self.particles = ParticleSet(rows, self.particles.weights)

    def update(self, scan, own):
        """Weight particles by a scan: a likelihood field (Thrun, Burgard, Fox 2005, 6.4) tempered
        by κ = INDEPENDENT, w ← w exp(−κ/2 Σ min(e/σ, MAX_ERROR)²). ``own``: filter's pose."""
        points = scan.points()
        points = points[np.linspace(0, len(points) - 1, min(BEAMS, len(points))).astype(int)]
        sigma = np.hypot(self.sensor.sigma(np.hypot(*points.T)), BLUR)
        errors = distances_to_walls(self.particles.rows, points, self.segments) / sigma
        squares = (np.minimum(errors, MAX_ERROR) ** 2).sum(axis=1)
        particles, _ = self.particles.reweighted(-0.5 * INDEPENDENT * squares)
        both = np.array([particles.moments.x, own])
        errors = distances_to_walls(both, points, self.segments) / sigma
        self._explained.append((errors < MAX_ERROR).mean(axis=1))
        self._through += [fraction_through_walls(x, scan, self.segments, self.sensor) for x in both]
        if particles.effective_sample_size < RESAMPLING_THRESHOLD * PARTICLES:
            rows = particles.resampled(self.rng).rows
            rows += JITTER * SPACING * self.rng.standard_normal(rows.shape)
            particles = ParticleSet.unweighted(rows)
        self.particles = particles

    @property
    def over(self):
        """Whether the particles do not explain the last scan, or enough scans have been used."""
        return self._explained[-1][0] < EXPLAINED or self.scans >= MIN_SCANS

    @property
    def plausible(self):
        """Whether the particles explain every scan, and better than the filter's pose does."""
        found, own = np.array(self._explained).T
        explains_more = found.min() >= EXPLAINED and found.mean() - own.mean() > MARGIN
        through, own_through = self._through / self.scans
        return bool(explains_more and through <= max(MAX_THROUGH, own_through))

    @property
    def found(self):
        return self.plausible and self.scans >= MIN_SCANS
