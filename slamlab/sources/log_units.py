"""Units of timestamps and headings in log files, detected from their values."""

import numpy as np

TIME_UNITS = {1.0: "seconds", 1e-3: "milliseconds", 1e-6: "microseconds", 1e-9: "nanoseconds"}
ALONG = 0.8  # least mean resultant length of headings along the path [1]


def time_unit(times, least, most):
    """Return the first of TIME_UNITS [s] in which the usual step of timestamps (n,) is from
    ``least`` to ``most`` seconds, or None."""
    steps = np.diff(times)
    period = np.median(steps[steps > 0]) if (steps > 0).any() else 0.0
    return next((unit for unit in TIME_UNITS if least <= period * unit <= most), None)


def headings_in_degrees(poses):
    """Return whether the headings of poses (n, 3) match the path in degrees, not in radians.

    A robot moves forward or back along its heading, so twice its angle to the path is constant.
    """
    dx, dy = np.diff(poses[:, :2], axis=0).T
    moved, theta = (dx != 0) | (dy != 0), poses[:-1, 2]
    if np.abs(poses[:, 2]).max(initial=0) <= 2 * np.pi or not moved.any():
        return False
    course = np.arctan2(dy, dx)[moved]
    in_radians, in_degrees = (
        abs(np.exp(2j * (course - unit * theta[moved])).mean()) for unit in (1, np.pi / 180)
    )
    return bool(in_degrees > max(ALONG, 2 * in_radians))
