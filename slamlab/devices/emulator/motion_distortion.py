"""Simulated motion distortion (rolling shutter): a lidar measures while it moves."""

import numpy as np

from slamlab.simulation.range_scanners import RPLIDAR_A2

TABLE_BITS = 14  # log2 of the noise table's rows
HASH_MULTIPLIER = np.uint64(0x9E3779B97F4A7C15)  # 2⁶⁴ / golden ratio: Fibonacci hashing


class MovingLidar:
    """Lidar on a moving robot or carrier, with motion distortion and noise.

    The noise of a sample depends only on the sample's time.
    """

    def __init__(self, body, rng, scanner=RPLIDAR_A2):
        self._body, self._scanner, self._model = body, scanner, scanner.model
        self._noise = rng.standard_normal((1 << TABLE_BITS, 2))
        self._lost = rng.random(1 << TABLE_BITS) < scanner.dropouts
        self._times = None  # of the last samples; their poses and noise are cached

    def __call__(self, times, directions):
        """Return distances (n,), 0 for no return [mm], at ascending times (n,) [s].

        The directions (n,) are clockwise from the lidar's front [degree].
        """
        scanner = self._scanner
        if times is not self._times:  # the packet encoder measures the same samples repeatedly
            self._times, self._sampled = times, self._sample(times)
        poses, bearing_noise, range_noise, lost = self._sampled
        ranges = self._body.cast(times, poses, bearing_noise - np.radians(directions))
        seen = np.isfinite(ranges) & ~lost
        ranges = np.where(seen, ranges, 0.0)
        ranges += self._model.sigma(ranges) * range_noise
        inside = (ranges >= scanner.range_min) & (ranges <= scanner.range_max)
        return np.where(seen & inside, 1000 * ranges, 0.0)

    def _sample(self, times):
        """Return the poses, noise of bearings and of ranges, and dropouts at times (n,) [s]."""
        key = np.ascontiguousarray(times, dtype=float).view(np.uint64)
        row = (key * HASH_MULTIPLIER) >> np.uint64(64 - TABLE_BITS)
        bearing_noise, range_noise = self._noise[row].T
        bearing_noise = self._scanner.bearing_sigma * bearing_noise
        return self._body.pose_at(times), bearing_noise, range_noise, self._lost[row]
