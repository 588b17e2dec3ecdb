"""``python -m slamlab.studies.intel_maps``: what wheels, and scans, make of the real Intel log.

The log itself is not part of the course. This keeps what lessons 01 and 13 show of it: which cells
of a grid the points of either map fall into, and how far off relative poses are.
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
SIDES = {"odometry": 0.15, "icp": 0.1}  # of a grid's cells [m]
WAYS = *SIDES, "icp-plain"


@dataclass(frozen=True)
class IntelMaps:
    """What was kept of the log, and of two maps of it, by ``odometry`` and by ``icp``.

    Parameters
    ----------
    readings : int
    minutes : float
    way : float, as the wheels tell it [m]
    points : dict, name to (n, 2) centres of the cells that a scan's point fell into [m]
    off : dict, name to the mean error of relative poses' places, see Relations [m]; also of
        ``icp-plain``
    turned : dict, the same of their headings [rad]
    relations : int, how many of these there are
    """

    readings: int
    minutes: float
    way: float
    points: dict
    off: dict
    turned: dict
    relations: int


@cache
def stored():
    """The stored maps, the same on every machine.

    Returns
    -------
    IntelMaps
    """
    with np.load(TABLE) as kept:
        points = {name: kept[name] * side for name, side in SIDES.items()}
        off, turned = (
            dict(zip(WAYS, kept[name].tolist(), strict=True)) for name in ("off", "turned")
        )
        count = int(kept["relations"])
        return IntelMaps(
            int(kept["readings"]), *kept["driven"].tolist(), points, off, turned, count
        )


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
    result = run(source, estimators.make("icp", source))
    plain = run(source, estimators.make("icp-plain", source)).trajectory
    ways = dict(zip(WAYS, (result.naive, result.trajectory, plain), strict=True))
    errors = [relations_error(way, relations) for way in ways.values()]
    kept = {}
    for name in SIDES:
        scans = [
            transform(p, r.scan.points()) for p, r in zip(ways[name].poses, readings, strict=True)
        ]
        cells = np.round(np.vstack(scans) / SIDES[name]).astype(np.int16)
        kept[name] = np.unique(cells, axis=0)
    steps = np.diff(result.naive.poses[:, :2], axis=0)
    return kept | {
        "off": [error.translation for error in errors],
        "turned": [error.rotation for error in errors],
        "relations": errors[0].count,
        "readings": len(readings),
        "driven": [np.ptp(result.trajectory.times) / 60, np.hypot(*steps.T).sum()],
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
