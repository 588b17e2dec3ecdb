"""A hidden world: a furnished floor, a drive through it and its readings; the truth held apart.

Iterating a world makes each reading when it is asked for, and draws the noise of reading i from a
stream of its own: nobody can look ahead, and every iteration yields the same.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from slamlab.geometry import wrap
from slamlab.models.observation import h
from slamlab.project.world_families import Family
from slamlab.readings import Observations, Reading, Trajectory
from slamlab.worlds.world import World

PERSON = 0.2  # radius [m]
SIGHT, SIGHT_SIGMA = 4.0, (0.05, np.radians(1))  # of point landmarks [m; m, rad]


@dataclass(frozen=True)
class HiddenWorld:
    """A world to be driven through once: iterate it for its readings, at most 200.

    Parameters
    ----------
    family : Family
    floor : World, the walls; truth
    truth : Trajectory of the robot, in the floor's frame
    metres : (n,) way driven before each reading; being carried is no way [m]
    odometry : (n, 3) increments [m, m, rad]
    people : (n, p, 2) where people are at each reading [m]
    landmarks : (m, 2) [m], none in a world of a lidar
    lost : (n,) bool, whether the scan is lost
    bias : float, true over reported range, less one [1]
    seed : int, of the sensor's noise
    """

    family: Family
    floor: World
    truth: Trajectory
    metres: np.ndarray
    odometry: np.ndarray
    people: np.ndarray
    landmarks: np.ndarray
    lost: np.ndarray
    bias: float
    seed: int = field(repr=False)

    @property
    def name(self):
        """The family's name."""
        return self.family.name

    def __len__(self):
        return len(self.truth)

    def __iter__(self):
        for i in range(len(self)):
            yield self.reading(i)

    def reading(self, i):
        """What the robot gets at its i-th stop, nothing of it shared with the world: Reading."""
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
        """Landmarks in sight, which no wall hides."""
        z = h(pose, self.landmarks)
        noisy = z + rng.standard_normal(z.shape) * SIGHT_SIGMA
        noisy[:, 1] = wrap(noisy[:, 1])
        clear = self.floor.cast(pose[:2], pose[2] + z[:, 1]) > z[:, 0] - 1e-6
        ids = np.flatnonzero(clear & (z[:, 0] < SIGHT) & (noisy[:, 0] > 0))
        return Observations(noisy[ids], ids)
