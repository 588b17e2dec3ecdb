"""Odometry increments that no robot makes: they are left out, as if it had stood still."""

from dataclasses import replace

import numpy as np

MAX_STEP = 50.0  # m between two readings; of what drives farther no two scans show one place


def odometry_anomaly(odometry):
    """The anomaly of an odometry increment: not finite, or a jump.

    Counters that were reset, or a damaged line, make a step of any size. Believed, it would leave
    nothing of a covariance but its largest numbers.

    Parameters
    ----------
    odometry : (3,) [m, m, rad]

    Returns
    -------
    str, empty where there is none
    """
    if not np.isfinite(odometry).all():
        return "odometry increments not finite"
    return "odometry jumps" if np.hypot(odometry[0], odometry[1]) > MAX_STEP else ""


def standing_still(reading):
    """A reading as if the robot had not moved since the last one: Reading."""
    return replace(reading, odometry=np.zeros(3))
