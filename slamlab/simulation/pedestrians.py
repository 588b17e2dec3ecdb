"""Pedestrians: a person with a hand-held lidar, and other people (moving obstacles)."""

import numpy as np

from slamlab.geometry import compose
from slamlab.simulation import worlds
from slamlab.simulation.pedestrian_gait import Walk, interpolate_rows
from slamlab.simulation.worlds.ray_casting import cast_each_ray

BODY, BODY_RADIUS = (-0.5, 0.0, 0.0), 0.18  # carrier's pose in the lidar's frame, its radius [m]
PEDESTRIAN_RADIUS = 0.2  # [m]
CLEARANCE = 1.2  # distance that other people keep from the carrier [m]
SPEED, AVOIDANCE_SPEED, TIME_STEP = 0.7, 1.5, 0.05  # of other people [m/s, m/s, s]
# waypoints of the carrier's walk (x, y) by flat [m]
WALKS = {
    "flat": [
        *[(0.0, 0.0), (3.2, 0.0), (4.05, 0.4), (4.05, 1.6), (4.7, 2.5), (6.5, 2.5), (7.5, 2.2)],
        *[(7.6, 0.4), (7.3, -1.6), (7.2, -2.7), (5.4, -2.7), (3.6, -2.5), (3.05, -1.6)],
        *[(3.05, -0.3), (2.2, 0.0), (1.2, 0.05), (0.85, -0.5), (0.85, -1.6), (0.7, -2.7)],
        *[(0.1, -2.5), (0.3, -1.7), (0.85, -1.4), (0.85, -0.4), (1.45, 0.2), (1.45, 1.2)],
        *[(1.2, 2.0), (0.5, 3.2), (1.2, 3.1), (1.8, 2.2), (1.5, 1.4), (1.45, 0.5), (2.2, 0.0)],
        *[(5.5, 0.0), (6.9, 0.2), (7.6, 1.2), (7.2, 2.5), (5.6, 2.5), (4.5, 2.3), (4.05, 1.4)],
        *[(4.05, 0.3), (3.0, 0.0), (0.0, 0.0)],
    ],
    "flat-2": [
        *[(0.0, 0.0), (2.5, 0.0), (5.2, 0.0), (7.6, 0.1), (8.5, 0.6), (8.4, 2.4), (8.1, 4.0)],
        *[(7.2, 5.2), (7.0, 6.05), (5.2, 6.05), (4.0, 6.2), (3.75, 5.4), (3.75, 4.2), (3.1, 4.0)],
        *[(2.85, 3.5), (2.8, 2.7), (2.4, 2.3), (2.6, 1.8), (3.0, 1.9), (2.9, 3.4), (2.3, 4.0)],
        *[(1.0, 4.1), (0.65, 4.7), (0.65, 5.6), (0.8, 6.7), (0.2, 6.9), (0.1, 6.0), (0.65, 5.2)],
        *[(0.65, 4.4), (1.4, 4.0), (5.5, 4.0), (6.6, 4.1), (8.1, 4.2), (8.1, 2.8), (7.7, 2.2)],
        *[(6.3, 2.2), (5.3, 1.2), (5.0, 0.1), (3.6, 0.0), (1.2, 0.1), (0.3, 0.5), (0.3, 2.0)],
        *[(0.3, 3.5), (0.8, 4.0), (1.8, 4.0)],
    ],
    "flat-3": [
        *[(0.0, 0.0), (1.5, 0.0), (3.2, 0.0), (4.0, 0.4), (4.5, 0.8), (5.6, 0.8), (6.9, 0.9)],
        *[(7.7, 1.9), (7.7, 3.2), (7.2, 4.4), (6.2, 4.5), (4.5, 4.5), (3.5, 4.4), (3.05, 3.8)],
        *[(3.05, 2.9), (2.5, 2.55), (1.2, 2.5), (0.75, 2.9), (0.75, 3.8), (0.9, 4.8), (0.4, 5.3)],
        *[(0.1, 4.7), (0.4, 3.9), (0.75, 3.2), (1.3, 2.6), (4.0, 2.55), (5.6, 2.5), (6.1, 3.2)],
        *[(6.2, 4.0), (5.4, 4.5), (4.0, 4.6), (3.1, 4.1), (3.05, 3.0), (2.4, 2.55), (1.0, 2.55)],
        *[(0.35, 2.2), (0.35, 1.2), (0.7, 0.4), (1.6, 0.0), (3.2, 0.0), (3.9, 0.7), (3.3, 1.0)],
        *[(3.0, 0.4), (2.3, 0.0), (0.0, 0.0)],
    ],
}
# waypoints between which other people walk back and forth, by flat [m]
ROUTES = {
    "flat": [[(7.5, -3.0), (7.6, 0.0), (7.3, 3.0)], [(0.6, 0.0), (5.0, 0.0)]],
    "flat-2": [[(5.0, 0.0), (8.0, 0.3), (8.2, 2.6), (8.1, 4.6)], [(-0.5, 4.0), (5.5, 4.0)]],
    "flat-3": [[(6.2, 1.0), (7.7, 2.2), (7.2, 4.4)], [(3.0, 2.55), (0.5, 2.5)]],
}


class Pedestrians:
    """Other people (moving obstacles) who walk along k routes and avoid the carrier of a Walk."""

    def __init__(self, routes, walk, rng):
        self._times = np.arange(0, walk.duration + TIME_STEP, TIME_STEP)
        carrier = walk.pose_at(self._times)[:, :2]
        paths = [_avoiding(np.array(route), carrier, rng) for route in routes]
        self._positions = np.hstack([np.empty((len(carrier), 0)), *paths])

    def at(self, times):
        """Return circles (n, k, 3) with x, y, radius [m] at times (n,) [s]."""
        shape = len(times), self._positions.shape[1] // 2, 2
        positions = interpolate_rows(times, self._times, self._positions).reshape(shape)
        return np.dstack([positions, np.full(positions.shape[:2], PEDESTRIAN_RADIUS)])


class Carrier:
    """Person who carries a lidar on a Walk through a World, with ray casting from the poses.

    ``begin``: start time of the walk, by default the time of the first pose [s].
    """

    def __init__(self, world, walk, pedestrians, begin=None):
        self.world, self.walk, self._begin = world, walk, begin
        self._pedestrians = pedestrians

    def pose_at(self, times):
        """Return true poses (n, 3) at increasing times (n,) [s], headings unwrapped [m, m, rad]."""
        if self._begin is None:
            self._begin = times[0]
        return self.walk.pose_at(times - self._begin)

    def cast(self, times, poses, bearings):
        """Cast rays at times (n,) [s] from poses (n, 3) along bearings (n,) [rad].

        Returns ranges (n,) [m]. A beam of a tilted lidar hits a wall at a larger range. The carrier
        blocks beams to the rear.
        """
        times = times - self._begin
        roll, pitch = self.walk.tilt_at(times).T
        axis = np.arctan2(pitch, roll)
        along, across = np.cos(bearings - axis), np.sin(bearings - axis)
        across *= np.cos(np.hypot(roll, pitch))
        headings = poses[:, 2] + axis + np.arctan2(across, along)

        static = np.broadcast_to(self.world.circles, (len(times), *self.world.circles.shape))
        carrier = np.column_stack([compose(poses, BODY)[:, :2], np.full(len(times), BODY_RADIUS)])
        moving = self._pedestrians.at(times)
        circles = np.concatenate([static, moving, carrier[:, None]], axis=1)
        horizontal = cast_each_ray(poses[:, :2], headings, self.world.walls, circles)
        return horizontal / np.hypot(along, across)


def carrier(flat, rng, people=2, begin=None, **walking):
    """Create the carrier of a hand-held lidar in a predefined flat with up to 2 other people.

    ``walking``: options of :class:`Walk`. Raises ValueError for a world without a walk.
    """
    if flat not in WALKS:
        raise ValueError(f"world {flat!r} has no walk; available: {', '.join(WALKS)}")
    walk = Walk(WALKS[flat], rng, **walking)
    return Carrier(worlds.by_name(flat), walk, Pedestrians(ROUTES[flat][:people], walk, rng), begin)


def _avoiding(route, carrier, rng):
    """Return positions (n, 2) of a person who walks back and forth and avoids the carrier."""
    positions, goal, onward = np.empty_like(carrier), int(rng.integers(len(route))), 1
    position = route[goal]
    for i, other in enumerate(carrier):
        if np.hypot(*(route[goal] - position)) < SPEED * TIME_STEP:
            onward = onward if 0 <= goal + onward < len(route) else -onward
            goal += onward
        ahead, away = route[goal] - position, position - other
        near = np.clip(CLEARANCE / np.hypot(*away) - 1, 0, 1)
        walking = SPEED * ahead / np.hypot(*ahead)
        avoiding = AVOIDANCE_SPEED * away / np.hypot(*away)
        v = (1 - near) * walking + near * avoiding
        position = position + TIME_STEP * v
        positions[i] = position
    return positions
