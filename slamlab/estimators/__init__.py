"""Estimators: every SLAM of the course, made by its name."""

from slamlab.estimators.base import Estimator
from slamlab.estimators.bor import BorSlam, bor
from slamlab.estimators.feet import FootSlam
from slamlab.estimators.graph import GraphSlam
from slamlab.estimators.icp import IcpSlam
from slamlab.estimators.mak import MakSlam, mak
from slamlab.estimators.montecarlo import CloudSlam, fastslam, montecarlo
from slamlab.estimators.odometry import Odometry
from slamlab.estimators.walls import WallSlam, of_scans

__all__ = [
    "NAMES",
    "BorSlam",
    "CloudSlam",
    "Estimator",
    "FootSlam",
    "GraphSlam",
    "IcpSlam",
    "MakSlam",
    "Odometry",
    "WallSlam",
    "make",
]

MAKERS = {
    "odometry": lambda source: Odometry(),
    "icp": lambda source: IcpSlam(),
    "icp-plain": lambda source: IcpSlam(plain=True),
    "graph": lambda source: GraphSlam(source.robot),
    "mak": mak,
    "mak-first-estimates": lambda source: mak(source, first_estimates=True),
    "bor": bor,
    "montecarlo": montecarlo,
    "fastslam": fastslam,
    "walls": lambda source: of_scans(WallSlam, source),
    "walls-foot": lambda source: of_scans(FootSlam, source),
}
NAMES = tuple(MAKERS)


def make(name, source):
    """An estimator by its name, for a source's robot and sensor.

    Parameters
    ----------
    name : str, one of NAMES
    source : Source

    Returns
    -------
    Estimator

    Raises
    ------
    ValueError : there is no such estimator; the text lists those there are
    """
    if name not in MAKERS:
        raise ValueError(f"no estimator {name!r}; there are: {', '.join(NAMES)}")
    return MAKERS[name](source)
