"""``python -m slamlab.studies.a2_at_rest``: how a real RPLIDAR A2 errs, told by three recordings.

The recordings, of a device that stood still, are not part of the course. This keeps the statistics
of them that lesson 02 analyses. What takes scans serves simulated ones as well.
"""

import argparse
import sys
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np

from slamlab import sources
from slamlab.studies import study_command
from slamlab.studies.study_command import TABLES, package_versions, write

TABLE = TABLES / "a2-at-rest.json"
RANGES = (2, 2.5, 3, 3.5, 4, 5, 6, 8, 10, 13)  # edges of classes [m]
SLANTS = (0, 15, 30, 45, 60, 75)  # edges of classes of incidence [degree]
WINDOWS = ((3.0, 3.2), (4.5, 4.7), (6.8, 7.2), (11.0, 11.4))  # in which steps are looked for [m]
SQUARE_ON = 0.5  # tan of the incidence below which a surface counts as seen square on
CELL = 0.05  # side of the cells in which the first turn is kept [m]


def surfaces(scan, angles):
    """Tell what a scan saw at other angles: on the line between the two neighbouring readings.

    Parameters
    ----------
    scan : Scan
    angles : (n,) [rad]

    Returns
    -------
    ranges (n,) [m], NaN at edges and empties; tan of the incidence (n,); how much more than one
    reading the difference from such a range errs (n,): √(1 + τ² + (1 − τ)²) at the share τ [1]
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
    """Compare each reading with the turn before, where that saw a smooth surface.

    Equations (02.9) and (02.10).

    Parameters
    ----------
    turns : list of Scan, of a device that stands still

    Returns
    -------
    (n, 3) rows of range [m], error as a share of it, NaN of an empty reading [1]; tan of incidence
    """
    rows = []
    for before, scan in pairwise(turns):
        expected, slant, root = surfaces(before, scan.angles)
        error = (scan.ranges - expected) / expected / root
        rows.append(np.column_stack([expected, error, slant])[np.isfinite(expected)])
    return np.vstack(rows)


def spread(errors):
    """Standard deviation of errors about 0, told by the median: a few gross ones do not move it.

    Parameters
    ----------
    errors : (n,), NaN where there is none

    Returns
    -------
    float, of the errors' unit
    """
    return 1.4826 * float(np.nanmedian(abs(errors)))


def by_range(rows, edges=RANGES, least=50):
    """Spread by classes of range, of surfaces seen square on.

    Parameters
    ----------
    rows : (n, 3), see repeats
    edges : sequence of float [m]
    least : int, a class of fewer readings is left out

    Returns
    -------
    dict of lists: "range" the mean [m], "share" σ as a share of it [1], "readings"
    """
    rows = rows[(rows[:, 2] < SQUARE_ON) & np.isfinite(rows[:, 1])]
    kinds = [rows[(low <= rows[:, 0]) & (rows[:, 0] < high)] for low, high in pairwise(edges)]
    return _classes(kind for kind in kinds if len(kind) >= least)


def by_slant(rows, low=2.0, high=4.0):
    """Spread by classes of incidence, of surfaces between two ranges [m]; see by_range."""
    rows = rows[(low < rows[:, 0]) & (rows[:, 0] < high) & np.isfinite(rows[:, 1])]
    incidence = np.degrees(np.arctan(rows[:, 2]))
    return _classes(rows[(a <= incidence) & (incidence < b)] for a, b in pairwise(SLANTS))


def _classes(kinds):
    found = {"range": [], "slant": [], "share": [], "readings": []}
    for kind in kinds:
        found["range"].append(round(float(kind[:, 0].mean()), 3))
        found["slant"].append(round(float(np.median(kind[:, 2])), 4))
        found["share"].append(round(spread(kind[:, 1]), 6))
        found["readings"].append(len(kind))
    return found


def lost(logs):
    """Share of empty readings where there is a surface.

    Parameters
    ----------
    logs : list of recordings, each a list of Scan of a device that stands still

    Returns
    -------
    two floats: where the turn before saw one; where the turn after saw it, too [1]
    """
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
    """Compute what is kept.

    Parameters
    ----------
    logs : list of recordings, each a list of Scan

    Returns
    -------
    dict, see stored
    """
    rows = np.vstack([repeats(turns) for turns in logs])
    errors = rows[np.isfinite(rows[:, 1]), 1]
    usual = errors[abs(errors) < 0.03]  # the others are people who walked through the beam
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
    """Load the statistics of the recordings, the same on every machine.

    Returns
    -------
    dict: "turns", readings of each turn of each recording; "errors", "by_slant", "by_range" of
    repeated ranges; "steps", the ranges that occur in each window [mm]; "empty", their share, the
    shares of lost ones, bearings of a recording's empties, turn by turn [degree]; "first_turn",
    (n, 2) cells of 5 cm that its points fall into
    """
    return study_command.stored(TABLE.stem)


def study():
    """The table, from the recordings.

    Returns
    -------
    dict, see stored

    Raises
    ------
    SourceError : the recordings are not there
    """
    paths = [sources.recording(f"rplidar-a2-{number}") for number in (1, 2, 3)]
    logs = [[reading.scan for reading in sources.open(path)] for path in paths]
    return {"versions": package_versions()} | statistics(logs)


def main(argv=None):
    """The command: write the table; 0 when written, 2 when the recordings are not there."""
    argv = sys.argv[1:] if argv is None else argv
    command = argparse.ArgumentParser(prog="python -m slamlab.studies.a2_at_rest")
    command.add_argument("--out", type=Path, default=TABLE, help="the file to write")
    return write(command.prog, argv, command.parse_args(argv).out, study)


if __name__ == "__main__":
    sys.exit(main())
