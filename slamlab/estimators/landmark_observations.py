"""Landmark observations of a reading, their measurement noise, and their data association."""

from dataclasses import replace

import numpy as np

from slamlab.landmarks.corners import corners
from slamlab.landmarks.ransac import Ransac, lines
from slamlab.models import noise
from slamlab.readings import Observations

SHORT_RANGE = 1.0  # a sensor of shorter range observes walls of a few centimetres [m]
SHORT_RANGE_RANSAC = Ransac(window=6, min_inliers=5, gap=0.05, max_hidden=2.5, min_length=0.05)
CORNER_REACH = 0.02  # largest distance of a corner from the observed end of a wall [m]
"""For the infrared scanner: from 2 to 3 cm, one corner in thirty is false."""
CORNER_R_FACTOR = 2.0  # inflation of R of the corners of a short-range sensor
"""R of the lines is correct for all but one corner in 200, which has an error of about 6 cm."""


def observed_landmarks(reading, sensor, rng, ransac=None):
    """Return the observations of a reading, with R: its landmarks or, without any, its scan's
    corners. Only corners of a short-range sensor get bisectors, because through doors, a lidar
    observes both sides of thin walls."""
    if reading.observations is not None:
        z, ids, R = (getattr(reading.observations, name) for name in ("z", "ids", "R"))
        z = np.asarray(z, dtype=float).reshape(-1, 2)
        R = measurement_noise(sensor, z[:, 0]) if R is None else R
        return replace(reading.observations, z=z, ids=np.asarray(ids), R=R)
    short = sensor.range_max < SHORT_RANGE
    found = []
    if reading.scan is not None:
        ransac = ransac or (SHORT_RANGE_RANSAC if short else None)
        walls = lines(reading.scan, sensor, rng, ransac)
        found = corners(walls, reach=CORNER_REACH) if short else corners(walls)
    z, R, bisectors, convex = (
        [getattr(corner, name) for corner in found] for name in ("z", "R", "bisector", "convex")
    )
    seen = Observations(np.reshape(z, (-1, 2)), np.full(len(found), -1), np.reshape(R, (-1, 2, 2)))
    if not short:
        return seen
    openings = {"bisectors": np.array(bisectors, float), "convex": np.array(convex, bool)}
    return replace(seen, R=CORNER_R_FACTOR * seen.R, **openings)


class DataAssociation:
    """Data association of observations with landmarks. Ids that the source gives are kept; others
    are negative. ``ambiguous`` counts observations that were ignored as ambiguous."""

    def __init__(self):
        self.ambiguous = 0
        self._next = -1

    def associate(self, observations, ids, pair):
        """Associate observations: return {id: row of observations.z}, each landmark at most once.
        For those without an id, ``pair`` returns {row: index into ids} and the unmatched rows."""
        rows: dict[int, int] = {}
        for k in np.flatnonzero(observations.ids >= 0).tolist():
            rows.setdefault(int(observations.ids[k]), k)
        rest = np.flatnonzero(observations.ids < 0)
        if len(rest):
            pairs, new = pair(observations.subset(rest))
            for k, j in pairs.items():
                rows.setdefault(ids[j], int(rest[k]))
            for k in new:
                rows[self._next] = int(rest[k])
                self._next -= 1
        self.ambiguous += len(observations.z) - len(rows)
        return rows


def correct_or_add(filter, rows, observations):
    """Update a filter by the known landmarks in ``rows`` {id: row}, and initialise the others."""
    known = set(filter.ids)
    for use, is_known in ((filter.update, True), (filter.add, False)):
        ids = [i for i in rows if (i in known) == is_known]
        if ids:
            k = [rows[i] for i in ids]
            use(ids, observations.z[k], observations.R[k])


def measurement_noise(sensor, ranges):
    """Return the measurement noise R (m, 2, 2) [m², rad²] at ranges (m,) [m]."""
    s = sensor
    R_each = [
        noise.R(r, s.range_error, s.bearing_sigma, s.range_sigma, s.range_curvature) for r in ranges
    ]
    return np.reshape(R_each, (-1, 2, 2))


def require_landmarks_or_scans(source, name):
    """Raise ValueError if a source has neither landmarks nor scans."""
    # an endless source, such as a robot, has no length and is not iterated
    if len(source) and all(r.observations is None and r.scan is None for r in source):
        raise ValueError(
            f"{source.name} has neither landmarks nor scans, but {name} needs one of them; "
            "sim:landmarks has landmarks"
        )
