"""Laws of ICP scan matching: rigid fit, point to point, point to line, normals."""

from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from slamlab.geometry import compose, inverse, transform, wrap
from slamlab.scanmatching import match, normals, point_to_line, point_to_point, rigid_fit
from slamlab.scanmatching.nearest_neighbours import NearestNeighbours
from tests.slamlab.room_clouds import pose_difference, seeds

MATCHERS = [point_to_point, point_to_line, match]
EACH = pytest.mark.parametrize("matcher", MATCHERS)
poses = st.tuples(st.floats(-5, 5), st.floats(-5, 5), st.floats(-3.1, 3.1)).map(np.array)


def outline(count=60):
    """Points along a crooked room's walls, none of them symmetric."""
    corners = np.array([[0, 0], [4.2, 0.3], [4.0, 2.1], [2.9, 2.3], [2.7, 3.6], [-0.4, 3.1]])
    ends = np.roll(corners, -1, axis=0)
    share = np.arange(count) / count
    return np.concatenate(
        [a + share[:, None] * (b - a) for a, b in zip(corners, ends, strict=True)]
    ) - [1.9, 1.4]


@given(poses, seeds)
def test_rigid_fit_recovers_any_motion_of_paired_points(pose, seed):
    cloud = np.random.default_rng(seed).normal(size=(20, 2))
    distance, turn = pose_difference(rigid_fit(cloud, transform(pose, cloud)), pose)
    assert distance < 1e-10
    assert turn < 1e-10


@given(poses, seeds)
def test_rigid_fit_beats_every_other_motion(other, seed):
    rng = np.random.default_rng(seed)
    p, q = rng.normal(size=(2, 12, 2))
    best = np.sum((transform(rigid_fit(p, q), p) - q) ** 2)
    assert best <= np.sum((transform(other, p) - q) ** 2) + 1e-9


@pytest.mark.parametrize("shape", ["reflected", "collinear", "one point", "collinear reflected"])
def test_rigid_fit_is_a_rotation_even_where_a_reflection_fits_better(shape):
    rng = np.random.default_rng(3)
    p = rng.normal(size=(30, 2))
    if shape.startswith("collinear"):
        p = np.outer(rng.normal(size=30), [0.6, 0.8])
    q = p * [1, -1] if "reflected" in shape else p.copy()
    if shape == "one point":
        p[:], q[:] = p[0], p[0]
    pose = rigid_fit(p, q)
    assert np.isfinite(pose).all()
    # a pose keeps the sense of rotation: the transformed unit vectors must still be right-handed
    o, e_x, e_y = transform(pose, [[0, 0], [1, 0], [0, 1]])
    assert np.linalg.det(np.column_stack([e_x - o, e_y - o])) == pytest.approx(1)
    if shape == "reflected":
        turns = np.linspace(-np.pi, np.pi, 721)
        costs = [np.sum((transform([0, 0, t], p - p.mean(0)) - q + q.mean(0)) ** 2) for t in turns]
        assert np.sum((transform(pose, p) - q) ** 2) <= min(costs) + 1e-9


small_errors = st.tuples(st.floats(-0.12, 0.12), st.floats(-0.12, 0.12), st.floats(-0.05, 0.05))


@settings(max_examples=40, deadline=None)
@given(small_errors, poses, seeds)
def test_plain_icp_recovers_a_motion_exactly_where_each_point_is_nearest_to_its_own(
    error, true, seed
):
    # posts 0.8 m apart or more, moved by less than half of that
    grid = np.stack(np.meshgrid(np.arange(-2, 3), np.arange(-2, 3)), axis=-1).reshape(-1, 2)
    target = grid + np.random.default_rng(seed).uniform(-0.1, 0.1, grid.shape)
    found = point_to_point(transform(inverse(true), target), target, compose(true, error))
    distance, turn = pose_difference(found.pose, true)
    assert found.converged
    assert distance < 1e-9
    assert turn < 1e-9


@settings(max_examples=25, deadline=None)
@given(small_errors, poses)
def test_point_to_line_recovers_a_motion_on_clean_walls(error, true):
    target = outline()
    found = point_to_line(transform(inverse(true), target), target, compose(true, error))
    distance, turn = pose_difference(found.pose, true)
    assert found.converged
    assert distance < 2e-4
    assert turn < 2e-4


@EACH
def test_clouds_of_unequal_size_match(matcher):
    target, source = outline(83), outline(40)
    true = np.array([0.1, -0.06, 0.05])
    found = matcher(transform(inverse(true), source), target)
    distance, turn = pose_difference(found.pose, true)
    assert distance < 0.01
    assert turn < 0.005


@settings(max_examples=30, deadline=None)
@given(seeds, st.sampled_from([1.0, 0.8]))
def test_the_squared_error_of_plain_icp_never_grows_from_round_to_round(seed, keep):
    rng = np.random.default_rng(seed)
    source, target = rng.normal(size=(40, 2)), rng.normal(size=(55, 2))
    found = point_to_point(source, target, rng.normal(size=3), keep=keep, history=True)
    squares = []
    for look in found.history:
        moved = transform(look.pose, source[look.pairs[:, 0]])
        squares.append(np.sum((moved - target[look.pairs[:, 1]]) ** 2))
    assert all(later <= earlier + 1e-9 for earlier, later in pairwise(squares))


def test_plain_icp_takes_the_same_iterations_as_a_naive_implementation():
    rng = np.random.default_rng(5)
    target = outline() + rng.normal(0, 0.01, outline().shape)
    source = transform(inverse([0.2, 0.1, 0.3]), outline() + rng.normal(0, 0.01, outline().shape))
    moved, last, iterations = source, 0.0, 0
    for _ in range(500):
        iterations += 1
        gaps = np.linalg.norm(moved[:, None] - target[None], axis=2)
        paired = target[gaps.argmin(axis=1)]
        moved = transform(rigid_fit(moved, paired), moved)
        if abs(last - gaps.min(axis=1).mean()) < 1e-6:
            break
        last = gaps.min(axis=1).mean()
    found = point_to_point(source, target)
    assert found.iterations == iterations
    assert np.allclose(transform(found.pose, source), moved, atol=1e-9)


def test_the_tolerance_is_in_metres():
    rng = np.random.default_rng(8)
    target = outline() + rng.normal(0, 0.01, outline().shape)
    source = outline() + rng.normal(0, 0.01, outline().shape)
    guess = np.array([0.2, -0.1, 0.2])
    small = point_to_point(source, target, guess, tolerance=1e-4)
    in_mm = point_to_point(1e3 * source, 1e3 * target, guess * [1e3, 1e3, 1], tolerance=0.1)
    assert in_mm.iterations == small.iterations
    assert in_mm.error == pytest.approx(1e3 * small.error)
    assert point_to_point(source, target, guess, tolerance=1e-9).iterations > small.iterations


def test_iterations_are_limited_and_not_converging_is_reported():
    found = point_to_point(outline(), outline(), [0.4, 0.3, 0.5], max_iterations=2)
    assert found.iterations == 2
    assert not found.converged
    assert "2 iterations" in found.verdict


@EACH
def test_history_runs_from_the_guess_to_the_result(matcher):
    guess = np.array([0.1, 0.05, 0.1])
    found = matcher(outline(), outline(), guess, history=True)
    assert len(found.history) == found.iterations + 1
    np.testing.assert_allclose(found.history[0].pose, guess)
    assert np.array_equal(found.history[-1].pose, found.pose)
    assert len(found.history[-1].pairs) == round(found.inlier_ratio * len(outline()))
    if matcher is not match:
        assert found.history[-1].error == found.error
    assert matcher(outline(), outline(), guess).history == ()


def test_trimming_tolerates_points_that_only_one_scan_saw():
    target = outline()
    box = np.random.default_rng(2).uniform(0, 0.8, (70, 2)) - [1.2, 0.2]
    true = np.array([0.15, -0.1, 0.1])
    source = transform(inverse(true), np.concatenate([target, box]))
    found = [point_to_point(source, target, keep=k).pose for k in (1.0, 0.8)]
    errors = [pose_difference(pose, true)[0] for pose in found]
    assert errors[1] < 1e-3 < errors[0]


def test_point_to_line_is_nearer_the_truth_than_plain_icp_on_noisy_scans():
    true, plain, lines = np.array([0.12, -0.08, 0.1]), [], []
    for seed in range(20):
        rng = np.random.default_rng(seed)
        target = outline() + rng.normal(0, 0.01, outline().shape)
        source = outline(57)
        source = transform(inverse(true), source + rng.normal(0, 0.01, source.shape))
        plain.append(pose_difference(point_to_point(source, target).pose, true)[0])
        lines.append(pose_difference(point_to_line(source, target).pose, true)[0])
    assert np.median(lines) < np.median(plain)


def test_along_a_corridor_the_first_guess_stands():
    x = np.arange(0, 6, 0.05)
    walls = np.concatenate([np.column_stack([x, 0 * x]), np.column_stack([x, 0 * x + 2])])
    guess = np.array([0.31, 0.06, 0.03])
    found = point_to_line(walls, walls, guess)
    assert found.converged
    assert found.pose[0] == pytest.approx(0.31, abs=0.01)
    assert np.abs(found.pose[1:]).max() < 1e-3


@EACH
@settings(max_examples=60, deadline=None)
@given(
    seeds,
    st.integers(3, 40),
    st.integers(3, 40),
    st.floats(-6, 6),
    st.sampled_from(["any", "one point", "line", "scan"]),
)
@example(seed=3112, n=3, m=3, scale=0.0, kind="any")  # a guess beyond half a turn, and no match
def test_for_all_point_clouds_the_pose_is_finite_and_the_verdict_is_reported(
    matcher, seed, n, m, scale, kind
):
    rng = np.random.default_rng(seed)
    source, target = rng.normal(size=(n, 2)) * 10**scale, rng.normal(size=(m, 2))
    if kind == "one point":
        source[:] = source[0]
    if kind == "line":
        target[:] = np.outer(target[:, 0], [0.6, 0.8])
    if kind == "scan":
        source, target = (c[np.argsort(np.arctan2(c[:, 1], c[:, 0]))] for c in (source, target))
    found = matcher(source, target, rng.normal(size=3))
    assert np.isfinite(found.pose).all()
    if matcher is match:
        assert np.isfinite(found.covariance).all()
    assert wrap(float(found.pose[2])) == pytest.approx(found.pose[2])
    assert found.verdict
    assert 0 <= found.inlier_ratio <= 1


def test_clouds_without_overlap_do_not_converge():
    found = point_to_line(outline() + 50, outline())
    assert not found.converged
    assert "too few correspondences" in found.verdict
    assert np.array_equal(found.pose, [0, 0, 0])


@EACH
@pytest.mark.parametrize(
    ("source", "target", "message"),
    [
        (np.zeros((2, 2)), outline(), "source has 2 points"),
        (outline(), np.zeros((0, 2)), "target has 0 points"),
        (outline()[:, 0], outline(), r"source must have shape \(n, 2\)"),
        (outline(), np.zeros((9, 3)), r"target must have shape \(n, 2\)"),
        (outline() * np.nan, outline(), "source contains NaN"),
        (outline(), outline() * 1e9, "metres"),
    ],
)
def test_bad_clouds_get_a_clear_error(matcher, source, target, message):
    with pytest.raises(ValueError, match=message):
        matcher(source, target)


SENSELESS = {"initial": [0, np.nan, 0]}, {"initial": [0, 0]}, {"max_iterations": 0}
SENSELESS_OF_ICP = {"tolerance": 0.0}, {"keep": 0.0}, {"keep": 1.5}


@pytest.mark.parametrize(
    ("matcher", "options"),
    [*product(MATCHERS, SENSELESS), *product(MATCHERS[:2], SENSELESS_OF_ICP)],
)
def test_senseless_options_get_a_clear_error(matcher, options):
    with pytest.raises(ValueError, match=next(iter(options))):
        matcher(outline(), outline(), **options)


def test_matching_leaves_its_inputs_alone():
    source, target, guess = outline(), outline(40), np.array([0.1, 0.1, 0.1])
    before = source.copy(), target.copy(), guess.copy()
    for matcher in MATCHERS:
        matcher(source, target, guess)
    assert all(np.array_equal(*pair) for pair in zip((source, target, guess), before, strict=True))


@settings(max_examples=30)
@given(seeds)
def test_cached_neighbours_are_the_nearest_ones_whatever_the_moves(seed):
    rng = np.random.default_rng(seed)
    target, source = rng.normal(size=(40, 2)), rng.normal(size=(30, 2))
    nearest = NearestNeighbours(target)
    for scale in (1.0, 0.3, 0.1, 0.01, 0.5, 0.001):
        source = source + scale * rng.normal(size=source.shape)
        distances, _ = nearest(source)
        truth = np.linalg.norm(source[:, None] - target[None], axis=2).min(axis=1)
        assert np.allclose(distances, truth, rtol=0, atol=1e-12)


@pytest.mark.parametrize("turn", [-3.0, -1.2, 0.0, 0.7, 2.1])
def test_normals_stand_across_a_wall(turn):
    wall = transform([3.0, -2.0, turn], np.column_stack([np.arange(20) * 0.05, np.zeros(20)]))
    across = np.array([-np.sin(turn), np.cos(turn)])
    assert np.allclose(np.abs(normals(wall) @ across), 1)


def test_a_point_alone_or_in_a_heap_has_no_normal():
    heap = np.random.default_rng(0).normal(0, 0.05, (200, 2))
    assert np.isnan(normals(np.concatenate([[[9.0, 9.0]], heap]))[0]).all()
    assert np.isnan(normals(heap)).all(axis=1).mean() > 0.5
    assert np.isnan(normals(np.zeros((5, 2)))).all()
    assert normals(np.empty((0, 2))).shape == (0, 2)
