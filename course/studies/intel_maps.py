"""``python -m course.studies.intel_maps``: maps of the real Intel log by odometry, scan matching
and graph SLAM (lessons 01, 13 and 15). The log is not part of the course."""

import argparse
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from course.studies.study_command import TABLES
from slamlab import estimators, sources
from slamlab.estimators.runner import run
from slamlab.evaluation.relations import load_relations, relations_error
from slamlab.files import SourceError
from slamlab.geometry import transform

TABLE = TABLES / "intel-maps.npz"
SIDES = {"odometry": 0.15, "icp": 0.1, "graph": 0.1}  # of a grid's cells [m]
NAMES = "odometry", "icp-plain", "icp", "graph"
ERRORS = "off", "spread", "turned"  # of the relations


@dataclass(frozen=True)
class IntelMaps:
    """Numbers and maps that are computed from the Intel log.

    ``readings``, ``minutes``, and ``path_length`` by odometry [m]. By estimator ("odometry", "icp",
    "graph"): ``points`` (n, 2), centres of cells [m]. By estimator, including "icp-plain": relative
    pose errors over ``relations``, mean ``off`` and standard deviation ``spread`` [m], mean
    ``turned`` [rad]. The graph's ``track`` (n, 2) and ``loops`` (m, 4) [m].
    """

    readings: int
    minutes: float
    path_length: float
    points: dict
    off: dict
    spread: dict
    turned: dict
    relations: int
    track: np.ndarray
    loops: np.ndarray


@cache
def stored():
    """Load the stored IntelMaps."""
    with np.load(TABLE) as kept:
        points = {name: kept[name] * side for name, side in SIDES.items()}
        errors = [dict(zip(NAMES, kept[name].tolist(), strict=True)) for name in ERRORS]
        counts, driven = (int(kept["readings"]), int(kept["relations"])), kept["driven"].tolist()
        track = kept["track"].astype(float)
        loops = track[kept["loops"]].reshape(-1, 4)
        return IntelMaps(counts[0], *driven, points, *errors, counts[1], track, loops)


def study():
    """Compute the arrays to store, with points rounded to cells; raise SourceError if the
    recordings are missing."""
    source = sources.open(sources.recording("intel"))
    relations = load_relations(sources.recording("intel-relations"))
    readings = list(source)
    plain, result, closed = (run(source, estimators.make(name, source)) for name in NAMES[1:])
    graph = closed.estimator.graph
    trajectories = (result.naive, plain.trajectory, result.trajectory, closed.trajectory)
    trajectories = dict(zip(NAMES, trajectories, strict=True))
    found = [relations_error(trajectory, relations) for trajectory in trajectories.values()]
    kept = {}
    for name in SIDES:
        scans = [
            transform(p, r.scan.points())
            for p, r in zip(trajectories[name].poses, readings, strict=True)
        ]
        cells = np.round(np.vstack(scans) / SIDES[name]).astype(np.int16)
        kept[name] = np.unique(cells, axis=0)
    steps = np.diff(result.naive.poses[:, :2], axis=0)
    return kept | {
        "off": [each.translation for each in found],
        "spread": [each.translation_std for each in found],
        "turned": [each.rotation for each in found],
        "relations": found[0].count,
        "readings": len(readings),
        "driven": [np.ptp(result.trajectory.times) / 60, np.hypot(*steps.T).sum()],
        "track": graph.poses[:, :2].astype(np.float32),
        "loops": np.array([(e.i, e.j) for e in graph.edges if e.robust], dtype=np.int16),
    }


def main(argv=None):
    command = argparse.ArgumentParser(prog="python -m course.studies.intel_maps")
    command.add_argument("--out", type=Path, default=TABLE, help="the file to write")
    asked = command.parse_args(argv)
    try:
        np.savez_compressed(asked.out, **study())
    except (SourceError, OSError) as error:
        print(f"{command.prog}: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
