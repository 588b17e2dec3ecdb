"""BOR filter: CPU time of an update as the map grows, memory, tightness of its boxes.

A step is one prediction and four sightings of known objects, as in :mod:`benchmarks.mak`, whose
filter takes turns with it. Association means that nobody says who was seen. Widths are of one
prediction, against the hull of a dense sample of everything that may have happened.
"""

import sys
import tracemalloc

import numpy as np

from benchmarks import mak as peer
from benchmarks.common import cpu_times, main, row, speed_rows
from slamlab.filters.bor import BOR
from slamlab.filters.bor.angle_intervals import angle_interval
from slamlab.filters.bor.intervals import around, width
from slamlab.filters.bor.prediction import odometry, predict_box, steered, wheels
from slamlab.models.observation import h
from slamlab.simulation.differential_drive import arc

TITLE = "BOR: predict + 4 sightings, memory, width over the exact hull"
SIZES = (10, 100, 1000, 10_000)
MAK_TO = 1000  # landmarks up to which the MAK filter takes its turns
QUICK_MAK_TO = 100
BOUNDS = (0.05, 0.02)  # of range and bearing errors [m, rad]
STILL = odometry((0.0, 0.0, 0.0), 1e-4, 1e-4)
PREDICTIONS, SAMPLES = 200, 20_000
BASE = 0.3  # of wheels and axles [m]


def scene(N):
    """Test scene: a filter that knows N objects' boxes, four of their ids, and how they look."""
    rng = np.random.default_rng(N)
    side = np.sqrt(N)  # one object a square metre, however many there are
    objects = rng.uniform(-side / 2, side / 2, (N, 2))
    boxes = np.repeat(objects, 2, axis=1) + np.array([-0.05, 0.05, -0.05, 0.05])
    bor = BOR((-0.05, 0.05, -0.05, 0.05), (-0.03, 0.03), dict(enumerate(boxes)), N)
    ids = np.argsort(np.hypot(*objects.T))[:4].tolist()
    return bor, ids, h(np.zeros(3), objects[ids])


def times_of_size(N, quick):
    """{method: median CPU time} of a map of N objects [s]."""
    bor, ids, z = scene(N)
    sights = list(zip(ids, z.tolist(), strict=True))

    def step():
        bor.predict(*STILL)
        for i, seen in sights:
            bor.update(i, seen, BOUNDS)

    def associate():
        for _, seen in sights:
            bor.overlapping(seen, BOUNDS)

    methods = {"slamlab": step, "slamlab, association of 4": associate}
    if (QUICK_MAK_TO if quick else MAK_TO) >= N:
        mak, ids, z = peer.scene(N)

        def mak_step():
            mak.predict(mak.pose, peer.Q)
            mak.update(ids, z, peer.R)

        methods["MAK filter"] = mak_step
    return cpu_times(methods, quick, 3.0)


def memory(N):
    """Bytes that a map of N objects takes, objects added one by one."""
    tracemalloc.start()
    bor = BOR(np.zeros(4), np.zeros(2))
    for i in range(N):
        bor.add(i, (1.0, 0.1), BOUNDS)
    size, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return size


def controls(drive, rng):
    """What a drive was told, (2,), and by how much it may be off, (2,)."""
    low, high = ((0.1, 0.1), (0.4, 0.4)) if drive == "wheels" else ((0.1, -0.5), (0.4, 0.5))
    return rng.uniform(low, high), rng.uniform(0.005, 0.05, 2)


def bounds_of(drive, u, off):
    """The motion's intervals, as the filter is given them."""
    if drive == "odometry":
        length, turn = u
        return odometry(arc(length - turn / 2, length + turn / 2, 1.0), *off)
    first, second = map(around, u, off)
    return steered(first, second, BASE, 1.0) if drive == "steered" else wheels(first, second, BASE)


def exact_motions(drive, u, heading):
    """x, y and turn of many drives from the origin, each exact."""
    if drive == "steered":
        V, gamma = u.T
        return V * np.cos(heading + gamma), V * np.sin(heading + gamma), V / BASE * np.sin(gamma)
    length, turn = u.T
    if drive == "wheels":
        length, turn = u.mean(axis=1), (u[:, 1] - u[:, 0]) / BASE
    chord, course = length * np.sinc(turn / 2 / np.pi), heading + turn / 2
    return chord * np.cos(course), chord * np.sin(course), turn


def widths(drive, seed=0):
    """Tightness: width of predictions over the hull of many drives, noise anywhere and at its ends.

    Parameters
    ----------
    drive : str, "steered", "wheels" or "odometry"
    seed : int

    Returns
    -------
    (n, 2) of place and of turn
    """
    rng, ratios = np.random.default_rng(seed), []
    for _ in range(PREDICTIONS):
        u, off = controls(drive, rng)
        heading = angle_interval(*around(rng.uniform(-3, 3), rng.uniform(0.01, 0.3)))
        noise = np.clip(rng.uniform(-1.3, 1.3, (SAMPLES, 3)), -1, 1)
        headings = np.mean(heading) + noise[:, 2] * width(heading) / 2
        x, y, turn = exact_motions(drive, u + noise[:, :2] * off, headings)
        motion = bounds_of(drive, u, off)
        box, _ = predict_box((0.0, 0.0, 0.0, 0.0), heading, *motion)
        place = (width(box[:2]) + width(box[2:])) / (np.ptp(x) + np.ptp(y))
        ratios.append([place, width(motion[2]) / np.ptp(turn)])
    return np.array(ratios)


def run(quick):
    """Rows of times, of their growth, of memory and of widths."""
    times = {N: times_of_size(N, quick) for N in SIZES}
    rows = []
    for N, found in times.items():
        rows += speed_rows(f"N = {N}", found, [("slamlab", "MAK filter")])
    for method in ("slamlab", "slamlab, association of 4"):
        for N in SIZES[1:]:
            growth = times[N][method] / times[SIZES[0]][method]
            rows.append(
                row(f"{method}: N = {N} over N = 10", growth, "times", "constant", 1 / growth)
            )
    each, few = memory(10_000) / 10_000, memory(1000) / 1000
    rows.append(row("memory per object, N = 10 000", each, "B", "N = 1000", few / each))
    for drive in ("steered", "wheels", "odometry"):
        place, turn = widths(drive).mean(axis=0)
        rows.append(row(f"{drive}: width of x and y", place, "times", "hull of samples", 1 / place))
        rows.append(row(f"{drive}: width of the turn", turn, "times", "hull of samples", 1 / turn))
    return rows


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.bor"))
