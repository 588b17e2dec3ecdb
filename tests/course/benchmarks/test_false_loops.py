"""False loops in a public graph neither bend the map nor let it be called ambiguous."""

import numpy as np
import pytest

from benchmarks import false_loops
from benchmarks.corrected_logs import aligned_error
from slamlab.files import SourceError


@pytest.mark.parametrize(
    ("kind", "count"), [("local", 1000), ("locally grouped", 500), ("random", 500)]
)
def test_false_loops_do_not_bend_the_map(kind, count):
    try:
        graph = false_loops.load("CSAIL")
    except SourceError as missing:
        pytest.skip(str(missing))
    rng = np.random.default_rng([list(false_loops.KINDS).index(kind), count, 0])
    corrupted = false_loops.with_false_loops(graph, kind, count, rng)
    poses, _, ambiguous = false_loops.slamlab_solution(corrupted)
    graph.optimise()
    assert aligned_error(poses, graph.poses) < false_loops.SOLVED
    assert not ambiguous
