"""Growth of the CPU time with landmarks, poses and scans, each doubled: rows and (unless quick) the
figure docs/growth.png.

Landmarks: a step of EKF-SLAM (prediction and four updates). Poses: the optimisation of a pose graph
on a grid of streets, from its rotation-first guess. Scans: graph SLAM on laps of one corridor.
"""

import sys
from dataclasses import replace
from pathlib import Path
from time import process_time

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator

from benchmarks import mak
from benchmarks.common import cpu_times, main, row
from slamlab import estimators, sources
from slamlab.geometry import between, compose
from slamlab.posegraph import PoseGraph
from slamlab.views.notebook_output import grouped, grouped_tick

TITLE = "Growth of the CPU time, one thread"
FIGURE = Path(__file__).resolve().parents[1] / "docs" / "growth.png"
LANDMARKS, POSES, LAPS = (125, 250, 500, 1000), (1250, 2500, 5000, 10_000), (1, 2, 4, 8)
STREET, NOISE = 5, (0.05, 0.05, 0.01)  # poses of a block's side; σ of an edge [m, m, rad]
FITTED = 3  # sizes, the largest, whose times give the exponent


def landmark_times(quick):
    """Measure the CPU time of a step of EKF-SLAM [s], by landmarks."""
    times = {}
    for N in LANDMARKS:
        filter_, ids, z = mak.scene(N)

        def step(filter_=filter_, ids=ids, z=z):
            filter_.predict(filter_.pose, mak.Q)
            filter_.update(ids, z, mak.R)

        times[N] = cpu_times({"step": step}, quick, 2.0)["step"]
    return times


def street_graph(count, rng):
    """Make a pose graph of a drive through streets on a grid, with loop closures at its places."""
    step, places, true = np.array([1.0, 0, 0]), {}, [np.zeros(3)]
    for k in range(1, count):
        turn = rng.choice([-1, 0, 1]) * np.pi / 2 if k % STREET == 0 else 0.0
        true.append(compose(true[-1], [*step[:2], turn]))
    graph, information = PoseGraph(), np.diag(1 / np.square(NOISE))
    for k, pose in enumerate(true):
        measured = between(true[k - 1], pose) + rng.normal(0, NOISE) if k else np.zeros(3)
        graph.add_pose(compose(graph.poses[-1], measured) if k else pose)
        if k:
            graph.add_edge(k - 1, k, measured, information)
        place = tuple(np.round(pose[:2]).astype(int))
        if place in places and k - places[place] > STREET:
            j = places[place]
            closed = between(true[j], pose) + rng.normal(0, NOISE)
            graph.add_edge(j, k, closed, information)
        places[place] = k
    graph.initialise()
    return graph


def pose_times(quick):
    """Measure the CPU time of the optimisation of a pose graph [s], by poses."""
    times = {}
    for count in POSES:
        graph = street_graph(count, np.random.default_rng(1))
        start = graph.poses.copy()

        def optimise(graph=graph, start=start):
            graph.poses = start
            assert graph.optimise().converged

        times[count] = cpu_times({"optimise": optimise}, quick, 2.0)["optimise"]
    return times


def scan_times(quick):
    """Measure the CPU time of graph SLAM [s], by scans."""
    source = sources.open("sim:corridor", np.random.default_rng(0))
    lap, true = list(source), source.truth.poses
    again = replace(lap[0], odometry=between(true[-1], true[0]))
    period, times = lap[-1].time - lap[0].time + 1, {}
    slam, spent, count = estimators.make("graph", source), 0.0, 0
    for number in range(LAPS[-1]):
        readings = [again, *lap[1:]] if number else lap
        begin = process_time()
        for reading in readings:
            slam.step(replace(reading, time=reading.time + number * period))
        spent, count = spent + process_time() - begin, count + len(lap)
        if number + 1 in LAPS:
            times[count] = spent
    return times


SERIES = {
    "landmarks: a step of EKF-SLAM": landmark_times,
    "poses: pose-graph optimisation": pose_times,
    "scans: graph SLAM, the whole run": scan_times,
}


def exponent(times):
    """Fit the growth exponent b of time = a nᵇ to the largest sizes."""
    sizes = list(times)[-FITTED:]
    return np.polyfit(np.log(sizes), np.log([times[n] for n in sizes]), 1)[0]


def rows_of(series):
    """Make rows of the times and exponents of {label: {size: seconds}}."""
    rows = []
    for label, times in series.items():
        unit = label.partition(":")[0]
        last = list(times)[-1]
        rows += [
            row(f"{label}: {n}", 1e3 * t, "ms", f"{last} {unit}", times[last] / t)
            for n, t in times.items()
        ]
        rows.append(row(f"{label}: exponent", exponent(times), "", "linear", 1 / exponent(times)))
    return rows


def draw(series, path):
    """Draw the times over the sizes, on logarithmic axes, with their exponents."""
    fig, axes = plt.subplots(1, len(series), figsize=(10, 3.4), layout="constrained")
    for ax, (label, times) in zip(axes, series.items(), strict=True):
        unit, _, what = label.partition(": ")
        sizes, ms = list(times), [1e3 * t for t in times.values()]
        ax.loglog(sizes, ms, "o-")
        ax.set_title(f"{what}\nexponent {exponent(times):.1f}", fontsize=10)
        ax.set_xlabel(unit)
        ax.set_xticks(sizes, list(map(grouped, sizes)))
        ax.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        ax.yaxis.set_major_formatter(grouped_tick)
        ax.minorticks_off()
        ax.grid(visible=True, alpha=0.3)
    axes[0].set_ylabel("CPU time [ms]")
    fig.savefig(path, dpi=110)
    plt.close(fig)


def run(quick):
    """Make rows of all series, and draw them into FIGURE."""
    series = {label: measure(quick) for label, measure in SERIES.items()}
    if not quick:
        draw(series, FIGURE)
    return rows_of(series)


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.growth"))
