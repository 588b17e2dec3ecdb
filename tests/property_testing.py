"""Property tests: hypothesis strategies of poses and landmarks, finite differences."""

import numpy as np
from hypothesis import strategies as st

angles = st.floats(-10, 10)
coordinates = st.floats(-20, 20)
poses = st.tuples(coordinates, coordinates, st.floats(-np.pi, np.pi)).map(np.array)
points = st.tuples(coordinates, coordinates).map(np.array)
odometry_controls = st.tuples(st.floats(-2, 2), st.floats(-3, 3)).map(np.array)
steered_controls = st.tuples(st.floats(-2, 2), st.floats(-1, 1)).map(np.array)
bases = st.floats(0.1, 3)
periods = st.floats(0.01, 1)
observation_vectors = st.tuples(st.floats(0.3, 15), st.floats(-3.1, 3.1)).map(np.array)


def same_angle(a, b, tolerance=1e-9):
    """Whether angles are equal up to whole turns."""
    return np.all(np.abs(np.exp(1j * np.asarray(a)) - np.exp(1j * np.asarray(b))) < tolerance)


def assert_same_pose(a, b, tolerance=1e-9):
    """Assert that poses are equal up to whole turns of the heading."""
    np.testing.assert_allclose(a[..., :2], b[..., :2], rtol=0, atol=tolerance)
    assert same_angle(a[..., 2], b[..., 2], tolerance)


def finite_differences(f, at, angular, step=1e-6):
    """Jacobian of f by central finite differences; rows flagged in ``angular`` are wrapped."""
    columns = []
    for unit in np.eye(len(at)):
        difference = f(at + step * unit) - f(at - step * unit)
        turn = np.angle(np.exp(1j * difference))
        columns.append(np.where(angular, turn, difference) / (2 * step))
    return np.column_stack(columns)
