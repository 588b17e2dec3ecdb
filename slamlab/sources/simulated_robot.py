"""Simulated robot as a source: lidar scans and odometry in ready worlds, by tour or by hand."""

from dataclasses import replace

import numpy as np

from slamlab import worlds
from slamlab.files.errors import SourceError
from slamlab.geometry import compose
from slamlab.models.parameters import RobotModel
from slamlab.readings import Reading, Trajectory
from slamlab.simulation.differential_drive import DifferentialDrive, Simulator, follow
from slamlab.simulation.range_scanners import RPLIDAR_A2, ULTRASONIC
from slamlab.sources.arena_runs import ArenaRun
from slamlab.sources.base import Source
from slamlab.sources.landmark_runs import LandmarkRun, Loop

PERIOD = 0.5  # between readings [s]

ROBOT = DifferentialDrive(left_scale=0.9985, right_scale=1.0015, base_scale=0.99, slip=0.003)
"""Small indoor robot: wheels unequal by 0.3 %, wheel base misjudged by 1 %, a little slip."""

# waypoints of a tour (x, y) by world [m]
TOURS = {
    "room": [(3.1, -0.6), (4.9, -0.9), (4.9, 1.2), (3.6, 2.6), (1.6, 2.3), (0.3, 1.6), (0.0, 0.0)],
    "corridor": [(12.0, 0.0), (12.0, 8.0), (-1.0, 8.0), (-1.0, 0.0), (0.0, 0.0)],
    "twins": [
        *[(3.0, 0.0), (3.0, 2.5), (1.0, 3.0), (2.6, 3.8), (4.6, 2.4), (3.0, 2.2), (3.0, 0.0)],
        *[(10.0, 0.0), (10.0, 2.5), (8.0, 3.0), (9.6, 3.8), (11.6, 2.4), (10.0, 2.2), (10.0, 0.0)],
        *[(13.5, 0.0), (0.0, 0.0)],
    ],
    "situation-1": [
        *[(0.0, 0.8), (0.0, 2.75), (0.0, 5.0), (1.8, 6.2), (-0.8, 6.2), (0.0, 4.5), (0.0, 2.75)],
        *[(5.0, 2.75), (5.0, 4.5), (6.5, 6.2), (5.0, 4.5), (5.0, 1.0), (6.5, -0.8), (5.0, 0.5)],
        *[(5.0, 2.75), (0.0, 2.75), (0.0, 0.0)],
    ],
    "situation-2": [
        *[(0.9, -0.6), (-0.6, -2.0), (-3.0, -1.4), (-4.4, -1.4), (-4.4, -3.8), (-3.2, -3.6)],
        *[(-3.2, -2.2), (-1.2, -1.2), (-1.8, 0.6), (0.8, 0.8), (0.0, 0.0)],
    ],
}
THESIS_LIDAR = replace(RPLIDAR_A2, range_error=0.01, range_curvature=0.0, dropouts=0.03)
THESIS_ROBOT = DifferentialDrive(slip=0.01)
"""For Smolec's situations: ranges 1 % off, exact wheels with Gaussian noise (§3.1, §3.2).

3 % of the beams come back empty, by chance: as many as in real recordings, those at edges included.
"""

POLYGON_TRUE_STEPS = np.array(
    [[np.radians(-45), 0.273], [np.radians(-45), 0.325], [0.0, 0.188]],
)
"""(3, 2) Tuček's measured steps: turn α [rad], then distance d along the new heading [m]."""

POLYGON_WRONG_STEPS = np.array(
    [[np.radians(-35), 0.150], [np.radians(-60), 0.450], [np.radians(20), 0.100]],
)
"""(3, 2) steps he gives out instead, wrong on purpose: turn [rad], distance [m]."""


def turn_then_drive(steps):
    """Odometry increments (relative poses) of steps that turn first: [d cos α, d sin α, α].

    Parameters
    ----------
    steps : (n, 2) turn α [rad], distance d [m]

    Returns
    -------
    (n, 3) [m, m, rad]
    """
    turn, d = np.asarray(steps, dtype=float).T
    return np.column_stack([d * np.cos(turn), d * np.sin(turn), turn])


class Simulation(Source):
    """Simulation of a robot with a lidar that was, or is being, driven through a world.

    Reading i always has the same noise, so every iteration yields the same readings.

    Parameters
    ----------
    name : str
    world : World
    lidar : Scanner
    rng : numpy.random.Generator; one number is drawn, all noise grows from it
    poses : (n, 3) true poses so far [m, m, rad]
    odometry : (n, 3) motion since the pose before, as the robot believes it [m, m, rad]
    controls : (n, 2) v and omega that led there [m/s, rad/s], or None
    robot : RobotModel, what the estimator is told of the odometry
    simulator : Simulator to drive on with, or None where that makes no sense
    """

    def __init__(
        self, name, world, lidar, rng, poses, odometry, controls=None, robot=None, simulator=None
    ):
        super().__init__()
        self.name, self.world, self.lidar = name, world, lidar
        self.sensor = lidar.model
        self.robot = robot or RobotModel()
        self._seed = int(rng.integers(2**63))
        self._poses, self._odometry = list(poses), list(odometry)
        self._controls = list(controls) if controls is not None else [None] * len(self._poses)
        self._simulator = simulator

    @property
    def drivable(self):
        """bool, whether there is a robot to drive; a fixed run has none."""
        return self._simulator is not None

    @property
    def truth(self):
        """Ground truth (Trajectory of the true poses), for evaluation only."""
        return Trajectory(PERIOD * np.arange(len(self)), np.array(self._poses))

    def __len__(self):
        return len(self._poses)

    def __iter__(self):
        for i in range(len(self)):
            yield self._reading(i)

    def drive(self, command):
        """Drive for one period and scan; a wall in the way stops the robot (collision check).

        Parameters
        ----------
        command : (2,) speed v, turn rate omega [m/s, rad/s]

        Returns
        -------
        Reading, the new last one

        Raises
        ------
        SourceError : the command is not two finite numbers, or this run is fixed
        """
        if self._simulator is None:
            raise SourceError(f"{self.name} is a fixed run: it cannot be driven")
        v, omega = _checked_command(command)
        if self._blocked(v):
            v = 0.0
        self._odometry.append(self._simulator.step(v, omega, PERIOD))
        self._poses.append(self._simulator.pose)
        self._controls.append(np.array([v, omega]))
        return self._reading(len(self) - 1)

    def _reading(self, i):
        rng = np.random.default_rng([self._seed, i])
        return Reading(
            time=PERIOD * i,
            odometry=self._odometry[i],
            scan=self.lidar.scan(self.world, self._poses[i], rng),
            control=self._controls[i],
        )

    def _blocked(self, v):
        """Whether a wall stands closer ahead (behind, when backing) than the next step reaches."""
        x, y, theta = self._simulator.pose
        fan = theta + (np.pi if v < 0 else 0) + np.linspace(-1, 1, 9)
        reach = abs(v) * PERIOD + self._simulator.robot.radius
        return v != 0 and self.world.cast((x, y), fan).min() < reach


def _checked_command(command):
    try:
        v, omega = (float(number) for number in command)
    except (TypeError, ValueError):
        raise SourceError(
            f"a command is speed and turn rate [m/s, rad/s], not {command!r}"
        ) from None
    if not np.isfinite([v, omega]).all():
        raise SourceError(f"a command is two finite numbers, not {command!r}")
    return v, omega


def simulation(world_name, rng, lidar=None, robot=None, tour=True):
    """Simulated run (source) by its name.

    Parameters
    ----------
    world_name : str, one of NAMES
    rng : numpy.random.Generator
    lidar : Scanner, by default an RPLIDAR_A2, for the situations THESIS_LIDAR, for the room by
        sound ULTRASONIC; among landmarks there is nothing to scan, the arena's robot has a scanner
        of its own
    robot : DifferentialDrive, by default ROBOT, for the situations THESIS_ROBOT; only the tours
        use it, the other runs have odometry of their own
    tour : bool; False starts with one reading and waits for ``drive``

    Returns
    -------
    Source, a Simulation, a LandmarkRun or an ArenaRun

    Raises
    ------
    SourceError : there is no such run; the text lists those there are
    """
    if world_name not in NAMES:
        raise SourceError(f"no simulation {world_name!r}; there are: {', '.join(NAMES)}")
    if world_name == LANDMARKS:
        return LandmarkRun(Loop(), rng)
    if world_name in ARENA:
        return ArenaRun(rng).snagged() if world_name == SNAGGED else ArenaRun(rng)
    if world_name == ROOM_BY_SOUND:
        heard = simulation("room", rng, lidar or ULTRASONIC, robot, tour)
        heard.name = f"sim:{ROOM_BY_SOUND}"
        return heard
    thesis = world_name.startswith("situation")
    lidar = lidar or (THESIS_LIDAR if thesis else RPLIDAR_A2)
    robot = robot or (THESIS_ROBOT if thesis else ROBOT)
    if world_name in POLYGON_RUNS:
        return _polygon_run(world_name, rng, lidar)
    return _tour_run(world_name, rng, lidar, robot, tour)


def _polygon_run(name, rng, lidar):
    poses = [np.zeros(3)]
    for motion in turn_then_drive(POLYGON_TRUE_STEPS):
        poses.append(compose(poses[-1], motion))
    odometry = [np.zeros(3), *turn_then_drive(POLYGON_RUNS[name])]
    robot = RobotModel(distance_error=0.3, turn_error=0.3, turn_per_metre=0.3)
    return Simulation(f"sim:{name}", worlds.polygon(), lidar, rng, poses, odometry, robot=robot)


def _tour_run(name, rng, lidar, robot, tour):
    simulator = Simulator(robot, rng.spawn(1)[0])
    poses, odometry, controls = [simulator.pose], [np.zeros(3)], [None]
    for command, motion in follow(simulator, TOURS[name] if tour else [], period=PERIOD):
        poses.append(simulator.pose)
        odometry.append(motion)
        controls.append(command)
    world, model = worlds.by_name(name), robot.model
    return Simulation(f"sim:{name}", world, lidar, rng, poses, odometry, controls, model, simulator)


# names of simulated runs, as after sim:
POLYGON_RUNS = {"polygon": POLYGON_TRUE_STEPS, "polygon-wrong": POLYGON_WRONG_STEPS}
LANDMARKS = "landmarks"
SNAGGED = "arena-snagged"
ARENA = "arena", SNAGGED
ROOM_BY_SOUND = "room-ultrasonic"
NAMES = (*TOURS, ROOM_BY_SOUND, *POLYGON_RUNS, LANDMARKS, *ARENA)
