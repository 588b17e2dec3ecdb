"""Public pose graphs, read and optimised, compared with GTSAM.

Both optimise by Levenberg-Marquardt from the poses that the file or, without vertices, the edges
give. GTSAM reads uncompressed files only, so both read such copies.
"""

import sys
import tempfile
import warnings
from pathlib import Path

from benchmarks.common import Missing, cpu_times, main, row, speed_rows
from slamlab import sources
from slamlab.files import SourceError, read_bytes
from slamlab.posegraph import g2o
from slamlab.posegraph.g2o_parser import read_rows
from slamlab.posegraph.graph_builder import Assembly

TITLE = "Public pose graphs: reading and optimising (CPU time, methods taking turns)"
GRAPHS = ("intel", "CSAIL", "manhattan", "kitti_00", "city10000")
OPTIMA = "slamlab", "GTSAM"


def run(quick):
    """Make rows for all graphs at hand."""
    try:
        import gtsam
    except ImportError:
        raise Missing("GTSAM is not installed: python -m pip install gtsam") from None
    rows = []
    with tempfile.TemporaryDirectory() as place, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name in GRAPHS:
            try:
                packed = sources.recording(f"{name}.g2o")
            except SourceError as missing:
                print(f"skipped: {missing}", file=sys.stderr)
                continue
            path = Path(place, f"{name}.g2o")
            path.write_bytes(read_bytes(packed)[0])
            rows += graph_rows(gtsam, name, path, quick)
    if not rows:
        raise Missing("no public pose graph is on this computer")
    return rows


def graph_rows(gtsam, name, path, quick):
    """Make rows for a graph: χ² of the optima, CPU times of reading and of optimising."""
    graph = g2o.load(path)
    start, (theirs, chi2) = graph.poses.copy(), gtsam_optimiser(gtsam, graph)

    def ours():
        graph.poses = start
        return graph.optimise().chi2

    costs = [ours(), chi2(theirs())]
    rows = [
        row(f"{name}: χ², {who}", cost, "", "GTSAM", costs[1] / cost)
        for who, cost in zip(OPTIMA, costs, strict=True)
    ]
    reading = {
        "GTSAM": lambda: gtsam.readG2o(str(path), False),
        "slamlab": lambda: Assembly(path, read_rows(path)[0]),
        "slamlab, with initial poses": lambda: g2o.load(path),
    }
    optimising = {"GTSAM": theirs, "slamlab": ours}
    rows += speed_rows(f"{name}: reading", cpu_times(reading, quick, 3.0))
    return rows + speed_rows(f"{name}: optimising", cpu_times(optimising, quick, 3.0))


def gtsam_factors(gtsam, graph):
    """Return the factors of a graph of poses, its edges first, and its poses, for GTSAM."""
    factors, guesses = gtsam.NonlinearFactorGraph(), gtsam.Values()
    for edge in graph.edges:
        noise = gtsam.noiseModel.Gaussian.Information(edge.information)
        motion = gtsam.Pose2(*edge.measured)
        factors.add(gtsam.BetweenFactorPose2(edge.i, edge.j, motion, noise))
    tight = gtsam.noiseModel.Isotropic.Sigma(3, 1e-6)
    for i in graph.fixed:
        factors.add(gtsam.PriorFactorPose2(i, gtsam.Pose2(*graph.poses[i]), tight))
    for i, pose in enumerate(graph.poses):
        guesses.insert(i, gtsam.Pose2(*pose))
    return factors, guesses


def gtsam_optimiser(gtsam, graph):
    """Return a function that optimises a graph of poses by GTSAM, and one that returns the χ²."""
    factors, guesses = gtsam_factors(gtsam, graph)
    settings = gtsam.LevenbergMarquardtParams()
    settings.setMaxIterations(100)

    def optimise():
        return gtsam.LevenbergMarquardtOptimizer(factors, guesses, settings).optimize()

    return optimise, lambda values: 2 * factors.error(values)


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.pose_graphs"))
