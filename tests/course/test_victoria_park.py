"""EKF-SLAM on Victoria Park: its Jacobians and batch optimum, and the stored table."""

import numpy as np
import pytest

from course.studies import victoria_park
from slamlab.models.finite_differences import numerical_jacobian
from slamlab.sources import gtsam_text


def test_the_jacobians_are_those_of_the_models():
    x, p, z = np.array([1.0, -2, 0.7]), np.array([[3.0, 0.5]]), np.array([[2.0, -1]])
    pairs = [
        (victoria_park._H(x, p)[0][0], lambda x: victoria_park.h(x, p)[0], x),
        (victoria_park._H(x, p)[1][0], lambda p: victoria_park.h(x, p), p[0]),
        (victoria_park._J(x, z)[0][0], lambda x: victoria_park.g(x, z)[0], x),
        (victoria_park._J(x, z)[1][0], lambda z: victoria_park.g(x, z[None])[0], z[0]),
    ]
    for jacobian, function, at in pairs:
        np.testing.assert_allclose(jacobian, numerical_jacobian(function, at), atol=1e-6)


def graph(noise):
    """A drive of 30 poses round four landmarks, measured when they are in front of the robot."""
    rng, C, R = np.random.default_rng(3), np.diag([1e-4, 4e-6, 4e-6]), 0.04 * np.eye(2)
    pose, trees, found = np.zeros(3), np.array([[4.0, 1], [2, 6], [-3, 4], [-1, -2]]), []
    for k in range(30):
        step = np.array([0.5, 0, 0.2])
        pose = victoria_park.compose(pose, step)
        step = step + noise * rng.multivariate_normal(np.zeros(3), C)
        found.append(gtsam_text.GraphMeasurement(k, k + 1, step, C))
        for j, p in enumerate(trees):
            z = victoria_park.h(pose, p) + noise * rng.multivariate_normal(np.zeros(2), R)
            if z[0] > 0:
                found.append(gtsam_text.GraphMeasurement(k + 1, 100 + j, z, R))
    return found, trees


@pytest.mark.parametrize("method", ["standard", "first estimates"])
def test_with_little_noise_the_filter_is_the_batch_optimum(method):
    measurements, trees = graph(noise=0.01)
    run = victoria_park.run(victoria_park.METHODS[method](), measurements)
    landmarks = dict(zip(run.filter.ids, run.filter.landmarks(), strict=True))
    best = victoria_park.batch(measurements, run.poses, landmarks)
    of_ids = trees[np.array(run.filter.ids) - 100]
    np.testing.assert_allclose(best.landmarks, of_ids, atol=0.01)
    np.testing.assert_allclose(run.filter.landmarks(), best.landmarks, atol=1e-4)
    np.testing.assert_allclose(run.poses[-1], best.poses[-1], atol=1e-4)
    np.testing.assert_allclose(run.P[-1], best.P_last, rtol=0.02, atol=1e-6)
    np.testing.assert_allclose(run.filter.blocks()[2], best.P_landmarks, rtol=0.02, atol=1e-6)


def test_the_compressed_filter_has_the_estimates_of_the_standard_filter(monkeypatch):
    monkeypatch.setattr(victoria_park, "REACH", 5.0)
    measurements, _ = graph(noise=1)
    standard, compressed = (
        victoria_park.run(victoria_park.METHODS[name](), measurements)
        for name in ("standard", "compressed")
    )
    np.testing.assert_allclose(compressed.poses, standard.poses, atol=1e-9)
    np.testing.assert_allclose(compressed.P, standard.P, atol=1e-9)


def test_submaps_and_particles_come_near_the_batch_optimum(monkeypatch):
    monkeypatch.setattr(victoria_park, "SUBMAP", 10)
    measurements, _ = graph(noise=1)
    standard, submaps, particles = (
        victoria_park.run(victoria_park.METHODS[name](), measurements)
        for name in ("standard", "submaps", "FastSLAM")
    )
    landmarks = dict(zip(standard.filter.ids, standard.filter.landmarks(), strict=True))
    best = victoria_park.batch(measurements, standard.poses, landmarks)
    for run in (submaps, particles):
        error = run.poses[-1] - best.poses[-1]
        error[2] = victoria_park.wrap(error[2])
        assert victoria_park.nees(error, best.P_last) < 9
        ratio = np.trace(run.P[-1][:2, :2]) / np.trace(best.P_last[:2, :2])
        assert 0.3 < ratio < 3


def test_the_stored_table_supports_the_lesson():
    kept = victoria_park.stored()
    assert kept["counts"].tolist() == [6969, 3640, 151]
    standard, first, compressed, submaps, particles = (
        kept[f"{name} checkpoints"].T for name in victoria_park.METHODS
    )
    assert np.median(standard[2]) > 10 * np.median(first[2]), "NEES by the filter's own P"
    assert standard[0].max() > 5 * standard[1][standard[0].argmax()], "too far off for its σ"
    assert (first[2] < 5).all()
    np.testing.assert_allclose(compressed, standard, rtol=1e-3)
    assert np.median(submaps[2]) > 10 * np.median(first[2])
    assert (particles[0] > 5 * particles[1]).mean() > 0.9
    assert kept["standard"].shape == kept["batch"].shape == kept["odometry"].shape


@pytest.mark.slow
def test_the_recording_gives_the_stored_table(tmp_path, recording):
    recording("victoria-park")
    assert victoria_park.main(["--out", str(tmp_path / "park.npz")]) == 0
    with np.load(tmp_path / "park.npz") as made, np.load(victoria_park.TABLE) as kept:
        assert set(made) == set(kept)
        for name in kept:
            if name.endswith("seconds") or "FastSLAM" in name:
                continue  # particles depend on the last bits
            np.testing.assert_allclose(made[name], kept[name], rtol=1e-2, atol=1e-2, err_msg=name)
