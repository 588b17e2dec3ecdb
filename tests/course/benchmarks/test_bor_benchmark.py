"""BOR benchmark: it times the stated work, and its widths are not below the hull."""

import numpy as np
import pytest

from benchmarks import bor as benchmark


def test_every_landmark_of_the_scene_is_observed_at_its_position_and_associated_alone():
    for N in (10, 1000):
        bor, ids, z = benchmark.scene(N)
        assert len(bor) == N
        for i, seen in zip(ids, z, strict=True):
            assert i in bor.overlapping(seen, benchmark.BOUNDS)
            bor.update(i, seen, benchmark.BOUNDS)


@pytest.mark.parametrize("drive", ["steered", "wheels", "odometry"])
def test_no_prediction_is_narrower_than_the_hull_of_sampled_motions(drive, monkeypatch):
    monkeypatch.setattr(benchmark, "PREDICTIONS", 20)
    monkeypatch.setattr(benchmark, "SAMPLES", 2000)
    ratios = benchmark.widths(drive)
    assert ratios.shape == (20, 2)
    assert (ratios > 1 - 1e-9).all()
    if drive == "steered":
        np.testing.assert_allclose(ratios, 1, atol=0.02)


def test_memory_grows_linearly_with_the_number_of_landmarks():
    assert benchmark.memory(2000) < 2.5 * benchmark.memory(1000)
