"""Public pose graphs with false loops, optimised by slamlab and by GTSAM's GncLMOptimizer.

The false loops are of the kinds of Vertigo (Sünderhauf and Protzel 2012): each claims that two
poses are at nearly the same place. The poses are drawn at random or, if *local*, not far apart in
time; *grouped* loops come in runs of ten that agree. Odometry is trusted by both methods.

A set is solved if the positions are within 0.1 m (rms) of the optimum of the graph without false
loops, or within twice the distance of the method's own result for that graph.
"""

import statistics
import sys
import time
import warnings
from importlib.util import find_spec

import numpy as np

from benchmarks.common import Missing, main, row
from benchmarks.corrected_logs import aligned_error
from benchmarks.pose_graphs import gtsam_factors
from slamlab import sources
from slamlab.files import SourceError
from slamlab.posegraph import g2o
from slamlab.posegraph.pose_graph import Edge, PoseGraph

TITLE = "Public pose graphs with false loops (CPU time, methods taking turns)"
COUNTS = 10, 100, 500, 1000  # of false loops
# counts and seeds for each kind; fewer where a set takes up to two minutes
GRAPHS = {
    "CSAIL": (COUNTS, 3),
    "intel": (COUNTS, 1),
    "manhattan": (COUNTS[:2], 1),
    "kitti_00": (COUNTS, 1),
    "city10000": (COUNTS[1:2], 1),
}
KINDS = {  # distance of the poses in time, at most, and loops in a group
    "random": (None, 1),
    "local": (20, 1),
    "grouped": (None, 10),
    "locally grouped": (20, 10),
}
NOISE = 0.3, 0.3, np.radians(10)  # σ of a false loop's relative pose [m, m, rad]
SOLVED = 0.1  # largest error of a solved set [m, rms]
LEAST_WARNED, MOST_WARNED = 90, 2  # wanted shares of unsolved and solved sets called ambiguous [%]
OURS, THEIRS = "slamlab", "GTSAM's GNC"


def with_false_loops(graph, kind, count, rng):
    """Return a copy of a PoseGraph with ``count`` false loops of a kind, drawn by a Generator."""
    reach, size = KINDS[kind]
    loops, last = [edge for edge in graph.edges if edge.robust], len(graph) - size
    edges = list(graph.edges)
    for _ in range(count // size):
        i = int(rng.integers(last - 2))
        j = int(rng.integers(i + 2, last if reach is None else min(last, i + reach + 1)))
        measured = rng.normal(0, NOISE)
        information = loops[rng.integers(len(loops))].information
        edges += [Edge(i + k, j + k, measured, information, True) for k in range(size)]
    return copied(graph, edges)


def copied(graph, edges):
    """Return a PoseGraph with the poses of another one and these edges."""
    copy = PoseGraph(graph.poses)
    copy.fixed, copy.edges = set(graph.fixed), edges
    return copy


def slamlab_solution(graph):
    """Optimise a PoseGraph by slamlab; return poses (n, 3), CPU time [s], whether ambiguous."""
    graph = copied(graph, graph.edges)
    begin = time.process_time()
    found = graph.optimise()
    return graph.poses, time.process_time() - begin, found.ambiguous


def gtsam_solution(graph):
    """Optimise a PoseGraph by GTSAM's graduated non-convexity; return as ``slamlab_solution``."""
    import gtsam

    factors, guesses = gtsam_factors(gtsam, graph)
    settings = gtsam.GncLMParams(gtsam.LevenbergMarquardtParams())
    trusted = [k for k, edge in enumerate(graph.edges) if not edge.robust]
    priors = range(len(graph.edges), factors.size())
    settings.setKnownInliers([*trusted, *priors])
    begin = time.process_time()
    found = gtsam.GncLMOptimizer(factors, guesses, settings).optimize()
    spent = time.process_time() - begin
    poses = [found.atPose2(i) for i in range(len(graph))]
    return np.array([(pose.x(), pose.y(), pose.theta()) for pose in poses]), spent, False


def results(graph, methods, kinds, counts, seeds):
    """Yield a dict for each set and method: kind, count, seed, method, error, solved, cpu,
    ambiguous."""
    clean = copied(graph, [edge._replace(robust=False) for edge in graph.edges])
    clean.initialise()
    clean.optimise()
    allowed = {}
    for method, solution in methods.items():
        allowed[method] = max(SOLVED, 2 * aligned_error(solution(graph)[0], clean.poses))
    for kind in kinds:
        for count in counts:
            for seed in range(seeds):
                rng = np.random.default_rng([list(KINDS).index(kind), count, seed])
                corrupted = with_false_loops(graph, kind, count, rng)
                for method, solution in methods.items():
                    poses, cpu, ambiguous = solution(corrupted)
                    error = aligned_error(poses, clean.poses)
                    found = dict(error=error, solved=error <= allowed[method], cpu=cpu)
                    yield (
                        dict(kind=kind, count=count, seed=seed, method=method, ambiguous=ambiguous)
                        | found
                    )


def kind_rows(label, found):
    """Make the rows of a graph and kind: solved sets and CPU times of each method, compared with
    the last one, and the shares of our sets that are called ambiguous."""
    by_method = {}
    for one in found:
        by_method.setdefault(one["method"], []).append(one)
    solved = {m: share([one["solved"] for one in some]) for m, some in by_method.items()}
    cpu = {m: 1e3 * statistics.median(one["cpu"] for one in some) for m, some in by_method.items()}
    last, rows = list(by_method)[-1], []
    for m in by_method:
        rows.append(
            row(f"{label}: solved: {m}", solved[m], "%", last, over(solved[m], solved[last]))
        )
    for m in by_method:
        rows.append(row(f"{label}: {m}", cpu[m], "ms", last, over(cpu[last], cpu[m])))
    for name, aim, wanted in (("unsolved", LEAST_WARNED, False), ("solved", MOST_WARNED, True)):
        flags = [one["ambiguous"] for one in by_method[OURS] if one["solved"] == wanted]
        if flags:
            value = share(flags)
            ratio = over(aim, value) if wanted else over(value, aim)
            rows.append(row(f"{label}: ambiguous of the {name}", value, "%", f"{aim} %", ratio))
    return rows


def share(flags):
    """Return the share of true flags [%]."""
    return 100 * float(np.mean(flags))


def over(a, b):
    """Return a / b; 1 for 0 / 0."""
    return 1.0 if a == b else a / b if b else np.inf


def methods():
    """Return {name: function}: ours and, if GTSAM is installed, theirs."""
    if find_spec("gtsam") is None:
        print("GTSAM is not installed (python -m pip install gtsam)", file=sys.stderr)
        return {OURS: slamlab_solution}
    return {OURS: slamlab_solution, THEIRS: gtsam_solution}


def load(name):
    """Load a public graph with robust loops. Raises SourceError if it is not on this computer."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        graph = g2o.load(sources.recording(f"{name}.g2o"), robust_loops=True)
    odometry = copied(graph, [edge for edge in graph.edges if not edge.robust])
    odometry.optimise()
    graph.poses = odometry.poses
    return graph


def run(quick):
    """Make rows for all graphs at hand and all kinds."""
    rows, compared = [], methods()
    sets = {name: (COUNTS[:1], 1) for name in list(GRAPHS)[:1]} if quick else GRAPHS
    for name, (counts, seeds) in sets.items():
        try:
            graph = load(name)
        except SourceError as missing:
            print(f"skipped: {missing}", file=sys.stderr)
            continue
        for kind in KINDS:
            found = list(results(graph, compared, [kind], counts, seeds))
            label = f"{name}, {kind} false loops (sets: {len(counts) * seeds})"
            rows += kind_rows(label, found)
    if not rows:
        raise Missing("no public pose graph is on this computer")
    return rows


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.false_loops"))
