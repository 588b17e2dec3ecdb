"""Set-membership filter (BOR): CPU time of an update by map size, memory, and tightness of the
boxes.

A step is one prediction and four observations of known landmarks, as in :mod:`benchmarks.mak`,
whose filter is timed in turn with BOR. "Association" means observations without ids. Widths are
those of one prediction, relative to the hull of a dense sample of all possible motions.
"""

import sys
import tracemalloc

import numpy as np

from benchmarks import mak as peer
from benchmarks.common import cpu_times, main, row, speed_rows
from slamlab.filters.set_membership import BOR
from slamlab.filters.set_membership.angle_intervals import angle_interval
from slamlab.filters.set_membership.intervals import around, width
from slamlab.filters.set_membership.prediction import odometry, predict_box, steered, wheels
from slamlab.models.observation import h
from slamlab.simulation.differential_drive import arc

TITLE = "BOR: predict + 4 observations, memory, width over the exact hull"
SIZES = (10, 100, 1000, 10_000)
MAK_TO = 1000  # largest map for which the MAK filter is timed, too
QUICK_MAK_TO = 100
BOUNDS = (0.05, 0.02)  # of range and bearing errors [m, rad]
STILL = odometry((0.0, 0.0, 0.0), 1e-4, 1e-4)
PREDICTIONS, SAMPLES = 200, 20_000
BASE = 0.3  # of wheels and axles [m]


def scene(N):
    """Make a test scene: a filter with N landmarks' boxes, four of their ids, and observations."""
    rng = np.random.default_rng(N)
    side = np.sqrt(N)  # one landmark per square metre
    objects = rng.uniform(-side / 2, side / 2, (N, 2))
    boxes = np.repeat(objects, 2, axis=1) + np.array([-0.05, 0.05, -0.05, 0.05])
    bor = BOR((-0.05, 0.05, -0.05, 0.05), (-0.03, 0.03), dict(enumerate(boxes)), N)
    ids = np.argsort(np.hypot(*objects.T))[:4].tolist()
    return bor, ids, h(np.zeros(3), objects[ids])


def times_of_size(N, quick):
    """Return {method: median CPU time} for a map of N landmarks [s]."""
    bor, ids, z = scene(N)
    observed = list(zip(ids, z.tolist(), strict=True))

    def step():
        bor.predict(*STILL)
        for i, seen in observed:
            bor.update(i, seen, BOUNDS)

    def associate():
        for _, seen in observed:
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
    """Measure the memory [bytes] of a map to which N landmarks are added one by one."""
    tracemalloc.start()
    bor = BOR(np.zeros(4), np.zeros(2))
    for i in range(N):
        bor.add(i, (1.0, 0.1), BOUNDS)
    size, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return size


def controls(drive, rng):
    """Draw a control input (2,) and its bounds (2,)."""
    low, high = ((0.1, 0.1), (0.4, 0.4)) if drive == "wheels" else ((0.1, -0.5), (0.4, 0.5))
    return rng.uniform(low, high), rng.uniform(0.005, 0.05, 2)


def bounds_of(drive, u, off):
    """Return the motion's intervals, the input of the filter."""
    if drive == "odometry":
        length, turn = u
        return odometry(arc(length - turn / 2, length + turn / 2, 1.0), *off)
    first, second = map(around, u, off)
    return steered(first, second, BASE, 1.0) if drive == "steered" else wheels(first, second, BASE)


def exact_motions(drive, u, heading):
    """Compute x, y and turn of many motions from the origin exactly."""
    if drive == "steered":
        V, gamma = u.T
        return V * np.cos(heading + gamma), V * np.sin(heading + gamma), V / BASE * np.sin(gamma)
    length, turn = u.T
    if drive == "wheels":
        length, turn = u.mean(axis=1), (u[:, 1] - u[:, 0]) / BASE
    chord, course = length * np.sinc(turn / 2 / np.pi), heading + turn / 2
    return chord * np.cos(course), chord * np.sin(course), turn


def widths(drive, seed=0):
    """Measure tightness: widths of predictions relative to the hull of many motions with bounded
    noise.

    Parameters
    ----------
    drive : str, "steered", "wheels" or "odometry"
    seed : int

    Returns
    -------
    (n, 2) of position and of turn
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
    """Make rows for times, their growth, memory and widths."""
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
    rows.append(row("memory per landmark, N = 10 000", each, "B", "N = 1000", few / each))
    for drive in ("steered", "wheels", "odometry"):
        place, turn = widths(drive).mean(axis=0)
        hull = "hull of sampled motions"
        rows.append(row(f"{drive}: width of x and y", place, "times", hull, 1 / place))
        rows.append(row(f"{drive}: width of the turn", turn, "times", hull, 1 / turn))
    return rows


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.bor"))
