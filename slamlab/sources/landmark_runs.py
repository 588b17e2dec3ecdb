"""Simulated runs among point landmarks with known data association, on a circular loop."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from slamlab.geometry import compose, wrap
from slamlab.models.observation import h
from slamlab.models.parameters import RobotModel, SensorModel
from slamlab.readings import Observations, Reading, Trajectory
from slamlab.simulation.differential_drive import arc
from slamlab.sources.base import SimulatedRun

CLEARANCE = 0.5  # least distance of a landmark from the loop [m]


@dataclass(frozen=True)
class Loop:
    """Settings of a simulated run: circular loop, landmarks, odometry and measurement noise.

    Landmarks are on both sides of the loop, within ``spread`` of it; ``steps`` is the number of
    readings after the first. The noise of speed and turn rate is independent in each step.
    """

    landmarks: int = 20
    radius: float = 4.0
    spread: float = 2.0
    v: float = 0.3
    steps: int = 600
    period: float = 1.0
    v_sigma: float = 0.02
    omega_sigma: float = 0.012
    range_max: float = 2.5
    field_of_view: float = 2 * np.pi
    range_sigma: float = 0.1
    bearing_sigma: float = np.radians(2)

    def __post_init__(self):
        above_zero = (self.radius, self.v, self.period, self.range_max)
        if self.landmarks < 1 or self.steps < 1 or not min(above_zero) > 0:
            raise ValueError("landmarks, steps, radius, v, period and range_max must be positive")
        if not 0 < self.field_of_view <= 2 * np.pi:
            raise ValueError(
                f"field_of_view must be above 0 and at most 2π radians, not {self.field_of_view}"
            )
        if not CLEARANCE <= self.spread < self.radius:
            raise ValueError(
                f"spread must be from {CLEARANCE} m to below the radius, not {self.spread}"
            )
        if min(self.v_sigma, self.omega_sigma, self.range_sigma, self.bearing_sigma) < 0:
            raise ValueError("a standard deviation must not be negative")

    @property
    def robot(self):
        """RobotModel: at constant speed, the noise of v and ω becomes noise per metre."""
        return RobotModel(
            distance_error=self.v_sigma / self.v,
            turn_error=0.0,
            turn_per_metre=self.omega_sigma / self.v,
        )

    @property
    def sensor(self):
        return SensorModel(
            range_max=self.range_max,
            field_of_view=self.field_of_view,
            range_error=0.0,
            range_sigma=self.range_sigma,
            bearing_sigma=self.bearing_sigma,
        )


class LandmarkRun(SimulatedRun):
    """Simulated counter-clockwise run of a robot on a Loop, with observations of known landmarks.

    The robot follows the loop exactly; only its measurements have errors. ``landmarks`` (n, 2) are
    the true positions [m].
    """

    name = "sim:landmarks"

    def __init__(self, loop, rng):
        super().__init__(rng)
        self.loop, self.robot, self.sensor = loop, loop.robot, loop.sensor
        poses = [np.zeros(3)]
        for _ in range(loop.steps):
            poses.append(compose(poses[-1], _arc_motion(loop.v, loop.v / loop.radius, loop.period)))
        self.truth = Trajectory(loop.period * np.arange(len(poses)), np.array(poses))
        self.landmarks = _scatter_landmarks(loop, self._rng(len(poses)))

    def seen(self, pose):
        """Return the ids (m,) of the landmarks within range and field of view of a pose (3,)."""
        return self._visible(h(pose, self.landmarks))

    def _visible(self, z):
        r, bearing = z.T
        near = (r > 0) & (r <= self.loop.range_max)
        return np.flatnonzero(near & (np.abs(bearing) <= self.loop.field_of_view / 2))

    @cached_property
    def _noise(self):
        """Noise of odometry and observations, cached for several estimators."""
        rngs = [self._rng(i) for i in range(len(self))]
        odometry = [rng.standard_normal(2) for rng in rngs]
        return odometry, [rng.standard_normal((self.loop.landmarks, 2)) for rng in rngs]

    def _reading(self, i):
        loop, (odometry_noise, observation_noise) = self.loop, self._noise
        sigmas = [loop.v_sigma, loop.omega_sigma]
        v, omega = np.array([loop.v, loop.v / loop.radius]) + odometry_noise[i] * sigmas
        z = h(self.truth.poses[i], self.landmarks)
        ids = self._visible(z)
        z = z[ids] + observation_noise[i][ids] * [loop.range_sigma, loop.bearing_sigma]
        z[:, 1] = wrap(z[:, 1])
        usable = z[:, 0] > 0  # noise can make a small range negative
        return Reading(
            time=self.truth.times[i],
            odometry=_arc_motion(v, omega, loop.period) if i else np.zeros(3),
            observations=Observations(z[usable], ids[usable]),
        )


def _arc_motion(v, omega, seconds):
    d, turn = v * seconds, omega * seconds
    return arc(d - turn / 2, d + turn / 2, 1.0)


def _scatter_landmarks(loop, rng):
    n = loop.landmarks
    around = 2 * np.pi * (np.arange(n) + rng.random(n)) / n
    off = rng.uniform(CLEARANCE, loop.spread, n) * rng.choice([-1, 1], n)
    out = loop.radius + off
    return np.column_stack([out * np.cos(around), loop.radius + out * np.sin(around)])
