"""Range scanners (lidar): scans have the noise, dropouts and range limits that they state."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from slamlab.simulation.range_scanners import GP2D120, RPLIDAR_A2, ULTRASONIC, Scanner
from slamlab.simulation.worlds import ring, room
from slamlab.simulation.worlds.world import World
from tests.slamlab.support import refuses

IDEAL = Scanner(range_error=0.0)
WELL = World(circles=[(0.0, 0.0, 5.0)])


def test_an_ideal_lidar_reports_true_distances():
    world, pose = room(), np.array([0.3, 0.2, 0.7])
    scan = IDEAL.scan(world, pose, np.random.default_rng(0))
    np.testing.assert_array_equal(scan.ranges, world.cast(pose[:2], pose[2] + IDEAL.angles))


def test_a_full_circle_repeats_no_beam_and_a_sector_includes_both_ends():
    steps = np.diff(IDEAL.angles)
    np.testing.assert_allclose(steps, 2 * np.pi / 400)
    assert IDEAL.angles[-1] + steps[0] == pytest.approx(np.pi)
    sector = Scanner(beams=181, field_of_view=np.pi).angles
    np.testing.assert_allclose(sector[[0, 90, -1]], [-np.pi / 2, 0, np.pi / 2], atol=1e-12)


def test_a_noisy_bearing_reads_a_neighbours_range_at_the_nominal_angle():
    lidar = replace(IDEAL, beams=50_001, field_of_view=1.0, bearing_sigma=0.01)
    wall = World([(2.0, -9.0, 2.0, 9.0)])
    scan = lidar.scan(wall, np.zeros(3), np.random.default_rng(2))
    np.testing.assert_array_equal(scan.angles, lidar.angles)
    flown = np.arccos(2 / scan.ranges)
    off = flown - np.abs(scan.angles)
    aside = np.abs(scan.angles) > 0.1
    assert off[aside].std() == pytest.approx(lidar.model.bearing_sigma, rel=0.02)


def test_the_share_of_dropouts_is_as_set():
    lidar = replace(IDEAL, beams=100_000, dropouts=0.03)
    scan = lidar.scan(WELL, np.zeros(3), np.random.default_rng(3))
    assert np.isnan(scan.ranges).mean() == pytest.approx(0.03, abs=0.003)


def test_nothing_nearer_or_farther_than_the_limits_is_reported():
    world = World(ring([(-0.1, -20), (20, -20), (20, 20), (-0.1, 20)]))
    lidar = Scanner(range_min=0.2, range_max=12.0, range_error=0.05)
    scan = lidar.scan(world, np.zeros(3), np.random.default_rng(4))
    true = world.cast((0, 0), lidar.angles)
    assert np.isnan(scan.ranges[(true < 0.15) | (true > 16)]).all()
    returned = scan.ranges[~np.isnan(scan.ranges)]
    assert len(returned) > 0
    assert returned.min() >= 0.2
    assert returned.max() <= 12.0


def test_open_space_returns_nothing():
    scan = RPLIDAR_A2.scan(World(), np.zeros(3), np.random.default_rng(5))
    assert np.isnan(scan.ranges).all()
    assert scan.points().shape == (0, 2)


def test_the_same_generator_gives_the_same_scan_and_a_scene_takes_no_more_draws_than_another():
    one, two = np.random.default_rng(6), np.random.default_rng(6)
    first = RPLIDAR_A2.scan(room(), np.zeros(3), one)
    again = RPLIDAR_A2.scan(room(), np.zeros(3), np.random.default_rng(6))
    np.testing.assert_array_equal(first.ranges, again.ranges)
    RPLIDAR_A2.scan(World(), np.zeros(3), two)
    assert one.random() == two.random()


def test_the_scanners_are_those_of_their_data_sheets():
    assert RPLIDAR_A2.beams == 400
    assert (RPLIDAR_A2.model.range_min, RPLIDAR_A2.model.range_max) == (0.2, 12.0)
    r = np.linspace(0.2, 12, 50)
    assert np.all(RPLIDAR_A2.model.sigma(r) < 0.0075 * r)
    # the infrared one's noise grows with the square of the range
    np.testing.assert_allclose(
        GP2D120.model.sigma(np.array([0.1, 0.2])), [0.00125, 0.005], rtol=0.03
    )
    np.testing.assert_allclose(np.degrees(np.diff(GP2D120.angles)), 2)
    np.testing.assert_allclose(np.degrees(np.diff(ULTRASONIC.angles)), 5)


test_a_lidar_that_is_invalid_is_refused = refuses(
    lambda wrong: Scanner(**wrong),
    ({"beams": 0}, "at least one beam"),
    ({"field_of_view": 360}, "in radians"),
    ({"range_min": 3.0, "range_max": 2.0}, "the limits are 3.0 and 2.0 m"),
    ({"dropouts": 3}, "a share from 0 to 1"),
    ({"range_error": -0.1}, "not be negative"),
)


def test_worlds_and_sensors_need_no_geometry_so_exercises_on_it_may_use_them():
    allowed = "slamlab.simulation.worlds, slamlab.simulation.range_scanners"
    code = f"import sys, {allowed}; print('slamlab.geometry' in sys.modules)"
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert shown.stdout.strip() == "False"


def test_a_wide_beam_returns_the_nearest_surface_in_its_cone():
    wall = World([(-5.0, 2.0, 5.0, 2.0)])
    silent = replace(ULTRASONIC, range_error=0.0, range_sigma=0.0)
    scan = silent.scan(wall, np.array([0, 0, np.pi / 2]), np.random.default_rng(0))
    off = np.abs(scan.angles) - silent.cone / 2
    seen = scan.valid
    # within half a cone of the perpendicular its foot is met, beyond it the cone's nearer edge
    expected = 2 / np.cos(np.maximum(off, 0))
    np.testing.assert_allclose(scan.ranges[seen], expected[seen], rtol=1e-4)
    assert np.all(scan.ranges[seen] <= 2 / np.cos(scan.angles[seen]) + 1e-12)


def test_a_beam_without_width_and_a_very_narrow_one_agree():
    world, pose = room(), np.array([0.3, 0.2, 0.7])
    narrow = replace(IDEAL, cone=1e-9)
    np.testing.assert_allclose(
        narrow.scan(world, pose, np.random.default_rng(0)).ranges,
        IDEAL.scan(world, pose, np.random.default_rng(0)).ranges,
        atol=1e-6,
    )


@pytest.mark.parametrize("scanner", [RPLIDAR_A2, GP2D120, ULTRASONIC])
@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_an_estimator_gets_the_noise_of_its_source(scanner, share):
    r = share * scanner.range_max
    limitless = {"range_min": 0.0, "range_max": 2 * scanner.range_max, "dropouts": 0.0}
    thin = replace(scanner, beams=100_000, bearing_sigma=0.0, cone=0.0, **limitless)
    scan = thin.scan(World(circles=[(0.0, 0.0, r)]), np.zeros(3), np.random.default_rng(9))
    errors, sigma = scan.ranges - r, scanner.model.sigma(r)
    assert errors.std() == pytest.approx(sigma, rel=0.02)
    assert abs(errors.mean()) < 5 * sigma / np.sqrt(len(errors))
    assert scanner.model.bearing_sigma >= scanner.bearing_sigma
