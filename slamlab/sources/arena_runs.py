"""Arena data sets: the MAK thesis' experiment (ch. 6–8) simulated, a robot with infrared scanner.

It follows the wall on its left through an arena of cardboard boxes, three laps round, and stops
every few centimetres to scan.
"""

from copy import copy
from dataclasses import replace

import numpy as np

from slamlab import worlds
from slamlab.geometry import compose, wrap
from slamlab.readings import Reading, Trajectory
from slamlab.simulation.differential_drive import DifferentialDrive, Simulator
from slamlab.simulation.range_scanners import GP2D120
from slamlab.simulation.wall_follower import WallFollower
from slamlab.sources.base import Source

ROBOT = DifferentialDrive(base=0.1, tick=0.0002, slip=0.003, radius=0.06, phase=0.5)
"""Robot of 12 × 12 cm (differential drive): a toy's chassis with the encoders of a computer mouse.

The thesis gives no figures of its odometry but that it strays farther and farther; this slip is
3 mm after a metre on each wheel, so some 10 cm and 20° after three laps.
"""

LAPS = 3  # rounds of the robot through the arena [1]
SETS = tuple((seed, seed == 6) for seed in range(1, 7))
"""Six data sets: seed, and whether the cable was snagged (odometry outlier): :func:`data_set`."""

BOX_CENTRE = 0.3, -0.32  # of the box that the robot goes round [m]
SCAN_SECONDS = 4.5  # 90 readings, the servo at rest for each
SNAG_DISTANCE = 0.05, 0.10  # what odometry gains while the cable holds the robot [m]
SNAG_TURN = np.radians(20), np.radians(40)  # to either side [rad]


class ArenaRun(Source):
    """Simulated run of a wall-following robot through the arena, its readings filtered afterwards.

    Reading i always has the same noise, so every iteration yields the same readings.

    Parameters
    ----------
    rng : numpy.random.Generator; one number is drawn, all noise grows from it
    laps : int
    robot : DifferentialDrive

    ``world`` is the arena, for evaluation only; ``snag`` the reading with the gross error or None.

    Raises
    ------
    ValueError : less than a lap
    """

    name = "sim:arena"
    world = worlds.arena()
    scanner = GP2D120
    follower = WallFollower()

    def __init__(self, rng, laps=LAPS, robot=ROBOT):
        super().__init__()
        if laps < 1:
            raise ValueError(f"laps is at least 1, not {laps}")
        self.robot, self.sensor = robot.model, self.scanner.model
        self._seed = int(rng.integers(2**63))
        self.truth, self._odometry = self._simulate_drive(laps, robot)
        self.snag = None

    def __len__(self):
        return len(self.truth)

    def __iter__(self):
        for i, (time, pose) in enumerate(zip(self.truth.times, self.truth.poses, strict=True)):
            yield Reading(
                time, self._odometry[i], self.scanner.scan(self.world, pose, self._rng(i))
            )

    def snagged(self):
        """Copy of the run with one odometry outlier: in its middle third the cable held the robot.

        The wheels turned on: one gross error of the odometry, and nothing else differs.

        Returns
        -------
        ArenaRun
        """
        rng, n, run = self._rng(-2), len(self), copy(self)
        run.name, run.snag = "sim:arena-snagged", int(rng.integers(n // 3, 2 * n // 3))
        turn = rng.choice([-1, 1]) * rng.uniform(*SNAG_TURN)
        gained = np.array([rng.uniform(*SNAG_DISTANCE), 0.0, turn])
        run._odometry = self._odometry.copy()
        run._odometry[run.snag] = compose(self._odometry[run.snag], gained)
        return run

    def _simulate_drive(self, laps, robot):
        """Trajectory of the stops, and the odometry that led to each."""
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
        """Noise of reading i; of the wheels at −1, of the cable at −2."""
        return np.random.default_rng([self._seed, 2 + i])


def data_set(seed, snagged=False):
    """Arena data set of a seed, such as one of ``SETS``.

    Parameters
    ----------
    seed : int
    snagged : bool

    Returns
    -------
    ArenaRun
    """
    run = ArenaRun(np.random.default_rng(seed))
    return run.snagged() if snagged else run


def _bearing_from_centre(pose):
    return float(np.arctan2(pose[1] - BOX_CENTRE[1], pose[0] - BOX_CENTRE[0]))
