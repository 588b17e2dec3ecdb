"""Coordinate frames of a robot (tf, transform tree): laser poses in the odometry frame over time.

Each frame has one parent. What moves is taken to move in the plane; what is fixed may be mounted in
any way, also upside down. Laser and odometry are synchronised (synchronized) by interpolation.
"""

import numpy as np
from scipy.spatial.transform import Rotation

MIN_COS_TILT = 0.9  # cosine of the tilt beyond which a laser does not scan the ground plane
WORLD_FRAMES = ("map", "world", "earth")  # frames above odometry's: somebody's corrections


class TransformTree:
    """Transform tree (tf buffer): transforms between coordinate frames, by child frame.

    Parameters
    ----------
    transforms : list of (stamp [s], parent, child, position (3,) [m], quaternion xyzw (4,))
    """

    def __init__(self, transforms):
        self.parents, self._fixed, self._moving = {}, {}, {}
        by_child = {}
        for stamp, parent, child, place, turn in transforms:
            self.parents[child] = parent
            by_child.setdefault((child, parent), []).append((stamp, *place, *turn))
        for (child, parent), rows in by_child.items():
            if self.parents[child] == parent:
                self._add_transforms(child, np.array(rows))

    def ancestors(self, frame):
        """Ancestors of a frame in the transform tree, itself first.

        Parameters
        ----------
        frame : str

        Returns
        -------
        list of str
        """
        chain = [frame]
        while chain[-1] in self.parents and self.parents[chain[-1]] not in chain:
            chain.append(self.parents[chain[-1]])
        return chain

    def odometry_frame(self, frame):
        """Odometry frame above another frame, in which odometry has it move, or None.

        Parameters
        ----------
        frame : str

        Returns
        -------
        str or None
        """
        chain = [name for name in self.ancestors(frame) if name not in WORLD_FRAMES]
        if "odom" in chain:
            return "odom"
        moved = any(name in self._moving for name in chain[:-1])
        return chain[-1] if moved else None

    def poses(self, frame, reference, times):
        """Look up planar poses of a frame in one of its ancestors, by interpolation at given times.

        Parameters
        ----------
        frame, reference : str, ``reference`` one of ``ancestors(frame)``
        times : (n,) [s]

        Returns
        -------
        (n, 3) [m, m, rad], (n,) bool where all that moves is known, bool whether it is upside down

        Raises
        ------
        ValueError : the frame is tilted
        """
        T = np.broadcast_to(np.eye(4), (len(times), 4, 4))
        known = np.ones(len(times), dtype=bool)
        for name in self.ancestors(frame)[: self.ancestors(frame).index(reference)]:
            if name in self._fixed:
                T = self._fixed[name] @ T
                continue
            stamps, planar = self._moving[name]
            known &= (times >= stamps[0]) & (times <= stamps[-1])
            at = np.column_stack([np.interp(times, stamps, column) for column in planar.T])
            T = _homogeneous(at) @ T
        up = T[:, 2, 2]
        if len(up) and np.abs(up).min() < MIN_COS_TILT:
            raise ValueError(f"{frame} is tilted: its scans are not of the ground's plane")
        theta = np.arctan2(T[:, 1, 0], T[:, 0, 0])
        return np.column_stack([T[:, :2, 3], theta]), known, bool(len(up) and up[0] < 0)

    def _add_transforms(self, child, rows):
        """Add rows of stamp, position and quaternion as a static or a moving transform."""
        turns = Rotation.from_quat(rows[:, 4:])
        # what is told again and again but never changes may be mounted in any way
        if np.ptp(rows[:, 1:], axis=0).max() < 1e-9:
            self._fixed[child] = np.eye(4)
            self._fixed[child][:3, :3] = turns[0].as_matrix()
            self._fixed[child][:3, 3] = rows[0, 1:4]
            return
        stamps, first = np.unique(rows[:, 0], return_index=True)
        yaw = np.unwrap(turns[first].as_euler("ZYX")[:, 0])
        self._moving[child] = stamps, np.column_stack([rows[first, 1:3], yaw])


def _homogeneous(poses):
    """Planar poses (n, 3) as homogeneous transforms in space (n, 4, 4)."""
    T = np.tile(np.eye(4), (len(poses), 1, 1))
    T[:, :2, 3] = poses[:, :2]
    c, s = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    T[:, 0, 0], T[:, 0, 1], T[:, 1, 0], T[:, 1, 1] = c, -s, s, c
    return T
