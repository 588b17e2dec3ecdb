"""The first large error of an estimate is found at the right reading."""

import numpy as np
import pytest

from classroom.contest.large_errors import MAX_ERROR, first_large_error
from slamlab.geometry import compose

METRES = 0.4 * np.arange(100)
TRUTH = np.column_stack([METRES, np.zeros(100), np.zeros(100)])


def turned_at(i, angle):
    """An estimate whose heading jumps at a reading."""
    jump = np.where((np.arange(100) >= i)[:, None], [0.0, 0.0, angle], 0.0)
    poses = [np.zeros(3)]
    for k in range(1, 100):
        poses.append(compose(poses[-1], [0.4, 0.0, jump[k, 2] - jump[k - 1, 2]]))
    return np.array(poses)


def test_the_truth_in_any_frame_has_no_large_error():
    assert first_large_error(TRUTH, TRUTH, METRES) is None
    assert first_large_error(compose([3.0, 1.0, 2.0], TRUTH), TRUTH, METRES) is None


def test_a_slip_is_found_at_its_reading():
    slipped = TRUTH + np.where(np.arange(100) >= 40, 0.3, 0.0)[:, None] * [1, 0, 0]
    error = first_large_error(slipped, TRUTH, METRES)
    assert error.reading == 41
    assert error.metres == pytest.approx(16.0)
    assert error.error == pytest.approx(0.3)
    assert "mainly a position error" in error.description


def test_a_turn_is_found_as_soon_as_it_shows_and_named():
    error = first_large_error(turned_at(40, 0.2), TRUTH, METRES)
    # it shows where 0.2 rad have led aside by the band
    assert error.metres - 16.0 == pytest.approx(MAX_ERROR / 0.2, abs=0.5)
    assert "mainly a heading error of 11.5°" in error.description


def test_a_slow_drift_is_not_a_large_error():
    assert first_large_error(TRUTH * [1.04, 1, 1], TRUTH, METRES) is None
    assert first_large_error(TRUTH * [1.06, 1, 1], TRUTH, METRES) is not None


def test_the_first_missing_pose_and_being_carried_are_large_errors_by_their_names():
    ended = TRUTH.copy()
    ended[30:] = np.nan
    carried = TRUTH + np.where(np.arange(100) >= 50, 8.0, 0.0)[:, None] * [0, 1, 0]
    for found, truth, reading, description in (
        (ended, TRUTH, 31, "no finite pose"),
        (TRUTH, carried, 51, "had just been carried"),
    ):
        error = first_large_error(found, truth, METRES)
        assert error.reading == reading
        assert description in error.description
