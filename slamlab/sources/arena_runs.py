"""Simulated arena data sets: experiment of the MAK thesis (ch. 6–8) with an infrared scanner."""

from copy import copy
from dataclasses import replace

import numpy as np

from slamlab.geometry import compose, wrap
from slamlab.readings import Reading, Trajectory
from slamlab.simulation import worlds
from slamlab.simulation.differential_drive import DifferentialDrive, Simulator
from slamlab.simulation.range_scanners import GP2D120
from slamlab.simulation.wall_follower import WallFollower
from slamlab.sources.base import SimulatedRun

# 12 × 12 cm, a toy's chassis with the encoders of a computer mouse. The thesis states only that its
# odometry drifts; this slip causes about 10 cm and 20° after three laps
ROBOT = DifferentialDrive(base=0.1, tick=0.0002, slip=0.003, radius=0.06, phase=0.5)

LAPS = 3  # of the robot around the inner box [1]
# six data sets: seed, and whether the cable was snagged (odometry outlier)
SETS = tuple((seed, seed == 6) for seed in range(1, 7))

BOX_CENTRE = 0.3, -0.32  # of the inner box [m]
SCAN_SECONDS = 4.5  # 90 beams, the servo at rest for each
SNAG_DISTANCE = 0.05, 0.10  # odometry error while the cable holds the robot [m]
SNAG_TURN = np.radians(20), np.radians(40)  # in both directions [rad]


class ArenaRun(SimulatedRun):
    """Simulated run of a robot that follows the wall on its left and stops for each scan.

    ``snag`` is the index of the reading with the odometry outlier, or None.
    """

    name = "sim:arena"
    world = worlds.arena()
    scanner = GP2D120
    follower = WallFollower()

    def __init__(self, rng, laps=LAPS, robot=ROBOT):
        if laps < 1:
            raise ValueError(f"laps must be at least 1, not {laps}")
        super().__init__(rng)
        self.robot, self.sensor = robot.model, self.scanner.model
        self.truth, self._odometry = self._simulate_run(laps, robot)
        self.snag = None

    def _reading(self, i):
        scan = self.scanner.scan(self.world, self.truth.poses[i], self._rng(i))
        return Reading(self.truth.times[i], self._odometry[i], scan)

    def snagged(self):
        """Return a copy with one odometry outlier in the middle third, where the cable snags."""
        rng, n, run = self._rng(-2), len(self), copy(self)
        run.name, run.snag = "sim:arena-snagged", int(rng.integers(n // 3, 2 * n // 3))
        turn = rng.choice([-1, 1]) * rng.uniform(*SNAG_TURN)
        gained = np.array([rng.uniform(*SNAG_DISTANCE), 0.0, turn])
        run._odometry = self._odometry.copy()
        run._odometry[run.snag] = compose(self._odometry[run.snag], gained)
        return run

    def _simulate_run(self, laps, robot):
        wheel_rng, beam_rng = self._rng(-1).spawn(2)
        simulator = Simulator(robot, wheel_rng)
        beam = replace(self.scanner, beams=1, field_of_view=1e-9)  # the servo at rest

        def read():
            pose = simulator.pose + np.array([0, 0, self.follower.look])
            return np.nan_to_num(beam.scan(self.world, pose, beam_rng).ranges[0], nan=np.inf)

        times, poses, odometry, turned = [0.0], [simulator.pose], [np.zeros(3)], 0.0
        while abs(turned) < 2 * np.pi * laps:
            moved, seconds = self.follower.advance(simulator, read)
            times.append(times[-1] + SCAN_SECONDS + seconds)
            poses.append(simulator.pose)
            odometry.append(moved)
            turned += wrap(_bearing_from_centre(poses[-1]) - _bearing_from_centre(poses[-2]))
        return Trajectory(np.array(times), np.array(poses)), odometry

    def _rng(self, i):
        """Return the noise generator of reading i, of the wheels (i = −1) or the cable (i = −2)."""
        return super()._rng(2 + i)


def data_set(seed, snagged=False):
    """Return an ArenaRun with a seed, such as the seeds of ``SETS``."""
    run = ArenaRun(np.random.default_rng(seed))
    return run.snagged() if snagged else run


def _bearing_from_centre(pose):
    return float(np.arctan2(pose[1] - BOX_CENTRE[1], pose[0] - BOX_CENTRE[0]))
