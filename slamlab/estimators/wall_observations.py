"""Wall observations: the lines of a scan, found by what its sensor is."""

from slamlab.landmarks.ransac import lines
from slamlab.landmarks.sonar_lines import sonar_lines


def observed_walls(scan, sensor, rng, ransac=None):
    """The lines of the walls in a scan: by the cone model for a sonar, else by RANSAC.

    Parameters
    ----------
    scan : Scan
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    ransac : Ransac, its defaults when None

    Returns
    -------
    list of Line
    """
    if sensor.half_cone:
        return sonar_lines(scan, sensor)
    return lines(scan, sensor, rng, ransac)
