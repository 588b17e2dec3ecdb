"""Trials with an emulated lidar and an emulated eMIR robot, in simulated time (lesson 14)."""

from dataclasses import dataclass, replace
from unittest import mock

import numpy as np
from scipy.spatial import cKDTree

from slamlab import estimators, sources
from slamlab.devices.emir import Calibration, commands
from slamlab.devices.emir.frames import Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.emir.wheel_odometry import Odometry
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.emulated_robot import COUNT_SIZE, EMIR, TOP_SPEEDS, EmulatedRobot
from slamlab.devices.emulator.motion_distortion import MovingLidar
from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
from slamlab.devices.rplidar.capsules import ExpressDecoder
from slamlab.devices.rplidar.requests import express
from slamlab.geometry import between, transform
from slamlab.simulation import worlds
from slamlab.simulation.differential_drive import Simulator
from slamlab.sources import lidar_on_robot

ROUND = [
    leg for ahead in (8.5, 5.4, 8.6, 5.3) for leg in ((ahead, 100, 0), (1.8, 0, 50))
]  # round the table of worlds.room: seconds, speed, turn [s, %, %]
ANSWER_SIZE = 7  # bytes before a lidar's stream
PERIOD = 0.1  # between two statuses [s]
NO_SLIP = replace(EMIR, slip=0.0)  # an eMIR whose odometry is exact


def received(device, asked, begin, seconds):
    """Return the bytes that an emulated device sends in the seconds after a request."""
    moments = begin + 0.01 * np.arange(1, round(100 * seconds) + 1)
    return device.feed(asked, begin) + b"".join(device.feed(b"", now) for now in moments)


def carried_lidar(body, seed=1):
    """Return an emulated lidar that is mounted on a robot."""
    rng = np.random.default_rng(seed)
    return RPLidarEmulator(MovingLidar(body, rng), rng=rng)


def statuses_of(course, world, seed=1):
    """Return the status messages that an emulated eMIR sends during commands (seconds, speed, turn)
    [s, %, %], and the simulated robot."""
    body = EmulatedRobot(world, np.random.default_rng(seed))
    emir, framer, now, found = EmirEmulator(body), Framer(), 0.0, []
    emir.feed(commands.info(True), now)
    for seconds, speed, turn in course:
        answer = received(emir, commands.move(speed, turn), now, seconds)
        now += seconds
        found += [Status.unpack(content) for content in framer.feed(answer)]
    return found, body


@dataclass(frozen=True)
class TwoScans:
    """Two scans of a lidar (n, 2) [degree, mm], and the odometry ``motion`` between them [m, m,
    rad]."""

    first: np.ndarray
    second: np.ndarray
    motion: np.ndarray

    def overlaid(self, clockwise=True, front=0.0):
        """Return the points of both scans (n, 2) [m], transformed by odometry to the first scan's
        frame, for angles clockwise or counter-clockwise from ``front`` [degree]."""
        sign = -1 if clockwise else 1
        first, second = (
            at[:, 1:] / 1000 * np.column_stack([np.cos(beta), np.sin(beta)])
            for at in (self.first, self.second)
            for beta in [np.radians(sign * (at[:, 0] - front))]
        )
        return first, transform(self.motion, second)

    def misfit(self, clockwise=True, front=0.0, percentile=50):
        """Return the median (or another percentile) of the distances of the second scan's points to
        their nearest neighbours in the first scan [cm]."""
        first, second = self.overlaid(clockwise, front)
        return 100 * float(np.percentile(cKDTree(first).query(second)[0], percentile))


def two_scans(speed, turn, seconds=4.0, world=None):
    """Take a scan, drive [%, %, s] without slip, and take another scan; by default in Tuček's
    polygon."""
    rng = np.random.default_rng(0)
    body = EmulatedRobot(world or worlds.polygon(), rng, robot=NO_SLIP)
    first = _scan(body, 0.0)
    body.advance(speed, turn, seconds)
    body.advance(0, 0, seconds)
    return TwoScans(first, _scan(body, seconds), body.pose)


def _scan(body, begin):
    sent = received(carried_lidar(body), express(1), begin, 0.5)
    nodes = ExpressDecoder().feed(sent[ANSWER_SIZE:])
    nodes = nodes[nodes["distance_q2"] > 0]
    return np.column_stack([nodes["angle_q6"] / 64, nodes["distance_q2"] / 4])


@dataclass(frozen=True)
class CountedRun:
    """A run: ``counts`` of distance and angle, bytes (n, 2), ten per second; true poses (n, 3)."""

    counts: np.ndarray
    true: np.ndarray

    def track(self, path_cm, turn_degrees):
        """Return poses (n, 3) [m, m, rad] from the counters, for the given size of a count [cm,
        degree]."""
        odometry = Odometry(Calibration(path_cm / 100, np.radians(turn_degrees)))
        return np.array(
            [odometry.advance(*n, PERIOD * k) for k, n in enumerate(self.counts.tolist())]
        )

    def error(self, path_cm, turn_degrees):
        """Return the position error of the last pose from the counters [cm]."""
        last = self.track(path_cm, turn_degrees)[-1]
        return 100 * float(np.hypot(*between(self.true[-1], last)[:2]))


def round_trip(seed):
    """Simulate a run around the table; return a CountedRun."""
    robot, rolled = Simulator(EMIR, np.random.default_rng(seed)), np.zeros(2)
    counts, true = [rolled], [robot.pose]
    for seconds, speed, turn in ROUND:
        command = np.array(TOP_SPEEDS) * [speed, turn] / 100
        for _ in range(round(seconds / PERIOD)):
            robot.step(*command, PERIOD)
            rolled = rolled + command * PERIOD
            counts.append(np.floor(rolled / COUNT_SIZE + 1e-9))
            true.append(robot.pose)
    return CountedRun(np.array(counts).astype(int).astype(np.int8), np.array(true))


def mapping_errors(path, true, ways):
    """Map a raw recording by icp in several ways; return {way: position error of the last pose
    [cm]}.

    ``true`` is the true Trajectory. A way is a dict: ``deskewed=False`` keeps the motion distortion
    of the scans; ``latency`` is how much too late the odometry is stamped [s].
    """
    source = sources.open(path)
    iter(source)  # begins the odometry anew
    revolutions = list(source._groups())  # the bytes are decoded once
    source._groups = lambda: iter(revolutions)
    return {name: _mapping_error(source, true, **way) for name, way in ways.items()}


def _mapping_error(source, true, deskewed=True, latency=0.0):
    deskew, pose_at = lidar_on_robot.deskew, source._odometry.pose_at
    source._pose_at = lambda time: pose_at(time - latency)
    replacement = deskew if deskewed else lambda scan, *_: scan
    estimator = estimators.make("icp", source)
    with mock.patch.object(lidar_on_robot, "deskew", replacement):
        for reading in lidar_on_robot.LidarOnRobot.__iter__(source):
            estimator.step(reading)
    return errors(estimator, true.poses[-1])[1]


def errors(estimator, true):
    """Return the position errors of odometry and of the estimate, (2,) [cm]."""
    poses = estimator.naive_pose, estimator.pose
    return np.array([100 * np.hypot(*between(true, pose)[:2]) for pose in poses])


def errors_now(pair):
    """Describe the position errors for a live view; return "" if the truth is unknown."""
    if not getattr(pair.source, "bench", None) or not len(pair.source.truth):
        return ""
    off = errors(pair.estimator, pair.source.truth.poses[: pair.count][-1])
    return "odometry alone {:.0f} cm, estimate {:.0f} cm off".format(*off)
