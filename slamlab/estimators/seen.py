"""The landmarks of a reading: those it names, else the corners of its scan."""

from dataclasses import dataclass

import numpy as np

from slamlab import noise
from slamlab.landmarks.corners import corners
from slamlab.landmarks.ransac import lines


@dataclass(frozen=True)
class Seen:
    """What an estimator of landmarks takes from one reading.

    Parameters
    ----------
    z : (m, 2) range [m] and bearing [rad]
    R : (m, 2, 2) their covariances
    ids : (m,) int; -1 where the landmark is not known
    """

    z: np.ndarray
    R: np.ndarray
    ids: np.ndarray


def seen(reading, sensor, rng, ransac=None):
    """The landmarks a reading shows.

    Parameters
    ----------
    reading : Reading
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC; alike generators find alike corners
    ransac : Ransac, its defaults when None

    Returns
    -------
    Seen, empty where there is nothing
    """
    if reading.observations is not None:
        z = np.asarray(reading.observations.z, dtype=float).reshape(-1, 2)
        return Seen(z, noise.R_of(sensor, z[:, 0]), np.asarray(reading.observations.ids))
    found = [] if reading.scan is None else corners(lines(reading.scan, sensor, rng, ransac))
    z, R = ([getattr(corner, name) for corner in found] for name in "zR")
    return Seen(np.reshape(z, (-1, 2)), np.reshape(R, (-1, 2, 2)), np.full(len(found), -1))
