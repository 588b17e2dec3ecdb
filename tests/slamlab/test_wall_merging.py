"""Pieces of one wall become one landmark; two walls and the two sides of one do not."""

import numpy as np
import pytest

from slamlab import estimators
from slamlab.estimators.wall_merging import ends_of, same_wall_landmarks
from slamlab.estimators.wall_slam import WallSlam
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.landmark_models import LINES
from slamlab.geometry import between, wrap
from slamlab.models.parameters import RobotModel
from slamlab.readings import Reading
from slamlab.simulation.range_scanners import Scanner
from slamlab.simulation.worlds import World
from slamlab.sources import simulation

FAR, FRONT = (2.5, np.pi / 2), (1.0, np.pi / 2)  # ρ and α of two walls, from below
SCANNER = Scanner(beams=400, range_error=0.005, range_max=3.0)  # it sees one door at a time


def house(out_of_line=0.0):
    """A corridor with two doors to a room; a piece of its far wall may stand out of line."""
    front = [[a, 1, b, 1] for a, b in ((-0.5, 0.5), (1.5, 5.5), (6.5, 7.5))]
    box = [[-0.5, -1, 7.5, -1], [-0.5, -1, -0.5, 2.5], [7.5, -1, 7.5, 2.5]]
    ends = [(-0.5, 2.5, 0.0), (2.5, 4.5, out_of_line), (4.5, 7.5, 0.0)]
    far = [[a, 2.5 + y, b, 2.5 + y] for a, b, y in (ends if out_of_line else [(-0.5, 7.5, 0)])]
    return World(np.array(front + box + far, dtype=float))


def drive(world, seed, watch=lambda slam: None):
    """Along the corridor, through the second door, back through the room; the estimator."""
    rng = np.random.default_rng(seed)
    corridor = [[x, 0, 0] for x in np.arange(0, 6.1, 0.2)]
    turned = [[6, 0, turn] for turn in np.linspace(0, np.pi / 2, 8)]
    inward = [[6, y, np.pi / 2] for y in np.arange(0, 1.7, 0.2)]
    round_ = [[6, 1.7, turn] for turn in np.linspace(np.pi / 2, np.pi, 8)]
    back = [[x, 1.7, np.pi] for x in np.arange(6, 0.4, -0.2)]
    robot = RobotModel(distance_error=0.02, turn_error=0.02, turn_per_metre=0.01)
    slam = WallSlam(robot, SCANNER.model, np.random.default_rng(0))
    pose = np.zeros(3)
    for k, place in enumerate(np.array(corridor + turned + inward + round_ + back)):
        step = between(pose, place)
        slip = step * rng.normal(1, 0.02, 3) + [0, 0, rng.normal(0, 0.01 * abs(step[0]))]
        slam.step(Reading(float(k), slip, scan=SCANNER.scan(world, place, rng)))
        watch(slam)
        pose = place
    return slam


def those_of(slam, line):
    """The ids of the landmarks that are a line, from the side given by its normal."""
    off = slam.filter.landmarks() - line
    off[:, 1] = wrap(off[:, 1])
    return [i for i, d in zip(slam.filter.ids, off, strict=True) if (abs(d) < 0.05).all()]


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_wall_seen_through_doors_is_several_landmarks_first_and_one_at_the_end(seed):
    counts = []
    slam = drive(house(), seed, lambda slam: counts.append(len(those_of(slam, FAR))))
    assert max(counts) > 1
    (far,) = those_of(slam, FAR)
    assert slam.merged >= 1
    low, high = slam.extents[far][0, 0], slam.extents[far][-1, 1]
    assert high - low > 7.5 and len(slam.walls()) == sum(map(len, slam.extents.values()))
    assert set(slam.extents) == set(slam.filter.ids)


def test_the_two_sides_of_a_wall_stay_two_landmarks():
    slam = drive(house(), 1)
    below, above = those_of(slam, FRONT), those_of(slam, (-FRONT[0], -FRONT[1]))
    assert below and above and not set(below) & set(above)


def test_a_wall_ten_centimetres_out_of_line_is_never_associated_with_the_other():
    for seed in (1, 2):
        slam = drive(house(out_of_line=0.1), seed)
        assert len(those_of(slam, (2.6, np.pi / 2))) == 1
        assert those_of(slam, FAR)


@pytest.mark.slow
def test_no_landmark_of_situation_1_repeats_another():
    source = simulation("situation-1", np.random.default_rng(1))
    slam = estimators.run(source, estimators.make("walls", source)).estimator
    assert same_wall_landmarks(slam.filter, hulls(slam)) is None
    rho, alpha = slam.filter.landmarks().T
    for i, a in enumerate(slam.filter.ids):
        for j, b in enumerate(slam.filter.ids[:i]):
            alike = abs(rho[i] - rho[j]) < 0.05 and abs(wrap(alpha[i] - alpha[j])) < 0.05
            (low, high), (begin, end) = hulls(slam)[a], hulls(slam)[b]
            assert not (alike and low < end and begin < high)
    assert slam.merged >= 1 and f"{slam.merged} merged" in slam.status


def hulls(slam):
    return {i: np.array([parts[0, 0], parts[-1, 1]]) for i, parts in slam.extents.items()}


def test_walls_of_the_first_scan_are_in_the_map_and_no_longer_tentative():
    source = simulation("situation-2", np.random.default_rng(1))
    slam = estimators.make("walls", source)
    slam.step(next(iter(source)))
    assert len(slam.filter.ids) == 7 and slam.status.startswith("7 walls, 0 tentative")


def test_only_parallel_walls_that_touch_and_may_be_one_are_pieces_of_one():
    def map_of(*walls):
        mak = MAK(np.zeros(3), np.zeros((3, 3)), kind=LINES)
        for i, (rho, alpha) in enumerate(walls):
            beyond = 2 * min(rho, 0) * np.array([np.cos(alpha), np.sin(alpha)])
            mak.predict([*beyond, 0], np.zeros((3, 3)))
            mak.add([i], [LINES.h(mak.pose, (rho, alpha))], np.diag([0.01, 0.005]) ** 2)
        return mak

    near, one = {0: np.array([0, 1.0]), 1: np.array([1.4, 2])}, (3.0, 0.1)
    assert same_wall_landmarks(map_of(one, (3.02, 0.11)), near) == (0, 1)
    assert same_wall_landmarks(map_of(one, (3.06, 0.1)), near) is None  # too far for its σ
    assert same_wall_landmarks(map_of(one, (3.0, 0.1 + np.radians(4))), near) is None
    assert same_wall_landmarks(map_of(one, (-3.0, 0.1 + np.pi)), near) is None  # its other side
    assert same_wall_landmarks(map_of(one, one), near | {1: np.array([1.6, 2])}) is None
    assert same_wall_landmarks(map_of(one), near) is None
    three = near | {2: np.array([0.5, 1.5])}
    assert same_wall_landmarks(map_of(one, (3.02, 0.1), (3.001, 0.1)), three) == (0, 2)


def test_the_ends_of_pieces_lie_on_their_line_where_they_were_seen():
    line, t = np.array([2.0, 0.7]), np.array([[-1, 0.5], [1.0, 3.0]])
    ends = ends_of(line, t)
    assert ends.shape == (2, 2, 2)
    np.testing.assert_allclose(ends @ [np.cos(0.7), np.sin(0.7)], 2.0)
    np.testing.assert_allclose(ends @ [-np.sin(0.7), np.cos(0.7)], t)
