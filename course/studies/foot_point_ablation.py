"""``python -m course.studies.foot_point_ablation``: ablation of SLAM with foot points of walls.

The command runs Smolec's method in situation 2 with less slip, with more beams, and without each
correction. The command compares the RMS position error with the error of odometry on the same run.
"""

import sys
from dataclasses import replace

import numpy as np

from course.studies import study_command
from course.studies.study_command import TABLES, package_versions, rounded, seeds
from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.foot_point_corrections import CORRECTIONS
from slamlab.estimators.foot_point_slam import FootPointSlam
from slamlab.estimators.wall_slam import WallSlam
from slamlab.parallel import map_runs
from slamlab.simulation.differential_drive import DifferentialDrive
from slamlab.sources.simulated_robot import THESIS_LIDAR, THESIS_ROBOT, simulation

TABLE = TABLES / "foot_point_ablation.json"
SITUATION = "situation-2"
SLIPS = (1.0, 0.5, 0.2)  # times the slip of THESIS_ROBOT
BEAMS = (360, 900, 3600)
LEAST = 6  # runs; with fewer the median has no 95 % interval
ODOMETRY, ALL, NONE = "odometry", "all corrections", "as printed"
VARIANTS = {
    ODOMETRY: lambda source, rng: DeadReckoning(),
    NONE: lambda s, rng: FootPointSlam(s.robot, s.sensor, rng),
    ALL: lambda s, rng: FootPointSlam(s.robot, s.sensor, rng, corrections=CORRECTIONS),
    "walls": lambda s, rng: WallSlam(s.robot, s.sensor, rng),
}


def errors_of(seed):
    """Return RMS errors [m] of one run by (slip, beams, variant), and by the omitted correction."""
    found = {}
    for slip in SLIPS:
        for beams in BEAMS:
            source, readings = _driven(seed, slip, beams)
            for name, make in VARIANTS.items():
                slam = make(source, np.random.default_rng(seed))
                found[slip, beams, name] = _rms(source, readings, slam)
    source, readings = _driven(seed, 1.0, THESIS_LIDAR.beams)
    for left_out in (None, *CORRECTIONS):
        corrections = [each for each in CORRECTIONS if each != left_out]
        slam = FootPointSlam(
            source.robot, source.sensor, np.random.default_rng(seed), corrections=corrections
        )
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
    """Run the thesis' listing, with options of FootPointSlam, on the first steps of a situation.

    Returns, for seed 1, the FootPointSlam, its RMS error and the RMS error of odometry [m].
    """
    source = simulation(situation, np.random.default_rng(1), replace(THESIS_LIDAR, beams=beams))
    slam = FootPointSlam(source.robot, source.sensor, np.random.default_rng(1), **options)
    readings = list(source)[:steps]
    return slam, _rms(source, readings, slam), _rms(source, readings, DeadReckoning())


def study(runs, jobs=None, scheduler=None):
    """Make the tables "verdicts" and "left_out": medians and paired differences with 95 % intervals
    [m]; raise ValueError for fewer than 6 runs."""
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
        "left_out": rounded({name: row(errors[name], errors[ALL]) for name in (ALL, *CORRECTIONS)}),
    }


def row(errors, baseline):
    """Make one row [m]: "rms_m", the median error; "more_m", the median paired difference to a
    baseline; "low_m" and "high_m", the median's interval by order statistics."""
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
    return study_command.main("foot_point_ablation", LEAST, study, argv)


if __name__ == "__main__":
    sys.exit(main())
