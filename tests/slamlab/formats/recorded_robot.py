"""A robot with a lidar in a known room, recorded in a ROS bag in all the ways that go wrong."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from slamlab.geometry import compose, transform
from slamlab.simulation.worlds.ray_casting import cast
from tests.slamlab.formats.bag_writing import MOUNT, Bag, rotation
from tests.slamlab.formats.room_runs import distances_to_walls

# segments x1 y1 x2 y2 of a room that looks alike from nowhere else [m]
ROOM = np.array(
    [
        [-4, -3, 5, -3],
        [5, -3, 5, 2],
        [5, 2, 2, 2],
        [2, 2, 2, 4],
        [2, 4, -4, 4],
        [-4, 4, -4, -3],
        [-2.5, 1.5, -1.5, 2.5],
    ]
)
BEGIN, COUNT, PERIOD = 100.0, 30, 0.1  # of the scans [s, 1, s]
ODOMETRY_PERIOD = 0.02  # [s]
FULL = np.linspace(-np.pi, np.pi, 240, endpoint=False)  # beams of a lidar [rad]


def pose(t):
    """True poses (..., 3) of the robot at times [s]."""
    t = np.asarray(t) - BEGIN
    return np.stack([0.8 * np.sin(0.9 * t), 0.6 * t - 1, 0.7 * np.sin(1.1 * t) + 0.2 * t], axis=-1)


def ranges_from(laser, angles):
    """True ranges (n,) [m] from poses (3,) or (n, 3) of a laser."""
    if np.ndim(laser) == 1:
        return cast(laser[:2], laser[2] + angles, ROOM)
    parts = np.array_split(np.arange(len(angles)), max(1, len(angles) // 3))
    each = [(laser[part[len(part) // 2]], angles[part]) for part in parts]
    return np.concatenate([ranges_from(*few) for few in each])


@dataclass
class Recording:
    """How a robot's messages are recorded.

    ``on_scan``, ``on_odometry`` get a message's number and arguments, which they may change; the
    message is lost where they give False. ``extra`` writes more messages. ``angles`` are those of
    scan k's beams [rad], as seen from above; ``sweep`` [s] is how much later the last beam is taken
    than the first, and ``turn_time`` what the header says of that. ``damage`` and ``note`` are what
    its reading shall report.
    """

    kind: str = "ros1"
    odometry: str | None = "topic"  # or tf
    mount: str | None = "/tf_static"
    mount_turn: np.ndarray | None = None
    on_scan: Callable = lambda k, message: None
    on_odometry: Callable = lambda k, message: None
    extra: Callable = lambda bag: None
    angles: Callable = lambda k: FULL
    sweep: float = 0.0
    turn_time: float = 0.0
    compress: Callable | None = None
    count: int = COUNT
    damage: dict = field(default_factory=dict)
    note: str = ""

    def write(self, path):
        """Write the bag to a folder; its path."""
        path.mkdir(exist_ok=True)
        path = path / ("run.bag" if self.kind == "ros1" else "run")
        with Bag(path, self.kind, self.compress) as bag:
            self.write_into(bag)
        return path

    def write_into(self, bag, scans=None):
        """Write the messages until and from some scans, those of a part of the recording."""
        first, last = (0, self.count) if scans is None else scans
        if self.mount and first == 0:
            bag.mount(BEGIN - 0.2, topic=self.mount, turn=self.mount_turn)
        begin, end = BEGIN + PERIOD * first, BEGIN + PERIOD * (last - 1)
        margin = 0.15 if scans is None else 0.05
        for k, t in enumerate(np.arange(begin - margin, end + margin, ODOMETRY_PERIOD)):
            self._write_odometry(bag, k, t)
        for k in range(first, last):
            self._write_scan(bag, k)
        self.extra(bag)

    def _write_odometry(self, bag, k, t):
        message = {"stamp": t, "pose": pose(t), "received": t + 0.002}
        if self.odometry is None or _lost(self.on_odometry(k, message)):
            return
        if self.odometry == "topic":
            bag.odometry(**message)
            return
        names = {"parent": "odom", "child": "base_link", "turn": rotation(message["pose"][2])}
        place = message.pop("pose")[:2]
        bag.transform(**{**names, "place": place, **message})

    def _write_scan(self, bag, k):
        t, angles = BEGIN + PERIOD * k, self.angles(k)
        times = np.linspace(max(0, -self.sweep), max(0, self.sweep), len(angles))
        laser = compose(pose(t + times if self.sweep else t), MOUNT)
        message = {
            "stamp": t,
            "received": t + 0.003,
            "ranges": ranges_from(laser, angles),
            "angle_min": angles[0],
            "angle_max": angles[-1],
            "angle_increment": (angles[-1] - angles[0]) / max(1, len(angles) - 1),
            "scan_time": PERIOD,
            "time_increment": self.turn_time / max(1, len(angles) - 1),
        }
        if not _lost(self.on_scan(k, message)):
            bag.scan(**message)


def _lost(kept):
    return kept is not None and not kept


def map_errors(source, begin=None):
    """Distances [m] of the points of all scans to the walls, by the source's odometry.

    ``begin`` is the true pose (3,) of the first scan.
    """
    laser = compose(pose(BEGIN), MOUNT) if begin is None else begin
    errors = []
    for reading in source:
        laser = compose(laser, reading.odometry)
        errors.append(_errors(reading.scan, laser))
    return np.concatenate(errors)


def errors_by_truth(source):
    """Distances [m] of the points of all scans to the walls, by the laser's true poses."""
    return np.concatenate([_errors(r.scan, compose(pose(r.time), MOUNT)) for r in source])


def _errors(scan, laser):
    points = scan.points()
    assert len(points) > 0.5 * len(scan.ranges)
    return distances_to_walls(transform(laser, points), ROOM)
