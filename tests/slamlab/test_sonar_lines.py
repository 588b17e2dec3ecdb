"""Walls by ultrasound: the cone model finds them and no edges, its covariance holds, SLAM runs."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab import estimators, sources
from slamlab.estimators.runner import run
from slamlab.estimators.wall_slam import observed_walls
from slamlab.evaluation import absolute_error, band, nees, pose_nees
from slamlab.geometry import wrap
from slamlab.landmarks.sonar_lines import fit_cone, slant, sonar_lines
from slamlab.readings import Scan
from slamlab.simulation.range_scanners import RPLIDAR_A2, ULTRASONIC
from slamlab.simulation.worlds.world import World
from slamlab.sources import simulation
from slamlab.sources.simulated_robot import THESIS_ROBOT

SONAR = ULTRASONIC.model
SMOOTH = replace(ULTRASONIC, dropouts=0.1, max_incidence=np.radians(30))
RUNS = pytest.mark.parametrize("runs", [8, pytest.param(30, marks=pytest.mark.slow)])
STEPS = np.linspace(15, 80, 6).astype(int)


def echoes(rho, alpha, turn=0.0, half_cone=SONAR.half_cone):
    """A scan of one endless wall by sound, without noise, as the formula has it."""
    angles = ULTRASONIC.angles + turn
    u = np.maximum(np.abs(wrap(angles - alpha)) - half_cone, 0)
    seen = u < np.radians(80)
    ranges = np.where(seen, rho / np.cos(np.where(seen, u, 0)), np.nan)
    return Scan(angles, ranges, range_max=ULTRASONIC.range_max)


@given(st.floats(0.1, 3), st.floats(-1.5, 1.5), st.floats(-3, 3))
def test_an_exact_wall_is_found_wherever_it_stands_and_once(rho, alpha, turn):
    (line,) = sonar_lines(echoes(rho, alpha + turn, turn), SONAR)
    assert line.z[0] == pytest.approx(rho, abs=1e-6)
    assert abs(wrap(line.z[1] - alpha - turn)) < 1e-6
    normal = np.array([np.cos(alpha + turn), np.sin(alpha + turn)])
    np.testing.assert_allclose(line.ends @ normal, rho, atol=1e-5)


@given(st.floats(0.2, 3), st.floats(-1, 1), st.floats(0.05, 0.4))
def test_its_step_solves_for_distance_and_direction_whatever_the_cone(rho, alpha, half_cone):
    sensor, scan = replace(SONAR, half_cone=half_cone), echoes(rho, alpha, 0.0, half_cone)
    rows = np.abs(wrap(scan.angles - alpha)) < 0.7
    z = np.array([1.01 * rho, alpha + 0.01])
    for _ in range(8):
        z, R = fit_cone(scan.angles[rows], scan.ranges[rows], sensor, z[1], z[0])
    np.testing.assert_allclose(z, [rho, alpha], atol=1e-8)
    assert np.linalg.eigvalsh(R).min() > 0


def test_an_object_inside_the_cone_gives_no_direction():
    angles = np.linspace(-0.1, 0.1, 5)
    _, R = fit_cone(angles, np.full(5, 2.0), SONAR, 0.0, 2.0)
    assert R is None


@given(st.floats(-10, 10), st.floats(-10, 10))
def test_a_beam_without_width_meets_the_wall_where_it_points(beta, alpha):
    assert slant(beta, alpha, 0.0) == pytest.approx(wrap(beta - alpha), abs=1e-12)
    assert slant(alpha + 0.2, alpha, 0.3) == 0


@pytest.mark.slow
@pytest.mark.parametrize("scanner", [ULTRASONIC, SMOOTH])
@pytest.mark.parametrize("direction", [0.0, 0.5, -1.4])
def test_over_many_scans_of_a_wall_line_errors_match_their_covariance(scanner, direction):
    normal = np.array([np.cos(direction), np.sin(direction)])
    way = 20 * np.array([-normal[1], normal[0]])
    world = World([[*(1.5 * normal - way), *(1.5 * normal + way)]])
    rng, errors, P = np.random.default_rng(4), [], []
    for _ in range(400):
        scan = scanner.scan(world, np.zeros(3), rng)
        for line in sonar_lines(scan, scanner.model):
            errors.append(line.z - [1.5, direction])
            P.append(line.R)
    assert 200 < len(errors) <= 400
    assert 1.6 < nees(np.array(errors), np.array(P)).mean() < 2.5


def seen(world, places, scanner=ULTRASONIC):
    """Count the walls observed on average from some positions, ten times each."""
    rng = np.random.default_rng(5)
    found = [
        len(sonar_lines(scanner.scan(world, np.array(place), rng), scanner.model))
        for place in places
        for _ in range(10)
    ]
    return np.mean(found)


@pytest.mark.parametrize("distance", [0.6, 1.0, 2.0])
def test_an_object_that_echoes_as_a_point_is_not_a_wall(distance):
    before = [[-distance, y, 0.0] for y in (-0.2, 0.0, 0.1)]
    legs = World(circles=[(0.0, 0.0, 0.02)])
    edge = World([[0, 0, 1.5, 1.5], [0, 0, 1.5, -1.5]])  # of a box, its corner towards the robot
    pillar = World(circles=[(0.15, 0.0, 0.15)])
    for world in (legs, edge, pillar):
        assert seen(world, before) < 0.05
    wall = World([[0.0, -3.0, 0.0, 3.0]])
    assert seen(wall, before) > 0.8


def test_lost_echoes_shorten_a_wall_but_make_none():
    wall, before = World([[0.0, -3.0, 0.0, 3.0]]), [[-1.0, 0.0, 0.0]]
    short = replace(ULTRASONIC, max_incidence=np.radians(30))
    whole, smooth = (
        scanner.scan(wall, np.array(before[0]), np.random.default_rng(1)).valid.sum()
        for scanner in (ULTRASONIC, short)
    )
    assert smooth < whole
    assert seen(wall, before, SMOOTH) > 0.7
    # only the region of constant depth is left: it gives no direction
    mirror = replace(ULTRASONIC, max_incidence=np.radians(3))
    assert seen(wall, before, mirror) == 0


def test_the_sensor_decides_by_what_its_walls_are_found():
    assert RPLIDAR_A2.model.half_cone == 0  # test_slip_relocalisation has its walls
    assert SONAR.half_cone == pytest.approx(ULTRASONIC.cone / 2)
    (line,) = observed_walls(echoes(1.0, 0.3), SONAR, rng=None)
    assert line.z[0] == pytest.approx(1.0)


def test_the_room_by_sound_is_a_source_and_its_log_keeps_the_cone(tmp_path):
    source = sources.open("sim:room-ultrasonic", np.random.default_rng(1))
    sources.write(source, tmp_path / "heard.log")
    received = sources.open(tmp_path / "heard.log")
    assert received.name == source.name == "sim:room-ultrasonic"
    assert received.sensor.half_cone == source.sensor.half_cone == SONAR.half_cone
    live, replayed = (run(one, estimators.make("walls", one)) for one in (source, received))
    np.testing.assert_array_equal(live.trajectory.poses, replayed.trajectory.poses)
    assert "walls" in live.estimator.status


def room_by_sound(seed, robot=None, scanner=ULTRASONIC):
    """A drive through the room: the run, its poses (n, 3) and their covariances (n, 3, 3)."""
    source, P = simulation("room", np.random.default_rng(seed), lidar=scanner, robot=robot), []
    slam = estimators.make("walls", source)
    result = run(source, slam, lambda _, after: P.append(after.filter.block([0, 1, 2])))
    return result, result.trajectory.poses, np.array(P)


@pytest.mark.slow
@RUNS
def test_through_the_room_it_nearly_halves_odometrys_error(runs):
    off, naive = [], []
    for seed in range(runs):
        result, _, _ = room_by_sound(seed)
        truth = result.source.truth
        off.append(absolute_error(result.trajectory, truth).translation)
        naive.append(absolute_error(result.naive, truth).translation)
    assert np.mean(off) < 0.65 * np.mean(naive)
    assert np.mean(np.array(off) < naive) > 0.85


@pytest.mark.slow
@RUNS
@pytest.mark.parametrize("scanner", [ULTRASONIC, SMOOTH])
def test_with_odometry_noise_as_modelled_the_pose_nees_stays_in_its_band(scanner, runs):
    """The room's own robot has wheels unequal for good, which no model of chance foresees."""
    results = [room_by_sound(seed, THESIS_ROBOT, scanner) for seed in range(100, 100 + runs)]
    sizes = [
        pose_nees(poses[STEPS], P[STEPS], result.source.truth.poses[STEPS])
        for result, poses, P in results
    ]
    low, high = band(3, runs, 1 - 0.05 / len(STEPS))  # all six within it 95 times in 100
    mean = np.mean(sizes, axis=0)
    assert np.all((low < mean) & (mean < high))
