"""A hidden world: a furnished floor, the robot's readings, and the separate ground truth.

Each reading is generated on request, with noise from a separate random stream. Therefore an
estimator cannot look ahead, and every iteration yields the same readings."""

from dataclasses import dataclass, field, replace

import numpy as np

from classroom.project.world_parameters import WorldFamily
from slamlab.geometry import wrap
from slamlab.models.observation import h
from slamlab.readings import Observations, Reading, Trajectory
from slamlab.simulation.worlds.world import World

PERSON = 0.2  # radius [m]
LANDMARK_RANGE, LANDMARK_SIGMA = 4.0, (0.05, np.radians(1))  # of point landmarks [m; m, rad]


@dataclass(frozen=True)
class HiddenWorld:
    """A world for one run; iteration yields its readings, at most 200."""

    family: WorldFamily
    floor: World  # the walls; ground truth
    truth: Trajectory  # of the robot, in the frame of the floor
    metres: np.ndarray  # (n,) distance travelled before each reading, not while carried [m]
    odometry: np.ndarray  # (n, 3) increments [m, m, rad]
    people: np.ndarray  # (n, p, 2) positions of people at each reading [m]
    landmarks: np.ndarray  # (m, 2) [m]; empty in a world with a lidar
    lost: np.ndarray  # (n,) bool, whether the scan is lost
    bias: float  # relative error of the measured ranges [1]
    seed: int = field(repr=False)  # of the sensor noise

    @property
    def name(self):
        return self.family.name

    def __len__(self):
        return len(self.truth)

    def __iter__(self):
        for i in range(len(self)):
            yield self.reading(i)

    def reading(self, i):
        """Generate the i-th Reading, which shares no data with the world."""
        rng, pose = np.random.default_rng([self.seed, i]), self.truth.poses[i]
        sensed = (
            {"observations": self._observe(pose, rng)}
            if len(self.landmarks)
            else {"scan": self._scan(i, pose, rng)}
        )
        return Reading(float(self.truth.times[i]), self.odometry[i].copy(), **sensed)

    def _scan(self, i, pose, rng):
        rims = np.column_stack([self.people[i], np.full(len(self.people[i]), PERSON)])
        floor = replace(self.floor, circles=np.concatenate([self.floor.circles, rims]))
        scan = self.family.lidar.scan(floor, pose, rng)
        ranges = np.full(len(scan.ranges), np.nan) if self.lost[i] else scan.ranges
        return replace(scan, ranges=ranges * (1 + self.bias))

    def _observe(self, pose, rng):
        z = h(pose, self.landmarks)
        noisy = z + rng.standard_normal(z.shape) * LANDMARK_SIGMA
        noisy[:, 1] = wrap(noisy[:, 1])
        clear = self.floor.cast(pose[:2], pose[2] + z[:, 1]) > z[:, 0] - 1e-6
        ids = np.flatnonzero(clear & (z[:, 0] < LANDMARK_RANGE) & (noisy[:, 0] > 0))
        return Observations(noisy[ids], ids)
