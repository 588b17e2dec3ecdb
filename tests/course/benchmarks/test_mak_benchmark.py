"""MAK benchmark: the timed methods do the same work; times are not tested."""

import numpy as np
import pytest

from benchmarks import mak as benchmark


def test_the_textbooks_and_filterpys_first_steps_equal_ours():
    mak, ids, z = benchmark.scene(20)
    peers = {"a": benchmark.Textbook(mak, ids, z), "b": benchmark.Filterpy(mak, ids, z)}
    benchmark.same_first_step(mak, ids, z, peers)
    peers["a"].P[0, 0] *= 2
    with pytest.raises(AssertionError, match="a"):
        benchmark.same_first_step(*benchmark.scene(20), peers)


def test_the_compressed_filters_round_settles_what_the_full_one_would_hold(monkeypatch):
    monkeypatch.setattr(benchmark, "REGION", 6)
    monkeypatch.setattr(benchmark, "REGION_STEPS", 3)
    mak, _, _ = benchmark.scene(20)
    before = mak.P
    benchmark.compressed_round(mak)()
    assert np.linalg.det(mak.P[3:, 3:]) < np.linalg.det(before[3:, 3:])


def test_growth_is_the_exponent_of_the_times():
    times = {N: {"m": 1e-9 * N**2} for N in benchmark.SIZES}
    assert np.isclose(benchmark.exponent(times, "m"), 2)
