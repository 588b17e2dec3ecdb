"""Trajectory errors (ATE, RPE) and the relations error."""

import numpy as np
import pytest

from slamlab.evaluation import absolute_error, relations_error, relative_error
from slamlab.evaluation.relations import Relations
from slamlab.evaluation.time_association import nearest_timestamps
from slamlab.geometry import between, compose
from slamlab.readings import Trajectory

RNG = np.random.default_rng(6)
TIMES = np.arange(8) * 2.0
POSES = RNG.normal(size=(8, 3))
PATH = Trajectory(TIMES, POSES)
PAIRS = np.array([[0, 1], [2, 5], [7, 3]])
TRUE = Relations(TIMES[PAIRS], between(POSES[PAIRS[:, 0]], POSES[PAIRS[:, 1]]))


def test_errors_do_not_depend_on_where_the_frame_lies():
    moved = Trajectory(TIMES, compose(np.array([3.0, -2.0, 1.1]), POSES))
    assert absolute_error(moved, PATH).translation < 1e-12
    assert relative_error(moved, PATH).rotation < 1e-12
    assert relations_error(moved, TRUE).translation < 1e-12


def test_a_known_offset_is_measured_in_metres_and_radians():
    poses = POSES.copy()
    poses[5] = compose(poses[5], [0.3, 0.4, 0.2])
    wrong = Trajectory(TIMES, poses)
    error = absolute_error(wrong, PATH)
    assert error.translation_max == pytest.approx(0.5)
    assert error.rotation_max == pytest.approx(0.2)
    assert error.translation == pytest.approx(0.5 / np.sqrt(8))
    found = relations_error(wrong, TRUE)
    assert found.count == 3
    assert found.translation == pytest.approx(0.5 / 3)
    assert found.rotation == pytest.approx(0.2 / 3)


def test_only_relations_within_two_milliseconds_of_a_pose_count():
    stamps = TRUE.stamps + np.array([[0.0019, -0.0019], [0.0, 0.0025], [0.0, 0.0]])
    assert relations_error(PATH, Relations(stamps, TRUE.poses)).count == 2


@pytest.mark.parametrize("count", [1, 2, 30])
def test_the_nearest_time_is_found_in_any_order(count):
    times, stamps = RNG.normal(size=count), RNG.normal(size=(40, 2))
    index, gap = nearest_timestamps(times, stamps)
    assert np.allclose(gap, np.abs(times - stamps[..., None]).min(axis=-1))
    assert np.allclose(np.abs(times[index] - stamps), gap)


def test_there_is_no_motion_over_as_many_steps_as_poses():
    with pytest.raises(ValueError, match="steps must be from 1 to 7 for 8 poses"):
        relative_error(PATH, PATH, steps=8)
