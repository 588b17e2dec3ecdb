"""Trajectories are paired by time, as evo pairs them; stamps that cannot pair are explained."""

import numpy as np
import pytest
from evo.core import metrics, sync
from evo.tools import file_interface
from hypothesis import given
from hypothesis import strategies as st

from slamlab.evaluation import absolute_error, load_trajectory, relative_error, save_tum
from slamlab.evaluation.time_association import associate
from slamlab.geometry import compose
from slamlab.readings import Trajectory

COUNT = 60
TIMES = 0.1 * np.arange(COUNT)
EPOCH = 1_403_636_579.0


def wandering(times, rng=None):
    """A smooth trajectory at these times, with noise of the poses."""
    theta = 0.9 * np.sin(times)
    poses = np.column_stack([times + np.sin(times), np.cos(0.7 * times), theta])
    if rng is not None:
        poses += rng.normal(0, 0.05, poses.shape)
    return Trajectory(np.asarray(times), poses)


TRUTH = wandering(TIMES)
# steps farther than the tolerance on both sides, so that no two claim one partner
series = st.lists(st.floats(0.03, 0.4), min_size=1, max_size=40).map(np.cumsum)


@given(series, series, st.floats(-0.5, 0.5))
def test_stamps_are_paired_as_evo_pairs_them(first, second, shift):
    second = second + shift
    # evo begins with the shorter one, of equals with the second
    swapped = len(second) > len(first)
    short, long = (first, second) if swapped else (second, first)
    theirs = sync.matching_time_indices(short, long)
    ours = associate(first, second)
    np.testing.assert_array_equal(ours.T, theirs if swapped else theirs[::-1])


any_series = st.lists(st.integers(0, 400), min_size=1, max_size=60, unique=True).map(
    lambda ticks: 0.004 * np.sort(ticks)
)


@given(any_series, any_series, st.floats(0, 0.05))
def test_a_stamp_is_paired_at_most_once_in_order_and_within_the_tolerance(first, second, bound):
    i, j = associate(first, second, bound).T
    assert (np.diff(i) > 0).all() and (np.diff(j) > 0).all()
    assert (np.abs(first[i] - second[j]) <= bound).all() or np.array_equal(first, second)
    # of the fewer only those are left over whose nearest is farther, or is nearer to another
    short, long, paired = (first, second, i) if len(first) < len(second) else (second, first, j)
    for k in np.setdiff1d(np.arange(len(short)), paired):
        gap = np.abs(long - short[k])
        rivals = np.abs(short - long[gap.argmin()])
        assert gap.min() > bound or rivals[np.arange(len(short)) != k].min() <= gap.min() + 1e-12


def assert_is(error, metric_of, trajectories):
    """Assert that an error of ours is evo's, in metres and radians."""
    relation = metrics.PoseRelation
    for what, mean, most in (
        (relation.translation_part, error.translation, error.translation_max),
        (relation.rotation_angle_rad, error.rotation, error.rotation_max),
    ):
        metric = metric_of(what)
        metric.process_data(trajectories)
        assert error.count == len(metric.error)
        rmse = metric.get_statistic(metrics.StatisticsType.rmse)
        assert mean == pytest.approx(rmse, rel=1e-6, abs=1e-9)
        assert most == pytest.approx(metric.error.max(), rel=1e-6, abs=1e-9)


@pytest.mark.parametrize(
    ("period", "phase"), [(0.1, 0.004), (0.25, 0.0), (0.03, 0.002), (0.07, 0.0)]
)
@pytest.mark.parametrize("steps", [1, 3])
def test_errors_of_other_stamps_are_evos(tmp_path, period, phase, steps):
    rng = np.random.default_rng(4)
    ours = TRUTH, wandering(np.arange(0.5, 5.5, period) + phase, rng)
    for name, trajectory in zip(("truth", "estimate"), ours, strict=True):
        save_tum(trajectory, tmp_path / name)
    theirs = [file_interface.read_tum_trajectory_file(tmp_path / n) for n in ("truth", "estimate")]
    truth, estimate = sync.associate_trajectories(*theirs)
    truth_file, estimate_file = (load_trajectory(tmp_path / n) for n in ("truth", "estimate"))
    found = relative_error(estimate_file, truth_file, steps)
    every = {"delta": steps, "delta_unit": metrics.Unit.frames, "all_pairs": True}
    assert_is(found, lambda relation: metrics.RPE(relation, **every), (truth, estimate))
    estimate.align_origin(truth)
    found = absolute_error(estimate_file, truth_file)
    assert found.of == len(ours[1])
    assert_is(found, metrics.APE, (truth, estimate))


def test_readings_that_were_lost_cost_their_poses_alone():
    kept = np.delete(np.arange(COUNT), [3, 17, 18, 40])
    found = absolute_error(Trajectory(TIMES[kept], TRUTH.poses[kept]), TRUTH)
    assert (found.count, found.of) == (COUNT - 4, COUNT - 4)
    assert found.translation < 1e-12
    found = absolute_error(TRUTH, Trajectory(TIMES[kept], TRUTH.poses[kept]))
    assert (found.count, found.of) == (COUNT - 4, COUNT)


@pytest.mark.parametrize("times", [np.zeros(COUNT), np.arange(COUNT), TIMES[::-1], TIMES + EPOCH])
def test_equal_stamps_pair_one_by_one_whatever_they_are(times):
    moved = Trajectory(times, compose(np.array([3.0, -1.0, 0.5]), TRUTH.poses))
    found = absolute_error(moved, Trajectory(times, TRUTH.poses))
    assert found.count == COUNT and found.translation < 1e-12
    assert relative_error(moved, Trajectory(times, TRUTH.poses), 5).count == COUNT - 5


REASONS = {
    "a clock ahead": (TIMES + 5000, "begins 5000 s after the truth.*add -5000 s"),
    "a clock behind": (TIMES - 5000, "begins 5000 s before the truth.*add 5000 s"),
    "nanoseconds": (1e9 * TIMES, "stamps of the estimate are in nanoseconds.*times by 1e-09"),
    "since 1970": (TIMES + EPOCH, "counts from 1970.*add -1403636579 s"),
    "nanoseconds since 1970": (1e9 * (TIMES + EPOCH), "nanoseconds.*; then .* counts from 1970"),
    "indices": (np.arange(COUNT), "the times of the estimate are its indices"),
    "between the others": (TIMES + 0.05, "differ by 0.05 s .*larger tolerance, or if the clocks"),
    "backwards": (TIMES[::-1].copy(), "are not ascending: 5.8 s of pose 1 comes after 5.9 s; sort"),
}


@pytest.mark.parametrize(("times", "why"), REASONS.values(), ids=REASONS)
@pytest.mark.parametrize("error", [absolute_error, relative_error])
def test_stamps_that_do_not_pair_are_explained(times, why, error):
    with pytest.raises(ValueError, match=why):
        error(Trajectory(times, TRUTH.poses), TRUTH)
    other = why.replace("the estimate", "the truth")
    if "begins" not in why and "counts" not in why:
        with pytest.raises(ValueError, match=other):
            error(TRUTH, Trajectory(times, TRUTH.poses))


@pytest.mark.parametrize("shift", [-31.7, 0.35, 0.9, 3.2])
def test_another_clock_is_found_though_some_stamps_pair_by_chance(shift):
    times = np.cumsum(np.random.default_rng(0).uniform(0.3, 0.5, 900))
    assert len(associate(times + shift, times)) > 2
    with pytest.raises(ValueError, match=f"if only the clocks differ, add {-shift:g} s"):
        absolute_error(wandering(times + shift), wandering(times))
    # the start of one is missing
    with pytest.raises(ValueError, match="larger tolerance, or if the clocks differ"):
        absolute_error(wandering(times[100:] + shift), wandering(times[:-50]))
    # an overlap of a few poses is compared
    assert absolute_error(wandering(times[-5:]), wandering(times[:-2])).count == 3


def test_an_error_needs_a_ground_truth():
    with pytest.raises(ValueError, match="there is no ground truth: use relations_error"):
        absolute_error(TRUTH, None)


@pytest.mark.parametrize("power", [3, 6, 9])
@pytest.mark.parametrize("origin", [0.0, 77.0])
def test_the_factor_is_found_though_half_of_the_poses_are_missing(power, origin):
    times = (TIMES[::2] + origin) * 10**power
    with pytest.raises(ValueError, match=f"its times by {10.0**-power:g}") as raised:
        absolute_error(Trajectory(times, TRUTH.poses[::2]), TRUTH)
    assert ("add -77 s" in str(raised.value)) == bool(origin)


def test_a_greater_tolerance_pairs_what_is_declared_near():
    between = wandering(TIMES[:-1] + 0.04)
    assert absolute_error(between, TRUTH, tolerance=0.05).count == COUNT - 1


def test_another_rate_pairs_fewer_and_it_is_reported():
    found = absolute_error(wandering(np.arange(40) / 7), TRUTH)
    assert (found.count, found.of) == (6, 40)


def test_trajectories_without_poses_are_refused():
    with pytest.raises(ValueError, match="the estimate has 0 poses and the truth 60"):
        absolute_error(Trajectory(TIMES[:0], TRUTH.poses[:0]), TRUTH)
