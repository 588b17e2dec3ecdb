"""Scans with beams in any order, merged turns and wild beams are matched as ordinary ones."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab.deskewing import deskew, merge_scans
from slamlab.geometry import between, compose
from slamlab.readings import Scan
from slamlab.scanmatching import match, normals, point_to_line, preprocess
from slamlab.scanmatching.beam_order import ordered_beams
from slamlab.scanmatching.submap import build_submap
from slamlab.simulation import worlds
from slamlab.simulation.range_scanners import RPLIDAR_A2, Scanner
from tests.slamlab.room_clouds import ALL, MOTION, OFF, PLACE, clouds, error, seeds

NOISY = Scanner(range_error=0.0, range_sigma=0.02)  # more than beams are apart, once merged


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
