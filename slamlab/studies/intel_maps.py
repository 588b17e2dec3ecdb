"""``python -m slamlab.studies.intel_maps``: what wheels, and scans, make of the real Intel log.

The log itself is not part of the course. This keeps what lessons 01, 13 and 15 show of it: which
cells of a grid the points of each map fall into, how far off relative poses are, the closed loops.
"""

import argparse
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from slamlab import estimators, sources
from slamlab.estimators.runner import run
from slamlab.evaluation.relations import load_relations, relations_error
from slamlab.files.errors import SourceError
from slamlab.geometry import transform
from slamlab.studies.study_command import TABLES

TABLE = TABLES / "intel-maps.npz"
SIDES = {"odometry": 0.15, "icp": 0.1, "graph": 0.1}  # of a grid's cells [m]
WAYS = "odometry", "icp-plain", "icp", "graph"
ERRORS = "off", "spread", "turned"  # of the relations


@dataclass(frozen=True)
class IntelMaps:
    """What was kept of the log, and of its maps by ``odometry``, by ``icp`` and by ``graph``.

    Parameters
    ----------
    readings : int
    minutes : float
    way : float, as the wheels tell it [m]
    points : dict, name to (n, 2) centres of the cells that a scan's point fell into [m]
    off, spread : dict, name to mean and standard deviation of relative poses' errors, see
        Relations [m]; also of ``icp-plain``
    turned : dict, the mean of their headings' errors [rad]
    relations : int, how many relative poses were asked
    track : (n, 2) places of the graph's keyframes [m]
    loops : (m, 4) the graph's loops, from place to place [m]
    """

    readings: int
    minutes: float
    way: float
    points: dict
    off: dict
    spread: dict
    turned: dict
    relations: int
    track: np.ndarray
    loops: np.ndarray


@cache
def stored():
    """The stored maps, the same on every machine.

    Returns
    -------
    IntelMaps
    """
    with np.load(TABLE) as kept:
        points = {name: kept[name] * side for name, side in SIDES.items()}
        errors = [dict(zip(WAYS, kept[name].tolist(), strict=True)) for name in ERRORS]
        counts, driven = (int(kept["readings"]), int(kept["relations"])), kept["driven"].tolist()
        track = kept["track"].astype(float)
        loops = track[kept["loops"]].reshape(-1, 4)
        return IntelMaps(counts[0], *driven, points, *errors, counts[1], track, loops)


def study():
    """The arrays to be stored, from the recording.

    Returns
    -------
    dict, see IntelMaps; points as whole numbers of cells

    Raises
    ------
    SourceError : the recording, or its relations, are not there
    """
    source = sources.open(sources.recording("intel"))
    relations = load_relations(sources.recording("intel-relations"))
    readings = list(source)
    plain, result, closed = (run(source, estimators.make(name, source)) for name in WAYS[1:])
    graph = closed.estimator.graph
    ways = (result.naive, plain.trajectory, result.trajectory, closed.trajectory)
    ways = dict(zip(WAYS, ways, strict=True))
    found = [relations_error(way, relations) for way in ways.values()]
    kept = {}
    for name in SIDES:
        scans = [
            transform(p, r.scan.points()) for p, r in zip(ways[name].poses, readings, strict=True)
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
    """Run the command line; returns its exit code."""
    command = argparse.ArgumentParser(prog="python -m slamlab.studies.intel_maps")
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
