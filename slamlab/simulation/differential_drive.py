"""Simulator of a differential-drive robot: ground-truth pose, encoders, odometry with slip."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import between, compose, wrap
from slamlab.models.parameters import RobotModel


@dataclass(frozen=True)
class DifferentialDrive:
    """Differential drive: two wheels with encoders, and every error of their odometry as a number.

    Parameters
    ----------
    base : float, distance of the wheels as odometry believes it [m]
    tick : float, way a wheel rolls between two ticks of its encoder, as odometry believes it [m]
    left_scale, right_scale : float, true way of a wheel over believed way [1]
    base_scale : float, true over believed base [1]
    slip : float, random difference between rolled and travelled way, standard deviation after
        1 m; it grows with the root of the way, so it does not matter how the way is cut [m/√m]
    radius : float, for drawing and for keeping off the walls [m]
    phase : float, where between two ticks the encoders stand at the start, 0 to 1. For a robot all
        of whose commands roll whole ticks it is one half: at 0 or 1 the last bit of a sum would
        decide when a tick is counted, and processors differ there [1]
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
            raise ValueError("base, tick and the scales of a robot are above zero")
        if not self.slip >= 0:
            raise ValueError(f"slip is a standard deviation, not negative: {self.slip}")
        if not 0 <= self.phase < 1:
            raise ValueError(f"phase is a share of a tick, 0 to below 1, not {self.phase}")

    @property
    def model(self):
        """Odometry noise parameters for an estimator, a RobotModel.

        Slip as it is; the constant errors of the scales as standard deviations.
        """
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
    """Odometry increment of a differential drive (forward kinematics): a circular arc, exact.

    Equations (01.2), (12.2) and (12.4).

    d = (l+r)/2,  Δθ = (r−l)/base,  chord d·sin(Δθ/2)/(Δθ/2) at bearing Δθ/2

    Parameters
    ----------
    left, right : float, ways of the wheels [m]
    base : float, distance of the wheels [m]

    Returns
    -------
    (3,) pose in the frame of the pose before [m, m, rad]
    """
    turn = (right - left) / base
    chord = (left + right) / 2 * np.sinc(turn / 2 / np.pi)
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), wrap(turn)])


class Simulator:
    """Simulates a robot: ground truth and odometry (dead reckoning) side by side.

    Parameters
    ----------
    robot : DifferentialDrive
    rng : numpy.random.Generator
    pose : (3,) true start [m, m, rad]
    """

    def __init__(self, robot, rng, pose=(0.0, 0.0, 0.0)):
        self.robot, self.rng = robot, rng
        self.pose = np.array(pose, dtype=float)
        # left, right, since the tick before the start, as believed [m]
        self._rolled = np.full(2, robot.phase * robot.tick)

    def step(self, v, omega, seconds):
        """Simulate a command for a while: move the true pose, measure the odometry increment.

        Parameters
        ----------
        v, omega : float, commanded speeds [m/s, rad/s]
        seconds : float [s]

        Returns
        -------
        (3,) odometry increment: the motion by the encoders, in the frame of the pose before
        """
        robot = self.robot
        roll = (v + np.array([-1, 1]) * omega * robot.base / 2) * seconds
        slip = robot.slip * np.sqrt(np.abs(roll)) * self.rng.standard_normal(2)
        travel = roll * [robot.left_scale, robot.right_scale] + slip
        self.pose = compose(self.pose, arc(*travel, robot.base * robot.base_scale))

        # whole ticks are counted; the rest of a tick is not lost but counted later
        ticks = np.floor((self._rolled + roll) / robot.tick) - np.floor(self._rolled / robot.tick)
        self._rolled += roll
        return arc(*(ticks * robot.tick), robot.base)


def follow(simulator, waypoints, v=0.4, omega=0.6, period=0.5):
    """Waypoint controller: turn to the next waypoint, drive to it, a command per period.

    It is fed the true pose, so the robot stays on its path whatever its odometry says.

    Parameters
    ----------
    simulator : Simulator
    waypoints : (n, 2) [m]
    v, omega : float, top speeds [m/s, rad/s]
    period : float [s]

    Yields
    ------
    (2,) command v, omega [m/s, rad/s] and (3,) odometry, after each step
    """
    for goal in np.asarray(waypoints, dtype=float):
        for _ in range(10_000):  # slip beyond reason would never arrive
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
