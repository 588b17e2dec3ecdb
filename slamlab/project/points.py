"""The published scale: what a drive is worth, from 0 (odometry) to 100, continuous in between.

Each measure is a gain over odometry on the same drive, and the package's own estimators on that
drive are the marks: as good as odometry 0, as ``icp`` 55, as ``graph`` 85, and 100 for errors a
fifth below those of ``graph``; straight lines between. A hard drive is hard for the marks, too.
"""

from dataclasses import dataclass

import numpy as np

from slamlab.evaluation.consistency import band
from slamlab.geometry import transform
from slamlab.project import drive_errors
from slamlab.project.drive_errors import LENGTHS

MARKS = 0.0, 55.0, 85.0, 100.0  # points of odometry, icp, graph, and of the best asked for
MAP_SHARE = 0.2  # of the points; the rest is for the trajectory [1]
FLOOR = 0.005  # errors are told apart down to about this [m]
FIRST_GAIN, NEXT_GAIN = np.log(1.5), np.log(1.35)  # least distances of marks: see ``marks``
BEYOND = np.log(1.25)  # what is asked for 100: errors smaller than graph's by this factor
MAP_GAIN = 0.2  # least distance of the marks of odometry and graph, of maps [1]
FALSE_CLAIM = 20.0  # points that a covariance costs that is off by a factor of 100 or more
NEES_BAND = band(3, 1)
"""Where the mean NEES of a drive lies if the claims are true: its errors hang together, so that a
drive counts as one draw."""


@dataclass(frozen=True)
class Measures:
    """What is measured of a drive.

    Parameters
    ----------
    gain : float, by how much the errors over 1, 5 and 20 m are smaller than odometry's: mean
        logarithm of their ratio, alike for the three [1]
    errors : (3,) mean relative errors over these lengths, for people [m]
    map : float, map score [1]
    completeness : float, share of finite poses [1]
    nees : float, mean NEES over the claims; NaN where there are none [1]
    relations : float, of a recorded log, mean error of its relations; it has no map score, no NEES
        and no errors over lengths, which are NaN [m]
    """

    gain: float
    errors: np.ndarray
    map: float
    completeness: float
    nees: float
    relations: float = np.nan


def measure(drive, world, odometry, walls):
    """Measure a drive against the truth.

    A relation with a pose that is not finite counts as odometry's.

    Parameters
    ----------
    drive : Drive
    world : HiddenWorld
    odometry : Drive of odometry in the same world
    walls : what :func:`slamlab.project.drive_errors.to_be_mapped` gives

    Returns
    -------
    Measures
    """
    truth, gains, means = world.truth.poses, [], []
    for length in LENGTHS:
        errors, of_odometry = (
            drive_errors.relative_errors(poses, truth, world.metres, length)
            for poses in (drive.trajectory, odometry.trajectory)
        )
        gain, mean = _gain(errors, of_odometry)
        gains.append(gain)
        means.append(mean)
    motion = drive_errors.aligned(drive.trajectory, truth)
    return Measures(
        float(np.mean(gains)),
        np.array(means),
        drive_errors.map_score(transform(motion, drive.points), *walls),
        drive.completeness,
        drive_errors.mean_nees(drive.online, drive.covariances, truth),
    )


def measure_log(drive, log, odometry):
    """Measure a drive through a recorded log by its relations; there is no truth to score a map.

    Parameters
    ----------
    drive : Drive
    log : RecordedLog
    odometry : Drive of odometry through the same log

    Returns
    -------
    Measures
    """
    gain, mean = _gain(log.errors(drive.trajectory), log.errors(odometry.trajectory))
    unknown = np.full(len(LENGTHS), np.nan)
    return Measures(gain, unknown, np.nan, drive.completeness, np.nan, mean)


def _gain(errors, of_odometry):
    """Gain over odometry and mean error [m]; an error that is not finite counts as odometry's."""
    errors = np.where(np.isfinite(errors), errors, of_odometry)
    gain = np.mean(np.log((of_odometry + FLOOR) / (errors + FLOOR)))
    return float(gain), float(errors.mean())


def marks(odometry, icp, graph):
    """The marks of a drive: gains, and map scores, that are worth 0, 55, 85 and 100 points.

    Where baselines fail or hardly differ a mark keeps a least distance from the one below: no luck
    of a single drive makes a small error worth many points. A map at ``graph``'s mark is as good as
    its own; there is none at ``icp``'s, the line is straight.

    Parameters
    ----------
    odometry, icp, graph : Measures

    Returns
    -------
    (4,) gains, (4,) map scores, growing
    """
    middle = max(icp.gain, FIRST_GAIN)
    high = max(graph.gain, middle + NEXT_GAIN)
    gains = np.array([0.0, middle, high, high + BEYOND])
    better = max(graph.map - odometry.map, MAP_GAIN)
    maps = odometry.map + better * np.array(MARKS) / MARKS[2]
    maps[3] = min(maps[3], max(1.0, maps[2] + 0.01))  # a perfect map is worth all
    return gains, maps


def points_of(measures, scale):
    """Points of a drive, 0 to 100.

    completeness · (0.8 · trajectory + 0.2 · min(map, trajectory)) − the cost of a false claim;
    where no map can be scored, completeness · trajectory

    Parameters
    ----------
    measures : Measures
    scale : what :func:`marks` gives

    Returns
    -------
    float
    """
    gains, maps = scale
    track = np.interp(measures.gain, gains, MARKS)
    # a map is worth no more than the track it is drawn along: pieces of odometry's gain nothing
    known = np.isfinite(measures.map)
    mapped = min(np.interp(measures.map, maps, MARKS), track) if known else track
    good = (1 - MAP_SHARE) * track + MAP_SHARE * mapped
    return float(max(0.0, measures.completeness * good - claim_cost(measures.nees)))


def claim_cost(nees):
    """What a claimed covariance costs: nothing while the mean NEES is in its band, or without one.

    Parameters
    ----------
    nees : float, mean NEES of a drive; NaN where nothing is claimed [1]

    Returns
    -------
    float, points, growing with the logarithm of the distance from the band
    """
    if np.isnan(nees):
        return 0.0
    low, high = NEES_BAND
    off = max(np.log(low / max(nees, 1e-9)), np.log(nees / high) if nees > 0 else 0.0, 0.0)
    return FALSE_CLAIM * min(1.0, off / np.log(100))
