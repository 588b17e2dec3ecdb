"""Landmark observations of a reading, their measurement noise, and their data association."""

from dataclasses import replace

import numpy as np

from slamlab.landmarks.corners import corners
from slamlab.landmarks.ransac import Ransac, lines
from slamlab.models import noise
from slamlab.readings import Observations

SHORT_RANGE = 1.0  # m, a sensor of shorter range sees walls of a few centimetres
SHORT_RANGE_RANSAC = Ransac(window=6, min_inliers=5, gap=0.05, max_hidden=2.5, min_length=0.05)
CORNER_REACH = 0.04  # m, that a corner may lie beyond a wall's seen end
"""For the infrared scanner: at most 0.28 m away its readings are 3 to 20 mm apart on a wall. Beyond
4 cm a line meets the wrong one: one corner in thirty is then none."""
CORNER_R_FACTOR = 2.0  # by which R of a short-sighted sensor's corners is enlarged
"""The lines' R is right for all but one corner in 250: that one is where no corner is, some 6 cm
beside one. No Gaussian has such a tail; twice the variance costs little and is hurt less by it."""


def observed_landmarks(reading, sensor, rng, ransac=None):
    """Landmark observations of a reading: those it names, else the corners of its scan (features).

    Corners of a short-sighted sensor say how they open. A lidar's do not: through doors it sees
    either side of thin walls, and one corner is convex here and concave there.

    Parameters
    ----------
    reading : Reading
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC; alike generators find alike corners
    ransac : Ransac; when None its defaults, or ``SHORT_RANGE_RANSAC`` for a sensor of less than 1 m

    Returns
    -------
    Observations with their R, empty where there is nothing
    """
    if reading.observations is not None:
        z, ids, R = (getattr(reading.observations, name) for name in ("z", "ids", "R"))
        z = np.asarray(z, dtype=float).reshape(-1, 2)
        R = measurement_noise(sensor, z[:, 0]) if R is None else R
        return replace(reading.observations, z=z, ids=np.asarray(ids), R=R)
    found = [] if reading.scan is None else _corners(reading.scan, sensor, rng, ransac)
    z, R, bisectors, convex = (
        [getattr(corner, name) for corner in found] for name in ("z", "R", "bisector", "convex")
    )
    seen = Observations(np.reshape(z, (-1, 2)), np.full(len(found), -1), np.reshape(R, (-1, 2, 2)))
    if sensor.range_max >= SHORT_RANGE:
        return seen
    openings = {"bisectors": np.array(bisectors, float), "convex": np.array(convex, bool)}
    return replace(seen, R=CORNER_R_FACTOR * seen.R, **openings)


class DataAssociation:
    """Data association: which landmark each observation is of, one of the map's or a new one.

    Ids of the source are taken as they are. ``ambiguous`` counts observations ignored: of a known
    landmark or a new one, or a second one of a landmark. Our own ids are negative, no source's is.
    """

    def __init__(self):
        self.ambiguous = 0
        self._next = -1

    def associate(self, observations, ids, pair):
        """Associate the observations of one reading with landmarks, at most one with each.

        Parameters
        ----------
        observations : Observations, with R
        ids : list of N, those of the landmarks in the map
        pair : callable(observations) -> ({row: which of the N}, rows that are new), of those that
            have no name

        Returns
        -------
        {id: row of observations.z}, a landmark at most once
        """
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


def _corners(scan, sensor, rng, ransac):
    if sensor.range_max >= SHORT_RANGE:
        return corners(lines(scan, sensor, rng, ransac))
    return corners(lines(scan, sensor, rng, ransac or SHORT_RANGE_RANSAC), reach=CORNER_REACH)


def measurement_noise(sensor, ranges):
    """Measurement noise R of ranges and bearings, :func:`slamlab.models.noise.R` of each range.

    Parameters
    ----------
    sensor : SensorModel
    ranges : (m,) [m]

    Returns
    -------
    (m, 2, 2) [m², rad²]
    """
    s = sensor
    R_each = [
        noise.R(r, s.range_error, s.bearing_sigma, s.range_sigma, s.range_curvature) for r in ranges
    ]
    return np.reshape(R_each, (-1, 2, 2))


def require_landmarks(source, name):
    """Raise an error for a source without landmark observations and scans.

    Parameters
    ----------
    source : Source
    name : str, of the estimator

    Raises
    ------
    ValueError : no reading holds landmarks or a scan
    """
    # a source that goes on for ever, such as a robot, has no length and is not run through
    if len(source) and all(r.observations is None and r.scan is None for r in source):
        raise ValueError(
            f"{source.name} holds neither landmarks nor scans, of which {name} needs one; "
            "sim:landmarks has landmarks"
        )


seen, CLOSE = observed_landmarks, SHORT_RANGE_RANSAC  # names in the first edition
