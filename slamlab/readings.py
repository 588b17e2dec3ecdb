"""Sensor data that a source yields: lidar scans, landmark observations, readings; trajectories."""

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Scan:
    """A range scan (lidar): one turn of a range sensor, in the robot's frame.

    Parameters
    ----------
    angles : (n,) directions, counter-clockwise from the robot's +x [rad]
    ranges : (n,) distances [m]; NaN where nothing came back
    range_max : float [m]; a reading at or beyond it is no return
    range_min : float [m]
    """

    angles: np.ndarray
    ranges: np.ndarray
    range_max: float = np.inf
    range_min: float = 0.0

    @property
    def valid(self):
        """(n,) bool mask of the valid beams, that hit something within range."""
        with np.errstate(invalid="ignore"):
            return (self.ranges > self.range_min) & (self.ranges < self.range_max)

    def points(self):
        """The scan as a point cloud: (k, 2) points hit, in the robot's frame [m], in beam order.

        Equation (02.3).
        """
        r, a = self.ranges[self.valid], self.angles[self.valid]
        return np.column_stack([r * np.cos(a), r * np.sin(a)])


@dataclass(frozen=True)
class Observations:
    """Landmark observations (measurements) of one moment: range, bearing, id; how corners open.

    Parameters
    ----------
    z : (m, 2) range [m] and bearing [rad]
    ids : (m,) int; -1 where the landmark is not known
    R : (m, 2, 2) covariances of z, or None where they are as the sensor's model says
    bisectors : (m,) of corners, direction between the two walls in the robot's frame, or None [rad]
    convex : (m,) bool, of corners, whether they are seen from outside, as a box's; or None
    """

    z: np.ndarray
    ids: np.ndarray
    R: np.ndarray | None = None
    bisectors: np.ndarray | None = None
    convex: np.ndarray | None = None

    def subset(self, rows):
        """The observations of some rows (k,), all of each."""
        parts = vars(self).items()
        return Observations(**{k: None if part is None else part[rows] for k, part in parts})


@dataclass(frozen=True)
class Reading:
    """One time step of sensor data: odometry increment, scan and landmark observations.

    Parameters
    ----------
    time : float [s]
    odometry : (3,) increment since the last reading, in the frame of the pose then [m, m, rad]
    scan : Scan or None
    observations : Observations or None
    control : (k,) array or None, the command that was driven (its meaning: the source's robot)
    """

    time: float
    odometry: np.ndarray = field(default_factory=lambda: np.zeros(3))
    scan: Scan | None = None
    observations: Observations | None = None
    control: np.ndarray | None = None


@dataclass(frozen=True)
class Trajectory:
    """A trajectory: timestamped poses.

    Parameters
    ----------
    times : (n,) [s], increasing
    poses : (n, 3) [m, m, rad]
    """

    times: np.ndarray
    poses: np.ndarray

    def __len__(self):
        return len(self.times)
