"""Line extraction: the fit has no direction it cannot fit, RANSAC finds walls and little else."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.evaluation import band, nees, precision_metres, recall_metres
from slamlab.geometry import inverse, transform, wrap
from slamlab.landmarks.line_fitting import Line, fit, scan_points, total_least_squares
from slamlab.landmarks.ransac import THESIS, Ransac, lines
from slamlab.landmarks.sonar_lines import sonar_lines
from slamlab.landmarks.spikes import spikes
from slamlab.models.parameters import SensorModel
from slamlab.readings import Scan
from slamlab.simulation import worlds
from slamlab.simulation.range_scanners import Scanner
from slamlab.simulation.worlds.world import World

LIDAR = Scanner(range_error=0.01)
RNG = np.random.default_rng
EXACT = SensorModel(range_error=0.0, range_sigma=0.0, bearing_sigma=0.0)


def wall_scan(rho, alpha, half=0.6, beams=41):
    """A scan of one wall without noise."""
    angles = alpha + np.linspace(-half, half, beams)
    return Scan(angles, rho / np.cos(angles - alpha))


@given(st.floats(0.1, 10), st.floats(-3.1, 3.1))
def test_a_wall_without_noise_is_fitted_whatever_its_direction(rho, alpha):
    points = scan_points(wall_scan(rho, alpha), EXACT)
    (found_rho, found_alpha), _ = fit(points, np.arange(len(points)))
    assert found_rho == pytest.approx(rho, abs=1e-9)
    assert abs(wrap(found_alpha - alpha)) < 1e-9
    np.testing.assert_allclose(total_least_squares(points.points)[0], rho, atol=1e-9)


def test_over_many_noisy_scans_the_fits_errors_match_its_covariance_without_bias():
    sensor, rng = SensorModel(range_error=0.01, bearing_sigma=0.002), np.random.default_rng(0)
    # far more of the wall to one side than to the other, where a biased fit turns
    angles, errors, P = 0.4 + np.linspace(-0.3, 1.1, 90), [], []
    for _ in range(2000):
        noise = rng.standard_normal((2, len(angles)))
        r = 3.0 / np.cos(angles + 0.002 * noise[0] - 0.4) * (1 + 0.01 * noise[1])
        points = scan_points(Scan(angles, r), sensor, floor=1e-6)
        z, R = fit(points, np.arange(len(points)))
        errors.append(z - [3.0, 0.4])
        P.append(R)
    low, high = band(2, 2000, 0.9999)
    assert low < nees(np.array(errors), np.array(P)).mean() < high
    bias = np.mean(errors, axis=0) / np.sqrt(np.mean(P, axis=0)[[0, 1], [0, 1]] / 2000)
    assert np.abs(bias).max() < 4


def test_points_that_a_second_wall_wants_are_left_to_neither():
    """At a corner the errors of the lines are no larger than their covariance."""
    world, rng, errors, P = World([(2.0, -1.5, 2.0, 1.0), (2.0, 1.0, -1.0, 1.0)]), RNG(7), [], []
    for _ in range(150):
        scan = LIDAR.scan(world, np.zeros(3), rng)
        for line in lines(scan, LIDAR.model, rng):
            truth = np.array([2.0, 0.0]) if abs(line.z[1]) < 0.7 else np.array([1.0, np.pi / 2])
            errors.append(line.z - truth)
            P.append(line.R)
    low, high = band(2, len(errors), 0.9999)
    assert 0.8 * low < nees(np.array(errors), np.array(P)).mean() < 1.2 * high


def test_points_selected_by_their_line_make_it_not_overconfident():
    """A tight band moves with the line and keeps what agrees; R must include that error."""
    world, rng, errors, P = World([(2.0, -1.5, 2.0, 1.0)]), RNG(8), [], []
    for _ in range(400):
        scan = LIDAR.scan(world, np.zeros(3), rng)
        best, *_ = lines(scan, LIDAR.model, rng, Ransac(sigmas=2.0))
        errors.append(best.z - [2.0, 0.0])
        P.append(best.R)
    low, high = band(2, 400, 0.9999)
    assert low < nees(np.array(errors), np.array(P)).mean() < high


def test_a_wall_goes_on_behind_a_leg_but_not_across_a_door():
    pillar = World([(2.0, -2.0, 2.0, 2.0)], [(0.8, 0.0, 0.1)])
    door = World([(2.0, -2.0, 2.0, -0.4), (2.0, 0.4, 2.0, 2.0), (4.0, -2.0, 4.0, 2.0)])
    for seed in range(5):
        rng = RNG(seed)
        found = lines(LIDAR.scan(pillar, np.zeros(3), rng), LIDAR.model, rng)
        assert max(line.length for line in found) > 3.6
        found = lines(LIDAR.scan(door, np.zeros(3), rng), LIDAR.model, rng)
        assert sum(1.2 < line.length < 1.8 for line in found if line.z[0] < 3) == 2


def test_a_wall_is_found_to_its_end_though_its_neighbour_wants_the_corner():
    world, length = World(worlds.box((0, 0), (4.0, 3.0))), []
    for seed in range(10):
        rng = RNG(seed)
        found = lines(LIDAR.scan(world, np.zeros(3), rng), LIDAR.model, rng)
        assert len(found) == 4
        length += [line.length for line in found]
    assert np.sum(length) / 10 == pytest.approx(14, abs=0.4)


def scans(name, count, seed=1):
    """Scans of a world from free places, with the poses they were taken from."""
    world, rng = worlds.by_name(name), np.random.default_rng(seed)
    corners = world.walls.reshape(-1, 2)
    while count:
        place = rng.uniform(corners.min(axis=0), corners.max(axis=0))
        around = world.cast(place, np.linspace(0, 2 * np.pi, 90))
        if np.isfinite(around).all() and around.min() > 0.3:
            pose = np.array([*place, rng.uniform(-3, 3)])
            count -= 1
            yield world, pose, LIDAR.scan(world, pose, rng), rng


@pytest.mark.parametrize("name", ["situation-1", "situation-2", "corridor", "room", "table-legs"])
def test_at_one_percent_noise_nearly_all_walls_are_found_and_nearly_nothing_else(name):
    sums = np.zeros(4)
    for world, pose, scan, rng in scans(name, 25):
        walls = lines(scan, LIDAR.model, rng)
        sums += *recall_metres(world, pose, scan, walls), *precision_metres(world, pose, walls)
    seen, found, right, wrong = sums
    assert found > 0.93 * seen
    assert wrong < 0.025 * (right + wrong)


def test_recall_is_relative_to_what_was_visible():
    """The walls themselves, given as lines, are found wholly; a line in mid-room not at all."""
    world, pose = World(worlds.box((0, 0), (4.0, 3.0))), np.array([0.5, 0.2, 0.3])
    scan = replace(LIDAR, range_error=0.0).scan(world, pose, RNG(0))

    def measured(*walls):
        found = [
            Line(np.zeros(2), np.eye(2), transform(inverse(pose), ends), np.arange(20))
            for ends in np.reshape(walls, (-1, 2, 2)).astype(float)
        ]
        return *recall_metres(world, pose, scan, found), *precision_metres(world, pose, found)

    around = pytest.approx(14, abs=0.4)
    assert measured(*world.walls) == (around, measured(*world.walls)[0], around, 0)
    assert measured(*world.walls, *world.walls)[1] == around  # found twice is found
    assert measured((-1, 0, 1, 0)) == (around, 0, 0, pytest.approx(2, abs=0.1))
    assert measured((-2, -1.5, 2, -0.5))[1:3] == (0, 0)
    assert measured((-2, -1.5, 0, -1.5))[1] == pytest.approx(2, abs=0.1)
    # what nobody saw may be on a wall, but not found
    scan.ranges[:200] = np.nan
    seen, found, right, _ = measured(*world.walls)
    assert found == seen < 10 < right


def test_the_thesis_band_fails_with_range():
    """A window of wall readings passes where the wall is near, hardly ever where it is far."""
    share = {}
    for size in ((3.0, 2.5), (8.0, 6.0)):
        room = World(worlds.box((0, 0), size))
        found = [
            len(lines(LIDAR.scan(room, np.zeros(3), rng), LIDAR.model, rng, THESIS))
            for rng in map(np.random.default_rng, range(10))
        ]
        share[size] = np.mean(found)
    assert share[3.0, 2.5] > 3
    assert share[8.0, 6.0] < 1


def test_the_same_seed_finds_the_same_walls_and_each_beam_belongs_to_one():
    ((_, _, scan, _),) = scans("situation-1", 1)
    first, second = (lines(scan, LIDAR.model, np.random.default_rng(3)) for _ in range(2))
    assert [line.z.tolist() for line in first] == [line.z.tolist() for line in second]
    beams = np.concatenate([line.beams for line in first])
    assert len(np.unique(beams)) == len(beams)


N = 60
NOISE = 0.01 * RNG(0).standard_normal(N)
WITHOUT_ANGLES = {
    "no beam": Scan(np.zeros(0), np.zeros(0)),
    "one beam": Scan(np.zeros(1), np.ones(1)),
    "angle step 0": Scan(np.full(N, 0.7), np.linspace(1, 3, N)),
    "angle step 0, one wall": Scan(np.zeros(N), 1 + NOISE),
    "angle step 1e-300": Scan(1e-300 * np.arange(N), np.ones(N)),
    "four returns": Scan(np.linspace(-3, 3, N), np.where(np.arange(N) < 4, 1.0, np.nan)),
    "no return": Scan(np.linspace(-3, 3, N), np.full(N, np.nan)),
    "infinite": Scan(np.linspace(-3, 3, N), np.full(N, np.inf)),
    "zero": Scan(np.linspace(-3, 3, N), np.zeros(N)),
    "angles are NaN": Scan(np.full(N, np.nan), np.ones(N)),
    "largest float": Scan(np.linspace(-3, 3, N), np.full(N, np.finfo(float).max)),
    "1e8 m": Scan(np.linspace(-3, 3, N), np.full(N, 1e8)),
}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scan", WITHOUT_ANGLES.values(), ids=WITHOUT_ANGLES)
def test_a_scan_without_angles_or_ranges_holds_no_landmark(scan):
    for ransac in (Ransac(), THESIS):
        assert lines(scan, LIDAR.model, RNG(0), ransac) == []
    assert sonar_lines(scan, replace(LIDAR.model, half_cone=0.2)) == []
    assert len(spikes(scan).z) == 0


@pytest.mark.filterwarnings("error")
def test_wild_beams_cost_themselves_alone():
    world, rng = World(worlds.box((0, 0), (4.0, 3.0))), RNG(0)
    scan = LIDAR.scan(world, np.zeros(3), rng)
    scan.ranges[[7, 90, 200]] = 1e8, np.finfo(float).max, np.finfo(np.float32).max
    assert len(lines(replace(scan, range_max=np.inf), LIDAR.model, rng)) == 4


@pytest.mark.filterwarnings("error")
@given(st.integers(0, 2**32 - 1), st.integers(0, 60), st.integers(0, 3))
def test_whatever_the_angles_and_ranges_lines_are_finite(seed, n, decimals):
    rng = RNG(seed)
    scan = Scan(rng.normal(0, 1, n).round(decimals), rng.lognormal(0, 0.3, n).round(decimals))
    for line in lines(scan, LIDAR.model, rng):
        assert np.isfinite(np.concatenate([line.z, line.R.ravel(), line.ends.ravel()])).all()
    assert np.isfinite(spikes(scan).z).all()


@pytest.mark.parametrize(
    "wrong", [{"min_inliers": 2}, {"min_inliers": 12}, {"band": 0.0}, {"sigmas": -1.0}]
)
def test_parameters_that_make_no_sense_are_refused(wrong):
    with pytest.raises(ValueError, match=r"min_inliers|above zero"):
        replace(Ransac(), **wrong)
