"""What lesson 12 shows of a drive through the arena: its corners named, changed, and drawn."""

from dataclasses import replace

import numpy as np

from slamlab.estimators.corner_names import CornerNames
from slamlab.estimators.landmark_observations import CORNER_R_FACTOR, SHORT_RANGE_RANSAC
from slamlab.landmarks.ransac import lines
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.models.jacobians import J_z
from slamlab.models.observation import g

ENLARGED = 3  # times as large as it is, a corner's ellipse can be seen
BEYOND = 0.3  # share of its length by which a wall is drawn beyond its ends
ARROW = 0.06  # m, length of a bisector


def named(source, readings):
    """Name the corners of a drive once, by an EKF-SLAM run beside, for any filter to take.

    Parameters
    ----------
    source : ArenaRun
    readings : its own, with corners

    Returns
    -------
    list of Reading
    """
    names = CornerNames("mak", source.robot, source.sensor, np.random.default_rng(0))
    return [replace(reading, observations=names.observe(reading)) for reading in readings]


def with_changed_corners(readings, opening, times_R):
    """Readings whose corners do or do not say how they open, with another R.

    Parameters
    ----------
    readings : of an arena run, with corners
    opening : bool, whether the corners keep bisector and convexity
    times_R : float, R of a corner over that of the two lines that meet in it

    Returns
    -------
    list of Reading
    """
    left_out = {} if opening else {"bisectors": None, "convex": None}
    factor = times_R / CORNER_R_FACTOR
    return [
        replace(each, observations=replace(seen, R=factor * seen.R, **left_out))
        for each in readings
        if (seen := each.observations)
    ]


def corner_layers(reading, sensor):
    """The first corner of a scan, in the robot's frame: its walls, how sure it is, how it opens.

    Parameters
    ----------
    reading : Reading, with corners
    sensor : SensorModel

    Returns
    -------
    {label: layer}
    """
    seen, here = reading.observations, np.zeros(3)
    z, R, bisector = seen.z[0], seen.R[0], seen.bisectors[0]
    p, J = g(here, z), J_z(here, z)
    pieces = lines(reading.scan, sensor, np.random.default_rng(0), SHORT_RANGE_RANSAC)
    longer = [np.ravel((1 + BEYOND) * w.ends - BEYOND * w.ends[::-1]) for w in pieces]
    arrow = [[*p, *(p + ARROW * np.array([np.cos(bisector), np.sin(bisector)]))]]
    return {
        "walls": Segments("walls", longer),
        "scan": Points("scan", reading.scan.points()),
        "robot": Poses("robot", [here]),
        f"corner, its 95 % ellipse × {ENLARGED}": Ellipses(
            "landmark", p[None], ENLARGED**2 * (J @ R @ J.T)[None]
        ),
        "bisector": Segments("corrected", arrow),
    }
