"""The landmarks of a reading: those it names, else the corners of its scan."""

import numpy as np

from slamlab import noise
from slamlab.landmarks.corners import corners
from slamlab.landmarks.ransac import Ransac, lines
from slamlab.readings import Observations

SHORT_SIGHTED = 1.0  # m, a sensor that reaches less far sees walls of a few centimetres
CLOSE = Ransac(window=6, needed=5, gap=0.05, hidden=2.5, shortest=0.05)
CLOSE_REACH = 0.04  # m, beyond a wall's seen end
"""For the infrared scanner: at most 0.28 m away its readings are 3 to 20 mm apart on a wall. Beyond
4 cm a line meets the wrong one: one corner in thirty is then none."""


def seen(reading, sensor, rng, ransac=None):
    """The landmarks a reading shows.

    Parameters
    ----------
    reading : Reading
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC; alike generators find alike corners
    ransac : Ransac; when None its defaults, or ``CLOSE`` for a sensor that reaches less than 1 m

    Returns
    -------
    Observations with their R, empty where there is nothing
    """
    if reading.observations is not None:
        z, ids, R = (getattr(reading.observations, name) for name in ("z", "ids", "R"))
        z = np.asarray(z, dtype=float).reshape(-1, 2)
        return Observations(z, np.asarray(ids), R_of(sensor, z[:, 0]) if R is None else R)
    found = [] if reading.scan is None else _corners(reading.scan, sensor, rng, ransac)
    z, R = ([getattr(corner, name) for corner in found] for name in "zR")
    ids = np.full(len(found), -1)
    return Observations(np.reshape(z, (-1, 2)), ids, np.reshape(R, (-1, 2, 2)))


class Names:
    """Which landmark each sighting is: as the source names it, else a known one near it, else new.

    ``unclear`` counts the sightings that were left out: they may be a known landmark or a new one,
    or a second sighting of one. Names of our own are negative: a source's never are.
    """

    def __init__(self):
        self.unclear = 0
        self._next = -1

    def of(self, found, ids, pair):
        """Name the sightings of one reading.

        Parameters
        ----------
        found : Observations, with R
        ids : list of N, the known landmarks'
        pair : callable(z, R) -> ({row of z: which of the N}, rows of z that are new)

        Returns
        -------
        {id: row of found.z}, a landmark at most once
        """
        names: dict[int, int] = {}
        for k in np.flatnonzero(found.ids >= 0).tolist():
            names.setdefault(int(found.ids[k]), k)
        rest = np.flatnonzero(found.ids < 0)
        if len(rest):
            pairs, new = pair(found.z[rest], found.R[rest])
            for k, j in pairs.items():
                names.setdefault(ids[j], int(rest[k]))
            for k in new:
                names[self._next] = int(rest[k])
                self._next -= 1
        self.unclear += len(found.z) - len(names)
        return names


def _corners(scan, sensor, rng, ransac):
    if sensor.range_max >= SHORT_SIGHTED:
        return corners(lines(scan, sensor, rng, ransac))
    return corners(lines(scan, sensor, rng, ransac or CLOSE), reach=CLOSE_REACH)


def R_of(sensor, ranges):
    """Covariances of a sensor's ranges and bearings, :func:`slamlab.noise.R` of each range.

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


def need_landmarks(source, name):
    """Refuse a source in which an estimator of landmarks has nothing to see.

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
