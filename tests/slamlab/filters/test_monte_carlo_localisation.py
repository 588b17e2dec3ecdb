"""Particle filters agree with the Kalman filter where that is exact, and with plain loops."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from slamlab import models
from slamlab.estimators.ekf_slam import Q_arc
from slamlab.filters import kalman_filter
from slamlab.filters.particle_filters import likelihood
from slamlab.filters.particle_filters.monte_carlo_localisation import MCL
from slamlab.filters.particle_filters.motion_sampling import sample_motion
from slamlab.filters.particle_filters.particle_set import ParticleSet, uniform
from slamlab.geometry import wrap
from slamlab.models.parameters import RobotModel
from slamlab.simulation.differential_drive import arc
from tests.property_testing import observation_vectors, points, poses
from tests.slamlab.filters.textbook import random_covariance

R = np.array([[0.01, 0.0005], [0.0005, 0.001]])
ROBOT = RobotModel(distance_error=0.05, turn_error=0.04, turn_per_metre=0.06, slip=0.02, base=0.3)
STILL = RobotModel(distance_error=0, turn_error=0, turn_per_metre=0)
MAP = np.array([[4.0, 1.0], [-2.0, 3.5], [1.0, -5.0], [-3.0, -2.0]])


def log_density(v, S):
    """The textbook's, by matrices."""
    return -0.5 * (v @ np.linalg.inv(S) @ v + math.log(np.linalg.det(2 * math.pi * S)))


@given(
    st.lists(poses, min_size=1, max_size=4),
    st.lists(points, min_size=1, max_size=4),
    observation_vectors,
)
def test_a_scan_is_as_likely_as_a_plain_loop_finds_it(x, p, z):
    x, p = np.array(x), np.array(p)
    assume(np.min(np.hypot(*(p - x[:, None, :2]).T)) > 0.01)
    z = np.tile(z, (len(p), 1))
    noises = np.array([R * (1 + k) for k in range(len(p))])
    v = z - models.h(x[:, None], p)
    v[..., 1] = wrap(v[..., 1])
    # on the seam either way round is as right as the other
    assume(np.pi - np.abs(v[..., 1]).max() > 1e-6)
    plain = [sum(log_density(*pair) for pair in zip(row, noises, strict=True)) for row in v]
    np.testing.assert_allclose(likelihood.of_scan(x, p, z, noises), plain, rtol=1e-9, atol=1e-6)
    pairs = sum(likelihood.of_observation(x, p[j], z[j], noises[j]) for j in range(len(p)))
    np.testing.assert_allclose(pairs, plain, rtol=1e-9, atol=1e-6)


def test_more_particles_than_a_block_get_the_same_weights_as_few():
    rng = np.random.default_rng(0)
    x = rng.uniform(-3, 3, (2 * likelihood.BLOCK + 7, 3))
    z, noises = models.h(np.zeros(3), MAP), np.tile(R, (4, 1, 1))
    together = likelihood.of_scan(x, MAP, z, noises)
    alone = [likelihood.of_scan(x[k : k + 1], MAP, z, noises)[0] for k in (0, 2047, 2048, 4102)]
    np.testing.assert_allclose(together[[0, 2047, 2048, 4102]], alone, rtol=1e-12)


def test_without_ids_one_landmark_equals_a_known_one_and_more_give_a_mixture_likelihood():
    rng = np.random.default_rng(1)
    x, z = rng.normal(size=(5, 3)) * 0.1, models.h(np.zeros(3), MAP[:1])
    named = likelihood.of_scan(x, MAP[:1], z, R[None])
    nameless = likelihood.of_unassociated_scan(x, MAP[:1], z, R[None], clutter=0)
    np.testing.assert_allclose(nameless, named, rtol=1e-9)
    each = [likelihood.of_scan(x, MAP[j : j + 1], z, R[None]) for j in range(4)]
    mixed = likelihood.of_unassociated_scan(x, MAP, z, R[None], clutter=0)
    np.testing.assert_allclose(mixed, np.log(np.mean(np.exp(each), axis=0)), rtol=1e-9)


def test_the_posterior_of_a_linear_gaussian_case_is_the_kalman_filters():
    """Four steps in the plane; bounds are six standard errors of a cloud of its effective size."""
    rng, n = np.random.default_rng(2), 20_000
    F, Q, H, R = np.eye(2), random_covariance(rng, 2, 0.1), np.eye(2), random_covariance(rng, 2)
    exact = kalman_filter.belief([0, 0], random_covariance(rng, 2))
    cloud = ParticleSet.unweighted(rng.multivariate_normal(exact.x, exact.P, n))
    for _ in range(4):
        u, z = rng.normal(size=2), rng.normal(size=2)
        exact = kalman_filter.predict(exact, F, Q, F, u)
        cloud = ParticleSet(cloud.rows + u + rng.multivariate_normal([0, 0], Q, n), cloud.weights)
        innovation, S = z - exact.x, exact.P + R
        exact, _ = kalman_filter.update(exact, z, H, R)
        cloud, evidence = cloud.reweighted(likelihood.log_gaussian(z - cloud.rows, R))
        assert abs(evidence - log_density(innovation, S)) < 0.05
        sigmas, few = np.sqrt(np.diag(exact.P)), np.sqrt(cloud.effective_sample_size)
        assert (np.abs(cloud.moments.x - exact.x) < 6 * sigmas / few).all()
        off = np.abs(cloud.moments.P - exact.P) / np.outer(sigmas, sigmas)
        assert (off < 6 * np.sqrt(2) / few).all()
        cloud = cloud.resampled(rng)


def test_the_covariance_of_moved_particles_is_that_of_the_motion():
    rng, pose = np.random.default_rng(3), np.array([1.0, -2.0, 0.7])
    odometry = arc(0.15, 0.35, 0.4)
    cloud = ParticleSet.unweighted(sample_motion(np.tile(pose, (40_000, 1)), odometry, ROBOT, rng))
    Q = Q_arc(pose, odometry, ROBOT)
    scale = np.sqrt(np.outer(np.diag(Q), np.diag(Q)))
    np.testing.assert_allclose(cloud.moments.P / scale, Q / scale, atol=0.05)


def test_the_mean_of_headings_round_the_seam_is_on_the_seam():
    rows = np.zeros((2, 3))
    rows[:, 2] = np.pi - 0.1, -np.pi + 0.1
    b = ParticleSet.unweighted(rows).moments
    assert np.isclose(abs(b.x[2]), np.pi)
    assert np.isclose(b.P[2, 2], 0.01)


@given(st.integers(0, 2**32), st.floats(0, 1))
def test_roughening_keeps_mean_and_covariance(seed, share):
    rng, n = np.random.default_rng(seed), 4000
    cloud = ParticleSet.unweighted(rng.multivariate_normal([3, -1], random_covariance(rng, 2), n))
    after, before = cloud.roughened(share, rng).moments, cloud.moments
    sigmas = np.sqrt(np.diag(before.P))
    assert (np.abs(after.x - before.x) < 8 * sigmas / np.sqrt(n)).all()
    off = np.abs(after.P - before.P) / np.outer(sigmas, sigmas)
    assert (off < 8 * np.sqrt(3 / n)).all()


def watch(mcl, truth, steps, rng, named=True):
    """Drive a square and look round; the distance of the mean from the truth [m]."""
    for _ in range(steps):
        odometry = arc(0.2, 0.3, 0.4)
        truth = sample_motion(truth[None], odometry, ROBOT, rng)[0]
        z = models.h(truth, MAP) + rng.multivariate_normal([0, 0], R, len(MAP))
        mcl.predict(odometry, ROBOT)
        mcl.update(z, R, range(len(MAP)) if named else None)
    return np.hypot(*(mcl.particles.moments.x - truth)[:2])


@pytest.mark.parametrize("named", [True, False])
def test_global_localisation_finds_the_robot_in_its_map(named):
    for seed in range(3):
        rng = np.random.default_rng(seed)
        mcl = MCL(uniform(5000, [-4, -5], [4, 4], rng), MAP, rng)
        assert watch(mcl, np.array([0.5, -1.0, 2.0]), 12, rng, named) < 0.3


def test_one_particle_follows_odometry_and_keeps_its_weight():
    mcl = MCL(ParticleSet.unweighted(np.zeros((1, 3))), MAP, np.random.default_rng(0))
    mcl.predict([0.2, 0, 0.1], STILL)
    mcl.update(models.h(np.array([1.0, 1.0, 0.0]), MAP), R, range(4))
    np.testing.assert_allclose(mcl.particles.rows, [[0.2, 0, 0.1]])
    assert mcl.particles.weights.tolist() == [1]
    assert mcl.unexplained == mcl.depleted == 0


def test_a_scan_that_no_particle_can_explain_is_omitted_and_counted(monkeypatch):
    mcl = MCL(uniform(50, [0, 0], [1, 1], np.random.default_rng(0)), MAP, np.random.default_rng(0))
    before = mcl.particles
    monkeypatch.setattr(likelihood, "of_scan", lambda x, *_: np.full(len(x), -np.inf))
    assert mcl.update(models.h(np.zeros(3), MAP), R, range(4)) == -np.inf
    np.testing.assert_array_equal(mcl.particles.rows, before.rows)
    assert mcl.unexplained == 1


def test_a_set_whose_weight_is_on_one_particle_is_counted_as_depleted():
    rows = np.zeros((20, 3))
    rows[1:, 0] = 3.0
    mcl = MCL(ParticleSet.unweighted(rows), MAP, np.random.default_rng(0))
    mcl.update(models.h(np.zeros(3), MAP), R * 1e-3, range(4))
    assert mcl.depleted == 1
    assert (mcl.particles.rows == 0).all()


def test_injected_particles_replace_others_and_the_weights_stay():
    rng = np.random.default_rng(0)
    mcl = MCL(ParticleSet.unweighted(np.zeros((50, 3))), MAP, rng)
    mcl.insert(ParticleSet.unweighted(np.ones((7, 3))))
    assert (mcl.particles.rows == 1).all(axis=1).sum() == 7
    assert np.isclose(mcl.particles.weights.sum(), 1)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda m: m.predict([0, 0], ROBOT), "odometry has shape"),
        (lambda m: m.predict([0, 0, np.nan], ROBOT), "odometry contains NaN"),
        (lambda m: m.update([[1, 0]], R, [0, 1]), "z has shape"),
        (lambda m: m.update([[np.nan, 0]], R, [0]), "z or R contains NaN"),
        (lambda m: m.update([[1, 0]], np.diag([0.0, 1]), [0]), "R is singular"),
        (lambda m: m.update([[1, 0]], np.eye(2), [4]), "landmark 4 is not one"),
        (lambda m: m.update([[1, 0]], np.eye(2), [-1]), "landmark -1 is not one"),
        (lambda m: MCL(ParticleSet.unweighted(np.zeros((3, 2))), MAP, m.rng), "must be poses"),
        (lambda m: ParticleSet.unweighted(np.zeros((0, 3))), "particles have shape"),
        (lambda m: ParticleSet.unweighted([[0, np.inf]]), "particles contain NaN"),
    ],
)
def test_bad_input_is_named_and_changes_nothing(call, message):
    mcl = MCL(ParticleSet.unweighted(np.zeros((5, 3))), MAP, np.random.default_rng(0))
    before = mcl.particles
    with pytest.raises(ValueError, match=message):
        call(mcl)
    assert mcl.particles is before
