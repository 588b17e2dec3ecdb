"""Studies of lesson 11: particle filters in one dimension and in a room, and the stored table."""

import numpy as np
import pytest

from course.studies import independent_particle_sets
from course.studies import particle_filter_1d as rail
from course.studies.global_localisation import MAP, NEAR, evidence, film, look, near
from course.studies.study_command import stored
from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.ekf_slam import EkfSlam
from slamlab.filters.particle_filters.particle_set import ParticleSet
from slamlab.sources.landmark_runs import LandmarkRun, Loop


def test_a_drive_is_the_same_whatever_follows_it():
    runs = [film(n, 3, 30, 9.0, injected, carried=12) for n, injected in ((20, 0), (300, 9))]
    truths = [np.array([truth for _, truth in pictures]) for pictures in runs]
    np.testing.assert_array_equal(*truths)
    jumps = np.hypot(*np.diff(truths[0][:, :2], axis=0).T)
    assert jumps[12] > 2
    assert np.delete(jumps, 12).max() < 0.3


def test_the_measurements_hardly_distinguish_a_position_from_the_opposite_one():
    assert 0.8 < np.median([evidence(seed, 10) for seed in range(40)]) < 1.5


@pytest.mark.parametrize("seed", range(0, 60, 12))
def test_the_post_is_out_of_range_from_both_positions_while_particles_converge(seed):
    way = np.array([truth[:2] for _, truth in film(1, seed)])
    here, opposite = np.hypot(*(np.stack([way, -way]) - MAP[4]).T).T
    assert here[:11].min() > 1.2
    assert opposite.min() > 1.2
    assert here.min() < 1.2


def test_the_post_is_seen_from_near_by_only():
    rng, beside = np.random.default_rng(0), np.array([*MAP[4] - [0.9, 0], 0.0])
    assert [len(look(beside, rng, reach)) for reach in (0.5, 1.2)] == [len(MAP) - 1, len(MAP)]


def test_near_is_the_weight_within_reach():
    rows = np.array([[0, 0, 0], [NEAR - 0.01, 0, 3], [0, NEAR + 0.01, 0]])
    assert near(ParticleSet(rows, np.array([0.5, 0.3, 0.2])), [0, 0, 1]) == pytest.approx(0.8)


@pytest.mark.parametrize("seed", [1, 2])
def test_in_one_dimension_particles_match_the_kalman_filter_and_noise_counted_twice_is_halved(
    seed,
):
    zs = rail.measured(seed)
    right, twice, largest = (
        rail.by_samples(zs, np.random.default_rng(2), 40_000, rule)
        for rule in (rail.RIGHT, rail.TWICE, rail.LARGEST)
    )
    np.testing.assert_allclose(right, rail.by_kalman(zs), atol=0.02)
    np.testing.assert_allclose(twice, rail.by_kalman(zs, rail.Q / 2), atol=0.02)
    assert right[1] - twice[1] > 0.02
    assert largest[1] < twice[1]


def test_a_resampled_set_drifts_as_far_as_theory_predicts():
    n, steps, sigma = 50, 40, 0.1
    walked, claimed = independent_particle_sets.resampled_drift(
        n, steps, sigma, np.random.default_rng(3), sets=3000
    )
    kept = (1 - 1 / n) ** np.arange(1, steps + 1)
    start = 2 * sigma**2 * (1 - 1 / n)  # of n draws, by n
    np.testing.assert_allclose(walked, np.sqrt(start * (1 - kept)), rtol=0.06)
    np.testing.assert_allclose(claimed, np.sqrt(start * kept), rtol=0.03)


def test_without_noise_nobody_is_off_and_odometry_claims_nothing():
    quiet = Loop(steps=12, v_sigma=0, omega_sigma=0, range_sigma=1e-9, bearing_sigma=1e-9)
    run = LandmarkRun(quiet, np.random.default_rng(0))
    rms, outside = independent_particle_sets.judged(run, DeadReckoning())
    assert rms < 1e-12
    assert np.isnan(outside)
    of_ekf = independent_particle_sets.judged(run, EkfSlam(run.robot, run.sensor))
    assert of_ekf == pytest.approx((0, 0), abs=1e-6)


def test_the_stored_table_supports_the_lesson():
    table = stored("particle_filters")
    found, maps = table["found"], table["maps"]
    assert table["runs"] >= 50
    assert found["5000"][1] > found["200"][2]  # intervals apart: many samples find more robots
    assert table["injected"]["50"]["found"][1] > table["injected"]["0"]["found"][2]
    outside = {name: row["outside"] for name, row in maps.items() if "outside" in row}
    assert outside[independent_particle_sets.EKF][2] < 0.1
    assert outside[independent_particle_sets.SETS][1] > 0.5
    assert outside["FastSLAM, 1000"][2] < outside["FastSLAM, 100"][1]
    assert maps[independent_particle_sets.SETS]["against odometry"][2] < 0
