"""Laws of scan matching for clouds that no simulated turn makes: beams in another order or at one
bearing, merged turns, clouds far from the origin, wild beams."""

from functools import cache

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from slamlab.deskewing import deskew, merge_scans
from slamlab.geometry import between, compose, transform
from slamlab.readings import Scan
from slamlab.scanmatching import (
    match,
    normals,
    point_to_line,
    point_to_point,
    preprocess,
    rigid_fit,
)
from slamlab.scanmatching.beam_order import ordered_beams
from slamlab.scanmatching.submap import build_submap
from slamlab.simulation import worlds
from slamlab.simulation.range_scanners import RPLIDAR_A2, Scanner

seeds = st.integers(0, 2**32 - 1)
PLACE, MOTION = np.array([0.2, 0.1, 0.3]), np.array([0.06, -0.05, 0.05])
OFF = np.array([0.02, -0.02, 0.02])  # of a first guess
NOISY = Scanner(range_error=0.0, range_sigma=0.02)  # more than beams are apart, once merged
MATCHERS = [match, point_to_line, point_to_point]
ALL = pytest.mark.parametrize("matcher", MATCHERS)


def looks(rng, lidar=RPLIDAR_A2, world="room"):
    """Scans from after a motion and from before it."""
    world = worlds.by_name(world)
    return lidar.scan(world, compose(PLACE, MOTION), rng), lidar.scan(world, PLACE, rng)


def clouds(seed):
    return [scan.points() for scan in looks(np.random.default_rng(seed))]


def error(found, true=MOTION):
    x, y, turn = between(true, found.pose)
    return np.hypot(x, y), abs(turn)


# --- the order of beams


@settings(max_examples=25)
@given(seeds, st.sampled_from(["shuffled", "rolled", "backward", "as they come"]), st.booleans())
def test_beams_in_any_order_and_with_ties_give_the_motion(seed, order, shared):
    rng = np.random.default_rng(seed)
    arranged = []
    for cloud in clouds(0):
        rows = np.concatenate([np.arange(len(cloud)), rng.integers(len(cloud), size=60)])
        if order == "shuffled":
            rows = rng.permutation(rows)
        elif order != "as they come":
            rows = np.roll(np.sort(rows), seed % 300)
        if order == "backward":
            rows = rows[::-1]
        # two beams at one bearing hit two ranges, or the very same point
        longer = 1 if shared else 1 + 0.002 * rng.standard_normal((len(rows), 1))
        arranged.append(cloud[rows] * longer)
    found = match(*arranged, MOTION + OFF)
    assert found.good
    assert error(found)[0] < 0.006
    assert error(found)[1] < 0.004


@pytest.mark.parametrize("world", ["room", "corridor", "polygon"])
def test_a_scan_deskewed_at_walking_speed_stays_a_scan_and_gives_the_motion(world):
    way = np.array([0.14, 0.0, 0.1])  # in a turn
    lidar, here = Scanner(800, range_error=0.005), worlds.by_name(world)
    rng, backward = np.random.default_rng(0), 0

    def turn(begin, end):
        steps = np.linspace(0, 1, lidar.beams)
        poses = compose(begin, steps[:, None] * between(begin, end))
        angles = lidar.angles
        ranges = [
            here.cast(p[:2], np.array([p[2] + a]))[0] for p, a in zip(poses, angles, strict=True)
        ]
        noise = 1 + 0.005 * rng.standard_normal(lidar.beams)
        return deskew(Scan(angles, ranges * noise, 12.0), steps, begin, end).points()

    middle = compose(PLACE, way)
    before, after = turn(PLACE, middle), turn(middle, compose(middle, way))
    for cloud in (before, after):
        backward += np.count_nonzero(np.diff(np.unwrap(np.arctan2(*cloud.T[::-1]))) < 0)
        assert preprocess(cloud).bearings is not None
    assert backward > 0
    found = match(after, before, way + OFF)
    assert found.good
    assert error(found, way)[0] < 0.005


@given(seeds, st.integers(5, 60))
def test_bearings_of_a_scan_never_fall_and_hold_every_beam_once(seed, n):
    rng = np.random.default_rng(seed)
    bearings = np.sort(rng.uniform(-np.pi, np.pi, n).round(1))
    bearings = np.roll(bearings, rng.integers(n))[:: rng.choice([-1, 1])]
    beams = ordered_beams(bearings)
    if beams is None:  # all but few of one bearing
        assert len(np.unique(bearings)) < 5
        return
    rows = np.arange(n) if beams.rows is None else beams.rows
    assert sorted(rows) == list(range(n))
    assert (np.diff(bearings[rows]) >= 0).all()
    assert beams.step > 0
    assert beams.gap > 0


@pytest.mark.parametrize(
    "cloud",
    [
        np.outer(np.linspace(1, 3, 40), [0.6, 0.8]),  # one bearing
        np.full((40, 2), 1.5),  # one point
        np.zeros((40, 2)),
        3 * np.column_stack([np.cos(np.arange(40)), np.sin(np.arange(40))]),  # one range
        np.array([[1.0, 0.0], [1.0, 0.1], [1.0, 0.2]]),
        np.repeat(np.eye(2), 20, axis=0),  # two bearings
        np.vstack([np.zeros((39, 2)), [[1.0, 1.0]]]),
    ],
)
def test_a_point_cloud_without_angles_is_matched_or_rejected_with_complete_surfaces(cloud):
    made, target = preprocess(cloud), preprocess(clouds(0)[1])
    for value in (made.gap, made.spacing, made.point_spacing, made.reach, made.median_range):
        assert np.isfinite(value)
    for found in (match(made, target), match(target, made), match(made, made)):
        assert np.isfinite(found.pose).all()
        assert found.verdict
    assert len(build_submap([made, made], np.zeros((2, 3)))) <= 2 * len(cloud)


# --- merged turns


def merged(lidar, place, turns, rng, kind):
    """The points of turns merged, taken at rest or on the way, as seen from a place."""
    back = np.array([-0.01, -0.004, -0.003]) * (kind == "moving")
    poses = [compose(place, k * back) for k in range(turns - 1, -1, -1)]
    scan = merge_scans([lidar.scan(worlds.by_name("room"), pose, rng) for pose in poses], poses)
    if kind == "nearly at rest":
        scan = Scan(scan.angles + 1e-6 * rng.standard_normal(len(scan.angles)), scan.ranges)
    return scan.points()


@cache
def error_of_merged(lidar, matcher, turns, kind, shuffled=False, runs=10):
    """Root mean square of the error [m], over runs."""
    errors = []
    for seed in range(runs):
        rng = np.random.default_rng(seed)
        both = [merged(lidar, p, turns, rng, kind) for p in (compose(PLACE, MOTION), PLACE)]
        if shuffled:
            both = [rng.permutation(cloud) for cloud in both]
        errors.append(error(matcher(*both, MOTION + OFF))[0])
    return np.sqrt(np.mean(np.square(errors)))


@pytest.mark.parametrize("lidar", [RPLIDAR_A2, NOISY])
@pytest.mark.parametrize("kind", ["at rest", "nearly at rest", "moving"])
@pytest.mark.parametrize("turns", [2, 5, 10])
def test_merged_turns_are_a_scan_and_as_much_better_as_they_are_more(lidar, kind, turns):
    cloud = merged(lidar, PLACE, turns, np.random.default_rng(0), kind)
    assert preprocess(cloud).bearings is not None
    one = error_of_merged(lidar, match, 1, "at rest")
    assert error_of_merged(lidar, match, turns, kind) < 2 * one / np.sqrt(turns)


@pytest.mark.parametrize("lidar", [RPLIDAR_A2, NOISY])
@pytest.mark.parametrize("kind", ["at rest", "nearly at rest", "moving"])
@pytest.mark.parametrize("matcher", [match, point_to_line])
def test_merged_turns_in_any_order_are_matched_no_worse_than_one(lidar, kind, matcher):
    one = error_of_merged(lidar, matcher, 1, "at rest", runs=4)
    assert error_of_merged(lidar, matcher, 10, kind, shuffled=True, runs=4) < 3 * one


@pytest.mark.parametrize("kind", ["at rest", "moving"])
def test_normals_of_merged_turns_stand_across_the_walls(kind):
    rng = np.random.default_rng(0)
    cloud = merged(NOISY, PLACE, 10, rng, kind)
    clean = Scanner(4000, range_error=0.0).scan(worlds.by_name("room"), PLACE, rng).points()
    nearest = np.argmin(np.hypot(*(clean[None] - cloud[::20, None]).transpose(2, 0, 1)), axis=1)
    cosine = np.abs(np.einsum("ij,ij->i", normals(clean)[nearest], normals(cloud)[::20]))
    assert np.nanmedian(cosine) > 0.99
    assert np.isfinite(cosine).mean() > 0.7


@pytest.mark.parametrize("turns", [1, 5])
def test_a_submap_of_merged_turns_is_as_dense_as_they_are_sharp(turns):
    rng, lidar = np.random.default_rng(0), NOISY
    made = [preprocess(merged(lidar, PLACE, turns, rng, "at rest")) for _ in range(4)]
    submap = build_submap(made, np.zeros((4, 3)))
    assert len(submap) < 4 * lidar.beams
    found = match(merged(lidar, compose(PLACE, MOTION), turns, rng, "at rest"), submap, MOTION)
    assert error(found)[0] < 0.006


# --- far from the origin


def shifted(pose, centre):
    """A pose between clouds that both have been moved by a centre."""
    x, y, turn = pose
    return np.array([*(np.array([x, y]) + centre - transform([0, 0, turn], [centre])[0]), turn])


distances = st.floats(1.2, 6).map(lambda exponent: 10**exponent)


@ALL
@settings(max_examples=15)
@given(seeds, distances, st.floats(-np.pi, np.pi))
@example(seed=0, distance=1e6, bearing=np.pi)
def test_moving_both_clouds_far_away_changes_nothing(matcher, seed, distance, bearing):
    rng = np.random.default_rng(seed)
    both = [rng.permutation(cloud) for cloud in clouds(seed % 5)]
    both = [cloud - cloud.mean(axis=0) for cloud in both]
    near = matcher(*both, OFF)
    centre = distance * np.array([np.cos(bearing), np.sin(bearing)])
    guess = shifted(OFF, centre)
    away = matcher(*(cloud + centre for cloud in both), guess, history=True)
    np.testing.assert_allclose(away.history[0].pose, guess, atol=1e-8)
    np.testing.assert_allclose(away.history[-1].pose, away.pose, atol=1e-8)
    assert away.verdict == near.verdict
    assert away.iterations == near.iterations
    # a millionth of the noise, but numbers of 1e6 m have no more digits
    np.testing.assert_allclose(shifted(away.pose, -centre), near.pose, rtol=0, atol=5e-9)


@pytest.mark.parametrize("as_surface", [False, True])
def test_a_scan_is_matched_with_a_map_far_from_its_origin(as_surface):
    here = np.array([4e5, 5e6, 1.2])
    source, target = clouds(0)
    target = transform(here, target)
    if as_surface:
        target = preprocess(target)
    found = match(source, target, compose(here, MOTION + OFF))
    assert found.good
    assert error(found, compose(here, MOTION))[0] < 0.005
    # observed from the scan position, as near the origin: so is its covariance
    near = match(*clouds(0), MOTION + OFF).covariance
    assert (np.diag(found.covariance) < 3 * np.diag(near).max()).all()


def test_the_covariance_of_point_clouds_far_away_is_that_at_the_origin_transformed():
    rng = np.random.default_rng(0)
    source, target = (rng.permutation(cloud) for cloud in clouds(0))
    centre = np.array([700.0, -200.0])
    near, away = match(source, target, MOTION), None
    away = match(source + centre, target + centre, shifted(MOTION, centre))
    dx, dy = transform([0, 0, near.pose[2]], [centre])[0]
    J = np.array([[1, 0, dy], [0, 1, -dx], [0, 0, 1]])
    for sigma in (0.0, 0.01):
        expected = J @ near.inflated_covariance(sigma) @ J.T
        got = away.inflated_covariance(sigma)
        scale = np.sqrt(np.diag(expected))
        np.testing.assert_allclose(got / scale / scale[:, None], expected / scale / scale[:, None],
                                   atol=0.1)  # fmt: skip


@given(seeds, distances)
def test_normals_and_rigid_fits_know_no_distance(seed, distance):
    cloud, rng = clouds(seed % 5)[0], np.random.default_rng(seed)
    centre = distance * np.array([0.6, 0.8])
    lines = normals(cloud)
    known = np.isfinite(normals(cloud + centre)[:, 0]) & np.isfinite(lines[:, 0])
    assert np.mean(known == np.isfinite(lines[:, 0])) > 0.99
    assert np.allclose(normals(cloud + centre)[known], lines[known], atol=1e-5)
    pose = rng.normal(size=3)
    fitted = rigid_fit(cloud + centre, transform(pose, cloud) + centre)
    np.testing.assert_allclose(shifted(fitted, -centre), pose, atol=1e-8)


def test_a_submap_far_away_is_matched_like_one_at_the_origin():
    made = [preprocess(cloud) for cloud in clouds(0)]
    poses = np.array([MOTION, np.zeros(3)])
    source, here = clouds(1)[0], np.array([3e5, -4e5, 0.7])
    near = match(source, build_submap(made, poses), MOTION + OFF)
    away = match(source, build_submap(made, compose(here, poses)), compose(here, MOTION + OFF))
    np.testing.assert_allclose(between(here, away.pose), near.pose, atol=2e-3)
    assert away.good


def test_the_correlative_search_is_made_about_the_centres():
    centre = np.array([2e5, 1e5])
    turned = MOTION + np.array([0, 0, 2.4])
    found = match(*(cloud + centre for cloud in clouds(0)), shifted(turned, centre))
    assert found.searched
    assert found.good
    assert error(found, shifted(MOTION, centre))[1] < 0.005


# --- wild beams


@pytest.mark.parametrize("shuffled", [False, True])
@pytest.mark.parametrize("matcher", [match, point_to_line])
@pytest.mark.parametrize("far", [1e2, 9e6])
@pytest.mark.parametrize("count", [1, 5])
def test_a_few_wild_beams_change_hardly_anything(shuffled, matcher, far, count):
    rng, both = np.random.default_rng(0), clouds(0)
    for cloud in both:
        rows = rng.integers(len(cloud), size=count)
        cloud[rows] *= far / np.hypot(*cloud[rows].T)[:, None]
    if shuffled:
        both = [rng.permutation(cloud) for cloud in both]
    found = matcher(*both, MOTION + OFF)
    assert found.converged
    assert "degenerate" not in found.verdict
    assert error(found)[0] < 0.004


@ALL
@pytest.mark.parametrize("value", [1e8, 1e300, np.finfo(np.float32).max, np.finfo(float).max])
def test_numbers_that_are_no_distances_are_named_and_counted(matcher, value):
    source, target = clouds(0)
    source[[3, 70]] = value, -value
    with pytest.raises(ValueError, match=f"source has 2 of {len(source)} points beyond 1e\\+07 m"):
        matcher(source, target)
