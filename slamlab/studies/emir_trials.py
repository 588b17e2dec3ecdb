"""Trials with an emulated lidar and an emulated eMIR, in simulated time, for lesson 14."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import cKDTree

from slamlab import worlds
from slamlab.devices.emir import Calibration, commands
from slamlab.devices.emir.frames import Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.emir.wheel_odometry import Odometry
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.motion_distortion import MovingLidar
from slamlab.devices.emulator.robot_body import COUNT_SIZE, EMIR, TOP_SPEEDS, RobotBody
from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
from slamlab.devices.rplidar.capsules import ExpressDecoder
from slamlab.devices.rplidar.requests import express
from slamlab.geometry import between, transform
from slamlab.simulation.differential_drive import Simulator

ROUND = [
    leg for way in (8.5, 5.4, 8.6, 5.3) for leg in ((way, 100, 0), (1.8, 0, 50))
]  # round the table of worlds.room: seconds, speed, turn [s, %, %]
ANSWER_SIZE = 7  # bytes before a lidar's stream
PERIOD = 0.1  # between two statuses [s]
NEVER_SLIPS = replace(EMIR, slip=0.0)  # an eMIR whose odometry is exact


def heard(device, asked, begin, seconds):
    """What an emulated device sends when it is asked something, and then left alone.

    Parameters
    ----------
    device : RPLidarEmulator or EmirEmulator
    asked : bytes
    begin, seconds : float, when it is asked, and for how long one listens [s]

    Returns
    -------
    bytes
    """
    moments = begin + 0.01 * np.arange(1, round(100 * seconds) + 1)
    return device.feed(asked, begin) + b"".join(device.feed(b"", now) for now in moments)


def lidar_on(body, seed=1):
    """Emulated lidar that a robot carries.

    Parameters
    ----------
    body : RobotBody
    seed : int, of its noise

    Returns
    -------
    RPLidarEmulator
    """
    rng = np.random.default_rng(seed)
    return RPLidarEmulator(MovingLidar(body, rng), rng=rng)


def statuses_of(course, world, seed=1):
    """Statuses that an emulated eMIR sends on a course, and its body.

    Parameters
    ----------
    course : list of (seconds, speed, turn) [s, %, %]
    world : World
    seed : int, of its slip

    Returns
    -------
    list of Status, RobotBody
    """
    body = RobotBody(world, np.random.default_rng(seed))
    emir, framer, now, found = EmirEmulator(body), Framer(), 0.0, []
    emir.feed(commands.info(True), now)
    for seconds, speed, turn in course:
        said = heard(emir, commands.move(speed, turn), now, seconds)
        now += seconds
        found += [Status.unpack(content) for content in framer.feed(said)]
    return found, body


@dataclass(frozen=True)
class TwoLooks:
    """Two looks of a lidar, and the robot's motion between them by its wheels.

    Parameters
    ----------
    first, second : (n, 2) the lidar's angle and distance of each point [degree, mm]
    motion : (3,) pose at the second look, seen from the first [m, m, rad]
    """

    first: np.ndarray
    second: np.ndarray
    motion: np.ndarray

    def overlaid(self, clockwise=True, front=0.0):
        """Points of both looks in the frame of the first, laid over each other by the wheels.

        Parameters
        ----------
        clockwise : bool, how the lidar's angles are read
        front : float, where the robot's front lies for the lidar [degree]

        Returns
        -------
        two (n, 2) [m]
        """
        sign = -1 if clockwise else 1
        first, second = (
            at[:, 1:] / 1000 * np.column_stack([np.cos(beta), np.sin(beta)])
            for at in (self.first, self.second)
            for beta in [np.radians(sign * (at[:, 0] - front))]
        )
        return first, transform(self.motion, second)

    def misfit(self, clockwise=True, front=0.0):
        """Median distance of the second look's points from the nearest of the first [cm]."""
        first, second = self.overlaid(clockwise, front)
        return 100 * float(np.median(cKDTree(first).query(second)[0]))


def two_looks(speed, turn, seconds=4.0, world=None):
    """Look, drive, and look again, with an emulated robot that never slips.

    Parameters
    ----------
    speed, turn : float [%]
    seconds : float, how long it drives [s]
    world : World, Tuček's polygon by default

    Returns
    -------
    TwoLooks
    """
    rng = np.random.default_rng(0)
    body = RobotBody(world or worlds.polygon(), rng, robot=NEVER_SLIPS)
    first = _look(body, 0.0)
    body.advance(speed, turn, seconds)
    body.advance(0, 0, seconds)
    return TwoLooks(first, _look(body, seconds), body.pose)


def _look(body, begin):
    sent = heard(lidar_on(body), express(1), begin, 0.5)
    nodes = ExpressDecoder().feed(sent[ANSWER_SIZE:])
    nodes = nodes[nodes["distance_q2"] > 0]
    return np.column_stack([nodes["angle_q6"] / 64, nodes["distance_q2"] / 4])


@dataclass(frozen=True)
class CountedDrive:
    """A drive, and what the counters told of it.

    Parameters
    ----------
    counts : (n, 2) int, bytes of path and angle, ten a second
    true : (n, 3) true poses [m, m, rad]
    """

    counts: np.ndarray
    true: np.ndarray

    def track(self, path_cm, turn_degrees):
        """Poses by the counters, (n, 3), if a count is so much [cm, degree] [m, m, rad]."""
        odometry = Odometry(Calibration(path_cm / 100, np.radians(turn_degrees)))
        return np.array(
            [odometry.advance(*n, PERIOD * k) for k, n in enumerate(self.counts.tolist())]
        )

    def error(self, path_cm, turn_degrees):
        """How far the last of these poses is from the true one [cm]."""
        last = self.track(path_cm, turn_degrees)[-1]
        return 100 * float(np.hypot(*between(self.true[-1], last)[:2]))


def round_trip(seed):
    """A drive round the table, told by the counters alone: no lidar looks.

    Parameters
    ----------
    seed : int, of the slip

    Returns
    -------
    CountedDrive
    """
    robot, rolled = Simulator(EMIR, np.random.default_rng(seed)), np.zeros(2)
    counts, true = [rolled], [robot.pose]
    for seconds, speed, turn in ROUND:
        command = np.array(TOP_SPEEDS) * [speed, turn] / 100
        for _ in range(round(seconds / PERIOD)):
            robot.step(*command, PERIOD)
            rolled = rolled + command * PERIOD
            counts.append(np.floor(rolled / COUNT_SIZE + 1e-9))
            true.append(robot.pose)
    return CountedDrive(np.array(counts).astype(int).astype(np.int8), np.array(true))


def errors(estimator, true):
    """How far the naive and the corrected pose of an estimator are from the true one.

    Parameters
    ----------
    estimator : Estimator
    true : (3,) [m, m, rad]

    Returns
    -------
    (2,) [cm]
    """
    poses = estimator.naive_pose, estimator.pose
    return np.array([100 * np.hypot(*between(true, pose)[:2]) for pose in poses])


def errors_now(pair):
    """The same of a live view, in words; empty where nobody knows the truth.

    Parameters
    ----------
    pair : what a note of ``views.live`` is called with

    Returns
    -------
    str
    """
    if not getattr(pair.source, "bench", None) or not len(pair.source.truth):
        return ""
    off = errors(pair.estimator, pair.source.truth.poses[: pair.count][-1])
    return "odometry alone {:.0f} cm, estimate {:.0f} cm off".format(*off)
