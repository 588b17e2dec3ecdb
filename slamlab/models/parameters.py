"""Parameters of a robot's odometry noise and of a range sensor: noise, range, field of view."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class RobotModel:
    """Odometry noise parameters of a robot, slip among them, as an estimator knows them.

    Parameters
    ----------
    distance_error : float, standard deviation as a share of the distance [1]
    turn_error : float, standard deviation as a share of the turn [1]
    turn_per_metre : float, standard deviation of the turn picked up per metre [rad/m]
    slip : float, of each of two wheels, standard deviation after 1 m, growing with the root of the
        way [m/√m]
    base : float, distance of these wheels [m]
    radius : float, for drawing [m]
    """

    distance_error: float = 0.05
    turn_error: float = 0.05
    turn_per_metre: float = 0.05
    slip: float = 0.0
    base: float = 0.3
    radius: float = 0.15


@dataclass(frozen=True)
class SensorModel:
    """Range sensor parameters: range limits, field of view, measurement noise.

    Parameters
    ----------
    range_min, range_max : float [m]
    field_of_view : float, field of view [rad]
    range_error : float, standard deviation as a share of the range [1]
    range_sigma : float, standard deviation at range zero [m]
    bearing_sigma : float [rad]
    range_curvature : float, standard deviation per range squared, of sensors that triangulate [1/m]
    half_cone : float, half opening angle of a beam that hears the nearest surface in it, as a
        sonar's does; 0 of a lidar, whose beam is a ray [rad]
    """

    range_min: float = 0.0
    range_max: float = np.inf
    field_of_view: float = 2 * np.pi
    range_error: float = 0.01
    range_sigma: float = 0.0
    bearing_sigma: float = 0.005
    range_curvature: float = 0.0
    half_cone: float = 0.0

    def sigma(self, ranges):
        """Standard deviation of the measurement noise of ranges.

        σ² = (error r)² + σ₀² + (curvature r²)². Equation (02.11), and σ₀.

        Parameters
        ----------
        ranges : (...,) [m]

        Returns
        -------
        (...,) [m]
        """
        variance = (self.range_error * ranges) ** 2 + self.range_sigma**2
        if self.range_curvature:  # as few sensors have: asked for every line of every scan
            variance += (self.range_curvature * ranges**2) ** 2
        return np.sqrt(variance)
