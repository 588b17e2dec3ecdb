"""Factory: creates an estimator from its name."""

from functools import partial

from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.ekf_slam import mak
from slamlab.estimators.foot_point_corrections import CORRECTIONS
from slamlab.estimators.foot_point_slam import FootPointSlam
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.estimators.icp_slam import IcpSlam
from slamlab.estimators.options import checked
from slamlab.estimators.particle_filter_slam import fastslam, montecarlo
from slamlab.estimators.set_membership_slam import bor
from slamlab.estimators.wall_slam import WallSlam, for_source

# each takes the source, and its options
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
    "walls-foot-points": lambda source, corrections="none": for_source(
        partial(FootPointSlam, corrections=CORRECTIONS if corrections == "all" else ()), source
    ),
}
NAMES = tuple(FACTORIES)  # of all estimators, as on the command line
WITHOUT_ODOMETRY = "icp", "graph", "walls"  # these use laser odometry instead


def make(name, source, **options):
    """Create an estimator from its name and the robot and sensor models of a source. Returns an
    Estimator. Raises ValueError for an unknown name or option, or a value out of range.

    Parameters
    ----------
    name : str, one of NAMES
    source : Source
    options : see :data:`slamlab.estimators.options.TAKES`
    """
    if name not in FACTORIES:
        raise ValueError(f"unknown estimator {name!r}; choose from {', '.join(NAMES)}")
    # a user's own source need not be a Source
    if not getattr(source, "has_odometry", True) and name not in WITHOUT_ODOMETRY:
        raise ValueError(
            f"{source.name} has no odometry, which {name} needs; use {', '.join(WITHOUT_ODOMETRY)}"
        )
    return FACTORIES[name](source, **checked(name, options))
