"""Running an estimator over a source."""

import numpy as np

from slamlab import estimators, sources
from slamlab.estimators.runner import run


def test_a_run_keeps_the_naive_trajectory_beside_the_estimate():
    source = sources.open("sim:polygon-wrong", np.random.default_rng(1))
    seen = []
    result = run(source, estimators.make("icp", source), lambda r, e: seen.append((r.time, e.pose)))
    reckoned = run(source, estimators.make("odometry", source))
    assert np.array_equal(result.naive.poses, reckoned.trajectory.poses)
    assert np.allclose([pose for _, pose in seen], result.trajectory.poses)
    assert [time for time, _ in seen] == result.naive.times.tolist()
    assert (result.frames, result.skipped) == (4, 0)


def test_skipped_adds_up_what_the_source_lost_and_what_the_estimator_could_not_use(tmp_path):
    good = "FLASER 4 1 1.5 2 1 0 0 0 0 0 0 {}.5 h 1"
    poor = "FLASER 4 99 99 99 1 0 0 0 0 0 0 {}.5 h 1"
    lines = [good.format(1), "FLASER x", poor.format(2), good.format(3)]
    (tmp_path / "log").write_text("\n".join(lines))
    source = sources.open(tmp_path / "log")
    result = run(source, estimators.make("icp", source))
    assert (result.frames, result.skipped) == (3, 2)
