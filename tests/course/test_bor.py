"""Set-membership filter BOR: boxes contain the truth; violations of bounds are reported."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from course.studies.box_containment import (
    STEPS,
    BoundedNoise,
    BoundedRun,
    random_world,
    violations,
)
from slamlab.evaluation import inside, outside
from slamlab.filters.set_membership import BOR, EmptyIntersection
from slamlab.filters.set_membership.angle_intervals import contains, width
from slamlab.filters.set_membership.prediction import steered, wheels
from slamlab.models.observation import h

POINT = (0.0, 0.0, 0.0, 0.0)
EXAMPLES = 500


@pytest.mark.parametrize(
    "examples", [EXAMPLES // 10, pytest.param(EXAMPLES, marks=pytest.mark.slow)]
)
def test_with_every_noise_inside_its_bounds_the_truth_is_never_outside_its_box(examples):
    @settings(max_examples=examples)
    @given(st.integers(0, 2**63 - 1))
    def holds(seed):
        found = violations(seed)
        assert found["outside"] == found["empty"] == 0

    holds()


def test_that_was_a_hundred_thousand_steps_wrapped_overlapping_and_without_any_bearing():
    assert EXAMPLES * STEPS >= 100_000
    kinds = [random_world(np.random.default_rng(seed)) for seed in range(300)]
    assert {k.drive for k in kinds} == {"odometry", "wheels", "steered"}
    assert any(k.spread < 0.05 < k.seeing[0] and k.objects > 1 for k in kinds)
    assert any(k.spread == 0 for k in kinds)
    assert any(k.moving == (0, 0) or k.seeing[0] == 0 for k in kinds)
    found = violations(1, BoundedNoise(seeing=(0.1, 2.0)))
    assert found["wide"] > 0


def feed(run, *filters):
    """Feed a run to filters; return what was observed last."""
    for motion, seen in run:
        for bor in filters:
            bor.predict(*motion)
            for i, z in seen:
                (bor.update if i in bor else bor.add)(i, z, run.world.seeing)
    return seen


@given(st.integers(0, 2**32 - 1))
def test_an_observation_never_enlarges_a_set_and_overlaps_its_landmark(seed):
    rng = np.random.default_rng(seed)
    run = BoundedRun(random_world(rng), rng, 20)
    bor = run.filter()
    for motion, seen in run:
        bor.predict(*motion)
        for i, z in seen:
            assert i not in bor or i in bor.overlapping(z, run.world.seeing)
            before = sizes(bor)
            (bor.update if i in bor else bor.add)(i, z, run.world.seeing)
            after = sizes(bor)
            assert (after[: len(before)] <= before + 1e-12).all()


def sizes(bor):
    """Width of the heading, of the robot's box in x and y, and of each object's."""
    boxes = np.vstack([bor.robot, bor.boxes()])
    return np.concatenate([[width(bor.heading)], (boxes[:, 1::2] - boxes[:, ::2]).ravel()])


def test_without_noise_the_map_is_exact_and_motion_is_followed():
    run = BoundedRun(BoundedNoise(moving=(0, 0), seeing=(0, 0)), np.random.default_rng(2), 30)
    bor = run.filter()
    feed(run, bor)
    assert sizes(bor).max() < 1e-6
    np.testing.assert_allclose(bor.pose, run.pose, atol=1e-6)


def test_a_noise_far_outside_its_bound_is_reported_and_changes_nothing():
    run = BoundedRun(BoundedNoise(share=1), np.random.default_rng(4), 30)
    bor, bounds = run.filter(), run.world.seeing
    seen = feed(run, bor)
    before = sizes(bor), bor.robot, bor.boxes()
    i, (r, bearing) = seen[0]
    for wrong in ((r + 3, bearing), (r, bearing + 2)):
        with pytest.raises(EmptyIntersection, match=f"landmark {i}.*exceeded its bounds.*Widen"):
            bor.update(i, wrong, bounds)
    for old, new in zip(before, (sizes(bor), bor.robot, bor.boxes()), strict=True):
        np.testing.assert_array_equal(old, new)


@pytest.mark.parametrize("seed", range(4))
def test_wrong_odometry_is_detected_by_the_next_observations(seed):
    run = BoundedRun(replace(BoundedNoise(), share=1), np.random.default_rng(seed), 40)
    bor, reported = run.filter(), False
    for k, (motion, seen) in enumerate(run):
        way, direction, turn = motion
        if k == 30:  # a cable snags: the robot believes it drove on
            way = way[0] + 1, way[1] + 1
        bor.predict(way, direction, turn)
        for i, z in seen:
            try:
                (bor.update if i in bor else bor.add)(i, z, run.world.seeing)
            except EmptyIntersection:
                reported = True
        assert k < 30 or reported or outside(bor, run.pose, run.objects)
        assert k >= 30 or not reported
    assert reported


def test_an_observation_is_associated_with_the_one_box_that_the_region_overlaps():
    bor = BOR(POINT, (0, 0), {7: (2, 2.1, 0, 0.1), 9: (0, 0.1, 2, 2.1)})
    assert bor.overlapping((2.0, 0.0), (0.2, 0.1)) == [7]
    assert bor.associate_and_update((2.0, np.pi / 2), (0.2, 0.1)) == 9
    assert bor.associate_and_update((2.0, -np.pi / 2), (0.2, 0.1)) == 2  # nobody there: a new one
    assert bor.ids == [7, 9, 2]
    assert inside(bor.boxes()[-1], (0, -2))


def test_an_observation_that_overlaps_two_boxes_is_ignored_and_counted():
    bor = BOR(POINT, (0, 0), {1: (2, 2.1, 0, 0.1), 2: (2, 2.1, -0.2, -0.1)})
    before = bor.boxes()
    assert bor.associate_and_update((2.0, 0.0), (0.3, 0.3)) is None
    assert bor.ambiguous == 1
    np.testing.assert_array_equal(bor.boxes(), before)
    assert bor.ids == [1, 2]


def test_an_unmapped_landmark_that_overlaps_one_box_is_associated_with_it():
    bor = BOR((-0.5, 0.5, -0.5, 0.5), (-0.1, 0.1), {1: (2, 2, 0, 0)})
    truth = np.array([0.4, 0.0, 0.0])
    assert bor.associate_and_update(h(truth, np.array([2.6, 0.1])), (0.05, 0.02)) == 1
    assert not inside(bor.robot, truth[:2]), "who is mistaken about whom he sees is wrong himself"


def test_more_landmarks_than_were_allocated_are_stored():
    bor = BOR(POINT, (0, 0), capacity=1)
    for i in range(40):
        bor.add(i, (1.0 + i, 0.1), (0.1, 0.01))
    assert len(bor) == len(bor.boxes()) == 40
    assert bor.boxes()[0][0] < 1 < bor.boxes()[0][1]
    assert bor.boxes()[39][1] > 38


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: BOR((1, 0, 0, 0), (0, 0)), "x_min ≤ x_max"),
        (lambda: BOR((0, 0, 0), (0, 0)), "robot has shape"),
        (lambda: BOR(POINT, (0.1, 0)), r"add 2π"),
        (lambda: BOR(POINT, (0, 0), {3: (0, 0, 1, 0)}), "landmark 3"),
        (lambda: BOR(POINT, (0, np.nan)), "NaN"),
        (lambda: BOR(POINT, (0, 0)).predict((1, 0), (0, 0), (0, 0)), "expected low ≤ high"),
        (lambda: BOR(POINT, (0, 0)).predict(1, (0, 0), (0, 0)), "must be an interval of two"),
        (lambda: BOR(POINT, (0, 0)).add(1, (1, 0, 0), (0, 0)), "each be range and bearing"),
        (lambda: steered((1, 1), (0, 0), 0, 1), "wheel base and period must be above zero"),
        (lambda: wheels((1, 1), (1, 1), -0.1), "distance between the wheels must be above zero"),
        (lambda: BOR(POINT, (0, 0)).update(1, (1, 0), (0, 0)), "add it instead"),
        (lambda: BOR(POINT, (0, 0), {1: POINT}).add(1, (1, 0), (0, 0)), "update it instead"),
        (lambda: BOR(POINT, (0, 0)).add(1, (-1, 0), (0, 0)), "range must be positive"),
        (lambda: BOR(POINT, (0, 0)).add(1, (1, 0), (-1, 0)), "bounds must not be negative"),
        (lambda: BOR(POINT, (0, 0)).associate_and_update((1, np.nan), (0, 0)), "NaN"),
    ],
)
def test_invalid_boxes_intervals_and_observations_are_reported_in_one_line(call, words):
    with pytest.raises(ValueError, match=words):
        call()


def test_the_headings_interval_holds_over_the_seam_when_given_so():
    bor = BOR(POINT, (3.0, 3.5))
    assert contains(bor.heading, -3.0)
    assert np.isclose(bor.pose[2], 3.25 - 2 * np.pi)


def test_restricted_by_what_is_known_otherwise_a_box_is_what_both_have_in_common():
    bor = BOR((0, 2, 0, 2), (-0.5, 0.5))
    bor.restrict((1, 3, -1, 1), (0.2 - 2 * np.pi, 0.9 - 2 * np.pi))  # whole turns do not matter
    np.testing.assert_allclose(bor.robot, (1, 2, 0, 1))
    np.testing.assert_allclose(bor.heading, (0.2, 0.5))


@pytest.mark.parametrize(
    ("robot", "heading"), [((3, 4, 0, 2), (-0.5, 0.5)), ((0, 2, 0, 2), (1.0, 2.0))]
)
def test_what_has_nothing_in_common_is_an_error_and_changes_nothing(robot, heading):
    bor = BOR((0, 2, 0, 2), (-0.5, 0.5))
    with pytest.raises(EmptyIntersection):
        bor.restrict(robot, heading)
    np.testing.assert_allclose([*bor.robot, *bor.heading], (0, 2, 0, 2, -0.5, 0.5))
