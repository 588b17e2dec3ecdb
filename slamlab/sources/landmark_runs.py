"""Simulated runs among point landmarks, with known data association: a robot drives a loop.

No scan, no walls: the landmarks come with their ids, so that a filter can be tried on its own.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from slamlab.geometry import compose, wrap
from slamlab.models.observation import h
from slamlab.models.parameters import RobotModel, SensorModel
from slamlab.readings import Observations, Reading, Trajectory
from slamlab.simulation.differential_drive import arc
from slamlab.sources.base import Source

CLEARANCE = 0.5  # least distance of a landmark from the loop [m]


@dataclass(frozen=True)
class Loop:
    """Settings of a simulated run: circular loop, landmarks, odometry and measurement noise.

    Odometry's noise is that of a speed and a turn rate, drawn anew for each step.

    Parameters
    ----------
    landmarks : int, how many
    radius : float, of the loop [m]
    spread : float, how far off the loop a landmark may lie, on either side [m]
    v : float, speed [m/s]
    steps : int, readings after the first
    period : float, between readings [s]
    v_sigma : float, standard deviation of the measured speed [m/s]
    omega_sigma : float, of the measured turn rate [rad/s]
    range_max : float, farthest landmark seen [m]
    field_of_view : float, centred on the heading [rad]
    range_sigma : float [m]
    bearing_sigma : float [rad]
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
            raise ValueError("a loop needs landmarks, steps, radius, v, period and range_max")
        if not 0 < self.field_of_view <= 2 * np.pi:
            raise ValueError(f"field_of_view is in radians, above 0 to 2π: {self.field_of_view}")
        if not CLEARANCE <= self.spread < self.radius:
            raise ValueError(f"spread is from {CLEARANCE} m to below the radius, not {self.spread}")
        if min(self.v_sigma, self.omega_sigma, self.range_sigma, self.bearing_sigma) < 0:
            raise ValueError("a standard deviation is not negative")

    @property
    def robot(self):
        """Robot model of the same odometry: at one speed, noise in v and ω is noise per metre."""
        return RobotModel(
            distance_error=self.v_sigma / self.v,
            turn_error=0.0,
            turn_per_metre=self.omega_sigma / self.v,
        )

    @property
    def sensor(self):
        """Sensor model (range–bearing sensor) of what observes the landmarks."""
        return SensorModel(
            range_max=self.range_max,
            field_of_view=self.field_of_view,
            range_error=0.0,
            range_sigma=self.range_sigma,
            bearing_sigma=self.bearing_sigma,
        )


class LandmarkRun(Source):
    """Simulated run of a robot round a loop, counter-clockwise, observing landmarks.

    It starts at the origin along x; landmarks come with their ids.
    The robot is steered along the true loop; what errs is what it measures. Reading i always has
    the same noise, so every iteration yields the same readings.

    Parameters
    ----------
    loop : Loop
    rng : numpy.random.Generator; one number is drawn, landmarks and noise grow from it

    ``landmarks`` (n, 2) are the true ones [m], for evaluation only.
    """

    name = "sim:landmarks"

    def __init__(self, loop, rng):
        super().__init__()
        self.loop, self.robot, self.sensor = loop, loop.robot, loop.sensor
        self._seed = int(rng.integers(2**63))
        poses = [np.zeros(3)]
        for _ in range(loop.steps):
            poses.append(compose(poses[-1], _arc_motion(loop.v, loop.v / loop.radius, loop.period)))
        self.truth = Trajectory(loop.period * np.arange(len(poses)), np.array(poses))
        self.landmarks = _scatter_landmarks(loop, self._rng(len(poses)))

    def __len__(self):
        return len(self.truth)

    def __iter__(self):
        for i in range(len(self)):
            yield self._reading(i)

    def seen(self, pose):
        """Visible landmarks: those within range and field of view (seen).

        Parameters
        ----------
        pose : (3,) [m, m, rad]

        Returns
        -------
        (m,) int ids, which are rows of ``landmarks``
        """
        return self._visible(h(pose, self.landmarks))

    def _visible(self, z):
        r, bearing = z.T
        near = (r > 0) & (r <= self.loop.range_max)
        return np.flatnonzero(near & (np.abs(bearing) <= self.loop.field_of_view / 2))

    @cached_property
    def _noise(self):
        """Of each reading, kept because many estimators take in one run: (n, 2), (n, k, 2) [1]."""
        rngs = [self._rng(i) for i in range(len(self))]
        of_motion = [rng.standard_normal(2) for rng in rngs]
        return of_motion, [rng.standard_normal((self.loop.landmarks, 2)) for rng in rngs]

    def _reading(self, i):
        loop, (of_motion, of_sights) = self.loop, self._noise
        v, omega = np.array([loop.v, loop.v / loop.radius]) + of_motion[i] * [
            loop.v_sigma,
            loop.omega_sigma,
        ]
        z = h(self.truth.poses[i], self.landmarks)
        ids = self._visible(z)
        z = z[ids] + of_sights[i][ids] * [loop.range_sigma, loop.bearing_sigma]
        z[:, 1] = wrap(z[:, 1])
        usable = z[:, 0] > 0  # noise may push a near landmark behind the sensor
        return Reading(
            time=self.truth.times[i],
            odometry=_arc_motion(v, omega, loop.period) if i else np.zeros(3),
            observations=Observations(z[usable], ids[usable]),
        )

    def _rng(self, i):
        return np.random.default_rng([self._seed, i])


def _arc_motion(v, omega, seconds):
    """(3,) motion increment of constant velocities, in the start's frame: an arc [m, m, rad]."""
    d, turn = v * seconds, omega * seconds
    return arc(d - turn / 2, d + turn / 2, 1.0)


def _scatter_landmarks(loop, rng):
    """(n, 2) landmarks inside and outside of the loop, all the way round [m]."""
    n = loop.landmarks
    around = 2 * np.pi * (np.arange(n) + rng.random(n)) / n
    off = rng.uniform(CLEARANCE, loop.spread, n) * rng.choice([-1, 1], n)
    out = loop.radius + off
    return np.column_stack([out * np.cos(around), loop.radius + out * np.sin(around)])
