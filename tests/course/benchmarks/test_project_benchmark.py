"""Project benchmark: it measures a known standard deviation, and runs."""

import numpy as np
import pytest

from benchmarks import project
from classroom.project.world_parameters import WorldFamily

SMALL = {"small": WorldFamily("small", plans=(("crc", "rcr"),), metres=(20.0, 22.0))}


@pytest.mark.parametrize("sigma", [2.0, 20.0])
def test_the_deviation_between_seeds_is_that_of_fresh_seeds(sigma):
    rng = np.random.default_rng(0)
    hard = 10 * rng.standard_normal((7, 5))  # lengths and families differ, that is no spread
    points = 50 + hard + sigma * rng.standard_normal((2000, 7, 5))
    fresh = project.scores(points).std()
    found = [project.between_seeds(points[20 * k : 20 * k + 20], rng) for k in range(5)]
    np.testing.assert_allclose(np.mean(found), fresh, rtol=0.1)


@pytest.mark.slow
def test_its_quick_run_reports_score_and_deviation_of_each(monkeypatch):
    monkeypatch.setattr(project, "WORLD_FAMILIES", SMALL)
    monkeypatch.setattr(project, "WORLDS_PER_FAMILY", 1)
    rows = project.run(quick=True)
    who = ("odometry", "icp", "graph", "solution")
    assert [row["name"] for row in rows[::3]] == [f"{name}: score" for name in who]
    assert all(np.isfinite(row["value"]) for row in rows)
