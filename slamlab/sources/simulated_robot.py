"""Simulated robot as a source: lidar scans and odometry in predefined worlds."""

from dataclasses import replace

import numpy as np

from slamlab.files import SourceError
from slamlab.geometry import compose
from slamlab.models.parameters import RobotModel
from slamlab.readings import Reading, Trajectory
from slamlab.simulation import worlds
from slamlab.simulation.differential_drive import DifferentialDrive, Simulator, follow_waypoints
from slamlab.simulation.pedestrians import WALKS
from slamlab.simulation.range_scanners import RPLIDAR_A2, ULTRASONIC
from slamlab.sources.arena_runs import ArenaRun
from slamlab.sources.base import SimulatedRun, checked_command
from slamlab.sources.handheld_lidar import CARRIED, HandheldLidar
from slamlab.sources.landmark_runs import LandmarkRun, Loop

PERIOD = 0.5  # between readings [s]

# small indoor robot: wheels unequal by 0.3 %, wheel base wrong by 1 %, small slip
ROBOT = DifferentialDrive(left_scale=0.9985, right_scale=1.0015, base_scale=0.99, slip=0.003)

# waypoints of the route (x, y) by world [m]
ROUTES = {
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
# Smolec's: range noise 1 %, exact wheels with Gaussian noise (§3.1, §3.2); dropouts as frequent as
# in real recordings, including those at edges
THESIS_LIDAR = replace(RPLIDAR_A2, range_error=0.01, range_curvature=0.0, dropouts=0.03)
THESIS_ROBOT = DifferentialDrive(slip=0.01)

# Tuček's measured steps, and his intentionally wrong ones: rotation α [rad], then distance d along
# the new heading [m]
POLYGON_TRUE_STEPS = np.array([[np.radians(-45), 0.273], [np.radians(-45), 0.325], [0.0, 0.188]])
POLYGON_WRONG_STEPS = np.array(
    [[np.radians(-35), 0.150], [np.radians(-60), 0.450], [np.radians(20), 0.100]]
)


def turn_then_drive(steps):
    """Return increments (n, 3) [d cos α, d sin α, α] of steps (n, 2): rotation α, distance d."""
    turn, d = np.asarray(steps, dtype=float).T
    return np.column_stack([d * np.cos(turn), d * np.sin(turn), turn])


class Simulation(SimulatedRun):
    """Simulation of a robot with a lidar in a world.

    ``poses`` (n, 3) are true poses, ``odometry`` (n, 3) measured increments, ``controls`` (n, 2) v
    and ω of each step. Without a ``simulator``, the robot cannot be driven.
    """

    def __init__(
        self, name, world, lidar, rng, poses, odometry, controls=None, robot=None, simulator=None
    ):
        super().__init__(rng)
        self.name, self.world, self.lidar = name, world, lidar
        self.sensor = lidar.model
        self.robot = robot or RobotModel()
        self._poses, self._odometry = list(poses), list(odometry)
        self._controls = list(controls) if controls is not None else [None] * len(self._poses)
        self._simulator = simulator

    @property
    def drivable(self):
        return self._simulator is not None

    @property
    def truth(self):
        return Trajectory(PERIOD * np.arange(len(self)), np.array(self._poses))

    def __len__(self):
        return len(self._poses)

    def drive(self, command):
        """Drive for one period and return the new Reading. The robot stops at a wall."""
        if self._simulator is None:
            raise SourceError(f"{self.name} is a fixed run and cannot be driven")
        v, omega = checked_command(command)
        if self._blocked(v):
            v = 0.0
        self._odometry.append(self._simulator.step(v, omega, PERIOD))
        self._poses.append(self._simulator.pose)
        self._controls.append(np.array([v, omega]))
        return self._reading(len(self) - 1)

    def _reading(self, i):
        scan = self.lidar.scan(self.world, self._poses[i], self._rng(i))
        return Reading(PERIOD * i, self._odometry[i], scan, control=self._controls[i])

    def _blocked(self, v):
        """Return whether the next step would hit a wall ahead (or behind, in reverse)."""
        x, y, theta = self._simulator.pose
        fan = theta + (np.pi if v < 0 else 0) + np.linspace(-1, 1, 9)
        reach = abs(v) * PERIOD + self._simulator.robot.radius
        return v != 0 and self.world.cast((x, y), fan).min() < reach


def simulation(world_name, rng, lidar=None, robot=None, tour=True):
    """Create a simulated run: a Simulation, a HandheldLidar, a LandmarkRun or an ArenaRun. Raises
    SourceError if the name is unknown.

    ``lidar`` (Scanner) and ``robot`` (DifferentialDrive) are by default those of the world. Without
    ``tour`` the robot does not follow the world's route: one reading, then ``drive``.
    """
    if world_name not in NAMES:
        raise SourceError(f"there is no simulation {world_name!r}; available: {', '.join(NAMES)}")
    if world_name == LANDMARKS:
        return LandmarkRun(Loop(), rng)
    if world_name in HANDHELD_RUNS:
        options = {} if lidar is None else {"lidar": lidar}
        return HandheldLidar(world_name.removesuffix(CARRIED), rng, **options)
    if world_name in ARENA:
        return ArenaRun(rng) if world_name == "arena" else ArenaRun(rng).snagged()
    if world_name == ULTRASONIC_ROOM:
        run = simulation("room", rng, lidar or ULTRASONIC, robot, tour)
        run.name = f"sim:{ULTRASONIC_ROOM}"
        return run
    thesis = world_name.startswith("situation")
    lidar = lidar or (THESIS_LIDAR if thesis else RPLIDAR_A2)
    robot = robot or (THESIS_ROBOT if thesis else ROBOT)
    if world_name in POLYGON_RUNS:
        return _polygon_run(world_name, rng, lidar)
    return _route_run(world_name, rng, lidar, robot, tour)


def _polygon_run(name, rng, lidar):
    poses = [np.zeros(3)]
    for motion in turn_then_drive(POLYGON_TRUE_STEPS):
        poses.append(compose(poses[-1], motion))
    odometry = [np.zeros(3), *turn_then_drive(POLYGON_RUNS[name])]
    robot = RobotModel(distance_error=0.3, turn_error=0.3, turn_per_metre=0.3)
    return Simulation(f"sim:{name}", worlds.polygon(), lidar, rng, poses, odometry, robot=robot)


def _route_run(name, rng, lidar, robot, tour):
    simulator = Simulator(robot, rng.spawn(1)[0])
    poses, odometry, controls = [simulator.pose], [np.zeros(3)], [None]
    for command, motion in follow_waypoints(simulator, ROUTES[name] if tour else [], period=PERIOD):
        poses.append(simulator.pose)
        odometry.append(motion)
        controls.append(command)
    world, model = worlds.by_name(name), robot.model
    return Simulation(f"sim:{name}", world, lidar, rng, poses, odometry, controls, model, simulator)


# names of simulated runs, after the prefix sim:
POLYGON_RUNS = {"polygon": POLYGON_TRUE_STEPS, "polygon-wrong": POLYGON_WRONG_STEPS}
LANDMARKS = "landmarks"
ARENA = "arena", "arena-snagged"
ULTRASONIC_ROOM = "room-ultrasonic"
HANDHELD_RUNS = tuple(flat + CARRIED for flat in WALKS)
NAMES = (*ROUTES, ULTRASONIC_ROOM, *POLYGON_RUNS, LANDMARKS, *ARENA, *HANDHELD_RUNS)
