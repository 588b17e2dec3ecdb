"""The published scale as laws: monotone in the error, continuous, the same in every frame."""

import dataclasses
from functools import cache

import numpy as np
import pytest

from classroom.project import estimate_errors, point_scale
from classroom.project.baselines import BASELINES
from classroom.project.estimator_runs import Budget, run_estimator
from classroom.project.scores import by_family, judge, prepare, score
from classroom.project.world_generation import generate_world, generate_worlds
from classroom.project.world_parameters import LANDMARKS, WorldFamily
from course.project.template import MySlam
from slamlab.geometry import compose, transform

SMALL = WorldFamily("small", plans=(("crc", "rcr"),))
START = np.array([2.0, -1.0, 0.7])


@cache
def prepared_world():
    """A small world with its marks, the same for all tests."""
    return prepare(generate_world(SMALL, np.random.default_rng(5), 25.0))


def truth():
    """The true poses there."""
    return prepared_world().world.truth.poses


def estimate(noise, seed=0):
    """A drive whose poses are the truth but for errors that grow, and whose map is perfect."""
    rng = np.random.default_rng(seed)
    steps = rng.standard_normal((len(truth()), 3)) * noise * np.array([0.02, 0.02, 0.01])
    poses = truth() + np.cumsum(steps, axis=0)
    odometry = prepared_world().runs["odometry"]
    return dataclasses.replace(
        odometry, online=poses, trajectory=poses, points=prepared_world().walls[0]
    )


def moved(run, frame):
    """The same drive in another frame."""
    return dataclasses.replace(
        run,
        online=compose(frame, run.online),
        trajectory=compose(frame, run.trajectory),
        points=transform(frame, run.points),
    )


def points_of(run):
    return prepared_world().judge(run).points


def test_odometry_scores_0_the_baselines_are_the_marks_and_the_truth_scores_100():
    assert set(BASELINES) == {"odometry", "icp", "graph"}
    assert all(not run.mistakes for run in prepared_world().runs.values())
    odometry, icp, graph = (points_of(prepared_world().runs[name]) for name in BASELINES)
    assert odometry == points_of(run_estimator(MySlam, prepared_world().world)) == 0
    assert 40 < icp < 65
    assert 75 < graph < 90
    assert points_of(estimate(0.0)) > 99


def test_points_fall_as_errors_grow():
    measured = [points_of(estimate(noise)) for noise in (0, 0.1, 0.3, 1, 3, 10, 30)]
    assert measured == sorted(measured, reverse=True)
    assert len(set(measured)) > 4


@pytest.mark.parametrize("gain", np.linspace(-1, 4, 11))
def test_points_are_continuous_and_monotone_in_each_measure(gain):
    base = point_scale.Metrics(gain, np.zeros(3), 0.4, 0.9, np.nan)
    for name in ("gain", "map", "completeness"):
        more = dataclasses.replace(base, **{name: getattr(base, name) + 1e-4})
        low, high = (point_scale.points_of(m, prepared_world().scale) for m in (base, more))
        assert 0 <= high - low < 0.1


@pytest.mark.parametrize("nees", np.geomspace(1e-6, 1e6, 25))
def test_the_penalty_of_a_covariance_grows_continuously_with_its_error(nees):
    low, high = point_scale.NEES_BAND
    costs = [point_scale.inconsistency_penalty(nees * factor) for factor in (1, 1.001)]
    assert abs(costs[1] - costs[0]) < 0.01
    assert (costs[0] == 0) == (low <= nees <= high)
    assert costs[0] <= point_scale.MAX_PENALTY
    outwards = nees * (1.1 if nees > 3 else 1 / 1.1)
    assert point_scale.inconsistency_penalty(outwards) >= costs[0]
    assert point_scale.inconsistency_penalty(np.nan) == 0  # without a covariance


@pytest.mark.parametrize("noise", [0.0, 0.3, 3.0])
def test_points_do_not_depend_on_the_estimators_frame(noise):
    run = estimate(noise)
    assert points_of(moved(run, START)) == pytest.approx(points_of(run), abs=0.5)


def test_errors_do_not_depend_on_the_frame_of_the_world():
    run, metres = estimate(1.0), prepared_world().world.metres
    for length in estimate_errors.LENGTHS:
        errors = [
            estimate_errors.relative_errors(run.trajectory, true, metres, length)
            for true in (truth(), compose(START, truth()))
        ]
        np.testing.assert_allclose(*errors, atol=1e-9)
    motion = estimate_errors.aligned(run.trajectory, compose(START, truth()))
    there = transform(motion, run.points)
    here = transform(estimate_errors.aligned(run.trajectory, truth()), run.points)
    np.testing.assert_allclose(there, transform(START, here), atol=1e-9)


def test_relative_errors_are_known_for_a_scale_that_is_wrong():
    true = np.column_stack([np.arange(30.0), np.zeros(30), np.zeros(30)])
    errors = estimate_errors.relative_errors(true * [1.1, 1, 1], true, true[:, 0], 5.0)
    np.testing.assert_allclose(errors, 0.5)
    assert len(errors) == 25


def test_missing_poses_cost_their_share_and_leaving_out_the_hard_ones_gains_nothing():
    run, metres = estimate(0.3), prepared_world().world.metres
    errors = estimate_errors.relative_errors(run.trajectory, truth(), metres, 5.0)
    hard = estimate_errors.pairs(metres, 5.0)[0][np.argsort(errors)[-8:]]
    trajectory = run.trajectory.copy()
    trajectory[hard] = np.nan
    assert points_of(dataclasses.replace(run, trajectory=trajectory)) < points_of(run)
    nothing = np.full_like(trajectory, np.nan)
    assert points_of(dataclasses.replace(run, trajectory=nothing, online=nothing)) == 0


def test_a_map_flooded_with_points_scores_nothing_and_one_given_often_no_more():
    walls = prepared_world().walls
    low, high = walls[1].min(axis=0), walls[1].max(axis=0)
    axes = [np.arange(a, b, 0.05) for a, b in zip(low, high, strict=True)]
    everywhere = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)
    right = estimate_errors.map_score(walls[0], *walls)
    assert right > 0.95
    assert estimate_errors.map_score(everywhere, *walls) < 0.5 * right
    often = np.concatenate([everywhere, *[walls[0]] * 50])
    assert estimate_errors.map_score(often, *walls) < 0.5 * right
    assert estimate_errors.map_score(np.empty((0, 2)), *walls) == 0


def test_only_landmarks_that_were_seen_are_to_be_mapped():
    world = next(generate_worlds(LANDMARKS, 3, count=1))
    seen, all_there_are = estimate_errors.walls_to_map(world)
    ids = {i for reading in world for i in reading.observations.ids.tolist()}
    assert len(seen) == len(ids) < len(all_there_are) == len(world.landmarks)
    assert estimate_errors.map_score(world.landmarks[sorted(ids)], seen, all_there_are) == 1


def test_nees_is_3_on_average_for_consistent_covariances_and_capped_for_others():
    rng = np.random.default_rng(0)
    P = np.diag([0.04, 0.01, 0.0025])
    online = truth() + rng.multivariate_normal(np.zeros(3), P, len(truth()))
    online[0] = truth()[0]
    claims = np.broadcast_to(P, (len(truth()), 3, 3)).copy()
    assert 2 < estimate_errors.mean_nees(online, claims, truth()) < 4
    assert np.isnan(estimate_errors.mean_nees(online, claims * np.nan, truth()))
    assert estimate_errors.mean_nees(online, -claims, truth()) == estimate_errors.WORST_NEES


def test_the_median_of_a_family_counts_and_families_count_equally():
    runs = [estimate(0.0), estimate(1.0), prepared_world().runs["odometry"]]
    results = [prepared_world().judge(run) for run in runs]
    other = [dataclasses.replace(results[0], family="other")]
    assert by_family(results)["small"] == results[1].points
    assert score(results + other) == pytest.approx((results[1].points + results[0].points) / 2)


def test_a_crash_ends_its_world_and_not_the_rest():
    worlds = []

    class Crashes(MySlam):
        def __init__(self):
            super().__init__()
            worlds.append(self)

        def step(self, reading):
            if len(worlds) == 1 and len(self._poses) == 10:
                raise ValueError("lost")
            super().step(reading)

    first, second = judge(Crashes, [prepared_world(), prepared_world()], Budget(1e9, 1e9, 1e9))
    assert first.mistakes
    assert not second.mistakes
    assert second.measures.completeness == 1
