"""``python -m course.studies.rplidar_a2_noise``: noise statistics of a real RPLIDAR A2 at rest
(lesson 02). The three recordings are not part of the course."""

import argparse
import sys
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np

from course.studies import study_command
from course.studies.study_command import TABLES, package_versions, write
from slamlab import sources

TABLE = TABLES / "rplidar_a2_noise.json"
RANGES = (2, 2.5, 3, 3.5, 4, 5, 6, 8, 10, 13)  # edges of classes [m]
INCIDENCES = (0, 15, 30, 45, 60, 75)  # edges of classes of incidence [degree]
WINDOWS = ((3.0, 3.2), (4.5, 4.7), (6.8, 7.2), (11.0, 11.4))  # ranges searched for steps [m]
MAX_TAN = 0.5  # of the angle of incidence at which a surface counts as perpendicular
CELL = 0.05  # side of the cells in which the first turn is kept [m]


def surfaces(scan, angles):
    """Interpolate a scan at other angles (n,), between neighbouring readings.

    Returns ranges (n,) [m], NaN at edges and empty readings; the tangent of the angle of incidence
    (n,); and the factor √(1 + τ² + (1 − τ)²) (n,) for the share τ. The difference between a reading
    and an interpolated range has a standard deviation that is larger by this factor than that of
    the reading.
    """
    order = np.argsort(scan.angles)
    known, ranges = scan.angles[order], scan.ranges[order]
    after = np.clip(np.searchsorted(known, angles), 1, len(known) - 1)
    width, jump = known[after] - known[after - 1], ranges[after] - ranges[after - 1]
    tau = (angles - known[after - 1]) / width
    between = ranges[after - 1] + tau * jump
    with np.errstate(invalid="ignore"):
        rough = ~(abs(jump) < 0.05 * between) | (abs(tau - 0.5) > 0.5)
    between[rough] = np.nan
    return between, abs(jump) / width / between, np.sqrt(1 + tau**2 + (1 - tau) ** 2)


def repeats(turns):
    """Compare each reading of a device at rest with the smooth surface of the previous turn.

    Returns rows (n, 3): range [m], error relative to it (NaN for an empty reading), tangent of the
    angle of incidence. Equations (02.9) and (02.10).
    """
    rows = []
    for before, scan in pairwise(turns):
        expected, slant, root = surfaces(before, scan.angles)
        error = (scan.ranges - expected) / expected / root
        rows.append(np.column_stack([expected, error, slant])[np.isfinite(expected)])
    return np.vstack(rows)


def spread(errors):
    """Return a robust standard deviation of errors (n,) about 0, computed from the median; NaN
    values are ignored."""
    return 1.4826 * float(np.nanmedian(abs(errors)))


def by_range(rows, edges=RANGES, least=50):
    """Return standard deviations by class of range, for perpendicular surfaces, from rows of
    ``repeats``: lists "range" [m], "slant" (tan of the incidence), "share" (σ over range),
    "readings" (at least ``least``)."""
    rows = rows[(rows[:, 2] < MAX_TAN) & np.isfinite(rows[:, 1])]
    kinds = [rows[(low <= rows[:, 0]) & (rows[:, 0] < high)] for low, high in pairwise(edges)]
    return _classes(kind for kind in kinds if len(kind) >= least)


def by_slant(rows, low=2.0, high=4.0):
    """Return standard deviations by class of incidence between two ranges; see :func:`by_range`."""
    rows = rows[(low < rows[:, 0]) & (rows[:, 0] < high) & np.isfinite(rows[:, 1])]
    incidence = np.degrees(np.arctan(rows[:, 2]))
    return _classes(rows[(a <= incidence) & (incidence < b)] for a, b in pairwise(INCIDENCES))


def _classes(kinds):
    found = {"range": [], "slant": [], "share": [], "readings": []}
    for kind in kinds:
        found["range"].append(round(float(kind[:, 0].mean()), 3))
        found["slant"].append(round(float(np.median(kind[:, 2])), 4))
        found["share"].append(round(spread(kind[:, 1]), 6))
        found["readings"].append(len(kind))
    return found


def lost(logs):
    """Return the shares of empty readings where the previous turn measured a surface, and where
    both the previous and the next turn measured one."""
    rows = []
    threes = [turns[i : i + 3] for turns in logs for i in range(len(turns) - 2)]
    for before, scan, after in threes:
        one, other = surfaces(before, scan.angles)[0], surfaces(after, scan.angles)[0]
        with np.errstate(invalid="ignore"):
            agreed = abs(one - other) < 0.05 * one
        rows.append(np.column_stack([np.isnan(scan.ranges), np.isfinite(one), agreed]))
    empty, before, around = np.vstack(rows).T
    return float(empty[before == 1].mean()), float(empty[around == 1].mean())


def statistics(logs):
    """Compute the statistics of recordings, lists of Scan; see :func:`stored`."""
    rows = np.vstack([repeats(turns) for turns in logs])
    errors = rows[np.isfinite(rows[:, 1]), 1]
    usual = errors[abs(errors) < 0.03]  # larger ones are people who walked through the beam
    longest = max(logs, key=len)
    angles = [np.degrees(scan.angles[np.isnan(scan.ranges)]) % 360 for scan in longest]
    millimetres = 1000 * np.concatenate([scan.ranges for turns in logs for scan in turns])
    values = np.unique(np.rint(millimetres[np.isfinite(millimetres)]).astype(int))
    cells = np.unique(np.rint(logs[0][0].points() / CELL).astype(int), axis=0)
    return {
        "turns": [[len(scan.ranges) for scan in turns] for turns in logs],
        "errors": {
            "readings": len(errors),
            "rms": round(float(np.sqrt(np.mean(usual**2))), 6),
            "median": round(spread(errors), 6),
        },
        "by_slant": by_slant(rows),
        "by_range": by_range(rows),
        "steps": [[v for v in values.tolist() if low <= v / 1000 < high] for low, high in WINDOWS],
        "empty": {
            "readings": round(float(np.mean(~np.isfinite(millimetres))), 4),
            "lost": [round(share, 4) for share in lost(logs)],
            "bearings": [each.round().astype(int).tolist() for each in angles],
        },
        "first_turn": cells.tolist(),
    }


@cache
def stored():
    """Load the stored dict: "turns", the number of readings in each turn; "errors", "by_slant",
    "by_range" of repeated ranges; "steps", the ranges that occur in each window [mm]; "empty",
    shares and bearings of empty readings [degree]; "first_turn", the 5 cm cells (n, 2) that contain
    the first turn's points."""
    return study_command.stored(TABLE.stem)


def study():
    """Make the table from the recordings; raise SourceError if they are missing."""
    paths = [sources.recording(f"rplidar-a2-{number}") for number in (1, 2, 3)]
    logs = [[reading.scan for reading in sources.open(path)] for path in paths]
    return {"versions": package_versions()} | statistics(logs)


def main(argv=None):
    argv = sys.argv[1:] if argv is None else argv
    command = argparse.ArgumentParser(prog="python -m course.studies.rplidar_a2_noise")
    command.add_argument("--out", type=Path, default=TABLE, help="the file to write")
    return write(command.prog, argv, command.parse_args(argv).out, study)


if __name__ == "__main__":
    sys.exit(main())
