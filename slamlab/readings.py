"""Sensor data of a source: scans, landmark observations, readings, odometry; trajectories."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Scan:
    """A range scan (lidar): one revolution of a range sensor, in the robot's frame.

    angles : (n,) counter-clockwise from +x [rad]; ranges : (n,) [m], NaN: no return; times : (n,)
    times of the beams relative to the reading's time [s], if the scan is not deskewed yet.
    """

    angles: np.ndarray
    ranges: np.ndarray
    range_max: float = np.inf
    range_min: float = 0.0
    times: np.ndarray | None = None

    @property
    def valid(self):
        """Mask (n,) of the beams with a return between range_min and range_max."""
        with np.errstate(invalid="ignore"):
            return (self.ranges > self.range_min) & (self.ranges < self.range_max)

    def points(self):
        """Return the point cloud (k, 2) [m] of the scan in beam order. Equation (02.3)."""
        r, a = self.ranges[self.valid], self.angles[self.valid]
        return np.column_stack([r * np.cos(a), r * np.sin(a)])


@dataclass(frozen=True)
class Observations:
    """Landmark observations (measurements) at one time; unknown values are None.

    z : (m, 2) range [m], bearing [rad]; ids : (m,) int, −1: unknown; R : (m, 2, 2) covariances; for
    corners, bisectors : (m,) directions between the two walls [rad]; convex : (m,) bool.
    """

    z: np.ndarray
    ids: np.ndarray
    R: np.ndarray | None = None
    bisectors: np.ndarray | None = None
    convex: np.ndarray | None = None

    def subset(self, rows):
        """Return the observations in the given rows (k,)."""
        parts = vars(self).items()
        return Observations(**{k: None if part is None else part[rows] for k, part in parts})


@dataclass(frozen=True)
class Reading:
    """Sensor data of one time step: time [s]; control, the command (control input) of the robot.

    odometry : (3,) odometry increment since the last reading, in the frame of the last pose; None
    means no odometry, unlike an increment of zero.
    """

    time: float
    odometry: np.ndarray | None = None
    scan: Scan | None = None
    observations: Observations | None = None
    control: np.ndarray | None = None


@dataclass(frozen=True)
class Trajectory:
    """Trajectory: times (n,) [s], ascending; poses (n, 3) [m, m, rad]."""

    times: np.ndarray
    poses: np.ndarray

    def __len__(self):
        return len(self.times)
