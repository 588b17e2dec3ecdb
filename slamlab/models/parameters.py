"""Noise parameters of a robot's odometry and of a range sensor (motion and sensor model)."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class RobotModel:
    """Standard deviations of a robot's odometry noise, as an estimator assumes them.

    Parameters
    ----------
    distance_error, turn_error : float, shares of distance and turn [1]
    turn_per_metre : float [rad/m]
    slip : float, of a wheel's path after 1 m, proportional to the root of the path [m/√m]
    base : float, distance between the wheels [m]
    radius : float, of the robot [m]
    """

    distance_error: float = 0.05
    turn_error: float = 0.05
    turn_per_metre: float = 0.05
    slip: float = 0.0
    base: float = 0.3
    radius: float = 0.15


@dataclass(frozen=True)
class SensorModel:
    """Range sensor parameters: standard deviations of the noise.

    Parameters
    ----------
    range_min, range_max : float [m]
    field_of_view : float [rad]
    range_error : float, share of the range [1]
    range_sigma : float, at range zero [m]
    bearing_sigma : float [rad]
    range_curvature : float, per range squared [1/m]
    half_cone : float, half the beam width of a sonar; 0: a ray [rad]
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
        """Standard deviation: σ² = (error r)² + σ₀² + (curvature r²)². Equation (02.11) with σ₀."""
        variance = (self.range_error * ranges) ** 2 + self.range_sigma**2
        if self.range_curvature:  # of few sensors; this is called for each line of each scan
            variance += (self.range_curvature * ranges**2) ** 2
        return np.sqrt(variance)
