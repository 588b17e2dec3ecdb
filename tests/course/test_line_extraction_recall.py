"""Evaluation of line extraction, and confirmation of walls by the rules of lesson 08."""

from dataclasses import replace

import numpy as np
import pytest

from course.studies import line_extraction_recall, wall_confirmation
from course.studies.line_extraction_recall import Metres
from slamlab.landmarks.line_fitting import Line
from slamlab.landmarks.ransac import THESIS
from slamlab.landmarks.track_management import TentativeWall
from slamlab.simulation import worlds
from slamlab.simulation.worlds import World
from slamlab.sources.simulated_robot import THESIS_LIDAR as LIDAR

ROOM = World(worlds.box((0, 0), (3.0, 2.5)))
POSE = np.array([0.3, -0.2, 0.7])


def as_lines(walls):
    """Walls of the world as lines that a robot at POSE has found."""
    c, s = np.cos(POSE[2]), np.sin(POSE[2])
    turned = (walls.reshape(-1, 2) - POSE[:2]) @ [[c, -s], [s, c]]
    return [Line(None, None, ends, np.arange(9)) for ends in turned.reshape(-1, 2, 2)]


def judged(found):
    """The judgement of lines found in a scan of the room, which has no dropouts."""
    lidar = replace(LIDAR, dropouts=0.0)
    scan = lidar.scan(ROOM, POSE, np.random.default_rng(1))
    return line_extraction_recall.judge(ROOM, POSE, scan, found)


def test_lines_have_their_share_of_the_walls_and_nothing_false():
    all_walls = judged(as_lines(ROOM.walls))
    assert all_walls.recall == pytest.approx(1, abs=0.01)
    assert all_walls.false == 0
    assert all_walls.right == pytest.approx(11, abs=0.3)  # metres round the room
    length = np.hypot(*(ROOM.walls[0, 2:] - ROOM.walls[0, :2]))
    assert judged(as_lines(ROOM.walls[:1])).recall == pytest.approx(length / 11, abs=0.02)
    nothing = judged([])
    assert (nothing.recall, nothing.false) == (0, 0)


@pytest.mark.parametrize(
    ("lines", "false", "recall"),
    [
        (ROOM.walls + 0.15, 0.9, 0.1),
        (ROOM.walls - 0.2, 0.9, 0.1),
        (np.array([[-0.5, 0.75, 0.5, 1.75]]), 1, 0.02),
    ],
    ids=["outside", "inside", "across"],
)
def test_a_line_beside_or_across_its_wall_is_false(lines, false, recall):
    found = judged(as_lines(lines))
    assert found.false >= false
    assert found.recall < recall


def test_metres_add_up():
    total = Metres(4, 2, 3, 1) + Metres(6, 3, 1, 0)
    assert (total.recall, total.false) == (0.5, 0.2)


def test_positions_are_in_free_space():
    for pose in line_extraction_recall.places(worlds.room(), 20, np.random.default_rng(2)):
        assert worlds.room().cast(pose[:2], np.linspace(0, 2 * np.pi, 90)).min() > 0.3


def test_the_default_finds_more_than_the_thesis_and_invents_next_to_nothing():
    ours, his = (
        line_extraction_recall.evaluate_world(ROOM, ransac, 6) for ransac in (None, THESIS)
    )
    assert ours.recall > 0.95 > his.recall + 0.2
    assert ours.false < 0.02


def test_more_required_observations_confirm_fewer_walls():
    seen = wall_confirmation.observed_walls(worlds.room(), scans=15)
    counts = [len(wall_confirmation.confirmed_walls(seen, needed)) for needed in (1, 2, 4, 16)]
    assert counts == sorted(counts, reverse=True)
    assert counts[-1] == 0  # in 15 scans nothing is seen 16 times


def test_a_wall_seen_twice_in_one_scan_enters_twice_unless_compared():
    observation = (np.array([2.0, 0.0]), np.array([[2.0, -1.0], [2.0, 1.0]]))
    for within_scan, repeats in ((False, 1), (True, 0)):
        walls = wall_confirmation.confirmed_walls(
            [[observation, observation]], within_scan=within_scan
        )
        assert wall_confirmation.duplicate_walls(walls).sum() == repeats
        assert len(walls) == 1 + repeats


def test_false_walls_are_those_where_no_wall_is():
    right, wrong = (
        TentativeWall(np.array([rho, 0.0]), np.array([-0.5, 0.5]), 1, 1) for rho in (1.5, 1.2)
    )
    assert wall_confirmation.false_walls(ROOM, [right, wrong]).tolist() == [False, True]
    np.testing.assert_allclose(wall_confirmation.ends(right), [[1.5, -0.5], [1.5, 0.5]])
