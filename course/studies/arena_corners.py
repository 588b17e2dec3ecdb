"""Corner landmarks of a run through the arena, associated, modified and drawn (lesson 12)."""

from dataclasses import replace

import numpy as np

from slamlab.estimators.corner_association import CornerAssociation
from slamlab.estimators.landmark_observations import CORNER_R_FACTOR, SHORT_RANGE_RANSAC
from slamlab.landmarks.ransac import lines
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.models.jacobians import J_z
from slamlab.models.observation import g

ENLARGED = 3  # factor by which a corner's ellipse is enlarged, to be visible
BEYOND = 0.3  # share of its length by which a wall is drawn beyond its ends
ARROW = 0.06  # m, length of a bisector


def associated_by_ekf(source, readings):
    """Associate the corners of a run by EKF-SLAM; return readings whose corners have ids."""
    associations = CornerAssociation("ekf", source.robot, source.sensor, np.random.default_rng(0))
    return [replace(reading, observations=associations.observe(reading)) for reading in readings]


def modified_corners(readings, opening, times_R):
    """Return readings whose corners have R multiplied by ``times_R``, and bisector and convexity
    only if ``opening``."""
    left_out = {} if opening else {"bisectors": None, "convex": None}
    factor = times_R / CORNER_R_FACTOR
    return [
        replace(each, observations=replace(seen, R=factor * seen.R, **left_out))
        for each in readings
        if (seen := each.observations)
    ]


def corner_layers(reading, sensor):
    """Return layers of a scan's first corner in the robot frame: walls, 95 % ellipse and
    bisector."""
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
