"""What a source yields: scans, landmark observations, readings; and trajectories."""

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Scan:
    """One turn of a range sensor, in the robot's frame.

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
        """(n,) bool: the beams that hit something within range."""
        with np.errstate(invalid="ignore"):
            return (self.ranges > self.range_min) & (self.ranges < self.range_max)

    def points(self):
        """(k, 2) the points hit, in the robot's frame [m], in the order of the beams."""
        r, a = self.ranges[self.valid], self.angles[self.valid]
        return np.column_stack([r * np.cos(a), r * np.sin(a)])


@dataclass(frozen=True)
class Observations:
    """Landmarks seen at one moment.

    Parameters
    ----------
    z : (m, 2) range [m] and bearing [rad]
    ids : (m,) int; -1 where the landmark is not known
    R : (m, 2, 2) covariances of z, or None where they are as the sensor's model says
    """

    z: np.ndarray
    ids: np.ndarray
    R: np.ndarray | None = None


@dataclass(frozen=True)
class Reading:
    """What a robot knows at one moment.

    Parameters
    ----------
    time : float [s]
    odometry : (3,) motion since the last reading, in the frame of the pose then [m, m, rad]
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
    """Poses over time.

    Parameters
    ----------
    times : (n,) [s], increasing
    poses : (n, 3) [m, m, rad]
    """

    times: np.ndarray
    poses: np.ndarray

    def __len__(self):
        return len(self.times)
