"""The first moment an estimate leaves its band is found where it was put."""

import numpy as np
import pytest

from slamlab.contest.moments import BAND, first_moment
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


def test_the_truth_in_any_frame_never_leaves_its_band():
    assert first_moment(TRUTH, TRUTH, METRES) is None
    assert first_moment(compose([3.0, 1.0, 2.0], TRUTH), TRUTH, METRES) is None


def test_a_slip_is_found_at_its_reading():
    slipped = TRUTH + np.where(np.arange(100) >= 40, 0.3, 0.0)[:, None] * [1, 0, 0]
    moment = first_moment(slipped, TRUTH, METRES)
    assert moment.reading == 41
    assert moment.metres == pytest.approx(16.0)
    assert moment.error == pytest.approx(0.3)
    assert "more by its place" in moment.says


def test_a_turn_is_found_as_soon_as_it_shows_and_named():
    moment = first_moment(turned_at(40, 0.2), TRUTH, METRES)
    # it shows where 0.2 rad have led aside by the band
    assert moment.metres - 16.0 == pytest.approx(BAND / 0.2, abs=0.5)
    assert "mostly by its heading, which was off by 11.5°" in moment.says


def test_a_slow_drift_within_the_band_is_none():
    assert first_moment(TRUTH * [1.04, 1, 1], TRUTH, METRES) is None
    assert first_moment(TRUTH * [1.06, 1, 1], TRUTH, METRES) is not None


def test_where_poses_end_is_a_moment():
    ended = TRUTH.copy()
    ended[30:] = np.nan
    moment = first_moment(ended, TRUTH, METRES)
    assert moment.reading == 31
    assert "no finite pose" in moment.says


def test_being_carried_is_told_as_such():
    carried = TRUTH + np.where(np.arange(100) >= 50, 8.0, 0.0)[:, None] * [0, 1, 0]
    moment = first_moment(TRUTH, carried, METRES)
    assert moment.reading == 51
    assert "had just been carried" in moment.says
