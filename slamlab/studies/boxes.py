"""``python -m slamlab.studies.boxes``: Monte Carlo study of BOR's guarantee under bounded noise.

Is the truth ever outside its box? Worlds of every kind are drawn: three ways to drive, noise that
fills its bounds or sits at their ends, bearings that say nothing, objects in one heap. Who is seen
is known. Written as JSON: command, seeds, versions, and what was counted.
"""

import sys
from dataclasses import asdict, dataclass
from functools import partial

import numpy as np

from slamlab.filters.bor.angle_intervals import FULL_CIRCLE, contains
from slamlab.filters.bor.bor import BOR
from slamlab.filters.bor.contraction import EmptyIntersection
from slamlab.filters.bor.half_planes import absolute_bearing
from slamlab.filters.bor.intervals import around
from slamlab.filters.bor.prediction import odometry, steered, wheels
from slamlab.geometry import compose, wrap
from slamlab.models.motion import f_steered
from slamlab.models.observation import h
from slamlab.parallel import map_runs
from slamlab.simulation.differential_drive import arc
from slamlab.studies import study_command
from slamlab.studies.study_command import TABLES, package_versions, seeds

BASE, PERIOD = 0.3, 1.0  # of wheels and axles [m], of a step [s]
STEPS = 200  # of a run
TABLE = TABLES / "boxes.json"


@dataclass(frozen=True)
class BoundedNoise:
    """Scenario parameters: a robot among objects, all of whose noise is bounded.

    Parameters
    ----------
    drive : str, "odometry", "wheels" or "steered"
    moving : (2,) most that the controls are off: length and turn [m, rad], the ways of two wheels
        [m], speed and steering angle [m/s, rad]
    seeing : (2,) most that range and bearing are off [m, rad]
    start : (2,) half-widths of the start's box and of its heading [m, rad]
    objects : int
    spread : float, objects stand within this of the start in x and in y [m]
    share : float, of the objects seen in a step [1]
    at_ends : bool, every noise is at an end of its bounds, else anywhere inside
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
    """One simulated run with bounded noise; iterate it once.

    Parameters
    ----------
    world : BoundedNoise
    rng : numpy.random.Generator
    steps : int

    ``pose`` (3,) and ``objects`` (n, 2) are the truth, ``pose`` as of the last step. Each step
    yields the motion as three intervals, and what was seen: a list of id and z (2,).
    """

    def __init__(self, world, rng, steps=STEPS):
        self.world, self.rng, self.steps = world, rng, steps
        self.pose = np.array([*rng.uniform(-5, 5, 2), rng.uniform(-np.pi, np.pi)])
        self.objects = self.pose[:2] + rng.uniform(-1, 1, (world.objects, 2)) * world.spread
        place, turn = world.start
        self._middle = self.pose + self._noise(place, place, turn)

    def filter(self):
        """The initial BOR filter: it knows the start's bounds and no object."""
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
            if r > 0:  # noise may push a near object behind the sensor
                seen.append((i, (r, wrap(bearing))))
        return seen

    def _noise(self, *bounds, rows=None):
        """Bounded noise: within bounds (k,), one sample (k,) or many (rows, k)."""
        shape = (len(bounds),) if rows is None else (rows, len(bounds))
        share = self.rng.uniform(-1, 1, shape)
        return (np.sign(share) if self.world.at_ends else share) * bounds


def random_world(rng):
    """Random scenario parameters, bounds from next to nothing to far too much.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    BoundedNoise
    """

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


def inside(box, point):
    """Containment: whether a point (2,) lies in a box (x_min, x_max, y_min, y_max)."""
    return box[0] <= point[0] <= box[1] and box[2] <= point[1] <= box[3]


def outside(bor, pose, objects):
    """Violations of the guarantee: what of the truth lies outside of its box.

    Parameters
    ----------
    bor : BOR
    pose : (3,) the true pose [m, m, rad]
    objects : (n, 2) the true objects, their ids being the rows [m]

    Returns
    -------
    list of "robot", "heading" and ids
    """
    found = [] if inside(bor.robot.tolist(), pose) else ["robot"]
    found += [] if contains(bor.heading.tolist(), pose[2]) else ["heading"]
    boxes = zip(bor.ids, bor.boxes().tolist(), strict=True)
    return found + [i for i, box in boxes if not inside(box, objects[i])]


def violations(seed, world=None, steps=STEPS):
    """Run the filter once and count violations: how often the truth was outside its box.

    Parameters
    ----------
    seed : int
    world : BoundedNoise, any kind when None
    steps : int

    Returns
    -------
    {"steps", "sightings", "wide", "whole", "outside", "empty"} : int; wide are sightings of an
    absolute bearing off by a right angle or more, whole are steps that end with any heading
    """
    rng = np.random.default_rng(seed)
    run = BoundedRun(world or random_world(rng), rng, steps)
    bor = run.filter()
    found = dict.fromkeys(("steps", "sightings", "wide", "whole", "outside", "empty"), 0)
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
        found["sightings"] += len(seen)
        found["whole"] += tuple(bor.heading.tolist()) == FULL_CIRCLE
        found["outside"] += bool(outside(bor, run.pose, run.objects))
    return {name: int(number) for name, number in found.items()}


def study(runs, world=None, jobs=None, scheduler=None):
    """Many runs, their violations counted together.

    Parameters
    ----------
    runs : int
    world : BoundedNoise, any kind when None
    jobs, scheduler : as of :func:`slamlab.parallel.map_runs`

    Returns
    -------
    dict : "versions", "seeds", "world", "counted"
    """
    found = map_runs(partial(violations, world=world), seeds(runs, least=1), jobs, scheduler)
    return {
        "versions": package_versions(),
        "seeds": [0, runs - 1],
        "world": asdict(world) if world else "of any kind",
        "counted": {name: sum(one[name] for one in found) for name in found[0]},
    }


def main(argv=None):
    """The command: run the study, write its table; exit code 0, or 2 on an error."""
    return study_command.main("boxes", 5000, study, argv)


def _arc(length, turn):
    return arc(length - turn / 2, length + turn / 2, 1.0)


# names in the first edition
Bounded, counted = BoundedNoise, violations


if __name__ == "__main__":
    sys.exit(main())
