"""False loops in a public graph neither bend the map nor let it be called ambiguous."""

import numpy as np
import pytest

from benchmarks import false_loops
from benchmarks.corrected_logs import aligned_error
from slamlab.files import SourceError


@pytest.mark.parametrize(
    ("name", "kind", "count", "seed"),
    [
        ("CSAIL", "local", 1000, 0),  # false loops that fit the drift
        ("CSAIL", "locally grouped", 500, 0),
        ("CSAIL", "random", 500, 0),
        ("intel", "random", 500, 2),  # a lone false loop that keeps out many true ones
    ],
)
def test_false_loops_do_not_bend_the_map(name, kind, count, seed):
    try:
        graph = false_loops.load(name)
    except SourceError as missing:
        pytest.skip(str(missing))
    rng = np.random.default_rng([list(false_loops.KINDS).index(kind), count, seed])
    corrupted = false_loops.with_false_loops(graph, kind, count, rng)
    poses, _, ambiguous = false_loops.slamlab_solution(corrupted)
    graph.optimise()
    assert aligned_error(poses, graph.poses) < false_loops.SOLVED
    assert not ambiguous
