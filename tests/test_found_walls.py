"""The judge of line extraction is fair, and walls enter a map by the rules that lesson 08 tells."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import worlds
from slamlab.landmarks.line_fitting import Line
from slamlab.landmarks.ransac import THESIS
from slamlab.landmarks.tentative_walls import TentativeWall
from slamlab.sources.simulated_robot import THESIS_LIDAR as LIDAR
from slamlab.studies import found_walls, walls_on_trial
from slamlab.studies.found_walls import Metres
from slamlab.worlds import World

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
    return found_walls.judge(ROOM, POSE, scan, found)


def test_who_finds_every_wall_has_full_recall_and_nothing_false():
    all_walls = judged(as_lines(ROOM.walls))
    assert all_walls.recall == pytest.approx(1, abs=0.01)
    assert all_walls.false == 0
    assert all_walls.right == pytest.approx(11, abs=0.3)  # metres round the room


def test_who_finds_one_wall_has_its_share():
    length = np.hypot(*(ROOM.walls[0, 2:] - ROOM.walls[0, :2]))
    assert judged(as_lines(ROOM.walls[:1])).recall == pytest.approx(length / 11, abs=0.02)


def test_who_finds_nothing_has_nothing_false():
    nothing = judged([])
    assert (nothing.recall, nothing.false) == (0, 0)


@pytest.mark.parametrize("move", [[0.15, 0.15], [-0.2, -0.2]])
def test_a_line_beside_its_wall_is_false(move):
    beside = judged(as_lines(ROOM.walls + np.tile(move, 2)))
    assert beside.false > 0.9
    assert beside.recall < 0.1


def test_a_line_across_a_wall_is_false():
    across = judged(as_lines(np.array([[-0.5, 0.75, 0.5, 1.75]])))
    assert across.recall < 0.02
    assert across.false == 1


def test_metres_add_up():
    total = Metres(4, 2, 3, 1) + Metres(6, 3, 1, 0)
    assert (total.recall, total.false) == (0.5, 0.2)


def test_places_are_free():
    for pose in found_walls.places(worlds.room(), 20, np.random.default_rng(2)):
        assert worlds.room().cast(pose[:2], np.linspace(0, 2 * np.pi, 90)).min() > 0.3


def test_the_default_finds_more_than_the_thesis_and_invents_next_to_nothing():
    ours, his = (found_walls.judge_places(ROOM, ransac, 6) for ransac in (None, THESIS))
    assert ours.recall > 0.95 > his.recall + 0.2
    assert ours.false < 0.02


def test_more_sightings_let_fewer_walls_in():
    seen = walls_on_trial.sightings(worlds.room(), scans=15)
    counts = [len(walls_on_trial.entered(seen, needed)) for needed in (1, 2, 4, 16)]
    assert counts == sorted(counts, reverse=True)
    assert counts[-1] == 0  # in 15 scans nothing is seen 16 times


def test_a_wall_seen_twice_in_one_scan_enters_twice_unless_compared():
    sight = (np.array([2.0, 0.0]), np.array([[2.0, -1.0], [2.0, 1.0]]))
    for within_scan, repeats in ((False, 1), (True, 0)):
        walls = walls_on_trial.entered([[sight, sight]], within_scan=within_scan)
        assert walls_on_trial.repeated(walls).sum() == repeats
        assert len(walls) == 1 + repeats


def test_false_walls_are_those_where_no_wall_is():
    right, wrong = (
        TentativeWall(np.array([rho, 0.0]), np.array([-0.5, 0.5]), 1, 1) for rho in (1.5, 1.2)
    )
    assert walls_on_trial.false(ROOM, [right, wrong]).tolist() == [False, True]
    np.testing.assert_allclose(walls_on_trial.ends(right), [[1.5, -0.5], [1.5, 0.5]])
