"""``python -m course.studies.wall_slam_variants``: ablation of Smolec's wall SLAM in both
situations: Monte Carlo runs of all variants on the same readings."""

import sys

import numpy as np

from course.studies import study_command
from course.studies.study_command import TABLES, first_runs, package_versions, rounded, seeds
from slamlab.estimators.base import Estimator
from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.foot_point_corrections import CORRECTIONS
from slamlab.estimators.foot_point_slam import FootPointSlam
from slamlab.estimators.wall_slam import WallSlam
from slamlab.evaluation import band, nees
from slamlab.geometry import transform, wrap
from slamlab.landmarks.downsampling import DownsampledPoints
from slamlab.landmarks.ransac import THESIS, Ransac
from slamlab.parallel import map_runs
from slamlab.sources.simulated_robot import simulation

TABLE = TABLES / "wall_slam_variants.json"
SITUATIONS = ("situation-1", "situation-2")
BURN_IN = 10  # steps left out, until the pose's covariance, zero at first, can be inverted safely
VARIANTS = {
    "true poses": lambda source, rng: TruePoses(source.truth),
    "odometry": lambda source, rng: DeadReckoning(),
    "foot points, thesis' lines": lambda s, rng: foot_points(s, rng, THESIS),
    "foot points, grown lines": lambda s, rng: foot_points(s, rng, Ransac()),
    "(ρ, α), standard": lambda s, rng: WallSlam(s.robot, s.sensor, rng, first_estimates=False),
    "(ρ, α), first estimates": lambda s, rng: WallSlam(s.robot, s.sensor, rng),
}


def foot_points(source, rng, ransac):
    """Make a FootPointSlam with every correction, so that only the foot point is wrong."""
    return FootPointSlam(source.robot, source.sensor, rng, ransac, corrections=CORRECTIONS)


class TruePoses(Estimator):
    """Estimator that uses the ground-truth poses; only the scans limit the quality of its map."""

    def __init__(self, truth):
        super().__init__()
        self._poses_left = iter(truth.poses)

    def step(self, reading):
        self.pose = next(self._poses_left)


def errors_of(seed):
    """Evaluate one run through each situation; return numbers by (situation, variant)."""
    found = {}
    for situation in SITUATIONS:
        source = simulation(situation, np.random.default_rng(seed))
        for name, make in VARIANTS.items():
            found[situation, name] = _run_variant(source, make(source, np.random.default_rng(seed)))
    return found


def _run_variant(source, slam):
    poses, P, drawn = [], [], DownsampledPoints()
    for reading in source:
        slam.step(reading)
        poses.append(slam.pose.copy())
        if hasattr(slam, "filter"):
            P.append(slam.filter.block([0, 1, 2]))
        drawn.add(transform(slam.pose, reading.scan.points()))
    errors = np.array(poses) - source.truth.poses
    errors[:, 2] = wrap(errors[:, 2])
    each = nees(errors[BURN_IN:], np.array(P)[BURN_IN:]) if P else np.array([np.nan])
    return {
        "final_m": np.hypot(*errors[-1, :2]),
        "final_deg": np.degrees(abs(errors[-1, 2])),
        "position_rmse_m": np.sqrt(np.mean(np.sum(errors[:, :2] ** 2, axis=1))),
        "map_m": _off_walls(drawn.xy, source.world.walls),
        "nees": each.mean(),
        "nees_end": each[-1],
    }


def _off_walls(points, walls):
    """Return the RMS distance of drawn points to the nearest true wall [m]."""
    start, vector = walls[:, :2], walls[:, 2:] - walls[:, :2]
    offset = points[:, None] - start
    along = np.clip(np.sum(offset * vector, axis=2) / np.sum(vector**2, axis=1), 0, 1)
    nearest = np.hypot(*(offset - along[..., None] * vector).transpose(2, 0, 1)).min(axis=1)
    return np.sqrt(np.mean(nearest**2))


def study(runs, jobs=None, scheduler=None):
    """Make the table: medians over the runs, and mean NEES with its band; raise ValueError for
    fewer than 3 runs."""
    results = map_runs(errors_of, seeds(runs), jobs, scheduler)
    table = {
        situation: rounded(
            {name: row([result[situation, name] for result in results]) for name in VARIANTS}
        )
        for situation in SITUATIONS
    }
    return {
        "versions": package_versions(),
        "seeds": [0, runs - 1],
        "first_runs": first_runs(results),
        "band_95": band(3, runs),
        "situations": table,
    }


def row(runs):
    """Make one row: medians of a variant's errors [m, degree], the worst final error, and, if
    available, the mean NEES."""
    numbers = {key: np.array([run[key] for run in runs]) for key in runs[0]}
    line = {key: np.median(values) for key, values in numbers.items() if "nees" not in key}
    line |= {"final_m_worst": numbers["final_m"].max()}
    if np.isfinite(numbers["nees"]).all():
        line |= {
            "nees": numbers["nees"].mean(),
            "nees_median_run": np.median(numbers["nees"]),
            "nees_end": numbers["nees_end"].mean(),
        }
    return line


def main(argv=None):
    return study_command.main("wall_slam_variants", 60, study, argv)


if __name__ == "__main__":
    sys.exit(main())
