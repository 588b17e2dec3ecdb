"""Simulator of a differential-drive robot: ground-truth pose, encoders, wheel slip, odometry."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import between, compose, wrap
from slamlab.models.parameters import RobotModel


@dataclass(frozen=True)
class DifferentialDrive:
    """Differential-drive model: two wheels, encoders, systematic and random odometry errors.

    Parameters
    ----------
    base, tick : float, nominal wheel base, distance per encoder tick [m]
    left_scale, right_scale, base_scale : float, true over nominal wheel travel, wheel base [1]
    slip : float, standard deviation of the wheel slip (true minus encoder distance) per root of the
        distance [m/√m]
    radius : float, radius of the robot [m]
    phase : float, initial fraction of a tick. Use 0.5 if commands correspond to whole ticks: near 0
        the number of ticks depends on the processor's rounding [1]
    """

    base: float = 0.3
    tick: float = 0.001
    left_scale: float = 1.0
    right_scale: float = 1.0
    base_scale: float = 1.0
    slip: float = 0.0
    radius: float = 0.15
    phase: float = 0.0

    def __post_init__(self):
        lengths = (self.base, self.tick, self.left_scale, self.right_scale, self.base_scale)
        if not min(lengths) > 0:
            raise ValueError("base, tick and the scales of a robot must be positive")
        if not self.slip >= 0:
            raise ValueError(f"slip, a standard deviation, must not be negative: {self.slip}")
        if not 0 <= self.phase < 1:
            raise ValueError(f"phase must be at least 0 and less than 1 tick, not {self.phase}")

    @property
    def model(self):
        """RobotModel with the same slip, and with systematic errors as standard deviations."""
        mean = (self.left_scale + self.right_scale) / 2 - 1
        difference = self.right_scale - self.left_scale
        return RobotModel(
            distance_error=abs(mean),
            turn_error=float(np.hypot(mean, self.base_scale - 1)),
            turn_per_metre=abs(difference) / self.base,
            slip=self.slip,
            base=self.base,
            radius=self.radius,
        )


def arc(left, right, base):
    """Motion model of a differential drive (forward kinematics): the odometry increment.

    The path is an exact circular arc about the instantaneous centre of rotation. Equations (02.14),
    (02.15), (12.2) and (12.4): d = (l+r)/2, Δθ = (r−l)/base, chord d·sin(Δθ/2)/(Δθ/2) at bearing
    Δθ/2. Returns (3,) [m, m, rad].

    Parameters
    ----------
    left, right : float, distances travelled by the wheels [m]
    base : float, wheel base [m]
    """
    turn = (right - left) / base
    chord = (left + right) / 2 * np.sinc(turn / 2 / np.pi)
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), wrap(turn)])


class Simulator:
    """Simulator of a differential-drive robot: ground truth (``pose``) and encoder odometry.

    Parameters
    ----------
    robot : DifferentialDrive
    rng : numpy.random.Generator
    pose : (3,) true start pose [m, m, rad]
    """

    def __init__(self, robot, rng, pose=(0.0, 0.0, 0.0)):
        self.robot, self.rng = robot, rng
        self.pose = np.array(pose, dtype=float)
        # left and right encoder distance since the tick before the start [m]
        self._rolled = np.full(2, robot.phase * robot.tick)

    def step(self, v, omega, seconds):
        """Drive at v, omega [m/s, rad/s] for a time [s]; return the odometry increment (3,).

        The wheel slip changes the true pose, but not the encoder ticks.
        """
        robot = self.robot
        roll = (v + np.array([-1, 1]) * omega * robot.base / 2) * seconds
        slip = robot.slip * np.sqrt(np.abs(roll)) * self.rng.standard_normal(2)
        travel = roll * [robot.left_scale, robot.right_scale] + slip
        self.pose = compose(self.pose, arc(*travel, robot.base * robot.base_scale))

        # quantisation: whole ticks are counted, the fraction is carried over to the next step
        ticks = np.floor((self._rolled + roll) / robot.tick) - np.floor(self._rolled / robot.tick)
        self._rolled += roll
        return arc(*(ticks * robot.tick), robot.base)


def follow_waypoints(simulator, waypoints, v=0.4, omega=0.6, period=0.5):
    """Follow waypoints with a controller that uses the true pose (waypoint following). Yields the
    command v, omega (2,) and the odometry increment (3,) [m, m, rad].

    Parameters
    ----------
    simulator : Simulator
    waypoints : (n, 2) [m]
    v, omega : float, maximum speed and turn rate [m/s, rad/s]
    period : float, duration of a command [s]
    """
    for goal in np.asarray(waypoints, dtype=float):
        for _ in range(10_000):  # with excessive slip the robot never arrives
            ahead = between(simulator.pose, np.append(goal, 0.0))
            distance, bearing = np.hypot(ahead[0], ahead[1]), np.arctan2(ahead[1], ahead[0])
            if distance < 0.05:
                break
            turn = np.clip(bearing / period, -omega, omega)
            if abs(bearing) > 0.3:
                command = np.array([0.0, turn])
            else:
                command = np.array([min(v, distance / period), turn])
            yield command, simulator.step(*command, period)
