"""Tuček's live test: eMIR drives round the obstacles from the page, and SLAM localises it.

Emulators move in simulated time, the real drivers are in between.
"""

import numpy as np
import pytest

from slamlab.geometry import between
from tests.course.browser.driving import NAME, Robot
from tests.timeouts import until

# round the table, and home; the pillars stay on the outside
ROUND = [(1.3, -0.5), (3.3, -0.1), (3.4, 1.6), (2.2, 2.3), (0.9, 1.9), (0.6, 0.4), (0.0, 0.0)]


@pytest.fixture
def robot(visit):
    """A robot whose view runs."""
    visit.open(NAME)
    visit.run(0)
    driven = Robot(visit)
    driven.wait(1)
    driven.press("▶ run")
    driven.at_rest()
    yield driven
    driven.tell("exit")
    assert visit.errors == []
    assert visit.foreign_requests == []


def off(poses, name):
    """How far a pose is from the true one [m], [rad]."""
    x, y, turn = between(poses["true"], poses[name])
    return np.hypot(x, y), abs(turn)


@pytest.mark.slow
def test_driven_round_the_table_the_corrected_pose_is_right_and_the_naive_one_is_not(robot, visit):
    # by a button and by keys
    robot.press("▲ forward")
    until(lambda: robot.poses()["true"][0] >= 0.3)
    robot.press("■ stop")
    robot.at_rest()
    robot.canvas.click()
    visit.page.keyboard.press("ArrowLeft")
    until(lambda: robot.poses()["true"][2] >= 0.3)
    visit.page.keyboard.press("Space")
    robot.at_rest()
    # and, where it matters, by numbers, from the start again
    robot.tell("reset")
    robot.at_rest()
    for place in ROUND:
        poses = robot.go_to(*place)
        assert np.hypot(*poses["true"][:2] - place) < 0.1
    (metres, turn), (naive_metres, naive_turn) = (off(poses, n) for n in ("corrected", "naive"))
    reported = f"corrected {metres:.3f} m {turn:.3f}, naive {naive_metres:.3f} m {naive_turn:.3f}"
    print(reported, visit.run(1).locator(".jp-OutputArea-output").text_content())
    assert metres < 0.05 and turn < np.radians(3), reported
    assert naive_metres > 5 * metres and naive_turn > 5 * turn, reported
