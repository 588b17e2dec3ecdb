"""A reading as arrays by name, and back: so that it passes the pipe to a worker."""

import numpy as np

from slamlab.readings import Observations, Reading, Scan


def arrays_of(reading):
    """The arrays of a reading.

    Parameters
    ----------
    reading : Reading of a HiddenWorld

    Returns
    -------
    dict, name to array
    """
    arrays = {"time": np.array(reading.time), "odometry": reading.odometry}
    if reading.scan is not None:
        scan = reading.scan
        limits = np.array([scan.range_max, scan.range_min])
        arrays |= {"angles": scan.angles, "ranges": scan.ranges, "limits": limits}
    if reading.observations is not None:
        arrays |= {"z": reading.observations.z, "ids": reading.observations.ids}
    return arrays


def reading_of(arrays):
    """The reading of some arrays.

    Parameters
    ----------
    arrays : what :func:`arrays_of` gives

    Returns
    -------
    Reading
    """
    scan = observations = None
    if "ranges" in arrays:
        scan = Scan(arrays["angles"], arrays["ranges"], *map(float, arrays["limits"]))
    if "z" in arrays:
        observations = Observations(arrays["z"], arrays["ids"])
    return Reading(float(arrays["time"]), arrays["odometry"], scan, observations)
