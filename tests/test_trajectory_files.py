"""Trajectories as TUM text, and our trajectory errors beside evo's."""

import gzip

import numpy as np
import pytest
from evo.core import metrics
from evo.tools import file_interface
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from slamlab import sources
from slamlab.cli import main
from slamlab.evaluation import absolute_error, load_tum, relative_error, save_tum
from slamlab.geometry import compose
from slamlab.readings import Trajectory
from slamlab.sources import SourceError
from tests.laws import assert_same_pose

rows = st.integers(1, 6).flatmap(
    lambda n: arrays(float, (n, 4), elements=st.floats(-1e6, 1e6, allow_subnormal=False))
)


def wandering(rng, count=40, noise=0.0):
    """A robot's way with steps of noise."""
    poses = [rng.normal(size=3)]
    steps = np.random.default_rng(1).normal([0.3, 0, 0.1], [0.2, 0.05, 0.4], size=(count - 1, 3))
    for step in steps + noise * rng.normal(size=steps.shape):
        poses.append(compose(poses[-1], step))
    return Trajectory(0.5 * np.arange(count), np.array(poses))


@given(rows)
def test_a_trajectory_reads_back_equal(tmp_path_factory, table):
    path = tmp_path_factory.mktemp("tum") / "way.txt"
    way = Trajectory(table[:, 0], np.column_stack([table[:, 1:3], np.remainder(table[:, 3], 6)]))
    save_tum(way, path)
    again = load_tum(path)
    np.testing.assert_array_equal(again.times, way.times)
    np.testing.assert_array_equal(again.poses[:, :2], way.poses[:, :2])
    assert_same_pose(again.poses, way.poses, 1e-12)


def test_evo_reads_the_same_poses(tmp_path):
    way = wandering(np.random.default_rng(3))
    save_tum(way, tmp_path / "way")
    theirs = file_interface.read_tum_trajectory_file(tmp_path / "way")
    np.testing.assert_array_equal(theirs.timestamps, way.times)
    np.testing.assert_allclose(theirs.positions_xyz[:, :2], way.poses[:, :2])
    for T, pose in zip(theirs.poses_se3, way.poses, strict=True):
        assert np.arctan2(T[1, 0], T[0, 0]) == pytest.approx(pose[2])


def test_what_evo_writes_is_read(tmp_path):
    way = wandering(np.random.default_rng(3))
    save_tum(way, tmp_path / "way")
    theirs = file_interface.read_tum_trajectory_file(tmp_path / "way")
    file_interface.write_tum_trajectory_file(tmp_path / "theirs", theirs)
    again = load_tum(tmp_path / "theirs")
    np.testing.assert_allclose(again.times, way.times)
    assert_same_pose(again.poses, way.poses, 1e-6)


@pytest.fixture
def compared(tmp_path):
    """Two ways, ours and evo's."""
    ways = wandering(np.random.default_rng(5)), wandering(np.random.default_rng(6), noise=0.1)
    for name, way in zip(("truth", "estimate"), ways, strict=True):
        save_tum(way, tmp_path / name)
    theirs = [file_interface.read_tum_trajectory_file(tmp_path / n) for n in ("truth", "estimate")]
    return ways, theirs


def same_as(error, metric_of, theirs):
    """Hold an error of ours equal to evo's metric, in metres and radians."""
    relation = metrics.PoseRelation
    for what, mean, most in (
        (relation.translation_part, error.translation, error.translation_max),
        (relation.rotation_angle_rad, error.rotation, error.rotation_max),
    ):
        metric = metric_of(what)
        metric.process_data(theirs)
        assert mean == pytest.approx(metric.get_statistic(metrics.StatisticsType.rmse), rel=1e-6)
        assert most == pytest.approx(metric.get_statistic(metrics.StatisticsType.max), rel=1e-6)


def test_the_absolute_error_is_evos_with_first_poses_aligned(compared):
    (truth, estimate), (their_truth, theirs) = compared
    theirs.align_origin(their_truth)
    same_as(absolute_error(estimate, truth), metrics.APE, (their_truth, theirs))


@pytest.mark.parametrize("steps", [1, 7])
def test_the_relative_error_is_evos_over_all_pairs(compared, steps):
    (truth, estimate), theirs = compared

    def metric(relation):
        return metrics.RPE(relation, delta=steps, delta_unit=metrics.Unit.frames, all_pairs=True)

    same_as(relative_error(estimate, truth, steps), metric, theirs)


def test_the_turn_about_z_is_read_of_any_quaternion(tmp_path):
    # 90° about z after a tilt, twice as long as a unit quaternion; then the same with its sign
    text = "# stamp tx ty tz qx qy qz qw\n1 2 3 4 0 0 1.4142135 1.4142135\n2,2,3,4,0,0,-1,-1\n"
    (tmp_path / "way").write_bytes(gzip.compress(text.encode()))
    way = load_tum(tmp_path / "way")
    np.testing.assert_allclose(way.poses, [[2, 3, np.pi / 2]] * 2)
    np.testing.assert_array_equal(way.times, [1, 2])


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("1 2 3", "line 2: a line reads"),
        ("1 2 3 0 0 0 0 one", "line 2: a line reads"),
        ("1 2 nan 0 0 0 0 1", "line 2: a line reads"),
        ("1 2 3 0 0 0 0 0", "line 2: a line reads"),
    ],
)
def test_a_damaged_line_is_refused_by_its_number(tmp_path, line, says):
    (tmp_path / "way").write_text(f"0 0 0 0 0 0 0 1\n{line}\n")
    with pytest.raises(SourceError, match=says):
        load_tum(tmp_path / "way")


def test_empty_missing_and_unwritable_files_are_refused(tmp_path):
    (tmp_path / "way").write_text("# nothing\n")
    with pytest.raises(SourceError, match="holds no pose"):
        load_tum(tmp_path / "way")
    with pytest.raises(SourceError, match="no such file"):
        load_tum(tmp_path / "none")
    with pytest.raises(SourceError, match="cannot be written"):
        save_tum(wandering(np.random.default_rng(1)), tmp_path)


def test_run_writes_the_corrected_trajectory(tmp_path, capsys):
    path = tmp_path / "way.tum"
    assert main(["run", "sim:polygon", "--estimator", "odometry", "--tum", str(path)]) == 0
    assert str(path) in capsys.readouterr().out
    source = sources.open("sim:polygon")
    way, pose = load_tum(path), np.zeros(3)
    for reading, time, found in zip(source, way.times, way.poses, strict=True):
        pose = compose(pose, reading.odometry)
        assert time == reading.time
        assert_same_pose(found, pose)


def test_a_trajectory_file_that_cannot_be_written_is_refused(tmp_path, capsys):
    for path in (tmp_path / "no" / "way", tmp_path):
        assert main(["run", "sim:polygon", "--tum", str(path)]) == 2
        said = capsys.readouterr().err
        assert str(path) in said and "Traceback" not in said
