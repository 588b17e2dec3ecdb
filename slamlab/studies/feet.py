"""``python -m slamlab.studies.feet``: what Smolec's feet of walls are worth, and on what it hangs.

In situation 2, with wheels that slip less and lidars of more beams: the root mean square error of
the position, each estimator's against odometry's on the same drive. And each mend left out alone.
"""

import sys
from dataclasses import replace

import numpy as np

from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.foot_mends import MENDS
from slamlab.estimators.foot_slam import FootSlam
from slamlab.estimators.wall_slam import WallSlam
from slamlab.parallel import map_runs
from slamlab.simulation.differential_drive import DifferentialDrive
from slamlab.sources.simulated_robot import THESIS_LIDAR, THESIS_ROBOT, simulation
from slamlab.studies import study_command
from slamlab.studies.study_command import TABLES, package_versions, rounded, seeds

TABLE = TABLES / "feet.json"
SITUATION = "situation-2"
SLIPS = (1.0, 0.5, 0.2)  # times the slip of THESIS_ROBOT
BEAMS = (360, 900, 3600)
LEAST = 6  # runs: of fewer the median has no 95 % interval
ODOMETRY, ALL, NONE = "odometry", "all mends", "as printed"
VARIANTS = {
    ODOMETRY: lambda source, rng: DeadReckoning(),
    NONE: lambda s, rng: FootSlam(s.robot, s.sensor, rng),
    ALL: lambda s, rng: FootSlam(s.robot, s.sensor, rng, mends=MENDS),
    "walls": lambda s, rng: WallSlam(s.robot, s.sensor, rng),
}


def errors_of(seed):
    """Errors of one drive's estimators, for every slip and number of beams, and without each mend.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict, (slip, beams, variant) or (mend left out) to the rms of the position's error [m]
    """
    found = {}
    for slip in SLIPS:
        for beams in BEAMS:
            source, readings = _driven(seed, slip, beams)
            for name, make in VARIANTS.items():
                slam = make(source, np.random.default_rng(seed))
                found[slip, beams, name] = _rms(source, readings, slam)
    source, readings = _driven(seed, 1.0, THESIS_LIDAR.beams)
    for left_out in (None, *MENDS):
        mends = [mend for mend in MENDS if mend != left_out]
        slam = FootSlam(source.robot, source.sensor, np.random.default_rng(seed), mends=mends)
        found[left_out or ALL] = _rms(source, readings, slam)
    return found


def _driven(seed, slip, beams):
    lidar = replace(THESIS_LIDAR, beams=beams)
    robot = DifferentialDrive(slip=slip * THESIS_ROBOT.slip)
    source = simulation(SITUATION, np.random.default_rng(seed), lidar=lidar, robot=robot)
    return source, list(source)


def _rms(source, readings, slam):
    poses = []
    for reading in readings:
        slam.step(reading)
        poses.append(slam.pose[:2].copy())
    errors = np.array(poses) - source.truth.poses[: len(poses), :2]
    return np.sqrt(np.mean(np.sum(errors**2, axis=1)))


def listing(situation, steps, beams=THESIS_LIDAR.beams, **options):
    """Drive the listing through the first steps of a situation, seed 1, and odometry beside it.

    Parameters
    ----------
    situation : str, such as "situation-2"
    steps : int
    beams : int, of the lidar
    options : of :class:`FootSlam`, such as ``mends``

    Returns
    -------
    slam : FootSlam, after the last step
    rms : float, root mean square error of its position [m]
    rms_odometry : float [m]
    """
    source = simulation(situation, np.random.default_rng(1), replace(THESIS_LIDAR, beams=beams))
    slam = FootSlam(source.robot, source.sensor, np.random.default_rng(1), **options)
    readings = list(source)[:steps]
    return slam, _rms(source, readings, slam), _rms(source, readings, DeadReckoning())


def study(runs, jobs=None, scheduler=None):
    """The tables: medians over the runs, and of paired differences with a 95 % interval.

    Parameters
    ----------
    runs : int; seeds 0 to runs − 1
    jobs, scheduler : see :func:`slamlab.parallel.map_runs`

    Returns
    -------
    dict

    Raises
    ------
    ValueError : fewer runs than 6
    """
    results = map_runs(errors_of, seeds(runs, LEAST), jobs, scheduler)
    errors = {key: np.array([result[key] for result in results]) for key in results[0]}
    return {
        "versions": package_versions(),
        "seeds": [0, runs - 1],
        "situation": SITUATION,
        "verdicts": [
            {"slip": slip, "beams": beams}
            | rounded(
                {
                    name: row(errors[slip, beams, name], errors[slip, beams, ODOMETRY])
                    for name in VARIANTS
                }
            )
            for slip in SLIPS
            for beams in BEAMS
        ],
        "left_out": rounded({name: row(errors[name], errors[ALL]) for name in (ALL, *MENDS)}),
    }


def row(errors, baseline):
    """One estimator's row: its median error, and the median of what it errs more than a baseline.

    The interval is the median's by order statistics, so one run that is lost moves it no farther
    than any other.

    Parameters
    ----------
    errors, baseline : (runs,) of the same drives [m]

    Returns
    -------
    dict of numbers [m]
    """
    from scipy.stats import quantile_test  # takes long to load, and no lesson needs it

    more = errors - baseline
    interval = quantile_test(more, p=0.5).confidence_interval(0.95)
    return {
        "rms_m": np.median(errors),
        "more_m": np.median(more),
        "low_m": interval.low,
        "high_m": interval.high,
    }


def main(argv=None):
    """The command: run the study, write its table; exit code 0, or 2 on an error."""
    return study_command.main("feet", LEAST, study, argv)


if __name__ == "__main__":
    sys.exit(main())
