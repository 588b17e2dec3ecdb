"""Laws of the matcher: accuracy, basin of convergence, covariance, and rejection."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab.geometry import between, compose, inverse, transform, wrap
from slamlab.scanmatching import match, preprocess
from slamlab.scanmatching.correlative_matching import candidate_poses
from slamlab.scanmatching.local_line_fits import estimate_range_noise, fit_scan_lines
from slamlab.scanmatching.registration import all_above
from slamlab.simulation import worlds
from slamlab.simulation.range_scanners import RPLIDAR_A2, Scanner
from slamlab.simulation.worlds import ring
from slamlab.simulation.worlds.world import World
from tests.slamlab.room_clouds import pose_difference, seeds

poses = st.tuples(st.floats(-5, 5), st.floats(-5, 5), st.floats(-3.1, 3.1)).map(np.array)
PAIR = np.array([0.25, -0.15, 0.2])  # a motion between two scans


def scans(world, motion, rng, lidar=RPLIDAR_A2, place=(0.2, 0.1, 0.3)):
    """The cloud after a motion and the one before it."""
    return [lidar.scan(world, compose(place, m), rng).points() for m in (motion, np.zeros(3))]


@cache
def room_pairs(count):
    """Scans of the room with the true motion between them and a guess off by 0.1 m and 0.1 rad."""
    world, found = worlds.room(), []
    for seed in range(count):
        rng = np.random.default_rng(seed)
        true = rng.normal(0, [0.2, 0.2, 0.2])
        place = [*rng.uniform(-0.5, 0.5, 2), rng.uniform(0, 3)]
        source, target = scans(world, true, rng, place=place)
        found.append((source, target, true, true + rng.normal(0, 0.1, 3)))
    return found


def squared_mahalanobis(error, covariance):
    """eᵀ P⁻¹ e, its turn wrapped."""
    error = np.array([*error[:2], wrap(float(error[2]))])
    return error @ np.linalg.solve(covariance, error)


def test_true_motions_are_recovered_within_the_reported_covariance():
    nees = []
    for source, target, true, guess in room_pairs(120):
        found = match(source, target, guess)
        assert found.good
        assert not found.searched
        nees.append(squared_mahalanobis(found.pose - true, found.covariance))
    # χ² of 3 degrees has the mean 3; lines bent at corners cost some of it
    assert 2.2 < np.mean(nees) < 4.5
    assert np.mean(np.array(nees) > 11.34) < 0.08  # where 1 % should be


def test_a_covariance_grows_with_the_noise_of_the_scans():
    sizes = []
    for sigma in (0.002, 0.004, 0.016):
        lidar = Scanner(range_error=0.0, range_sigma=sigma)
        clouds = scans(worlds.room(), PAIR, np.random.default_rng(1), lidar)
        sizes.append(np.sqrt(np.diag(match(*clouds, PAIR).covariance)))
    assert (sizes[0] < 0.8 * sizes[1]).all()
    assert (sizes[1] < 0.5 * sizes[2]).all()


@settings(max_examples=25)
@given(seeds, st.floats(-3.1, 3.1))
def test_turning_both_clouds_turns_the_result(seed, turn):
    source, target = scans(worlds.room(), PAIR, np.random.default_rng(seed))
    frame = np.array([0.0, 0.0, turn])
    plain = match(source, target, PAIR * 0.8)
    guess = compose(compose(frame, PAIR * 0.8), inverse(frame))
    turned = match(transform(frame, source), transform(frame, target), guess)
    back = compose(compose(inverse(frame), turned.pose), frame)
    # sectors of the round are where they were: pairs differ by a beam here and there
    assert squared_mahalanobis(back - plain.pose, plain.covariance) < 0.5


@settings(max_examples=15)
@given(seeds, poses)
def test_moving_both_clouds_moves_the_result_within_its_covariance(seed, frame):
    # seen from elsewhere the clouds are no scans any more: the tree has to do
    source, target = scans(worlds.room(), PAIR, np.random.default_rng(seed))
    plain = match(source, target, PAIR)
    guess = compose(compose(frame, PAIR), inverse(frame))
    moved = match(transform(frame, source), transform(frame, target), guess)
    back = compose(compose(inverse(frame), moved.pose), frame)
    assert np.linalg.norm(pose_difference(back, PAIR)) < 0.015
    assert squared_mahalanobis(back - plain.pose, plain.covariance) < 40


def test_exchanging_source_and_target_inverts_the_result_within_its_covariance():
    differences = []
    for source, target, _, guess in room_pairs(40):
        there, back = match(source, target, guess), match(target, source, inverse(guess))
        differences.append(squared_mahalanobis(inverse(back.pose) - there.pose, there.covariance))
    # the same noise is in both; with noise of their own they would differ by 6
    assert np.mean(differences) < 3


@settings(max_examples=20)
@given(seeds, st.integers(1, 350), st.booleans())
def test_a_scan_may_start_at_any_beam_and_go_round_either_way(seed, first, clockwise):
    source, target = scans(worlds.room(), PAIR, np.random.default_rng(seed))
    other = np.roll(target, -first, axis=0)[:: -1 if clockwise else 1]
    one, two = (match(source, cloud, PAIR * 0.9, history=True) for cloud in (target, other))
    assert np.allclose(one.pose, two.pose, atol=1e-9)
    assert np.allclose(
        target[one.history[-1].pairs[:, 1]], other[two.history[-1].pairs[:, 1]], atol=1e-12
    )


@pytest.mark.parametrize("beams", [90, 400, 3600])
@pytest.mark.parametrize("field", [180, 240, 360])
@pytest.mark.parametrize("scale", [0.5, 10.0])
def test_few_beams_and_many_narrow_fields_and_wide_small_rooms_and_halls(beams, field, scale):
    room = worlds.room()
    world = World(room.walls * scale, room.circles * scale)
    lidar = Scanner(
        beams, 0.01, 100.0, np.radians(field), range_error=0.0, range_sigma=0.003 * scale
    )
    motion = PAIR * [scale, scale, 1]
    for seed in range(3):
        clouds = scans(
            world, motion, np.random.default_rng(seed), lidar, [0.2 * scale, 0.1 * scale, 0.3]
        )
        found = match(*clouds, motion * 0.6)
        distance, turn = pose_difference(found.pose, motion)
        assert found.good
        assert distance < 0.015 * scale
        assert turn < 0.01


@pytest.mark.parametrize("heading", [0.0, 0.5, -1.2])
def test_a_bare_corridor_is_reported_as_a_degenerate_direction(heading):
    walls = World([[-60, -1, 60, -1], [-60, 1.2, 60, 1.2]])
    lidar = Scanner(range_error=0.005)
    true, guess = np.array([0.3, 0.05, 0.04]), np.array([0.1, 0.0, 0.0])
    place = np.array([0.0, 0.0, heading])
    frame = inverse(place)  # the corridor as the robot sees it
    motion = compose(compose(frame, [*true[:2], true[2] + heading]), np.zeros(3))
    start = compose(frame, [*guess[:2], guess[2] + heading])
    found = match(*scans(walls, motion, np.random.default_rng(3), lidar, place), start)
    seen = found.observability
    assert found.good
    assert seen.fixed.tolist() == [False, True, True]
    along = np.array([np.cos(heading), -np.sin(heading), 0.0])
    assert abs(seen.directions[:, 0] @ along) > 0.99
    assert f"along {np.degrees(-heading) % 180:.0f}°" in found.verdict or heading == 0.0
    assert "degenerate along" in found.verdict
    # across and in turn it is right, along it stays where the guess was, and it knows
    error = transform(place, [found.pose[:2]])[0] - [0.0, true[1]]
    assert abs(error[1]) < 0.01
    assert abs(error[0] - guess[0]) < 0.03
    assert abs(found.pose[2] - true[2]) < 0.01
    assert along[:2] @ found.covariance[:2, :2] @ along[:2] > 0.5


def test_a_round_room_is_degenerate_in_heading_and_a_corner_is_not():
    lidar = Scanner(range_error=0.004)
    silo = World(circles=[(0.0, 0.0, 3.0)])
    clouds = scans(silo, [0.2, 0.1, 0.4], np.random.default_rng(0), lidar, [0, 0, 0])
    turning = match(*clouds)
    assert "degenerate in rotation" in turning.verdict
    assert abs(turning.pose[2]) < 0.03
    # round the middle of the room, where the first scan was taken
    assert np.hypot(*turning.pose[:2]) == pytest.approx(np.hypot(0.2, 0.1), abs=0.005)
    hall = World(ring([(-3, -2), (4, -2), (4, 3), (-3, 3)]))
    cornered = match(*scans(hall, [0.2, 0.1, 0.1], np.random.default_rng(0), lidar))
    assert cornered.verdict == "fits"
    assert cornered.observability.fixed.all()


def test_scans_of_different_positions_are_rejected():
    lidar, refused = RPLIDAR_A2, 0
    names = ["room", "corridor", "situation-2", "polygon"]
    clouds = [lidar.scan(worlds.by_name(n), [0, 0, 0.2], np.random.default_rng(0)) for n in names]
    for a in clouds:
        for b in clouds:
            if a is not b:
                found = match(a.points(), b.points())
                assert not found.good
                assert found.verdict.startswith(("poor", "lost", "still"))
                refused += 1
    assert refused == 12


def test_clouds_with_too_little_overlap_are_rejected():
    source, target = scans(worlds.room(), PAIR, np.random.default_rng(0))
    found = match(source + 50, target, search=0)
    assert not found.good
    assert not match(source[:40], source[200:240], search=0).good


@settings(max_examples=30)
@given(seeds, st.floats(-np.pi, np.pi), st.floats(-1, 1), st.floats(-1, 1))
def test_a_poor_initial_guess_is_recovered_by_correlative_search(seed, turn, x, y):
    source, target = scans(worlds.room(), PAIR, np.random.default_rng(seed))
    found = match(source, target, PAIR + np.array([x, y, turn]))
    assert found.good
    distance, turn = pose_difference(found.pose, PAIR)
    assert distance < 0.015
    assert turn < 0.01


def test_the_correlative_search_is_left_out_when_asked_and_kept_within_its_angle():
    source, target = scans(worlds.room(), PAIR, np.random.default_rng(0))
    lost = match(source, target, [0, 0, 2.6], search=0)
    assert not lost.searched
    assert not lost.good
    assert match(source, target, [0, 0, 2.6], search=1.0).searched
    assert not match(source, target, [0, 0, 2.6], search=1.0).good
    assert match(source, target, [0, 0, 2.6], search=3.0).good


@settings(max_examples=20)
@given(seeds, st.floats(-np.pi, np.pi))
def test_the_correlative_search_finds_the_position_to_a_cell_for_every_turn(seed, turn):
    true = np.array([0.5, -0.4, turn])
    source, target = scans(worlds.room(), true, np.random.default_rng(seed))
    found = candidate_poses(preprocess(source), preprocess(target), np.zeros(3))
    cell = 4 * np.quantile(np.hypot(*target.T), 0.95) / 64
    off = between(true, found)
    assert ((np.hypot(off[:, 0], off[:, 1]) < 2.5 * cell) & (np.abs(off[:, 2]) < 0.15)).any()


def test_in_a_room_that_looks_the_same_from_two_sides_the_guess_decides():
    hall = World(ring([(-3, -2), (3, -2), (3, 2), (-3, 2)]))
    clouds = scans(hall, [0.0, 0.0, 0.0], np.random.default_rng(2), place=[0, 0, 0])
    for near in (0.0, np.pi):
        found = match(*clouds, [0.3, 0.2, near - 0.3], search=np.pi / 2)
        assert abs(wrap(found.pose[2] - near)) < 0.02


@pytest.mark.parametrize("sigma", [0.002, 0.01, 0.03])
def test_the_range_noise_is_estimated_from_the_scan_itself(sigma):
    hall = World(ring([(-3, -2), (4, -2), (4, 3), (-3, 3)]))
    lidar = Scanner(range_error=0.0, range_sigma=sigma)
    step, estimates = 2 * np.pi / lidar.beams, []
    for seed in range(10):
        scan = lidar.scan(hall, [0, 0, 0.1], np.random.default_rng(seed))
        estimates.append(estimate_range_noise(scan.ranges, step))
    assert np.mean(estimates) == pytest.approx(sigma, rel=0.15)


def test_lines_of_a_scan_lie_in_its_walls_and_none_spans_a_jump():
    # a wall 2 m ahead, and behind a door's edge one 4 m ahead
    bearings = np.radians(np.arange(-60, 60))
    depth = np.where(bearings < 0, 2.0, 4.0)
    x, y = depth, depth * np.tan(bearings)
    fits, _ = fit_scan_lines(x, y, np.hypot(x, y), np.radians(1), closed=False)
    assert np.allclose(np.abs(fits.nx[fits.good]), 1)
    assert np.allclose(np.abs(fits.offset[fits.good]), depth[fits.good])
    assert fits.good.mean() > 0.9


def test_ready_surfaces_give_what_their_clouds_give():
    for source, target, _, guess in room_pairs(5):
        plain = match(source, target, guess)
        ready = match(preprocess(source), preprocess(target), guess)
        assert np.array_equal(plain.pose, ready.pose)
        assert np.array_equal(plain.covariance, ready.covariance)


@given(seeds, st.floats(-4, 0), st.floats(0, 1))
def test_all_eigenvalues_are_above_a_floor_below_the_least_and_none_else(seed, least, middle):
    values = np.array([1.0, 10 ** (least * middle), 10**least])  # a matrix's floor is 1e-4 of them
    axes = np.linalg.qr(np.random.default_rng(seed).standard_normal((3, 3)))[0]
    A = (axes * values) @ axes.T
    assert all_above(A, 0.99 * values[2])
    for value in values:
        assert not all_above(A, 1.01 * value)
