"""Trajectories as text that slamlab writes, and that evo reads and writes."""

import numpy as np
import pytest
from evo.tools import file_interface

from slamlab import sources
from slamlab.cli import main
from slamlab.evaluation import load_trajectory, save_tum
from slamlab.geometry import compose
from slamlab.readings import Trajectory
from slamlab.sources import SourceError
from tests.property_testing import assert_same_pose


def wandering():
    """A robot's way."""
    rng = np.random.default_rng(3)
    poses = [rng.normal(size=3)]
    for step in rng.normal([0.3, 0, 0.1], [0.2, 0.05, 0.4], size=(39, 3)):
        poses.append(compose(poses[-1], step))
    return Trajectory(0.5 * np.arange(len(poses)), np.array(poses))


def test_evo_reads_the_same_poses(tmp_path):
    trajectory = wandering()
    save_tum(trajectory, tmp_path / "way")
    theirs = file_interface.read_tum_trajectory_file(tmp_path / "way")
    np.testing.assert_array_equal(theirs.timestamps, trajectory.times)
    np.testing.assert_allclose(theirs.positions_xyz[:, :2], trajectory.poses[:, :2])
    for T, pose in zip(theirs.poses_se3, trajectory.poses, strict=True):
        assert np.arctan2(T[1, 0], T[0, 0]) == pytest.approx(pose[2])


def test_files_of_evo_are_read(tmp_path):
    trajectory = wandering()
    save_tum(trajectory, tmp_path / "way")
    theirs = file_interface.read_tum_trajectory_file(tmp_path / "way")
    file_interface.write_tum_trajectory_file(tmp_path / "theirs", theirs)
    again = load_trajectory(tmp_path / "theirs")
    np.testing.assert_allclose(again.times, trajectory.times)
    assert_same_pose(again.poses, trajectory.poses, 1e-6)


def test_missing_and_unwritable_files_are_refused(tmp_path):
    with pytest.raises(SourceError, match="does not exist"):
        load_trajectory(tmp_path / "none")
    with pytest.raises(SourceError, match="cannot be written"):
        save_tum(wandering(), tmp_path)


def test_run_writes_the_corrected_trajectory(tmp_path, capsys):
    path = tmp_path / "way.tum"
    words = ["run", "sim:polygon", "--estimator", "odometry", "--out", str(tmp_path)]
    assert main([*words, "--tum", str(path)]) == 0
    assert str(path) in capsys.readouterr().out
    source = sources.open("sim:polygon")
    trajectory, pose = load_trajectory(path), np.zeros(3)
    for reading, time, found in zip(source, trajectory.times, trajectory.poses, strict=True):
        pose = compose(pose, reading.odometry)
        assert time == reading.time
        assert_same_pose(found, pose)
    table = load_trajectory(tmp_path / "trajectory.csv")
    np.testing.assert_array_equal(table.times, trajectory.times)
    assert_same_pose(table.poses, trajectory.poses)


def test_a_trajectory_file_that_cannot_be_written_is_refused(tmp_path, capsys):
    for path in (tmp_path / "no" / "way", tmp_path):
        assert main(["run", "sim:polygon", "--tum", str(path)]) == 2
        output = capsys.readouterr().err
        assert str(path) in output and "Traceback" not in output
