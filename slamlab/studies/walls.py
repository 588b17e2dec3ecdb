"""``python -m slamlab.studies.walls``: Smolec's system, part by part, in both of his situations.

Every variant sees the same readings; a row a variant and situation, over many seeds.
"""

import sys

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.feet import FootSlam
from slamlab.estimators.odometry import Odometry
from slamlab.estimators.walls import WallSlam
from slamlab.evaluation import band, nees
from slamlab.geometry import transform, wrap
from slamlab.landmarks.ransac import THESIS, Ransac
from slamlab.landmarks.thinned import Thinned
from slamlab.parallel import map_runs
from slamlab.sources import simulation
from slamlab.studies import command
from slamlab.studies.command import TABLES, made_with, rounded, seeds

TABLE = TABLES / "walls.json"
SITUATIONS = ("situation-1", "situation-2")
SETTLED = 10  # steps until the pose's covariance, zero at first, can be inverted safely
VARIANTS = {
    "true poses": lambda source, rng: Known(source.truth),
    "odometry": lambda source, rng: Odometry(),
    "feet, thesis' lines": lambda s, rng: FootSlam(s.robot, s.sensor, rng, THESIS),
    "feet, grown lines": lambda s, rng: FootSlam(s.robot, s.sensor, rng, Ransac()),
    "(ρ, α), standard": lambda s, rng: WallSlam(s.robot, s.sensor, rng, first_estimates=False),
    "(ρ, α), first estimates": lambda s, rng: WallSlam(s.robot, s.sensor, rng),
}


class Known(Estimator):
    """Who knows the way: his map is as good as the scans allow.

    Parameters
    ----------
    truth : Trajectory
    """

    def __init__(self, truth):
        super().__init__()
        self._poses_left = iter(truth.poses)

    def step(self, reading):
        self.pose = next(self._poses_left)


def errors_of(seed):
    """One drive through each situation, by every variant.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict, (situation, variant) to dict of numbers
    """
    found = {}
    for situation in SITUATIONS:
        source = simulation(situation, np.random.default_rng(seed))
        for name, make in VARIANTS.items():
            found[situation, name] = _driven(source, make(source, np.random.default_rng(seed)))
    return found


def _driven(source, slam):
    poses, P, drawn = [], [], Thinned()
    for reading in source:
        slam.step(reading)
        poses.append(slam.pose.copy())
        if hasattr(slam, "filter"):
            P.append(slam.filter.block([0, 1, 2]))
        drawn.add(transform(slam.pose, reading.scan.points()))
    errors = np.array(poses) - source.truth.poses
    errors[:, 2] = wrap(errors[:, 2])
    each = nees(errors[SETTLED:], np.array(P)[SETTLED:]) if P else np.array([np.nan])
    return {
        "final_m": np.hypot(*errors[-1, :2]),
        "final_deg": np.degrees(abs(errors[-1, 2])),
        "position_rmse_m": np.sqrt(np.mean(np.sum(errors[:, :2] ** 2, axis=1))),
        "map_m": _off_walls(drawn.xy, source.world.walls),
        "nees": each.mean(),
        "nees_end": each[-1],
    }


def _off_walls(points, walls):
    """Root mean square distance of drawn points to the nearest true wall [m]."""
    start, way = walls[:, :2], walls[:, 2:] - walls[:, :2]
    offset = points[:, None] - start
    along = np.clip(np.sum(offset * way, axis=2) / np.sum(way**2, axis=1), 0, 1)
    nearest = np.hypot(*(offset - along[..., None] * way).transpose(2, 0, 1)).min(axis=1)
    return np.sqrt(np.mean(nearest**2))


def study(runs, jobs=None, scheduler=None):
    """The table: medians over the runs, and the mean NEES with its band.

    Parameters
    ----------
    runs : int; seeds 0 to runs − 1
    jobs, scheduler : see :func:`slamlab.parallel.map_runs`

    Returns
    -------
    dict

    Raises
    ------
    ValueError : fewer runs than 3
    """
    results = map_runs(errors_of, seeds(runs), jobs, scheduler)
    table = {
        situation: rounded(
            {name: row([result[situation, name] for result in results]) for name in VARIANTS}
        )
        for situation in SITUATIONS
    }
    return {
        "versions": made_with(),
        "seeds": [0, runs - 1],
        "band_95": band(3, runs),
        "situations": table,
    }


def row(runs):
    """One line of the table.

    Parameters
    ----------
    runs : list of dict of numbers

    Returns
    -------
    dict of numbers; without a covariance there is no NEES
    """
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


def main(words=None):
    """The command; 0 when written, 2 when something is wrong with what was asked."""
    return command.main("walls", 60, study, words)


if __name__ == "__main__":
    sys.exit(main())
