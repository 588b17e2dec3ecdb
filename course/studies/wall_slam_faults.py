"""``python -m course.studies.wall_slam_faults``: Monte Carlo runs of wall SLAM, correct or with one
fault, on the same readings."""

import sys
from dataclasses import replace
from functools import partial

import numpy as np

from course.studies import foot_point_ablation, study_command
from course.studies.line_extraction_errors import expected_from, lines_of, wall_under
from course.studies.study_command import TABLES, first_runs, package_versions, rounded, seeds
from course.studies.wall_slam_loop import WallLoop
from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.foot_point_slam import FootPointSlam
from slamlab.estimators.runner import run
from slamlab.estimators.wall_slam import AMBIGUITY_GATE
from slamlab.evaluation import band, nees
from slamlab.filters.landmark_models import LINES
from slamlab.geometry import transform, wrap
from slamlab.landmarks.line_fitting import scan_points
from slamlab.landmarks.ransac import THESIS, lines
from slamlab.parallel import map_runs
from slamlab.simulation.worlds import World
from slamlab.sources.simulated_robot import simulation

TABLE = TABLES / "wall_slam_faults.json"
LEAST = foot_point_ablation.LEAST
BURN_IN = 10  # steps without NEES, until the pose's covariance, zero at first, can be inverted
MEANS = "nees", "map_nees", "map_nees_drawn"  # over the runs; of the others, medians
WINDOWS = replace(THESIS, band=None)  # 25 readings a line, within a band that grows with the range
OUT_OF_LINE = "situation-1, a piece out of line"
RIGHT = "as it should be"
PRODUCTS = (1e-5, 1e-4, 1e-3, 1e-2, 1e-1)  # c of the listing's Q, which is not printed


def _lever_arms_in_degrees(*matrices):
    """Return the Jacobians with lever arms too long by 180/π, as if angles were in degrees."""
    wrong = [M.copy() for M in matrices]
    for M in wrong:
        M[..., 0, 2 if M.shape[-1] == 3 else 1] *= 180 / np.pi
    return tuple(wrong)


IN_DEGREES = replace(
    LINES,
    H=lambda x, line: _lever_arms_in_degrees(*LINES.H(x, line)),
    J=lambda x, z: _lever_arms_in_degrees(*LINES.J(x, z)),
)


class SlopeAndIntercept(WallLoop):
    """Fault: walls are fitted by y = a x + b in the robot frame."""

    def extract(self, scan):
        points, found = scan_points(scan, self.sensor), []
        for line in super().extract(scan):
            a, b = np.polyfit(*points.points[np.isin(points.beams, line.beams)].T, 1)
            z = np.array([b / np.hypot(1, a), np.arctan2(1, -a)])
            found.append(replace(line, z=z if b > 0 else np.array([-z[0], wrap(z[1] + np.pi)])))
        return found


class InfiniteLines(WallLoop):
    """Fault: a wall is treated as an infinite line."""

    def near(self, line, d2):
        return [(d, i) for d, i in zip(d2, self.mak.ids, strict=True) if d < AMBIGUITY_GATE]


class FirstFound(WallLoop):
    """Fault: a line is associated with the first wall of the map within the gate."""

    def choice(self, near):
        return next((pair for pair in near if pair[0] <= self.gate), super().choice(near))


class Windows(WallLoop):
    """Fault: lines are windows of 25 readings, and are confirmed at the first observation."""

    def extract(self, scan):
        return lines(scan, self.sensor, self.rng, WINDOWS)


class NeverMerged(WallLoop):
    """Fault: duplicate walls are never merged."""

    def merge(self):
        """Do nothing."""


class AssociatedTooEarly(WallLoop):
    """Fault: data association uses the pose before the prediction."""

    def step(self, odometry, found):
        known, new = self.associate(found)
        self.predict(odometry)
        self.update(known)
        self.initialise(new, known)
        self.merge()


class PlacedTooEarly(WallLoop):
    """Fault: new walls are also added with the pose before the prediction."""

    def step(self, odometry, found):
        known, new = self.associate(found)
        self.initialise(new, dict(known))
        self.predict(odometry)
        self.update(known)
        self.merge()


VARIANTS = {
    RIGHT: WallLoop,
    "degrees in the Jacobians": partial(WallLoop, kind=IN_DEGREES),
    "y = a x + b": SlopeAndIntercept,
    "infinite lines": InfiniteLines,
    "first found": FirstFound,
    "new at first observation": partial(WallLoop, min_observations=1),
    "windows, first observation": partial(Windows, min_observations=1),
    "never merged": NeverMerged,
    "associated before prediction": AssociatedTooEarly,
    "placed before prediction": PlacedTooEarly,
}


def extracted_lines(source, make=WallLoop):
    """Extract the Lines of every scan with the loop ``make(source)``; the Lines depend only on the
    scan."""
    loop = make(source)
    return [loop.extract(reading.scan) for reading in source]


def driven(source, loop, found):
    """Run a loop on a source with each scan's Lines; return poses (n, 3) [m, m, rad], P (n, 3, 3),
    and the walls after each step (k, 4) [m]."""
    poses, P, maps = [], [], []
    for reading, here in zip(source, found, strict=True):
        loop.step(reading.odometry, here)
        poses.append(loop.mak.pose)
        P.append(loop.mak.block([0, 1, 2]))
        maps.append(loop.segments())
    return np.array(poses), np.array(P), maps


def errors(source, poses):
    """Return estimates (n, 3) minus the truth, headings wrapped [m, m, rad]."""
    off = poses - source.truth.poses
    off[:, 2] = wrap(off[:, 2])
    return off


def map_errors(source, loop):
    """Return the errors (n, 2) [m], [rad] of a map's walls, each against the nearest true line, and
    the NEES of the whole map with its cross-covariances, per number (1 if P is right)."""
    true, walls = lines_of(source.world.walls), loop.mak.landmarks()
    true = np.vstack([true, true * [-1, 1] + [0, np.pi]])  # each with both signs of rho
    apart = walls[:, None] - true
    apart[..., 1] = wrap(apart[..., 1])
    off = apart[np.arange(len(walls)), np.abs(apart).sum(axis=2).argmin(axis=1)]
    P = loop.mak.block(loop.mak.rows(loop.mak.ids))
    return off, float(nees(off.ravel(), P)) / off.size


def redrawn(source, found, rng):
    """Return each scan's Lines with their errors replaced by draws from N(0, R)."""
    true, scans = lines_of(source.world.walls), []
    for pose, seen in zip(source.truth.poses, found, strict=True):
        expected = expected_from(pose, true)
        rows = [wall_under(transform(pose, line.ends), source.world.walls) for line in seen]
        drawn = [
            rng.multivariate_normal(expected[k], line.R) for k, line in zip(rows, seen, strict=True)
        ]
        scans.append(
            [
                replace(line, z=np.array([z[0], wrap(z[1])]))
                for line, z in zip(seen, drawn, strict=True)
            ]
        )
    return scans


def out_of_line(source, by=0.1):
    """Shift the wall piece between two doors of situation 1 out of line by ``by`` [m]."""
    walls = source.world.walls.copy()
    walls[5, [1, 3]] += by
    source.world = World(walls)
    return source


def errors_of(seed):
    """Evaluate one run per situation; return numbers by (situation, variant), and the listing's RMS
    error [m] by c."""
    rng, table = partial(np.random.default_rng, seed), {}
    for situation in ("situation-1", "situation-2"):
        table |= rows_of(situation, simulation(situation, rng()), VARIANTS, seed)
    bent = out_of_line(simulation("situation-1", rng()))
    few = {name: VARIANTS[name] for name in (RIGHT, "infinite lines")}
    table |= rows_of(OUT_OF_LINE, bent, few, seed)
    source = simulation("situation-2", rng())
    for c in PRODUCTS:
        table[c] = _rms(source, FootPointSlam(source.robot, source.sensor, rng(), c=c))
    return table


def rows_of(situation, source, variants, seed=0):
    """Evaluate odometry and the variants' loops on one run; return numbers by (situation, variant).
    ``seed`` is that of redrawn lines."""
    grown, found = extracted_lines(source), {}
    for name in {"y = a x + b", "windows, first observation"} & set(variants):
        found[name] = extracted_lines(source, variants[name])
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
        if name == RIGHT:
            drawn = make(source)
            driven(source, drawn, redrawn(source, grown, np.random.default_rng(seed)))
            for key, each in {"map_nees": loop, "map_nees_drawn": drawn}.items():
                rows[situation, name][key] = map_errors(source, each)[1]
    return rows


def _rms(source, slam):
    off = errors(source, run(source, slam).trajectory.poses)
    return np.sqrt(np.mean(np.sum(off[:, :2] ** 2, axis=1)))


def study(runs, jobs=None, scheduler=None):
    """Make the tables "situations" and "listing": medians "rms_m", "turned_deg", "walls", mean
    "nees" of the pose, mean "map_nees" (also of "redrawn" lines), paired differences to odometry
    [m]; raise ValueError for fewer than 6 runs."""
    results = map_runs(errors_of, seeds(runs, LEAST), jobs, scheduler)

    def over_runs(key):
        return {n: np.array([one[key][n] for one in results]) for n in results[0][key]}

    tables = {}
    for situation, name in (key for key in results[0] if isinstance(key, tuple)):
        numbers, wheels = over_runs((situation, name)), over_runs((situation, "odometry"))
        row = foot_point_ablation.row(numbers["rms_m"], wheels["rms_m"])
        row |= {n: np.median(numbers[n]) for n in ("turned_deg", "walls") if n in numbers}
        row |= {n: numbers[n].mean() for n in MEANS if n in numbers}
        tables.setdefault(situation, {})[name] = row
    baseline = over_runs(("situation-2", "odometry"))["rms_m"]
    by_c = {
        f"{c:g}": foot_point_ablation.row(np.array([one[c] for one in results]), baseline)
        for c in PRODUCTS
    }
    return {
        "versions": package_versions(),
        "seeds": [0, runs - 1],
        "first_runs": first_runs(results),
        "band_95": band(3, runs),
        "situations": {situation: rounded(rows) for situation, rows in tables.items()},
        "listing": rounded(by_c),
    }


def main(argv=None):
    return study_command.main("wall_slam_faults", 12, study, argv)


if __name__ == "__main__":
    sys.exit(main())
