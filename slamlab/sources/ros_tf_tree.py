"""Coordinate frames of ROS (TF frames): a tf tree resolves the pose of one frame in another.

Moving frames move in the plane (see ``PoseSeries``); static transforms are three-dimensional.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation

from slamlab.sources.ros_pose_interpolation import MIN_COS_TILT, ROW, SAME, PoseSeries

BLOCK = 10_000  # poses at a time, to bound the memory
# frames above that of the odometry, moved by corrections of a localisation
WORLD_FRAMES = ("map", "world", "earth", "utm")


@dataclass
class Motion:
    """Planar poses (n, 3) of a frame at given times, and masks (n,): ``covered`` (all moving
    transforms are known), ``tilted``, ``upside_down``. ``notes`` are sentences; ``interval`` is the
    time between timestamps [s], None for static transforms."""

    poses: np.ndarray
    covered: np.ndarray
    tilted: np.ndarray
    upside_down: np.ndarray
    notes: list = field(default_factory=list)
    interval: tuple | None = None

    @classmethod
    def empty(cls, count):
        none = np.zeros(count, dtype=bool)
        return cls(np.zeros((count, 3)), ~none, none, none.copy())


class TransformTree:
    """TF tree (transform tree, tf buffer) of the TF frames; each frame has one parent.

    ``moving`` and ``fixed`` are those of ``ros_messages.Messages``. ``notes`` are sentences about
    frames with several parents.
    """

    def __init__(self, moving, fixed):
        self.parents, self._links, self._notes = {}, {}, {}
        candidates = {}
        for (parent, child), row in fixed.items():
            candidates.setdefault(child, {})[parent] = np.array([row])
        for (parent, child), rows in moving.items():
            if parent != child:
                candidates.setdefault(child, {})[parent] = np.array(rows).reshape(-1, ROW)
        for child, by_parent in candidates.items():
            parent = max(by_parent, key=lambda name: _rank(name, len(by_parent[name])))
            if len(by_parent) > 1:
                several = " and ".join(sorted(by_parent))
                self._notes[child] = f"{child} has the parents {several}; {parent} is used"
            self.parents[child] = parent
            self._links[child] = _link(f"{parent} → {child}", by_parent[parent])

    def ancestors(self, frame):
        """Return the names of a frame and its ancestors in the tree."""
        chain = [frame]
        while chain[-1] in self.parents and self.parents[chain[-1]] not in chain:
            chain.append(self.parents[chain[-1]])
        return chain

    def moves(self, frame):
        """Return whether a frame moves relative to its parent."""
        return isinstance(self._links.get(frame), PoseSeries)

    def moving_links(self, frame, reference):
        """Return the PoseSeries of each moving transform between a frame and its ancestor."""
        return [link for link in self._down(frame, reference) if isinstance(link, PoseSeries)]

    def notes(self, frame):
        """Return sentences about a frame and its ancestors."""
        return [self._notes[name] for name in self.ancestors(frame) if name in self._notes]

    def resolve(self, reference, frame):
        """Resolve the pose of a frame in a reference; return factors (link, whether inverted), or
        None if the frames are not connected."""
        theirs, own = self.ancestors(reference), self.ancestors(frame)
        # the reference first: transforms may form a cycle
        common = next((name for name in (reference, *own) if name in theirs and name in own), None)
        if common is None:
            return None
        up = [(link, True) for link in reversed(self._down(reference, common))]
        return [*up, *((link, False) for link in self._down(frame, common))]

    def _down(self, frame, ancestor):
        chain = self.ancestors(frame)
        return [self._links[name] for name in reversed(chain[: chain.index(ancestor)])]


def motion(factors, stamps):
    """Return the Motion at times (Stamps) from the factors of ``TransformTree.resolve``."""
    found = Motion.empty(len(stamps.header))
    series = [link for link, _ in factors if isinstance(link, PoseSeries)]
    if series:
        headers = [poses.stamps.header for poses in series]
        found.interval = max(h.min() for h in headers), min(h.max() for h in headers)
    prepared = {poses: poses.prepare(stamps) for poses in series}
    found.notes = [note for _, note in prepared.values() if note]
    for start in range(0, len(stamps.header), BLOCK):
        part = slice(start, start + BLOCK)
        T = np.tile(np.eye(4), (len(stamps.header[part]), 1, 1))
        for link, inverted in factors:
            factor = link
            if isinstance(link, PoseSeries):
                factor, covered, tilted = prepared[link][0](part)
                found.covered[part] &= covered
                found.tilted[part] |= tilted
            T = T @ (np.linalg.inv(factor) if inverted else factor)
        theta = np.arctan2(T[:, 1, 0], T[:, 0, 0])
        found.poses[part] = np.column_stack([T[:, :2, 3], theta])
        found.upside_down[part] = T[:, 2, 2] < 0
        found.tilted[part] |= np.abs(T[:, 2, 2]) < MIN_COS_TILT
    return found


def _rank(parent, count):
    """Rank a parent frame: odometry is best, corrections by a localisation are worst."""
    return last_name(parent) not in WORLD_FRAMES, is_odometry(parent), count


def last_name(frame):
    """Return the name of a frame without its namespace."""
    return frame.rpartition("/")[2]


def is_odometry(frame):
    """Return whether the name is that of an odometry frame, such as odom."""
    return "odom" in last_name(frame)


def is_body(frame):
    """Return whether the name is that of a robot's body frame, such as base_link."""
    return last_name(frame).startswith(("base", "robot"))


def _link(name, rows):
    """Return the PoseSeries of a moving transform, or the matrix (4, 4) of a static one."""
    turns = rows[:, 5:] * np.where(rows[:, 5:] @ rows[0, 5:] < 0, -1, 1)[:, None]
    # a transform that is published repeatedly but never changes is static
    if max(np.ptp(rows[:, 2:5], axis=0).max(), np.ptp(turns, axis=0).max()) > SAME:
        return PoseSeries(name, rows)
    T = np.eye(4)
    T[:3, :3] = Rotation.from_quat(rows[0, 5:]).as_matrix()
    T[:3, 3] = rows[0, 2:5]
    return T
