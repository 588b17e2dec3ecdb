"""EKF-SLAM with walls (line landmarks) in Smolec's situations; its parts on their own."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.distance import pdist

from slamlab import estimators
from slamlab.estimators.runner import run
from slamlab.estimators.wall_slam import WallSlam
from slamlab.evaluation import absolute_error, nees
from slamlab.geometry import wrap
from slamlab.landmarks.corners import corners
from slamlab.landmarks.downsampling import DownsampledPoints
from slamlab.landmarks.ransac import lines
from slamlab.landmarks.spikes import spikes
from slamlab.landmarks.track_management import TrackManager, extent, overlap
from slamlab.landmarks.wall_segments import split_at_gaps, union
from slamlab.models.observation import g
from slamlab.models.parameters import RobotModel, SensorModel
from slamlab.readings import Reading, Scan
from slamlab.simulation import worlds
from slamlab.simulation.range_scanners import Scanner
from slamlab.sources import simulation

LIDAR = Scanner(range_error=0.005)


@pytest.fixture(scope="module", params=["situation-1", "situation-2"])
def driven(request):
    """A situation driven through, with what the filter believed of its pose after each step."""
    source, P = simulation(request.param, np.random.default_rng(2)), []
    slam = estimators.make("walls", source)
    result = run(source, slam, lambda _, after: P.append(after.filter.block([0, 1, 2])))
    return source, result, np.array(P)


@pytest.mark.slow
def test_it_ends_much_nearer_to_the_truth_than_odometry(driven):
    source, result, _ = driven
    off, naive = (
        absolute_error(t, source.truth).translation for t in (result.trajectory, result.naive)
    )
    assert off < naive / 5
    assert off < 0.05


def test_it_is_consistent_by_its_nees(driven):
    source, result, P = driven
    errors = result.trajectory.poses - source.truth.poses
    errors[:, 2] = wrap(errors[:, 2])
    assert np.median(nees(errors[10:], P[10:])) < 9


def test_its_walls_lie_on_walls_and_none_is_drawn_twice_over_nothing(driven):
    source, result, _ = driven
    found, true = result.estimator.walls(), source.world.walls
    assert 5 <= len(found) <= 6 * len(true)
    end_to_end = true[:, 2:] - true[:, :2]
    normals = np.column_stack([-end_to_end[:, 1], end_to_end[:, 0]])
    normals /= np.hypot(*normals.T)[:, None]
    middles = (found[:, :2] + found[:, 2:]) / 2
    off = np.abs(np.sum((middles[:, None] - true[:, :2]) * normals, axis=2)).min(axis=1)
    assert off.max() < 0.3


def test_a_scan_with_nothing_in_it_is_counted_and_the_robot_goes_on():
    slam = WallSlam(RobotModel(), SensorModel(), np.random.default_rng(0))
    empty = Scan(np.linspace(-3, 3, 40), np.full(40, np.nan))
    slam.step(Reading(0.0, np.array([0.1, 0, 0]), scan=empty))
    slam.step(Reading(1.0, np.array([0.1, 0, 0])))
    assert slam.skipped == 2
    np.testing.assert_allclose(slam.pose, [0.2, 0, 0])


# ---- its parts --------------------------------------------------------------------------------


def test_every_leg_that_stands_free_is_a_spike_and_a_bare_room_has_none():
    world = worlds.table_legs()
    scan = LIDAR.scan(world, np.zeros(3), np.random.default_rng(1))
    found = g(np.zeros(3), spikes(scan).z)
    off = np.hypot(*(found[:, None] - world.circles[None, :, :2]).transpose(2, 0, 1)).min(axis=1)
    assert len(found) >= 14 and off.max() < 0.06
    bare = LIDAR.scan(worlds.situation_2(), np.zeros(3), np.random.default_rng(1))
    assert len(spikes(bare).z) == 0


def test_a_leg_across_the_seam_of_a_turn_is_one_spike():
    angles = np.linspace(-np.pi, np.pi, 100, endpoint=False)
    ranges = np.full(100, 4.0)
    ranges[[-1, 0, 1]] = 1.0
    (z,) = spikes(Scan(angles, ranges)).z
    assert z[0] == pytest.approx(1.0)
    assert abs(wrap(z[1] - angles[0])) < 1e-9


def test_empty_beams_make_no_spikes_and_a_leg_before_an_open_view_is_one():
    angles = np.linspace(-np.pi, np.pi, 400, endpoint=False)
    smooth, open_view = np.full(400, 3.0), np.full(400, np.nan)
    smooth[[50, 53, 60, 61, 64, 65]] = np.nan
    assert len(spikes(Scan(angles, smooth)).z) == 0
    open_view[100:104] = 1.5
    ((r, bearing),) = spikes(Scan(angles, open_view)).z
    assert r == 1.5 and bearing == pytest.approx(angles[100:104].mean())


def test_corners_are_where_walls_meet_and_errors_match_their_R():
    world, errors, P = worlds.situation_2(), [], []
    rng = np.random.default_rng(3)
    for _ in range(60):
        for corner in corners(lines(LIDAR.scan(world, np.zeros(3), rng), LIDAR.model, rng)):
            off = g(np.zeros(3), corner.z) - world.walls[:, :2]
            nearest = world.walls[np.hypot(*off.T).argmin(), :2]
            r, beta = np.hypot(*nearest), np.arctan2(nearest[1], nearest[0])
            errors.append(corner.z - [r, beta])
            P.append(corner.R)
    assert len(errors) > 150
    assert 1.5 < np.mean(nees(np.array(errors), np.array(P))) < 3.5


def wall(rho, alpha, low, high):
    """An observed line, transformed to the world: line and ends."""
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    way = np.array([-normal[1], normal[0]])
    return np.array([rho, alpha]), rho * normal + np.outer([low, high], way)


def test_a_tentative_wall_is_confirmed_at_its_third_observation_and_deleted_when_unseen():
    trial = TrackManager(min_observations=3, max_misses=2)
    one, other = wall(2.0, 0.5, -1, 1), wall(2.0, 0.5, 4, 5)
    assert [trial.update([one]) for _ in range(3)] == [[False], [False], [True]]
    assert trial.tentative == []
    trial.update([one])
    trial.update([])
    assert trial.update([one]) == [False] and trial.tentative[0].observations == 2
    for _ in range(2):
        trial.update([])
    assert trial.tentative == []
    trial.update([one, other])
    assert len(trial.tentative) == 2  # collinear, but far apart: two walls


@pytest.mark.slow
def test_through_a_door_no_wall_is_drawn():
    source = simulation("situation-1", np.random.default_rng(1))
    slam = run(source, estimators.make("walls", source)).estimator
    for x in (0.0, 5.0):  # the middles of the doors at y = 2 and y = 3.5
        for x1, y1, x2, y2 in slam.walls():
            if abs(y1 - y2) < 0.3 and min(abs(y1 - 2), abs(y1 - 3.5)) < 0.3:
                assert not min(x1, x2) + 0.2 < x < max(x1, x2) - 0.2


@given(st.lists(st.floats(-3, 3), max_size=30), st.lists(st.floats(-3, 3), max_size=30))
def test_segments_hold_what_stands_close_and_their_union_holds_both(first, second):
    first, second = split_at_gaps(np.array(first)), split_at_gaps(np.array(second))
    for parts in (first, second, union(first, second)):
        assert np.all(parts[:, 0] <= parts[:, 1]) and np.all(parts[1:, 0] > parts[:-1, 1])
    both = union(first, second)
    for low, high in [*first, *second]:
        assert np.any((both[:, 0] <= low) & (high <= both[:, 1]))
    assert np.sum(np.diff(both)) <= np.sum(np.diff(first)) + np.sum(np.diff(second)) + 1e-9


def test_a_gap_splits_two_segments_and_a_lone_hit_is_none():
    np.testing.assert_allclose(
        split_at_gaps(np.array([1.0, 0.8, 0.9, 2.0, 2.1, 3.0])), [[0.8, 1], [2, 2.1]]
    )


def test_an_extent_lies_along_its_line_and_extents_that_nearly_touch_overlap():
    line, ends = wall(3.0, 1.0, -0.7, 1.2)
    np.testing.assert_allclose(extent(line, ends), [-0.7, 1.2], atol=1e-12)
    assert overlap((0, 1), (1.4, 2)) and not overlap((0, 1), (1.6, 2))


@pytest.mark.slow
@given(st.lists(st.tuples(st.floats(-1, 1), st.floats(-1, 1)), max_size=60))
def test_kept_points_keep_their_distance_and_every_other_one_is_near_a_kept_one(points):
    points = np.array(points).reshape(-1, 2)
    downsampled = DownsampledPoints(0.1)
    kept = sum(downsampled.add(part) for part in np.array_split(points, 3))
    assert kept == len(downsampled.xy)
    if kept > 1:
        assert pdist(downsampled.xy).min() > 0.1
    if len(points):
        off = np.hypot(*(points[:, None] - downsampled.xy[None]).transpose(2, 0, 1))
        assert off.min(axis=1).max() <= 0.1 + 1e-9
