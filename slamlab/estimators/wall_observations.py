"""Wall observations: the lines of a scan, found by what its sensor is."""

from slamlab.estimators.landmark_observations import SHORT_RANGE, SHORT_RANGE_RANSAC
from slamlab.landmarks.ransac import lines
from slamlab.landmarks.sonar_lines import sonar_lines


def observed_walls(scan, sensor, rng, ransac=None):
    """Line landmarks (walls) that a scan shows: by the cone model for a sonar, else by RANSAC.

    Parameters
    ----------
    scan : Scan
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    ransac : Ransac; when None its defaults, or ``SHORT_RANGE_RANSAC`` for a sensor of less than 1 m

    Returns
    -------
    list of Line, the best supported first
    """
    if sensor.half_cone:
        return sonar_lines(scan, sensor)
    if ransac is None and sensor.range_max < SHORT_RANGE:
        ransac = SHORT_RANGE_RANSAC
    return lines(scan, sensor, rng, ransac)
