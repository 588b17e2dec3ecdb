"""``python -m slamlab.studies.spoilt_walls``: SLAM with walls, one part spoilt at a time.

Every loop drives the same tours and gets the same scans; a row a loop and situation.
"""

import sys
from dataclasses import replace
from functools import partial

import numpy as np

from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.foot_slam import FootSlam
from slamlab.estimators.runner import run
from slamlab.estimators.wall_slam import AMBIGUITY_GATE
from slamlab.evaluation import band, nees
from slamlab.filters.landmark_models import LINES
from slamlab.geometry import wrap
from slamlab.landmarks.line_fitting import cloud
from slamlab.landmarks.ransac import THESIS, lines
from slamlab.parallel import map_runs
from slamlab.sources.simulated_robot import simulation
from slamlab.studies import feet, study_command
from slamlab.studies.study_command import TABLES, package_versions, rounded, seeds
from slamlab.studies.wall_loop import WallLoop
from slamlab.worlds import World

TABLE = TABLES / "spoilt_walls.json"
LEAST = feet.LEAST
BURN_IN = 10  # steps without NEES, until the pose's covariance, zero at first, can be inverted
WINDOWS = replace(THESIS, band=None)  # 25 readings a line, within a band that grows with the range
OUT_OF_LINE = "situation-1, a piece out of line"
RIGHT = "as it should be"
PRODUCTS = (1e-5, 1e-4, 1e-3, 1e-2, 1e-1)  # c of the listing's Q, which is not printed


def _times_57(*matrices):
    """Jacobians whose lever arms act on degrees though they are those for radians."""
    spoilt = [M.copy() for M in matrices]
    for M in spoilt:
        M[..., 0, 2 if M.shape[-1] == 3 else 1] *= 180 / np.pi
    return tuple(spoilt)


IN_DEGREES = replace(
    LINES,
    H=lambda x, line: _times_57(*LINES.H(x, line)),
    J=lambda x, z: _times_57(*LINES.J(x, z)),
)


class SlopeAndIntercept(WallLoop):
    """Walls fitted by y = a x + b in the robot's frame."""

    def extract(self, scan):
        """The lines of a scan, each with the (ρ, α) of that fit."""
        points, found = cloud(scan, self.sensor), []
        for line in super().extract(scan):
            a, b = np.polyfit(*points.points[np.isin(points.beams, line.beams)].T, 1)
            z = np.array([b / np.hypot(1, a), np.arctan2(1, -a)])
            found.append(replace(line, z=z if b > 0 else np.array([-z[0], wrap(z[1] + np.pi)])))
        return found


class Endless(WallLoop):
    """A wall is its infinite line."""

    def near(self, line, d2):
        """Walls that a line may be, wherever along their lines it was seen."""
        return [(d, i) for d, i in zip(d2, self.mak.ids, strict=True) if d < AMBIGUITY_GATE]


class FirstFound(WallLoop):
    """A line is the first wall of the map that it may be."""

    def choice(self, near):
        """The first of them in the order of the map."""
        return next((pair for pair in near if pair[0] <= self.gate), super().choice(near))


class Windows(WallLoop):
    """Lines are windows of 25 readings, and enter at first sight."""

    def extract(self, scan):
        """The lines of a scan, not grown."""
        return lines(scan, self.sensor, self.rng, WINDOWS)


class NeverMerged(WallLoop):
    """What entered as two walls stays two."""

    def merge(self):
        """Nothing."""


class PairedTooEarly(WallLoop):
    """Pairs are made with the pose before the drive."""

    def step(self, odometry, found):
        """Pair, and only then predict."""
        known, new = self.pair(found)
        self.predict(odometry)
        self.update(known)
        self.welcome(new, known)
        self.merge()


class PlacedTooEarly(WallLoop):
    """New walls, too, are placed from where the robot was before the drive."""

    def step(self, odometry, found):
        """Pair and place, and only then predict."""
        known, new = self.pair(found)
        self.welcome(new, dict(known))
        self.predict(odometry)
        self.update(known)
        self.merge()


VARIANTS = {
    RIGHT: WallLoop,
    "degrees in the Jacobians": partial(WallLoop, kind=IN_DEGREES),
    "y = a x + b": SlopeAndIntercept,
    "infinite lines": Endless,
    "first found": FirstFound,
    "new at first sight": partial(WallLoop, sightings=1),
    "windows, first sight": partial(Windows, sightings=1),
    "never merged": NeverMerged,
    "paired before predict": PairedTooEarly,
    "placed before predict": PlacedTooEarly,
}


def found_by(source, make=WallLoop):
    """The lines of every scan of a source: they hang on the scan alone, not on the map.

    Parameters
    ----------
    source : Source
    make : callable(source) that gives a loop

    Returns
    -------
    list of lists of Line
    """
    loop = make(source)
    return [loop.extract(reading.scan) for reading in source]


def driven(source, loop, found):
    """Drive a loop through a source.

    Parameters
    ----------
    source : Source
    loop : WallLoop; it is changed
    found : list of lists of Line, of each scan

    Returns
    -------
    poses : (n, 3) [m, m, rad]
    P : (n, 3, 3) what is believed of them
    maps : list of (k, 4) line segments, the walls after each step [m]
    """
    poses, P, maps = [], [], []
    for reading, here in zip(source, found, strict=True):
        loop.step(reading.odometry, here)
        poses.append(loop.mak.pose)
        P.append(loop.mak.block([0, 1, 2]))
        maps.append(loop.segments())
    return np.array(poses), np.array(P), maps


def errors(source, poses):
    """Estimates minus the truth, headings wrapped: (n, 3) [m, m, rad].

    Parameters
    ----------
    source : Source
    poses : (n, 3) [m, m, rad]
    """
    off = poses - source.truth.poses
    off[:, 2] = wrap(off[:, 2])
    return off


def out_of_line(source, by=0.1):
    """Move the piece of situation 1's wall between two doors out of line.

    Parameters
    ----------
    source : Simulation of situation 1; it is changed
    by : float [m]

    Returns
    -------
    Simulation
    """
    walls = source.world.walls.copy()
    walls[5, [1, 3]] += by
    source.world = World(walls)
    return source


def errors_of(seed):
    """Errors of all loops on one drive through each situation, and of the listing for each c.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict, (situation, variant) to dict of numbers; c to float [m]
    """
    rng, table = partial(np.random.default_rng, seed), {}
    for situation in ("situation-1", "situation-2"):
        table |= rows_of(situation, simulation(situation, rng()), VARIANTS)
    bent = out_of_line(simulation("situation-1", rng()))
    few = {name: VARIANTS[name] for name in (RIGHT, "infinite lines")}
    table |= rows_of(OUT_OF_LINE, bent, few)
    source = simulation("situation-2", rng())
    for c in PRODUCTS:
        table[c] = _rms(source, FootSlam(source.robot, source.sensor, rng(), c=c))
    return table


def rows_of(situation, source, variants):
    """Errors of some loops, and of odometry, on one drive.

    Parameters
    ----------
    situation : str, for the keys
    source : Source
    variants : dict, name to callable(source) that gives a loop

    Returns
    -------
    dict, (situation, variant) to dict of numbers
    """
    grown, found = found_by(source), {}
    for name in {"y = a x + b", "windows, first sight"} & set(variants):
        found[name] = found_by(source, variants[name])
    rows = {(situation, "odometry"): {"rms_m": _rms(source, DeadReckoning())}}
    for name, make in variants.items():
        loop = make(source)
        poses, P, _ = driven(source, loop, found.get(name, grown))
        off = errors(source, poses)
        rows[situation, name] = {
            "rms_m": np.sqrt(np.mean(np.sum(off[:, :2] ** 2, axis=1))),
            "turned_deg": np.degrees(np.abs(off[:, 2]).max()),
            "nees": nees(off[BURN_IN:], P[BURN_IN:]).mean(),
            "walls": len(loop.mak.ids),
        }
    return rows


def _rms(source, slam):
    off = errors(source, run(source, slam).trajectory.poses)
    return np.sqrt(np.mean(np.sum(off[:, :2] ** 2, axis=1)))


def study(runs, jobs=None, scheduler=None):
    """The tables: medians over the runs, and of paired differences to odometry a 95 % interval.

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

    def over_runs(key):
        return {n: np.array([one[key][n] for one in results]) for n in results[0][key]}

    tables = {}
    for situation, name in (key for key in results[0] if isinstance(key, tuple)):
        numbers, wheels = over_runs((situation, name)), over_runs((situation, "odometry"))
        row = feet.row(numbers["rms_m"], wheels["rms_m"])
        row |= {n: np.median(numbers[n]) for n in ("turned_deg", "walls") if n in numbers}
        row |= {"nees": numbers["nees"].mean()} if "nees" in numbers else {}
        tables.setdefault(situation, {})[name] = row
    baseline = over_runs(("situation-2", "odometry"))["rms_m"]
    by_c = {f"{c:g}": feet.row(np.array([one[c] for one in results]), baseline) for c in PRODUCTS}
    return {
        "versions": package_versions(),
        "seeds": [0, runs - 1],
        "band_95": band(3, runs),
        "seed_0": {  # of one drive, for who wants to see whether it comes out again
            key[1]: round(float(row["rms_m"]), 6)
            for key, row in results[0].items()
            if isinstance(key, tuple) and key[0] == "situation-2"
        },
        "situations": {situation: rounded(rows) for situation, rows in tables.items()},
        "listing": rounded(by_c),
    }


def main(argv=None):
    """The command: run the study, write its table; exit code 0, or 2 on an error."""
    return study_command.main("spoilt_walls", 12, study, argv)


if __name__ == "__main__":
    sys.exit(main())
