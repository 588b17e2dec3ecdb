"""SLAM on corrected CARMEN logs with corrupted odometry: error over 5 m, APE, CPU time.

    python -m benchmarks.corrected_logs FOLDER [--estimators icp,graph] [--json FILE]

A corrected log (as published, for example in acschaefer/ple) contains poses of an offline SLAM
system. These poses are the reference; the odometry is computed from them and corrupted by gains,
noise or wheel slip.
"""

import argparse
import json
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from slamlab.estimators import make
from slamlab.geometry import between, compose, wrap
from slamlab.sources.carmen import CarmenLog

DISTANCE = 5.0  # over which the relative pose error is computed [m]
CORRUPTIONS = ("gain", "noise", "slip")
GAIN = 0.95, 1.06, 0.02  # of distances and turns [1], and the turn that a metre adds [rad/m]
NOISE = 0.05, 0.05, 0.04  # shares of distance and turn [1], turn picked up in a metre [rad/√m]
SLIP = 0.04, 0.5, 0.15  # share of the steps that slip, most lost of the way [1], turn [rad]


def corrupted(readings, kind, rng):
    """Corrupt the odometry of readings by one kind of error and a little noise.

    Parameters
    ----------
    readings : list of Reading
    kind : str, one of CORRUPTIONS
    rng : numpy.random.Generator

    Returns
    -------
    list of Reading
    """
    return [replace(r, odometry=_corrupt(r.odometry, kind, rng)) for r in readings]


def _corrupt(odometry, kind, rng):
    """Corrupt the distance and the turn of an increment (3,)."""
    distance, n, u = np.hypot(*odometry[:2]), rng.standard_normal(3), rng.random(2)
    shares = np.array(NOISE) * (1.0 if kind == "noise" else 0.25)
    length = 1 + shares[0] * n[0]
    turn = odometry[2] * (1 + shares[1] * n[1]) + shares[2] * np.sqrt(distance) * n[2]
    if kind == "gain":
        length, turn = length * GAIN[0], turn * GAIN[1] + GAIN[2] * distance
    if kind == "slip" and u[0] < SLIP[0]:
        length, turn = length * (1 - SLIP[1] * u[1]), turn + SLIP[2] * n[2]
    return np.array([*(odometry[:2] * length), wrap(turn)])


def load(path):
    """Load a corrected log; return source, readings with exact odometry, and reference poses (n,
    3)."""
    source = CarmenLog(path)
    readings = list(source)
    poses = [np.zeros(3)]
    for reading in readings[1:]:
        poses.append(compose(poses[-1], reading.odometry))
    return source, readings, np.array(poses)


def error_over(length, poses, reference):
    """Return the RMS relative pose error [m] over a path length, starting from each reference
    pose."""
    driven = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(reference[:, :2], axis=0).T))])
    ends = np.searchsorted(driven, driven + length)
    starts = np.flatnonzero(ends < len(poses))
    motions = [between(p[starts], p[ends[starts]]) for p in (reference, poses)]
    return float(np.sqrt(np.mean(np.sum(between(*motions)[:, :2] ** 2, axis=1))))


def aligned_error(poses, reference):
    """Return the absolute pose error (APE): RMS distance after least-squares alignment [m]."""
    a, b = (p[:, 0] + 1j * p[:, 1] for p in (poses, reference))
    a, b = a - a.mean(), b - b.mean()
    turn = np.vdot(a, b)
    return float(np.sqrt(np.mean(np.abs(a * turn / abs(turn) - b) ** 2)))


def measure(name, source, readings, reference):
    """Run one estimator on one log; return error over 5 m, APE [m], CPU time [s], and the
    estimator."""
    begin = time.process_time()
    slam = make(name, source)
    for reading in readings:
        slam.step(reading)
    poses = slam.trajectory().poses
    cpu = time.process_time() - begin
    return dict(
        over=error_over(DISTANCE, poses, reference), ape=aligned_error(poses, reference), cpu=cpu
    ), slam


def measured(folder, estimators, kinds, seeds, only=()):
    """Yield a dict of results for each log of a folder, each corruption and each estimator."""
    for path in sorted(Path(folder).glob("*.log*")):
        name = path.name.split(".log")[0].removesuffix("-corrected")
        if only and name not in only:
            continue
        source, readings, reference = load(path)
        for kind in kinds:
            for seed in seeds:
                rng = np.random.default_rng([seed, CORRUPTIONS.index(kind)])
                worse = corrupted(readings, kind, rng)
                for estimator in estimators:
                    found, _ = measure(estimator, source, worse, reference)
                    yield dict(log=name, kind=kind, seed=seed, estimator=estimator, **found)


def main(argv=None):
    """Run the command line: print one line per run, and write all results as JSON if requested."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.corrected_logs")
    parser.add_argument("folder", type=Path, help="folder of CARMEN logs, *.log or *.log.gz")
    parser.add_argument("--estimators", default="odometry,icp,graph")
    parser.add_argument("--kinds", default=",".join(CORRUPTIONS))
    parser.add_argument("--seeds", type=int, default=1, help="number of seeds per kind")
    parser.add_argument("--first-seed", type=int, default=0)
    parser.add_argument("--only", default="", help="names of logs, separated by commas")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(argv)
    rows = []
    seeds = range(options.first_seed, options.first_seed + options.seeds)
    only = options.only.split(",") if options.only else ()
    lists = options.estimators.split(","), options.kinds.split(",")
    for row in measured(options.folder, *lists, seeds, only):
        rows.append(row)
        print(
            f"{row['log']:18} {row['kind']:6} {row['seed']:2} {row['estimator']:9} over 5 m "
            f"{row['over']:7.3f} m, APE {row['ape']:7.3f} m, CPU {row['cpu']:6.1f} s",
            flush=True,
        )
        if options.json:
            options.json.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
