"""Factory of estimators by name, such as ``icp``: what ``slamlab run --estimator NAME`` takes."""

from functools import partial

from slamlab.estimators.bor_slam import bor
from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.foot_mends import MENDS
from slamlab.estimators.foot_slam import FootSlam
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.estimators.icp_slam import IcpSlam
from slamlab.estimators.mak_slam import mak
from slamlab.estimators.montecarlo_slam import fastslam, montecarlo
from slamlab.estimators.options import checked
from slamlab.estimators.wall_slam import WallSlam, for_source

# from a source, and from options where it takes some
FACTORIES = {
    "odometry": lambda source: DeadReckoning(),
    "icp": lambda source: IcpSlam(),
    "icp-plain": lambda source: IcpSlam(plain=True),
    "graph": lambda source: GraphSlam(source.robot),
    "mak": mak,
    "mak-first-estimates": partial(mak, first_estimates=True),
    "bor": bor,
    "montecarlo": montecarlo,
    "fastslam": fastslam,
    "walls": lambda source, relocalise="yes": for_source(
        partial(WallSlam, relocalise=relocalise == "yes"), source
    ),
    "walls-foot": lambda source, mends="none": for_source(
        partial(FootSlam, mends=MENDS if mends == "all" else ()), source
    ),
}
NAMES = tuple(FACTORIES)  # of all estimators, as the command line takes them


def make(name, source, **options):
    """Make an estimator by its name, with the models of a source's robot and sensor.

    Parameters
    ----------
    name : str, one of NAMES
    source : Source
    options : those of :data:`slamlab.estimators.options.TAKES`

    Returns
    -------
    Estimator

    Raises
    ------
    ValueError : there is no such estimator, the text lists those there are; it has no such option,
        or that not such a value
    """
    if name not in FACTORIES:
        raise ValueError(f"no estimator {name!r}; there are: {', '.join(NAMES)}")
    return FACTORIES[name](source, **checked(name, options))
