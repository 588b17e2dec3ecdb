"""The published scale as laws: monotone in the error, continuous, the same in every frame."""

import dataclasses
from functools import cache

import numpy as np
import pytest

from course.project.template import MySlam
from slamlab.geometry import compose, transform
from slamlab.project import drive_errors, points
from slamlab.project.baselines import BASELINES
from slamlab.project.drawing import draw_family, draw_world
from slamlab.project.driving import Budget, drive
from slamlab.project.scores import by_family, judge, prepare, score
from slamlab.project.world_families import LANDMARKS, Family

SMALL = Family("small", plans=(("crc", "rcr"),))
START = np.array([2.0, -1.0, 0.7])


@cache
def arena():
    """A small world with its marks, the same for all tests."""
    return prepare(draw_world(SMALL, np.random.default_rng(5), 25.0))


def truth():
    """The true poses there."""
    return arena().world.truth.poses


def estimate(noise, seed=0):
    """A drive whose poses are the truth but for errors that grow, and whose map is perfect."""
    rng = np.random.default_rng(seed)
    steps = rng.standard_normal((len(truth()), 3)) * noise * np.array([0.02, 0.02, 0.01])
    poses = truth() + np.cumsum(steps, axis=0)
    odometry = arena().drives["odometry"]
    return dataclasses.replace(odometry, online=poses, trajectory=poses, points=arena().walls[0])


def moved(driven, frame):
    """The same drive in another frame."""
    return dataclasses.replace(
        driven,
        online=compose(frame, driven.online),
        trajectory=compose(frame, driven.trajectory),
        points=transform(frame, driven.points),
    )


def points_of(driven):
    return arena().judge(driven).points


def test_odometry_and_the_template_score_0():
    assert points_of(arena().drives["odometry"]) == 0
    assert points_of(drive(MySlam, arena().world)) == 0


def test_the_baselines_are_the_marks():
    icp, graph = (arena().judge(arena().drives[name]).points for name in ("icp", "graph"))
    assert 40 < icp < 65
    assert 75 < graph < 90
    assert icp < graph


def test_the_truth_scores_100():
    assert points_of(estimate(0.0)) > 99


def test_points_fall_as_errors_grow():
    measured = [points_of(estimate(noise)) for noise in (0, 0.1, 0.3, 1, 3, 10, 30)]
    assert measured == sorted(measured, reverse=True)
    assert len(set(measured)) > 4


@pytest.mark.parametrize("gain", np.linspace(-1, 4, 11))
def test_points_are_continuous_and_monotone_in_each_measure(gain):
    base = points.Measures(gain, np.zeros(3), 0.4, 0.9, np.nan)
    for name, step in (("gain", 1e-4), ("map", 1e-4), ("completeness", 1e-4)):
        more = dataclasses.replace(base, **{name: getattr(base, name) + step})
        rise = points.points_of(more, arena().scale) - points.points_of(base, arena().scale)
        assert 0 <= rise < 0.1


@pytest.mark.parametrize("nees", np.geomspace(1e-6, 1e6, 25))
def test_a_false_claim_costs_the_more_the_falser_it_is_and_continuously(nees):
    low, high = points.NEES_BAND
    costs = [points.claim_cost(nees * factor) for factor in (1, 1.001)]
    assert abs(costs[1] - costs[0]) < 0.01
    assert (costs[0] == 0) == (low <= nees <= high)
    assert costs[0] <= points.FALSE_CLAIM
    outwards = nees * (1.1 if nees > 3 else 1 / 1.1)
    assert points.claim_cost(outwards) >= costs[0]


def test_no_claim_no_loss():
    assert points.claim_cost(np.nan) == 0


@pytest.mark.parametrize("noise", [0.0, 0.3, 3.0])
def test_points_do_not_depend_on_the_estimators_frame(noise):
    driven = estimate(noise)
    assert points_of(moved(driven, START)) == pytest.approx(points_of(driven), abs=0.5)


def test_errors_do_not_depend_on_the_frame_of_the_world():
    driven = estimate(1.0)
    for length in drive_errors.LENGTHS:
        errors = [
            drive_errors.relative_errors(driven.trajectory, true, arena().world.metres, length)
            for true in (truth(), compose(START, truth()))
        ]
        np.testing.assert_allclose(*errors, atol=1e-9)
    motion = drive_errors.aligned(driven.trajectory, compose(START, truth()))
    there = transform(motion, driven.points)
    here = transform(drive_errors.aligned(driven.trajectory, truth()), driven.points)
    np.testing.assert_allclose(there, transform(START, here), atol=1e-9)


def test_relative_errors_are_known_for_a_scale_that_is_wrong():
    true = np.column_stack([np.arange(30.0), np.zeros(30), np.zeros(30)])
    errors = drive_errors.relative_errors(true * [1.1, 1, 1], true, true[:, 0], 5.0)
    np.testing.assert_allclose(errors, 0.5)
    assert len(errors) == 25


def test_missing_poses_cost_their_share_and_leaving_out_the_hard_ones_gains_nothing():
    driven = estimate(0.3)
    errors = drive_errors.relative_errors(driven.trajectory, truth(), arena().world.metres, 5.0)
    hard = drive_errors.pairs(arena().world.metres, 5.0)[0][np.argsort(errors)[-8:]]
    trajectory = driven.trajectory.copy()
    trajectory[hard] = np.nan
    assert points_of(dataclasses.replace(driven, trajectory=trajectory)) < points_of(driven)
    nothing = np.full_like(trajectory, np.nan)
    assert points_of(dataclasses.replace(driven, trajectory=nothing, online=nothing)) == 0


def test_a_map_flooded_with_points_scores_nothing_and_one_given_often_no_more():
    walls = arena().walls
    low, high = walls[1].min(axis=0), walls[1].max(axis=0)
    axes = [np.arange(a, b, 0.05) for a, b in zip(low, high, strict=True)]
    everywhere = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)
    right = drive_errors.map_score(walls[0], *walls)
    assert right > 0.95
    assert drive_errors.map_score(everywhere, *walls) < 0.5 * right
    often = np.concatenate([everywhere, *[walls[0]] * 50])
    assert drive_errors.map_score(often, *walls) < 0.5 * right
    assert drive_errors.map_score(np.empty((0, 2)), *walls) == 0


def test_only_landmarks_that_were_seen_are_to_be_mapped():
    world = next(draw_family(LANDMARKS, 3, count=1))
    seen, all_there_are = drive_errors.to_be_mapped(world)
    ids = {i for reading in world for i in reading.observations.ids.tolist()}
    assert len(seen) == len(ids) < len(all_there_are) == len(world.landmarks)
    assert drive_errors.map_score(world.landmarks[sorted(ids)], seen, all_there_are) == 1


def test_nees_is_3_on_average_for_true_claims_and_capped_for_false_ones():
    rng = np.random.default_rng(0)
    P = np.diag([0.04, 0.01, 0.0025])
    online = truth() + rng.multivariate_normal(np.zeros(3), P, len(truth()))
    online[0] = truth()[0]
    claims = np.broadcast_to(P, (len(truth()), 3, 3)).copy()
    assert 2 < drive_errors.mean_nees(online, claims, truth()) < 4
    assert np.isnan(drive_errors.mean_nees(online, claims * np.nan, truth()))
    assert drive_errors.mean_nees(online, -claims, truth()) == drive_errors.WORST_NEES


def test_the_median_of_a_family_counts_and_families_count_alike():
    drives = [estimate(0.0), estimate(1.0), arena().drives["odometry"]]
    results = [arena().judge(driven) for driven in drives]
    other = [dataclasses.replace(results[0], family="other")]
    assert by_family(results)["small"] == results[1].points
    assert score(results + other) == pytest.approx((results[1].points + results[0].points) / 2)


@pytest.mark.parametrize("crash_at", [0, 10])
def test_a_crash_ends_its_world_and_not_the_rest(crash_at):
    worlds = []

    class Crashes(MySlam):
        def __init__(self):
            super().__init__()
            worlds.append(self)

        def step(self, reading):
            if len(worlds) == 1 and len(self._poses) == crash_at:
                raise ValueError("lost")
            super().step(reading)

    first, second = judge(Crashes, [arena(), arena()], Budget(1e9, 1e9, 1e9))
    assert first.mistakes
    assert not second.mistakes
    assert second.measures.completeness == 1


def test_a_baseline_is_fed_like_a_student():
    assert set(BASELINES) == {"odometry", "icp", "graph"}
    assert all(not driven.mistakes for driven in arena().drives.values())
