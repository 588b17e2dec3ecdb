"""Monte Carlo benchmark: the timed methods do the same work; times are not tested."""

import numpy as np
import pytest

from benchmarks import montecarlo as benchmark
from slamlab.filters.particle_filters.resampling import systematic_at


def test_the_loops_weights_are_ours(monkeypatch):
    x, p, z = benchmark.scene(200)
    benchmark.same_weights(x, p, z)
    plain = benchmark.loop_weights
    monkeypatch.setattr(benchmark, "loop_weights", lambda *scene: [w / 2 for w in plain(*scene)])
    with pytest.raises(AssertionError):
        benchmark.same_weights(x, p, z)


def test_the_plain_loops_systematic_resampling_is_the_librarys():
    weights = np.random.default_rng(0).exponential(size=50)
    drawn = benchmark.loop_resample(list(range(50)), weights.tolist(), 0.37)
    assert drawn == systematic_at(weights / weights.sum(), 50, 0.37).tolist()


def test_every_method_moves_to_the_pose_that_the_map_implies():
    x, p, z = benchmark.scene(2000)
    ends = [
        step(x, p, z, np.random.default_rng(1)).mean(axis=0)
        for step in (benchmark.slamlab_step, benchmark.textbook_step, benchmark.loop_step)
    ]
    np.testing.assert_allclose(ends[1], ends[0], atol=0.05)
    np.testing.assert_allclose(ends[2], ends[0], atol=0.05)
