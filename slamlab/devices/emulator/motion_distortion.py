"""Motion distortion: a lidar on a moving robot takes each sample from another pose."""

import numpy as np

from slamlab.simulation.range_scanners import RPLIDAR_A2

TABLE_BITS = 14  # log2 of the noise table's rows
HASH_MULTIPLIER = np.uint64(0x9E3779B97F4A7C15)  # 2⁶⁴ / golden ratio: Fibonacci hashing


class MovingLidar:
    """Range measurements of a lidar that moves with the robot: scans with motion distortion.

    A sample's noise hangs on its time alone, so however often it is asked for it is the same.

    Parameters
    ----------
    body : RobotBody that carries the lidar in its centre, front ahead
    rng : numpy.random.Generator, of the noise
    scanner : Scanner, whose noise and limits it has
    """

    def __init__(self, body, rng, scanner=RPLIDAR_A2):
        self._body, self._scanner, self._model = body, scanner, scanner.model
        self._noise = rng.standard_normal((1 << TABLE_BITS, 2))
        self._lost = rng.random(1 << TABLE_BITS) < scanner.dropouts
        self._times = None  # of the samples asked for last, and what hangs on them alone

    def __call__(self, times, directions):
        """Measure distances, each from the robot's pose at its time.

        Parameters
        ----------
        times : (n,) increasing [s]
        directions : (n,) clockwise from the lidar's front [degree]

        Returns
        -------
        (n,) [mm]; 0 where nothing came back
        """
        scanner, world = self._scanner, self._body.world
        if times is not self._times:  # a packet asks for its samples again and again
            self._times, self._sampled = times, self._sample(times)
        poses, beside, along, lost = self._sampled
        headings = poses[:, 2] - np.radians(directions) + beside
        ranges = cast_each_ray(poses[:, :2], headings, world.walls, world.circles)
        seen = np.isfinite(ranges) & ~lost
        ranges = np.where(seen, ranges, 0.0)
        ranges += self._model.sigma(ranges) * along
        inside = (ranges >= scanner.range_min) & (ranges <= scanner.range_max)
        return np.where(seen & inside, 1000 * ranges, 0.0)

    def _sample(self, times):
        """Poses, noise of bearings and of ranges, and which are lost: what hangs on times alone."""
        key = np.ascontiguousarray(times, dtype=float).view(np.uint64)
        row = (key * HASH_MULTIPLIER) >> np.uint64(64 - TABLE_BITS)
        beside, along = self._noise[row].T
        beside = self._scanner.bearing_sigma * beside
        return self._body.pose_at(times), beside, along, self._lost[row]


def cast_each_ray(positions, directions, walls, circles):
    """Ray casting with one origin per ray: distance to the nearest obstacle.

    ``slamlab.worlds.ray_casting`` casts many rays from one place; from the many of a moving lidar
    a plain table of rays and obstacles is quicker.

    Parameters
    ----------
    positions : (n, 2) [m]
    directions : (n,) counter-clockwise from +x [rad]
    walls : (w, 4) rows x1 y1 x2 y2 [m]
    circles : (c, 3) rows x y radius [m]

    Returns
    -------
    (n,) [m]; inf where nothing is met
    """
    ux, uy = np.cos(directions)[:, None], np.sin(directions)[:, None]
    x, y = positions[:, :1], positions[:, 1:]
    with np.errstate(divide="ignore", invalid="ignore"):
        ax, ay = walls[:, 0] - x, walls[:, 1] - y
        wx, wy = walls[:, 2] - walls[:, 0], walls[:, 3] - walls[:, 1]
        across = ux * wy - uy * wx
        along, share = (ax * wy - ay * wx) / across, (ax * uy - ay * ux) / across
        hits = (along >= 0) & (share >= 0) & (share <= 1)
        to_walls = np.where(hits, along, np.inf)
        cx, cy = circles[:, 0] - x, circles[:, 1] - y
        middle = ux * cx + uy * cy
        half = np.sqrt(circles[:, 2] ** 2 - (ux * cy - uy * cx) ** 2)
        near, far = middle - half, middle + half
        to_rims = np.where(near >= 0, near, np.where(far >= 0, far, np.inf))
    return np.minimum(  # NaN: past a rim
        to_walls.min(axis=1, initial=np.inf), np.fmin.reduce(to_rims, axis=1, initial=np.inf)
    )


Sight = MovingLidar  # name in the first edition
