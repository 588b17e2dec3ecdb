"""The error of a pose along arcs: its law is straight where the spread of places is bent."""

from itertools import islice

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.linalg import matrix_power

from slamlab.estimators.ekf_slam import predict
from slamlab.evaluation import band, nees, pose_nees, twist
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.geometry import compose, from_matrix, matrix, wrap
from slamlab.simulation.differential_drive import arc
from slamlab.sources.simulated_robot import THESIS_ROBOT, simulation

RUNS = 150
STEP = 28


@given(st.floats(-2, 2), st.floats(-3, 3))
def test_the_twist_of_an_arc_is_its_length_and_its_turn(way, turn):
    motion = arc(way - turn / 2, way + turn / 2, 1.0)
    np.testing.assert_allclose(twist(motion), [way, 0, turn], atol=1e-9)


@given(st.lists(st.floats(-2, 2), min_size=3, max_size=3))
def test_many_small_pieces_of_a_twist_make_the_whole_motion(motion):
    pose = moved_by(np.zeros(3), twist(motion))
    np.testing.assert_allclose(pose, [*motion[:2], wrap(motion[2])], atol=5e-4)


def test_small_errors_have_the_same_nees_in_the_map_and_along_arcs():
    rng = np.random.default_rng(0)
    truth, P = rng.normal(size=(50, 3)), 1e-8 * np.diag([1.0, 4.0, 2.0])
    off = 1e-4 * rng.normal(size=(50, 3))
    np.testing.assert_allclose(pose_nees(truth + off, P, truth), nees(off, P), rtol=1e-2)
    with pytest.raises(ValueError, match="positive definite"):
        pose_nees(truth, np.zeros((3, 3)), truth)


def test_a_banana_shaped_distribution_is_consistent_along_arcs_and_not_in_the_map():
    rng, truth = np.random.default_rng(0), np.array([1.0, -2.0, 0.7])
    root = np.array([[0.3, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.2]])
    sideways = np.array([[0.0, 3.0, 0.0]])  # seen from a start 3 m back, a turn throws it aside
    lean = np.eye(3) + np.outer([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]) * sideways[0, 1]
    twists = rng.standard_normal((RUNS, 3)) @ root.T @ lean.T
    poses = np.array([moved_by(truth, -one) for one in twists])
    turned = np.array([rotation(pose[2]) for pose in poses])
    P = turned @ (lean @ root @ root.T @ lean.T) @ turned.transpose(0, 2, 1)
    off = poses - truth
    off[:, 2] = wrap(off[:, 2])
    low, high = band(3, RUNS, 0.9999)
    assert low < pose_nees(poses, P, np.tile(truth, (RUNS, 1))).mean() < high
    assert nees(off, P).mean() > high


def moved_by(pose, motion):
    """A pose after a twist, driven in many small pieces."""
    pieces = 2**16
    return compose(pose, from_matrix(matrix_power(matrix(motion / pieces), pieces)))


def rotation(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


def test_most_of_odometrys_excess_in_the_map_is_the_curvature():
    """Wheels with the noise of the filter's model have a NEES above 3 in the map, after a turn."""
    in_the_map, along_arcs = [], []
    for seed in range(2000, 2000 + RUNS):
        source = simulation("room", np.random.default_rng(seed), robot=THESIS_ROBOT)
        filter = MAK(np.zeros(3), np.zeros((3, 3)), 0)
        for reading in islice(source, STEP + 1):
            predict(filter, reading, source.robot)
        pose, P, truth = filter.pose, filter.block([0, 1, 2]), source.truth.poses[STEP]
        off = pose - truth
        off[2] = wrap(float(off[2]))
        in_the_map.append(nees(off, P))
        along_arcs.append(pose_nees(pose, P, truth))
    excess = np.mean(in_the_map) - 3
    assert excess > 0.5
    assert np.mean(along_arcs) - 3 < 0.6 * excess
