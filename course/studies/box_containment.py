"""``python -m course.studies.box_containment``: count how often the truth is outside the boxes of
the set-membership filter BOR.

Each seed draws a random world: one of three motion models, noise within its bounds or at their
ends, useless bearings, clustered landmarks.
"""

import sys
from dataclasses import asdict, dataclass
from functools import partial

import numpy as np

from course.studies import study_command
from course.studies.study_command import TABLES, first_runs, package_versions, seeds
from slamlab.evaluation.containment import outside
from slamlab.filters.set_membership.angle_intervals import FULL_CIRCLE
from slamlab.filters.set_membership.bor_filter import BOR
from slamlab.filters.set_membership.contraction import EmptyIntersection
from slamlab.filters.set_membership.half_planes import absolute_bearing
from slamlab.filters.set_membership.intervals import around
from slamlab.filters.set_membership.prediction import odometry, steered, wheels
from slamlab.geometry import compose, wrap
from slamlab.models.motion import f_steered
from slamlab.models.observation import h
from slamlab.parallel import map_runs
from slamlab.simulation.differential_drive import arc

BASE, PERIOD = 0.3, 1.0  # of wheels and axles [m], of a step [s]
STEPS = 200  # of a run
TABLE = TABLES / "box_containment.json"


@dataclass(frozen=True)
class BoundedNoise:
    """A robot among landmarks (``objects``) with bounded noise.

    Bounds, half-widths: ``moving`` ("odometry": length and turn [m, rad], "wheels": both wheels'
    paths [m], "steered": speed and steering angle [m/s, rad]), ``seeing`` of an observation [m,
    rad], ``start`` [m, rad]. Landmarks are within ``spread`` [m]; a step observes a ``share`` of
    them; noise is at the ends of its bounds (if ``at_ends``) or anywhere within them.
    """

    drive: str = "odometry"
    moving: tuple[float, float] = (0.01, 0.01)
    seeing: tuple[float, float] = (0.05, 0.03)
    start: tuple[float, float] = (0.0, 0.0)
    objects: int = 6
    spread: float = 3.0
    share: float = 0.4
    at_ends: bool = False


class BoundedRun:
    """A simulated run, which can be iterated once: each step yields the motion as three intervals
    and a list of (id, z (2,)). ``pose`` (3,) and ``objects`` (n, 2) are the truth."""

    def __init__(self, world, rng, steps=STEPS):
        self.world, self.rng, self.steps = world, rng, steps
        self.pose = np.array([*rng.uniform(-5, 5, 2), rng.uniform(-np.pi, np.pi)])
        self.objects = self.pose[:2] + rng.uniform(-1, 1, (world.objects, 2)) * world.spread
        place, turn = world.start
        self._middle = self.pose + self._noise(place, place, turn)

    def filter(self):
        """Return the initial BOR, which has the bounds of the start pose and no landmarks."""
        (x, y, heading), (place, turn) = self._middle.tolist(), self.world.start
        return BOR([*around(x, place), *around(y, place)], around(heading, turn))

    def __iter__(self):
        for _ in range(self.steps):
            yield self._move(), self._observe()

    def _move(self):
        world, rng = self.world, self.rng
        if world.drive == "steered":
            u = rng.uniform(-0.2, 0.4), rng.uniform(-0.6, 0.6)
            self.pose = f_steered(self.pose, u + self._noise(*world.moving), BASE, PERIOD)
            return steered(*map(around, u, world.moving), BASE, PERIOD)
        if world.drive == "wheels":
            u = rng.uniform(-0.2, 0.4, 2)
            self.pose = compose(self.pose, arc(*(u + self._noise(*world.moving)), BASE))
            return wheels(*map(around, u.tolist(), world.moving), BASE)
        u = np.array([rng.uniform(-0.2, 0.4), rng.uniform(-1, 1)])
        self.pose = compose(self.pose, _arc(*(u + self._noise(*world.moving))))
        return odometry(_arc(*u), *world.moving)

    def _observe(self):
        seen, n = [], len(self.objects)
        r_and_bearing = h(self.pose, self.objects) + self._noise(*self.world.seeing, rows=n)
        for i in np.flatnonzero(self.rng.random(n) < self.world.share).tolist():
            r, bearing = r_and_bearing[i].tolist()
            if r > 0:  # noise may make a short range negative
                seen.append((i, (r, wrap(bearing))))
        return seen

    def _noise(self, *bounds, rows=None):
        """Draw one sample (k,) or several samples (rows, k) within bounds (k,)."""
        shape = (len(bounds),) if rows is None else (rows, len(bounds))
        share = self.rng.uniform(-1, 1, shape)
        return (np.sign(share) if self.world.at_ends else share) * bounds


def random_world(rng):
    """Draw a random world with bounds from nearly zero to very large."""

    def some(low, high):
        return float(np.exp(rng.uniform(np.log(low), np.log(high)))) * float(rng.random() < 0.9)

    return BoundedNoise(
        drive=str(rng.choice(["odometry", "wheels", "steered"])),
        moving=(some(1e-4, 0.1), some(1e-4, 0.1)),
        seeing=(some(1e-4, 1), some(1e-4, 2)),
        start=(some(1e-4, 1), some(1e-4, 3)),
        objects=int(rng.integers(1, 9)),
        spread=some(0.01, 10),
        share=float(rng.uniform(0.1, 0.9)),
        at_ends=bool(rng.random() < 0.5),
    )


def violations(seed, world=None, steps=STEPS):
    """Count the events of one run: "steps", "observations", "wide" observations (half-width of the
    absolute bearing at least a right angle), "whole" (steps that end with an unknown heading),
    "outside", "empty" (empty intersections)."""
    rng = np.random.default_rng(seed)
    run = BoundedRun(world or random_world(rng), rng, steps)
    bor = run.filter()
    found = dict.fromkeys(("steps", "observations", "wide", "whole", "outside", "empty"), 0)
    for motion, seen in run:
        bor.predict(*motion)
        for i, z in seen:
            _, d_abs = absolute_bearing(bor.heading.tolist(), z, run.world.seeing)
            found["wide"] += d_abs >= np.pi / 2
            try:
                (bor.update if i in bor else bor.add)(i, z, run.world.seeing)
            except EmptyIntersection:
                found["empty"] += 1
        found["steps"] += 1
        found["observations"] += len(seen)
        found["whole"] += tuple(bor.heading.tolist()) == FULL_CIRCLE
        found["outside"] += bool(outside(bor, run.pose, run.objects))
    return {name: int(number) for name, number in found.items()}


def study(runs, world=None, jobs=None, scheduler=None):
    """Make the table of many runs: "versions", "seeds", "world", and the sums "counted"."""
    found = map_runs(partial(violations, world=world), seeds(runs, least=1), jobs, scheduler)
    return {
        "versions": package_versions(),
        "seeds": [0, runs - 1],
        "first_runs": first_runs(found),
        "world": asdict(world) if world else "of any kind",
        "counted": {name: sum(one[name] for one in found) for name in found[0]},
    }


def main(argv=None):
    return study_command.main("box_containment", 5000, study, argv)


def _arc(length, turn):
    return arc(length - turn / 2, length + turn / 2, 1.0)


if __name__ == "__main__":
    sys.exit(main())
