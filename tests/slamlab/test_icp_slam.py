"""ICP SLAM (Tuček's): one test for each erratum of its listing, and what it must reach."""

import numpy as np
import pytest

from slamlab import estimators, sources
from slamlab.estimators.icp_slam import IcpSlam, stands_still
from slamlab.estimators.runner import run
from slamlab.geometry import between, compose, transform
from slamlab.readings import Reading, Scan
from slamlab.scanmatching import point_to_point
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.simulation.worlds import polygon

PATH = [np.zeros(3)]
for _motion in ([0.2, 0.0, -0.3], [0.15, 0.05, 0.2], [0.2, -0.05, -0.25], [0.1, 0.1, 0.15]):
    PATH.append(compose(PATH[-1], _motion))
POOR = Scan(np.array([0.0, 0.5]), np.array([1.0, 1.1]))


def readings(poor=(), empty=(), poses=PATH):
    """A drive through the polygon with perfect odometry; some scans poor or missing."""
    rng, world, last = np.random.default_rng(4), polygon(), poses[0]
    for i, pose in enumerate(poses):
        scan = RPLIDAR_A2.scan(world, pose, rng)
        scan = POOR if i in poor else None if i in empty else scan
        yield Reading(float(i), between(last, pose), scan)
        last = pose


def driven(slam, stream):
    for reading in stream:
        slam.step(reading)
    return slam


def layer(slam, name, kind):
    return next(a for a in slam.layers() if a.name == name and type(a).__name__ == kind)


def near(pose, true, metres=0.03, radians=0.03):
    d = between(true, pose)
    return np.hypot(d[0], d[1]) < metres and abs(d[2]) < radians


@pytest.mark.parametrize("plain", [False, True])
def test_the_second_scans_motion_is_not_lost(plain):
    slam = driven(IcpSlam(plain), readings(poses=PATH[:2]))
    assert near(slam.pose, PATH[1], 0.08)
    seen = [len(r.scan.points()) for r in readings(poses=PATH[:2])]
    assert len(layer(slam, "corrected", "Points").xy) == sum(seen)


def test_the_first_scan_is_map_and_previous_scan_at_once():
    slam = driven(IcpSlam(), readings(poses=PATH[:1]))
    assert len(layer(slam, "corrected", "Points").xy) > 100
    assert np.array_equal(slam.pose, np.zeros(3))
    slam.step(list(readings(poses=PATH[:2]))[1])
    assert slam.unmatched == 0
    assert not np.array_equal(slam.pose, PATH[1])


def test_zero_motion_means_the_identity_and_not_a_sum_of_zero():
    assert stands_still(np.zeros(3))
    # 2 cos α + x + y + 1 = 0: the listing's sum calls this real motion zero
    assert not stands_still(np.array([-1.5, -1.5, 0.0]))
    assert not stands_still(np.array([0.01, 0.0, 0.0]))
    assert not stands_still(np.array([0.0, 0.0, np.radians(2)]))


def test_points_do_not_pile_up_while_the_robot_stands():
    poses = [PATH[0], *[PATH[1]] * 20]
    slam = driven(IcpSlam(), readings(poses=poses))
    count = len(layer(slam, "corrected", "Points").xy)
    moving = driven(IcpSlam(), readings(poses=PATH[:2]))
    assert count == len(layer(moving, "corrected", "Points").xy)
    assert len(slam.trajectory()) == len(poses)


def test_an_empty_reading_is_skipped_and_counted_and_slam_goes_on():
    slam = driven(IcpSlam(), readings(poor=[2]))
    assert slam.skipped == 1
    assert len(slam.trajectory()) == len(PATH)
    assert near(slam.pose, PATH[-1])


def test_a_reading_without_a_scan_moves_the_pose_and_counts_as_nothing_lost():
    slam = driven(IcpSlam(), readings(empty=[2]))
    assert slam.skipped == 0
    assert near(slam.trajectory().poses[2], PATH[2])
    assert near(slam.pose, PATH[-1])


def test_two_poor_scans_in_a_row_never_become_the_scan_to_match_with():
    slam = driven(IcpSlam(), readings(poor=[2, 3]))
    assert slam.skipped == 2
    assert all(near(p, t) for p, t in zip(slam.trajectory().poses, PATH, strict=True))
    assert slam.unmatched == 0


def test_after_a_gap_the_scan_is_matched_with_the_last_good_one_from_all_odometry_since():
    wrong = [
        Reading(r.time, r.odometry + (np.array([0.03, 0, 0.03]) if i else 0), r.scan)
        for i, r in enumerate(readings(poor=[1, 2]))
    ]
    slam = driven(IcpSlam(), wrong)
    assert near(slam.trajectory().poses[3], PATH[3], 0.02, 0.02)
    assert not near(slam.trajectory().poses[2], PATH[2], 0.02, 0.02)


def test_naive_points_are_moved_by_the_accumulated_transform():
    stream = list(readings())
    slam = driven(IcpSlam(), stream)
    expected = np.concatenate(
        [transform(p, r.scan.points()) for p, r in zip(PATH, stream, strict=True)]
    )
    assert np.allclose(layer(slam, "naive", "Points").xy, expected)
    assert np.allclose(slam.naive_pose, PATH[-1])


def test_two_slams_share_nothing():
    one, other = IcpSlam(), IcpSlam()
    driven(one, readings())
    assert len(layer(other, "corrected", "Points").xy) == 0
    assert len(other.trajectory()) == 0
    assert np.array_equal(other.pose, np.zeros(3))


def test_a_match_that_fails_leaves_the_odometry_and_is_counted():
    first, second = list(readings(poses=PATH[:2]))
    far = Scan(second.scan.angles, np.full(400, 11.0))
    slam = driven(IcpSlam(), [first, Reading(1.0, second.odometry, far)])
    assert slam.unmatched == 1
    assert np.allclose(slam.pose, PATH[1])


@pytest.mark.slow
def test_the_polygon_with_the_thesis_wrong_odometry_comes_out_right_in_100_of_100_seeds():
    for seed in range(100):
        source = sources.open("sim:polygon-wrong", np.random.default_rng(seed))
        result = run(source, estimators.make("icp", source))
        errors = between(source.truth.poses, result.trajectory.poses)
        assert np.hypot(errors[:, 0], errors[:, 1]).max() < 0.05, f"seed {seed}"
        assert np.abs(errors[:, 2]).max() < np.radians(2), f"seed {seed}"


def test_trimming_corrects_what_plain_icp_makes_of_the_polygon():
    plain, trimmed = [], []
    for seed in range(5):
        source = sources.open("sim:polygon", np.random.default_rng(seed))
        clouds = [r.scan.points() for r in source]
        poses = source.truth.poses
        for i, motion in enumerate(between(poses[:-1], poses[1:])):
            for keep, errors in ((1.0, plain), (0.8, trimmed)):
                found = point_to_point(clouds[i + 1], clouds[i], motion, keep=keep)
                errors.append(np.hypot(*between(motion, found.pose)[:2]))
    assert np.median(trimmed) < np.median(plain)


def test_dead_reckoning_is_the_sum_of_the_odometry():
    slam = driven(estimators.make("odometry", None), readings())
    assert np.allclose(slam.trajectory().poses, PATH)


def test_an_unknown_estimator_is_named_with_those_there_are():
    with pytest.raises(ValueError, match=r"unknown estimator 'kalman'; choose from odometry, icp"):
        estimators.make("kalman", None)
