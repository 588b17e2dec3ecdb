"""Gait of a pedestrian: pose and tilt of a hand-held lidar during a walk."""

import numpy as np

STEP = 0.01  # of the path [m], of the table of poses [s]
CORNER = 0.2  # scale of the rounding of corners [m]
SPEEDS = 0.5, 1.2  # limits of the walking speed [m/s]
ACCELERATION, EASE = 0.8, 0.15  # of a person; smoothing of the start [m/s², s]
TURN_RATE = 1.1  # of the path; below 1.5 with sway and hand [rad/s]
CREEP = 0.02  # speed of the last centimetre before a stop [m/s]
STAND = 1.0  # time at rest before the first and after the last step [s]
LOOK = np.radians(50)  # largest rotation during a stop [rad]
STRIDE = 0.9  # stride frequency [Hz]
SWAY = 0.01, 0.02, np.radians(1.5)  # of the body ahead, sideways, in heading, at 1 m/s [m, m, rad]
TILT = np.radians(6)  # largest tilt of the lidar [rad]
AIM = np.radians(4)  # largest heading error of the hand [rad]
WOBBLE, DRIFT = (0.2, 2.0), (0.05, 0.25)  # frequencies of the tilt, of the heading error [Hz]


class Walk:
    """A walk along waypoints (n, 2) [m]: pose and tilt of the hand-held lidar at any time.

    The person stands for 1 s at the first waypoint, facing the second, and for 1 s at the last.
    ``speed``: mean walking speed [m/s]; ``tilt``: largest tilt [rad]; ``stops``: number of stops
    with a rotation in place. Attributes: ``length`` [m], ``duration`` [s].
    """

    def __init__(self, waypoints, rng, speed=0.85, tilt=TILT, stops=3):
        path, headings = _rounded_path(np.asarray(waypoints, dtype=float))
        self.length = STEP * (len(path) - 1)
        when, rows, looks = _time_profile(headings, speed, stops, rng)
        self.duration = when[-1]
        self._times = t = np.arange(0, self.duration + STEP, STEP)
        row = _smoothed(np.interp(t, when, rows), EASE / STEP)
        x, y, theta = (
            np.interp(row, np.arange(len(path)), column) for column in (*path.T, headings)
        )
        for begin, seconds, turn in looks:
            theta += turn * np.sin(np.pi * np.clip((t - begin) / seconds, 0, 1)) ** 2

        v, phase = STEP * np.gradient(row, t), 2 * np.pi * STRIDE * t
        theta += v * SWAY[2] * np.sin(phase)
        theta += np.clip(t - STAND, 0, 1) * AIM * _oscillation(t, DRIFT, rng)
        ahead, aside = v * SWAY[0] * np.sin(2 * phase), v * SWAY[1] * np.cos(phase)
        c, s = np.cos(theta), np.sin(theta)
        self._poses = np.column_stack([x + c * ahead - s * aside, y + s * ahead + c * aside, theta])
        wobble = np.column_stack([_oscillation(t, WOBBLE, rng), _oscillation(t, WOBBLE, rng)])
        self._tilts = tilt * wobble / np.hypot(*wobble.T).max()

    def pose_at(self, times):
        """Return the true poses (n, 3) at times (n,) [s], with unwrapped headings [m, m, rad]."""
        return interpolate_rows(times, self._times, self._poses)

    def tilt_at(self, times):
        """Return roll and pitch (n, 2) [rad] at times (n,) [s]."""
        return interpolate_rows(times, self._times, self._tilts)


def _rounded_path(waypoints):
    """Return the path (m, 2) with rounded corners, sampled every centimetre, and headings (m,)."""
    path = _resampled(_smoothed(_resampled(waypoints), CORNER / STEP))
    return path, np.unwrap(np.arctan2(*np.gradient(path, axis=0).T[::-1]))


def _resampled(points):
    along = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    even = np.arange(0, along[-1], STEP)
    return np.column_stack([np.interp(even, along, column) for column in points.T])


def _smoothed(values, sigma):
    """Smooth values along the first axis with a Gaussian, and preserve both ends."""
    reach = min(int(4 * sigma), len(values) - 1)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    columns = values.reshape(len(values), -1).T
    padded = np.pad(columns, ((0, 0), (reach, reach)), "reflect", reflect_type="odd")
    smoothed = [np.convolve(column, kernel / kernel.sum(), "valid") for column in padded]
    return np.array(smoothed).T.reshape(values.shape)


def _time_profile(headings, speed, stops, rng):
    """Return times and rows of the path, and (begin, duration, rotation) of each stop."""
    n = len(headings)
    walking = speed * (1 + 0.25 * _oscillation(STEP * np.arange(n), (0.05, 0.3), rng))
    bends = np.abs(np.gradient(headings)) / STEP
    fastest = np.minimum(np.clip(walking, *SPEEDS), TURN_RATE / np.maximum(bends, 1e-9))
    stands = np.sort(rng.choice(np.arange(n // 10, n - n // 10), stops, replace=False))
    fastest[[0, *stands, -1]] = CREEP
    ramp = 2 * ACCELERATION * STEP * np.arange(n)
    squares = np.minimum.accumulate(fastest**2 - ramp) + ramp
    squares = (np.minimum.accumulate(squares[::-1] - ramp) + ramp)[::-1]
    v = np.sqrt(squares)
    walked = np.concatenate([[0], np.cumsum(2 * STEP / (v[1:] + v[:-1]))])

    seconds, turns = rng.uniform(2, 4, stops), rng.uniform(-LOOK, LOOK, stops)
    waits = np.zeros(n)
    waits[[0, *stands, -1]] = STAND, *seconds, STAND
    leaving = walked + np.cumsum(waits)
    when = np.column_stack([leaving - waits, leaving])
    looks = list(zip(when[stands, 0], seconds, turns, strict=True))
    return when.ravel(), np.repeat(np.arange(n), 2), looks


def _oscillation(t, band, rng):
    """Return the mean, from −1 to 1, of five oscillations with frequencies in a band [Hz]."""
    waves = rng.uniform(*band, 5)[:, None] * t + rng.uniform(0, 1, 5)[:, None]
    return np.sin(2 * np.pi * waves).mean(axis=0)


def interpolate_rows(times, at, table):
    """Linearly interpolate a table (m, k) with times ``at``; return rows (n, k) at ``times``."""
    columns = [np.interp(times, at, column) for column in table.T]
    return np.reshape(columns, (len(columns), len(times))).T
