"""Listings of estimators, their parameters, sources, worlds and recordings; checks of names.

Large packages are imported only when a listing that needs them is printed.
"""

from pathlib import Path

from slamlab.cli.parsers import UsageError, did_you_mean, table
from slamlab.devices import LIDARS
from slamlab.sources.public_datasets import RECORDINGS

ESTIMATORS = {
    "odometry": "Dead reckoning by odometry, without any correction",
    "icp": "Scan-to-scan matching (point-to-line ICP, robust)",
    "icp-plain": "Scan-to-scan matching (point-to-point ICP, no outlier rejection)",
    "graph": "Pose-graph SLAM with scan matching and loop closure",
    "mak": "EKF-SLAM with point landmarks",
    "mak-first-estimates": "EKF-SLAM with point landmarks and first-estimates Jacobians",
    "bor": "Set-membership SLAM with bounding boxes of point landmarks",
    "montecarlo": "Particle filter with particle sets of the pose and each landmark",
    "fastslam": "FastSLAM (Rao-Blackwellised particle filter)",
    "walls": "EKF-SLAM with line landmarks (walls)",
    "walls-foot-points": "EKF-SLAM with walls as foot points, after Smolec's thesis",
}
LIVE = "live devices; the robot is optional"
KINDS = (
    ("sim:WORLD", "simulated run with its ground truth", "sim:room"),
    ("emulated:WORLD", "emulated RPLIDAR and eMIR, read by the drivers", "emulated:polygon"),
    *((f"{prefix}LIDAR_PORT,EMIR_PORT", LIVE, f"{prefix}/dev/ttyUSB0") for prefix in LIDARS),
    ("FILE", "log: reading log, CARMEN, BreezySLAM or RPLIDAR text", "robot.log.gz"),
    ("FILE", "raw recording of devices, from slamlab record", "drive.rec.gz"),
    ("FILE[#/scan,/odom]", "ROS 1 or ROS 2 bag, with its topics", "drive.bag#/scan,/odom"),
    ("NAME", "published recording, from slamlab data get", "intel"),
)


def estimators():
    """Yield lines that describe each estimator and its parameters."""
    from slamlab.estimators.options import OPTIONS, TAKES

    yield "Estimators (--estimator NAME) and their parameters (--param NAME=VALUE):"
    for row, name in zip(table(ESTIMATORS.items()), ESTIMATORS, strict=True):
        yield row
        for parameter in TAKES.get(name, ()):
            option = OPTIONS[parameter]
            unit = f" [{option.unit}]" if getattr(option, "unit", "") else ""
            yield f"    {parameter}: {option.help}{unit}"
            yield f"        {option.range} (default: {option.default})"


def sources():
    """Yield lines that list the kinds of sources and the worlds."""
    from slamlab.simulation.worlds import WORLDS
    from slamlab.sources.simulated_robot import NAMES

    yield "Kinds of sources, each with an example:"
    width = max(len(about) for _, about, _ in KINDS)
    yield from table([(kind, f"{about:{width}}  {example}") for kind, about, example in KINDS])
    yield f"Simulated runs (sim:WORLD): {', '.join(NAMES)}"
    yield f"Worlds (emulated:WORLD, --world WORLD): {', '.join(WORLDS)}"
    yield "Published recordings: slamlab data lists them"


def check_estimator(name):
    """Raise UsageError if no estimator has the given name."""
    check_name("estimator", name, ESTIMATORS, "slamlab run --list-estimators")


def check_source(spec):
    """Raise UsageError if SOURCE names a world or a recording that does not exist."""
    from slamlab.sources.simulated_robot import NAMES

    kind, colon, world = spec.partition(":")
    if colon and kind == "sim":
        check_name("simulated run", world, NAMES)
    elif colon and kind == "emulated":
        check_world(world)
    elif not Path(spec.partition("#")[0]).exists() and did_you_mean(spec, RECORDINGS):
        check_name("file or recording", spec, RECORDINGS)


def check_world(name):
    """Raise UsageError if no world has the given name."""
    from slamlab.simulation.worlds import WORLDS

    check_name("world", name, WORLDS)


def check_name(what, name, known, listing="slamlab run --list-sources"):
    """Raise UsageError if a name of an estimator, a recording … is not one of those known."""
    if name not in known:
        meant = did_you_mean(name, known)
        raise UsageError(f"there is no {what} {name!r}.{meant} '{listing}' lists all.")
